//! The clear sky: what each kind of change costs.

use super::{
    Account, Case, Setup, Size, Work,
    stopwatch::{Stopwatch, peak_memory_bytes},
    viewer::{AIR_TABLES, CAMERA_PASSES, Sight, Viewer, forbidden},
};
use crate::{commands::Failure, settings::Settings};
use serde_json::{Map, json};
use std::sync::Arc;
use welkin_encode::{Options, encode};
use welkin_scene::{Atmosphere, Direction, Format, Projection, Quality, Scene, SunPosition, renderer::Frame};

const SIZES: [Size; 4] = [
    Size::new(640, 360),
    Size::new(900, 600),
    Size::new(1280, 720),
    Size::new(1920, 1080),
];

/// Directions at which the error is taken: pixels of an environment map.
const ERROR_SIZE: Size = Size::new(128, 64);

pub(super) struct Sky;

impl Case for Sky {
    fn name(&self) -> &'static str {
        "sky"
    }

    fn baselines(&self, _setup: &Setup) -> &'static [&'static str] {
        &["horizon-sky"]
    }

    fn setups(&self, sizes: Option<&[Size]>) -> Vec<Setup> {
        let setups = |size: &Size| {
            [Quality::Preview, Quality::Final].map(|quality| Setup {
                size: *size,
                parameters: Map::from_iter([("quality".to_owned(), json!(quality))]),
            })
        };
        sizes.unwrap_or(&SIZES).iter().flat_map(setups).collect()
    }

    fn measure(&self, setup: &Setup, settings: &Settings) -> Result<Account, Failure> {
        let mut scene = Scene::clear();
        let quality = setup.parameter("quality")?;
        let watch = Stopwatch::start();
        let renderer = crate::open_renderer(settings)?;
        let viewer = Viewer {
            renderer: &*renderer,
            size: setup.size,
            quality,
            assets: Arc::default(),
        };
        let (mut first, _) = viewer.see("first-frame", &scene)?;
        first.spent = watch.stop();

        // A fresh process's second frame still pays for memory and for finding the size of tiles.
        turn_sun(&mut scene, 34.0);
        viewer.see("unmeasured", &scene)?;

        turn_sun(&mut scene, 33.0);
        let (mut sun_moved, _) = viewer.see("sun-moved", &scene)?;
        sun_moved.fault = forbidden(&sun_moved.passes, |pass| !AIR_TABLES.contains(&pass));

        scene.camera.direction = Direction::angles(190.0, 12.0);
        let (mut camera_turned, _) = viewer.see("camera-turned", &scene)?;
        camera_turned.fault = forbidden(&camera_turned.passes, |pass| CAMERA_PASSES.contains(&pass));

        let (mut nothing_changed, _) = viewer.see("nothing-changed", &scene)?;
        nothing_changed.fault = forbidden(&nothing_changed.passes, |_| false);

        scene.atmosphere = Some(Atmosphere {
            density_factor: 1.1,
            ..Atmosphere::default()
        });
        let (mut air_changed, frame) = viewer.see("air-changed", &scene)?;
        if air_changed.passes.is_empty() {
            air_changed.fault = Some("names no pass, so nothing is known of the passes that ran".to_owned());
        }

        let mut works = vec![first, sun_moved, camera_turned, nothing_changed, air_changed];
        works.push(encoding("encode-png", &frame, Format::Png)?);
        works.push(encoding("encode-jpeg", &frame, Format::Jpeg)?);
        // Before the reference, which is not part of anybody's frame.
        let peak_memory_bytes = peak_memory_bytes();
        let error = error(&viewer)?;
        for work in works.iter_mut().filter(|work| !work.passes.is_empty()) {
            work.error = Some(error);
        }
        Ok(Account {
            device: renderer.device(),
            works,
            peak_memory_bytes,
        })
    }
}

fn turn_sun(scene: &mut Scene, elevation_deg: f64) {
    scene.sun.position = SunPosition::Direction(Direction::angles(180.0, elevation_deg));
}

/// Over the whole sphere but the pixels that the horizon crosses, without the sun's disc.
fn error(viewer: &Viewer<'_>) -> Result<f64, Failure> {
    let mut scene = Scene::clear();
    scene.sun.disc = false;
    scene.camera.projection = Projection::Equirectangular {};
    viewer.error(&scene, &scene, ERROR_SIZE, &environment(ERROR_SIZE))
}

/// The centres of the pixels, west at the left edge and the zenith at the top, but those at the horizon.
fn environment(size: Size) -> Vec<Sight> {
    let step_deg = 180.0 / f64::from(size.height_px);
    let mut sights = Vec::new();
    let mut index = 0;
    for row in 0..size.height_px {
        for column in 0..size.width_px {
            let azimuth_deg = 360.0 * (f64::from(column) + 0.5) / f64::from(size.width_px) - 90.0;
            let elevation_deg = 90.0 - step_deg * (f64::from(row) + 0.5);
            if elevation_deg.abs() > step_deg {
                sights.push(Sight {
                    index,
                    direction: Direction::angles(azimuth_deg, elevation_deg),
                    weight: elevation_deg.to_radians().cos(),
                });
            }
            index += 1;
        }
    }
    sights
}

fn encoding(work: &str, frame: &Frame, format: Format) -> Result<Work, Failure> {
    let options = Options::default();
    let watch = Stopwatch::start();
    let file = encode(frame, format, &options)?;
    let spent = watch.stop();
    drop(file);
    Ok(Work {
        work: work.to_owned(),
        varied: Map::new(),
        spent,
        passes: Vec::new(),
        error: None,
        flip: None,
        fault: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_environment_map_has_west_at_its_left_edge_and_the_zenith_at_its_top() {
        let sights = environment(Size::new(8, 4));
        // Rows at 67.5, 22.5, -22.5 and -67.5 degrees; the middle ones touch the horizon.
        assert_eq!(sights.len(), 16);
        let (first, last) = (&sights[0], &sights[15]);
        assert_eq!(
            (first.index, first.direction),
            (0, Direction::angles(-67.5, 67.5))
        );
        assert_eq!(
            (last.index, last.direction),
            (31, Direction::angles(247.5, -67.5))
        );
    }
}
