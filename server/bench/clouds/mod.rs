//! Clouds: what each kind of change costs, and the tables of two published programs.

mod scenes;
mod tables;
mod truth;

use super::{
    Account, Case, Limits, Setup, Size, Work,
    stopwatch::{Stopwatch, peak_memory_bytes},
    viewer::{AIR_TABLES, CAMERA_PASSES, Viewer, forbidden},
};
use crate::{commands::Failure, settings::Settings};
use serde_json::{Map, json};
use std::sync::Arc;
use tables::Table;
use welkin_scene::{Direction, Quality, Scene, SunPosition, renderer::Render};

/// The passes that make noise and weather, which depend on seeds and frequencies alone.
const NOISE: [&str; 5] = [
    "cloud_shape",
    "cloud_detail",
    "cloud_curl",
    "cloud_weather",
    "cloud_sheet",
];
/// The passes that follow rays of view through the clouds, in final frames and in previews.
const VIEW: &str = "cloud_view";
/// Lights what they see.
const VIEW_LIGHT: &str = "cloud_view_light";
const DOME: &str = "cloud_dome";
/// Lights what came into view.
const DOME_LIGHT: &str = "cloud_dome_light";

/// The baseline `horizon` takes ten seconds and more for larger frames.
const MOST_HORIZON_PIXELS: u64 = 900 * 600;

/// What the rays of larger final frames see is not kept.
const MOST_KEPT_PIXELS: u64 = 1280 * 720;

/// Size at which the targets hold.
const TARGET_SIZE: Size = Size::new(900, 600);

pub(super) struct CloudCase;

impl Case for CloudCase {
    fn name(&self) -> &'static str {
        "clouds"
    }

    /// The baselines' frames take most of each.
    fn rounds(&self) -> u32 {
        3
    }

    /// How far frames are off is the same in every round.
    fn repeats(&self, setup: &Setup) -> bool {
        !matches!(setup.parameter("table"), Ok(Table::Truth))
    }

    fn baselines(&self, setup: &Setup) -> &'static [&'static str] {
        match setup.parameter("table") {
            Ok(Table::Changes) if pixels(setup.size) <= MOST_HORIZON_PIXELS => &["listing", "horizon"],
            Ok(Table::Changes) => &["listing"],
            Ok(Table::ShellDensity | Table::ShellCoverage) if setup.size == TARGET_SIZE => &["listing"],
            _ => &[],
        }
    }

    fn target(&self, setup: &Setup, work: &str, baseline: &str) -> Option<f64> {
        let quality = setup.parameter("quality").ok()?;
        match (baseline, work, quality) {
            _ if setup.size != TARGET_SIZE => None,
            ("listing", "sun-moved", Quality::Preview) => Some(100.0),
            ("listing", "sun-moved", Quality::Final) => Some(5.0),
            ("listing", "camera-turned", _) => Some(300.0),
            _ => None,
        }
    }

    fn limits(&self, setup: &Setup, work: &str) -> Limits {
        let judged = matches!(setup.parameter("table"), Ok(Table::Truth));
        Limits {
            error: (judged && work == "final").then_some(0.01),
            flip: (judged && work == "preview").then_some(0.05),
            ..Limits::default()
        }
    }

    fn judges_baseline(&self, setup: &Setup) -> bool {
        matches!(setup.parameter("table"), Ok(Table::Truth))
    }

    fn tables(&self) -> Vec<String> {
        let name = |table| json!(table).as_str().map(str::to_owned);
        Table::ALL.into_iter().filter_map(name).collect()
    }

    fn setups(&self, sizes: Option<&[Size]>) -> Vec<Setup> {
        let mut all = Vec::new();
        for size in sizes.unwrap_or(&tables::SIZES) {
            for table in Table::ALL {
                // At sizes that are asked for, each table once in each quality.
                let places = table.places().iter();
                let mut qualities: Vec<Quality> = places
                    .filter(|(own, _)| sizes.is_some() || own == size)
                    .flat_map(|(_, qualities)| *qualities)
                    .copied()
                    .collect();
                qualities.sort_by_key(|quality| *quality == Quality::Final);
                qualities.dedup();
                let parameters: Vec<_> = match table {
                    Table::Truth if qualities.is_empty() || pixels(*size) > pixels(tables::PATCH) => {
                        Vec::new()
                    }
                    Table::Truth => scenes::NAMES.map(|scene| ("scene", json!(scene))).into(),
                    _ => qualities
                        .iter()
                        .map(|quality| ("quality", json!(quality)))
                        .collect(),
                };
                all.extend(parameters.into_iter().map(|(name, value)| Setup {
                    size: *size,
                    parameters: Map::from_iter([
                        ("table".to_owned(), json!(table)),
                        (name.to_owned(), value),
                    ]),
                }));
            }
        }
        all
    }

    fn measure(&self, setup: &Setup, settings: &Settings) -> Result<Account, Failure> {
        let quality = || setup.parameter("quality");
        match setup.parameter("table")? {
            Table::Changes => changes(setup.size, quality()?, settings),
            Table::Noise => noise(setup.size, quality()?, settings),
            Table::Truth => {
                let scene: String = setup.parameter("scene")?;
                let renderer = crate::open_renderer(settings)?;
                let works = truth::works(&*renderer, &scenes::named(&scene), TARGET_SIZE, setup.size)?;
                // Brute force is not part of anybody's frame.
                Ok(account(&*renderer, works, None))
            }
            table => sweep(table, setup.size, quality()?, settings),
        }
    }
}

fn pixels(size: Size) -> u64 {
    u64::from(size.width_px) * u64::from(size.height_px)
}

/// What somebody does who looks at clouds.
fn changes(size: Size, quality: Quality, settings: &Settings) -> Result<Account, Failure> {
    let mut scene = tables::shell();
    let watch = Stopwatch::start();
    let renderer = crate::open_renderer(settings)?;
    let viewer = Viewer {
        renderer: &*renderer,
        size,
        quality,
        assets: Arc::default(),
    };
    let (mut first, _) = viewer.see("first-frame", &scene)?;
    first.spent = watch.stop();
    warm_up(&viewer, &scene)?;

    turn_sun(&mut scene, 39.0);
    let (mut sun_moved, _) = viewer.see("sun-moved", &scene)?;
    sun_moved.fault = forbidden(&sun_moved.passes, |pass| {
        let followed = pass == DOME || (pass == VIEW && pixels(size) <= MOST_KEPT_PIXELS);
        !AIR_TABLES.contains(&pass) && !NOISE.contains(&pass) && !followed
    });

    let before = scene.camera.direction.to_angles();
    scene.camera.direction = Direction::angles(before.azimuth_deg + 20.0, before.elevation_deg);
    let (mut turned, _) = viewer.see("camera-turned", &scene)?;
    turned.fault = forbidden(&turned.passes, |pass| {
        CAMERA_PASSES.contains(&pass) || [VIEW, VIEW_LIGHT, DOME, DOME_LIGHT].contains(&pass)
    });

    let (mut nothing_changed, _) = viewer.see("nothing-changed", &scene)?;
    nothing_changed.fault = forbidden(&nothing_changed.passes, |_| false);

    let works = vec![first, sun_moved, turned, nothing_changed];
    Ok(account(&*renderer, works, peak_memory_bytes()))
}

/// A table's frames, one after the other, each of a scene that was not there before.
fn sweep(table: Table, size: Size, quality: Quality, settings: &Settings) -> Result<Account, Failure> {
    let renderer = crate::open_renderer(settings)?;
    let viewer = Viewer {
        renderer: &*renderer,
        size,
        quality,
        assets: Arc::default(),
    };
    warm_up(&viewer, &table.scene(&Map::new())?)?;
    let mut works = Vec::new();
    for varied in table.variations() {
        let (mut work, _) = viewer.see(table.work(), &table.scene(&varied)?)?;
        work.varied = varied;
        works.push(work);
    }
    Ok(account(&*renderer, works, peak_memory_bytes()))
}

/// All noise, by a seed that was not there before, with nothing on disk.
fn noise(size: Size, quality: Quality, settings: &Settings) -> Result<Account, Failure> {
    let settings = Settings {
        disk_cache_bytes: 0,
        ..settings.clone()
    };
    let renderer = crate::open_renderer(&settings)?;
    let viewer = Viewer {
        renderer: &*renderer,
        size,
        quality,
        assets: Arc::default(),
    };
    let mut scene = tables::fair_weather();
    viewer.see("unmeasured", &scene)?;
    if let Some(clouds) = &mut scene.clouds {
        clouds.seed += 1;
    }
    let (mut made, _) = viewer.see(Table::Noise.work(), &scene)?;
    let missing: Vec<_> = NOISE
        .into_iter()
        .filter(|pass| made.passes.iter().all(|ran| ran.pass != *pass))
        .collect();
    made.fault = (!missing.is_empty()).then(|| format!("did not run {}", missing.join(", ")));
    Ok(account(&*renderer, vec![made], peak_memory_bytes()))
}

/// Compiles the shaders and finds the size of tiles, at a quarter of the cost and under another sun.
fn warm_up(viewer: &Viewer<'_>, scene: &Scene) -> Result<(), Failure> {
    let mut scene = scene.clone();
    turn_sun(&mut scene, 41.0);
    viewer.see("unmeasured", &scene).map(drop)
}

fn turn_sun(scene: &mut Scene, elevation_deg: f64) {
    scene.sun.position = SunPosition::Direction(Direction::angles(70.0, elevation_deg));
}

fn account(renderer: &dyn Render, works: Vec<Work>, peak_memory_bytes: Option<u64>) -> Account {
    Account {
        device: renderer.device(),
        works,
        peak_memory_bytes,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;

    #[test]
    fn setups_of_a_size_stand_together_so_that_the_baseline_is_asked_once() {
        let setups = CloudCase.setups(None);
        let groups = setups.chunk_by(|a, b| a.size == b.size);
        let mut seen: Vec<Size> = Vec::new();
        for group in groups {
            assert!(!seen.contains(&group[0].size), "{:?}", group[0].size);
            seen.push(group[0].size);
        }
        assert_eq!(seen.len(), tables::SIZES.len());
    }

    #[test]
    fn targets_stand_at_one_size_and_against_one_baseline() {
        let setups = CloudCase.setups(None);
        let of = |baseline: &str, work: &str| {
            let all = setups.iter().filter_map(|setup| {
                let target = CloudCase.target(setup, work, baseline)?;
                assert_eq!(setup.size, TARGET_SIZE);
                (setup.parameter::<Table>("table").unwrap() == Table::Changes).then_some(target)
            });
            all.collect::<Vec<_>>()
        };
        assert_eq!(of("listing", "sun-moved"), [100.0, 5.0]);
        assert_eq!(of("listing", "camera-turned"), [300.0, 300.0]);
        assert_eq!(of("listing", "first-frame"), [0.0; 0]);
        assert_eq!(of("horizon", "sun-moved"), [0.0; 0]);
    }

    #[test]
    fn final_frames_must_be_near_in_radiance_and_previews_in_looks() {
        let setups = CloudCase.setups(None);
        let truth: Vec<_> = setups
            .iter()
            .filter(|setup| CloudCase.judges_baseline(setup))
            .collect();
        assert_eq!(truth.len(), scenes::NAMES.len());
        for setup in &setups {
            let of = |work| {
                let limits = CloudCase.limits(setup, work);
                [limits.error, limits.flip]
            };
            let judged = truth.contains(&setup);
            assert_eq!(of("final"), [judged.then_some(0.01), None]);
            assert_eq!(of("preview"), [None, judged.then_some(0.05)]);
            assert_eq!(of("brute-force"), [None, None]);
        }
    }

    #[test]
    fn large_frames_are_not_followed_by_brute_force() {
        let compared = |size| {
            let setups = CloudCase.setups(Some(&[size]));
            let of_truth = setups.iter().filter(|setup| CloudCase.judges_baseline(setup));
            of_truth.count()
        };
        assert_eq!(compared(tables::PATCH), scenes::NAMES.len());
        assert_eq!(compared(Size::new(640, 360)), 0);
    }

    #[test]
    fn tables_are_asked_for_by_the_names_that_setups_bear() {
        let mut named: Vec<String> = Vec::new();
        for setup in CloudCase.setups(None) {
            let name = setup.parameter("table").unwrap();
            if !named.contains(&name) {
                named.push(name);
            }
        }
        let mut known = CloudCase.tables();
        known.sort();
        named.sort();
        assert_eq!(named, known);
    }
}
