//! The clear sky: what each kind of change costs.

use super::{
    Account, Case, Pass, Setup, Size, Work,
    stopwatch::{Stopwatch, peak_memory_bytes},
};
use crate::{commands::Failure, settings::Settings};
use serde_json::{Map, json};
use std::sync::Arc;
use welkin_encode::{Options, encode};
use welkin_scene::{
    Atmosphere, Direction, Format, ProbeRequest, Projection, Quality, Scene, SunPosition,
    renderer::{Frame, FrameOrder, Output, Pixels, Priority, Render},
};

const SIZES: [Size; 4] = [
    Size::new(640, 360),
    Size::new(900, 600),
    Size::new(1280, 720),
    Size::new(1920, 1080),
];

/// The tables of the air alone: no sun may cost them.
const AIR_TABLES: [&str; 2] = ["transmittance", "multi_scattering"];
/// The passes that see the camera: a turn may cost these and no other.
const CAMERA_PASSES: [&str; 3] = ["sky", "exposure", "tone"];

/// Directions at which the error is taken: pixels of an environment map.
const ERROR_SIZE: Size = Size::new(128, 64);

pub(super) struct Sky;

impl Case for Sky {
    fn name(&self) -> &'static str {
        "sky"
    }

    fn baseline(&self) -> Option<&'static str> {
        Some("horizon-sky")
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
        let mut scene = Scene::default();
        let quality = setup.parameter("quality")?;
        let watch = Stopwatch::start();
        let renderer = crate::open_renderer(settings)?;
        let viewer = Viewer {
            renderer: &*renderer,
            size: setup.size,
            quality,
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
        let error = viewer.error(&Scene::default())?;
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

/// Names the passes that ran and should not have.
fn forbidden(passes: &[Pass], allowed: impl Fn(&str) -> bool) -> Option<String> {
    let names = passes.iter().map(|pass| pass.pass.as_str());
    let wrong: Vec<_> = names.filter(|pass| !allowed(pass)).collect();
    (!wrong.is_empty()).then(|| format!("ran {}", wrong.join(", ")))
}

/// Somebody who looks at one scene after the other.
struct Viewer<'a> {
    renderer: &'a dyn Render,
    size: Size,
    quality: Quality,
}

impl Viewer<'_> {
    fn see(&self, work: &str, scene: &Scene) -> Result<(Work, Arc<Frame>), Failure> {
        let order = self.order(scene, self.size, Output::Display);
        let watch = Stopwatch::start();
        let frame = pollster::block_on(self.renderer.frame(order))?;
        let work = Work {
            work: work.to_owned(),
            spent: watch.stop(),
            passes: frame.passes.iter().map(Pass::from).collect(),
            error: None,
            fault: None,
        };
        Ok((work, frame))
    }

    fn order(&self, scene: &Scene, size: Size, output: Output) -> FrameOrder {
        FrameOrder {
            scene: Arc::new(scene.clone()),
            width_px: size.width_px,
            height_px: size.height_px,
            quality: self.quality,
            output,
            priority: Priority::Interactive,
        }
    }

    /// Relative RMSE of a frame's radiance against a probe of the same directions, which integrates along each of
    /// them without the sky-view table: over the whole sphere but the pixels that the horizon crosses, by solid angle,
    /// without the sun's disc.
    fn error(&self, scene: &Scene) -> Result<f64, Failure> {
        let mut scene = scene.clone();
        scene.sun.disc = false;
        scene.camera.projection = Projection::Equirectangular {};
        let order = self.order(&scene, ERROR_SIZE, Output::Linear);
        let frame = pollster::block_on(self.renderer.frame(order))?;
        let places = environment(ERROR_SIZE);
        let directions = places
            .iter()
            .map(|place| Direction::angles(place.azimuth_deg, place.elevation_deg))
            .collect();
        let truth = pollster::block_on(self.renderer.probe(ProbeRequest { scene, directions }))?;
        let Pixels::Linear(values) = &frame.pixels else {
            return Err(Failure::Bench(
                "the renderer gave a picture for radiance".to_owned(),
            ));
        };
        let (mut off, mut all) = (0.0, 0.0);
        for (place, truth) in places.iter().zip(&truth.radiance_w_m2_sr) {
            let seen = &values[3 * place.index..3 * place.index + 3];
            let weight = place.elevation_deg.to_radians().cos();
            for (seen, truth) in seen.iter().zip(truth) {
                off += weight * (f64::from(*seen) - truth).powi(2);
                all += weight * truth.powi(2);
            }
        }
        Ok((off / all).sqrt())
    }
}

/// A pixel of an environment map.
struct Place {
    index: usize,
    azimuth_deg: f64,
    elevation_deg: f64,
}

/// The centres of the pixels, west at the left edge and the zenith at the top, but those at the horizon.
fn environment(size: Size) -> Vec<Place> {
    let step_deg = 180.0 / f64::from(size.height_px);
    let mut places = Vec::new();
    let mut index = 0;
    for row in 0..size.height_px {
        for column in 0..size.width_px {
            let place = Place {
                index,
                azimuth_deg: 270.0 + 360.0 * (f64::from(column) + 0.5) / f64::from(size.width_px) - 360.0,
                elevation_deg: 90.0 - step_deg * (f64::from(row) + 0.5),
            };
            if place.elevation_deg.abs() > step_deg {
                places.push(place);
            }
            index += 1;
        }
    }
    places
}

fn encoding(work: &str, frame: &Frame, format: Format) -> Result<Work, Failure> {
    let options = Options::default();
    let watch = Stopwatch::start();
    let file = encode(frame, format, &options)?;
    let spent = watch.stop();
    drop(file);
    Ok(Work {
        work: work.to_owned(),
        spent,
        passes: Vec::new(),
        error: None,
        fault: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pass_that_should_not_have_run_is_named() {
        let ran = ["sky_view", "sky"].map(|pass| Pass {
            pass: pass.to_owned(),
            ms: 1.0,
        });
        let fault = forbidden(&ran, |pass| CAMERA_PASSES.contains(&pass));
        assert_eq!(fault.as_deref(), Some("ran sky_view"));
        assert_eq!(forbidden(&ran, |pass| !AIR_TABLES.contains(&pass)), None);
        assert_eq!(forbidden(&[], |_| false), None);
    }

    #[test]
    fn the_environment_map_has_west_at_its_left_edge_and_the_zenith_at_its_top() {
        let places = environment(Size::new(8, 4));
        // Rows at 67.5, 22.5, -22.5 and -67.5 degrees; the middle ones touch the horizon.
        assert_eq!(places.len(), 16);
        let (first, last) = (&places[0], &places[15]);
        assert_eq!(
            (first.index, first.azimuth_deg, first.elevation_deg),
            (0, -67.5, 67.5)
        );
        assert_eq!(
            (last.index, last.azimuth_deg, last.elevation_deg),
            (31, 247.5, -67.5)
        );
    }
}
