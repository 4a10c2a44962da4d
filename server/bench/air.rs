//! The three ways to follow light through the air, on a planet and off it: table 6.1 of Iniesta and Pérez 2015.

use super::{
    Account, Case, Setup, Size,
    stopwatch::peak_memory_bytes,
    viewer::{AIR_TABLES, CAMERA_PASSES, Sight, Viewer, forbidden},
};
use crate::{commands::Failure, settings::Settings};
use serde::{Deserialize, Serialize};
use serde_json::{Map, json};
use std::sync::Arc;
use welkin_scene::{Camera, Direction, Method, Projection, Quality, Scene, SunPosition, preset};

/// Those of the thesis.
const SIZES: [Size; 3] = [Size::new(800, 600), Size::new(1280, 720), Size::new(1920, 1080)];

/// Of each of the thesis' integrals.
const STEPS: u32 = 30;

const VERTICAL_FOV_DEG: f64 = 60.0;
const AZIMUTH_DEG: f64 = 200.0;
const SUN_AZIMUTH_DEG: f64 = 180.0;
const SUN_ELEVATION_DEG: f64 = 35.0;

/// Rows of the frame whose pixels are compared with the reference.
const ERROR_HEIGHT_PX: u32 = 90;

/// Where the camera is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Place {
    /// Near the ground, looking at the horizon.
    Ground,
    /// In space, with a part of the planet and its limb in sight.
    Space,
}

pub(super) struct Air;

impl Case for Air {
    fn name(&self) -> &'static str {
        "air"
    }

    fn setups(&self, sizes: Option<&[Size]>) -> Vec<Setup> {
        let mut setups = Vec::new();
        for size in sizes.unwrap_or(&SIZES) {
            for place in [Place::Ground, Place::Space] {
                for method in [Method::Nested, Method::Table, Method::Lut] {
                    setups.push(Setup {
                        size: *size,
                        parameters: Map::from_iter([
                            ("method".to_owned(), json!(method)),
                            ("place".to_owned(), json!(place)),
                        ]),
                    });
                }
            }
        }
        setups
    }

    /// The first approach, seen from the same place.
    fn slower(&self, setup: &Setup) -> Option<Setup> {
        let mut slower = setup.clone();
        let method = slower
            .parameters
            .insert("method".to_owned(), json!(Method::Nested));
        (method != Some(json!(Method::Nested))).then_some(slower)
    }

    fn measure(&self, setup: &Setup, settings: &Settings) -> Result<Account, Failure> {
        let place = setup.parameter("place")?;
        let mut scene = scene(place, setup.parameter("method")?);
        let renderer = crate::open_renderer(settings)?;
        let of_size = |size| Viewer {
            renderer: &*renderer,
            size,
            quality: Quality::Final,
            assets: Arc::default(),
        };
        // Compiles the shaders and finds the size of tiles, at a quarter of the cost.
        let Size { width_px, height_px } = setup.size;
        of_size(Size::new(width_px.div_ceil(2), height_px.div_ceil(2))).see("unmeasured", &scene)?;
        let viewer = of_size(setup.size);

        scene.camera.direction = Direction::angles(AZIMUTH_DEG + 5.0, elevation_deg(place));
        let (mut turned, _) = viewer.see("camera-turned", &scene)?;
        turned.fault = forbidden(&turned.passes, |pass| CAMERA_PASSES.contains(&pass));

        scene.camera.position_m[0] += 50.0;
        scene.camera.position_m[2] += 1.0;
        let (mut moved, _) = viewer.see("camera-moved", &scene)?;
        moved.fault = forbidden(&moved.passes, |pass| !AIR_TABLES.contains(&pass));

        turn_sun(&mut scene, SUN_ELEVATION_DEG - 1.0);
        let (mut sun_moved, _) = viewer.see("sun-moved", &scene)?;
        sun_moved.fault = forbidden(&sun_moved.passes, |pass| !AIR_TABLES.contains(&pass));

        let mut works = vec![turned, moved, sun_moved];
        // Before the reference, which is not part of anybody's frame.
        let peak_memory_bytes = peak_memory_bytes();
        let error = error(&viewer, place, setup)?;
        for work in &mut works {
            work.error = Some(error);
        }
        Ok(Account {
            device: renderer.device(),
            works,
            peak_memory_bytes,
        })
    }
}

/// The thesis' own scene by day. It draws no disc, and nothing of the night, which is seen from space by day too.
fn scene(place: Place, method: Method) -> Scene {
    let mut scene = preset("complutense")
        .map(|preset| preset.scene.clone())
        .unwrap_or_default();
    turn_sun(&mut scene, SUN_ELEVATION_DEG);
    scene.sun.disc = false;
    (scene.moon, scene.stars) = (None, None);
    scene.camera = Camera {
        position_m: match place {
            Place::Ground => [0.0, 0.0, 2.0],
            Place::Space => [0.0, 0.0, 4e5],
        },
        direction: Direction::angles(AZIMUTH_DEG, elevation_deg(place)),
        projection: Projection::Perspective {
            vertical_fov_deg: VERTICAL_FOV_DEG,
        },
        ..Camera::default()
    };
    if let Some(air) = &mut scene.atmosphere {
        air.method = method;
        air.airglow = None;
        // The third approach has no loop of the thesis' to be compared with.
        let steps = (method != Method::Lut).then_some(STEPS);
        (air.view_steps, air.sun_steps) = (steps, steps);
    }
    scene
}

/// From 400 km the horizon lies 19.8° down.
const fn elevation_deg(place: Place) -> f64 {
    match place {
        Place::Ground => 0.0,
        Place::Space => -30.0,
    }
}

fn turn_sun(scene: &mut Scene, elevation_deg: f64) {
    scene.sun.position = SunPosition::Direction(Direction::angles(SUN_AZIMUTH_DEG, elevation_deg));
}

/// Of a smaller frame of the same shape, but its pixels at the horizon, against a probe with its own number of steps.
fn error(viewer: &Viewer<'_>, place: Place, setup: &Setup) -> Result<f64, Failure> {
    let truth = {
        let mut scene = scene(place, Method::Table);
        if let Some(air) = &mut scene.atmosphere {
            (air.view_steps, air.sun_steps) = (None, None);
        }
        scene
    };
    let Size { width_px, height_px } = setup.size;
    let size = Size::new((width_px * ERROR_HEIGHT_PX).div_ceil(height_px), ERROR_HEIGHT_PX);
    let [.., altitude_m] = truth.camera.position_m;
    let radius_m = truth.planet.radius_m;
    let horizon_deg = -(radius_m / (radius_m + altitude_m)).acos().to_degrees();
    let sights = perspective(size, AZIMUTH_DEG, elevation_deg(place), horizon_deg);
    viewer.error(&scene(place, setup.parameter("method")?), &truth, size, &sights)
}

/// The centres of a pinhole camera's pixels, but those within a pixel of the horizon.
fn perspective(size: Size, azimuth_deg: f64, elevation_deg: f64, horizon_deg: f64) -> Vec<Sight> {
    let (sin_az, cos_az) = azimuth_deg.to_radians().sin_cos();
    let (sin_el, cos_el) = elevation_deg.to_radians().sin_cos();
    let forward = [sin_az * cos_el, cos_az * cos_el, sin_el];
    let right = [cos_az, -sin_az, 0.0];
    let up = [-sin_az * sin_el, -cos_az * sin_el, cos_el];
    let (width, height) = (f64::from(size.width_px), f64::from(size.height_px));
    // One pixel at the distance 1.
    let pixel = 2.0 * (0.5 * VERTICAL_FOV_DEG).to_radians().tan() / height;
    let mut sights = Vec::new();
    let mut index = 0;
    for row in 0..size.height_px {
        for column in 0..size.width_px {
            let x = pixel * (f64::from(column) + 0.5 - 0.5 * width);
            let y = pixel * (0.5 * height - f64::from(row) - 0.5);
            let direction = Direction::Vector([0, 1, 2].map(|i| forward[i] + x * right[i] + y * up[i]));
            let off_deg = direction.to_angles().elevation_deg - horizon_deg;
            if off_deg.abs() > pixel.to_degrees() {
                sights.push(Sight {
                    index,
                    direction,
                    weight: 1.0,
                });
            }
            index += 1;
        }
    }
    sights
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;

    #[test]
    fn the_first_approach_alone_has_no_slower_one() {
        let setups = Air.setups(Some(&[Size::new(64, 36)]));
        assert_eq!(setups.len(), 6);
        for setup in &setups {
            let slower = Air.slower(setup);
            let first = setup.parameters["method"] == json!("nested");
            assert_eq!(slower.is_none(), first);
            if let Some(slower) = slower {
                assert!(setups.contains(&slower), "{slower:?}");
                assert_eq!(slower.parameters["place"], setup.parameters["place"]);
            }
        }
    }

    #[test]
    fn the_thesis_steps_are_those_of_its_own_approaches() {
        let steps = |method| {
            let air = scene(Place::Space, method).atmosphere.unwrap();
            (air.view_steps, air.sun_steps)
        };
        assert_eq!(steps(Method::Nested), (Some(30), Some(30)));
        assert_eq!(steps(Method::Table), (Some(30), Some(30)));
        assert_eq!(steps(Method::Lut), (None, None));
    }

    #[test]
    fn a_pinhole_camera_looks_up_at_its_top_and_right_at_its_right() {
        let sights = perspective(Size::new(3, 3), 90.0, 10.0, -50.0);
        assert_eq!(sights.len(), 9);
        let angles = |index: usize| sights[index].direction.to_angles();
        let centre = angles(4);
        assert!((centre.azimuth_deg - 90.0).abs() < 1e-9 && (centre.elevation_deg - 10.0).abs() < 1e-9);
        // A third of the way up from the lower edge to the upper: tan is even over the picture.
        let off_deg = (2.0 / 3.0 * (30_f64).to_radians().tan()).atan().to_degrees();
        assert!((angles(1).elevation_deg - 10.0 - off_deg).abs() < 1e-9);
        assert!((angles(7).elevation_deg - 10.0 + off_deg).abs() < 1e-9);
        assert!(angles(3).azimuth_deg < 90.0 && angles(5).azimuth_deg > 90.0);
        // The horizon through the middle row takes it away.
        let left: Vec<_> = perspective(Size::new(3, 9), 90.0, 0.0, 0.0)
            .iter()
            .map(|sight| sight.index)
            .collect();
        assert_eq!(left.len(), 18, "{left:?}");
        assert!(left.iter().all(|index| !(9..18).contains(index)), "{left:?}");
    }
}
