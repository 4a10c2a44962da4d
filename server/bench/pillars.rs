//! Light pillars: what lamps cost, few and many, in the open and among hills.

use super::{
    Account, Case, Setup, Size, Work,
    stopwatch::{Stopwatch, peak_memory_bytes},
    viewer::Viewer,
};
use crate::{commands::Failure, settings::Settings};
use serde::{Deserialize, Serialize};
use serde_json::{Map, json};
use std::sync::Arc;
use welkin_scene::{
    Direction, IceCrystals, ProbeRequest, Quality, Scene, SunPosition, Terrain, Town,
    ice_crystals::CrystalLayer,
    lights::{Above, ProceduralTown},
    renderer::Render,
    terrain::{Heightfield, Mountains},
};

const SIZES: [Size; 1] = [Size::new(1920, 1080)];

/// Those of the thesis' table 2 first.
const LAMPS: [u32; 8] = [1, 2, 5, 10, 20, 100, 1_000, 10_000];

/// What stands in the lamps' light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Ground {
    Open,
    Hills,
}

pub(super) struct Pillars;

impl Case for Pillars {
    fn name(&self) -> &'static str {
        "pillars"
    }

    fn rounds(&self) -> u32 {
        3
    }

    fn setups(&self, sizes: Option<&[Size]>) -> Vec<Setup> {
        let mut setups = Vec::new();
        for size in sizes.unwrap_or(&SIZES) {
            for ground in [Ground::Open, Ground::Hills] {
                setups.push(Setup {
                    size: *size,
                    parameters: Map::from_iter([("ground".to_owned(), json!(ground))]),
                });
            }
        }
        setups
    }

    fn measure(&self, setup: &Setup, settings: &Settings) -> Result<Account, Failure> {
        let ground: Ground = setup.parameter("ground")?;
        let renderer = crate::open_renderer(settings)?;
        let viewer = Viewer {
            renderer: &*renderer,
            size: setup.size,
            quality: Quality::Final,
            assets: Arc::default(),
        };
        // Compiles the shaders and finds the size of tiles.
        viewer.see("unmeasured", &scene(ground, 3, 0.0))?;
        viewer.see("unmeasured", &scene(ground, 0, 0.0))?;
        let (none, _) = viewer.see("no-lamps", &scene(ground, 0, 0.5))?;
        let mut works = vec![none];
        for (turn_deg, count) in (1_u32..).map(f64::from).zip(LAMPS) {
            // Turned each time, so that nothing is kept from before.
            let (mut work, _) = viewer.see("lamps", &scene(ground, count, turn_deg))?;
            work.varied = Map::from_iter([("lamps".to_owned(), json!(count))]);
            works.push(work);
        }
        looked_through(&*renderer, ground, 1, 20.0)?;
        for (turn_deg, count) in [(21.0, 0), (22.0, LOOKED_THROUGH)] {
            let mut work = looked_through(&*renderer, ground, count, turn_deg)?;
            work.varied = Map::from_iter([("lamps".to_owned(), json!(count))]);
            works.push(work);
        }
        Ok(Account {
            device: renderer.device(),
            works,
            peak_memory_bytes: peak_memory_bytes(),
        })
    }
}

/// By night, so that little but the pillars is to be done.
fn scene(ground: Ground, count: u32, turn_deg: f64) -> Scene {
    let mut scene = Scene {
        moon: None,
        stars: None,
        shafts: None,
        town: Some(Town::Procedural(ProceduralTown {
            count,
            radius_m: 6_000.0,
            centre_m: [0.0, 4_000.0],
            above: Above::Ground,
            ..ProceduralTown::default()
        })),
        ice_crystals: Some(IceCrystals::One(CrystalLayer::default())),
        ..Scene::clear()
    };
    scene.sun.position = SunPosition::Direction(Direction::angles(330.0, -30.0));
    scene.camera.direction = Direction::angles(turn_deg, 10.0);
    scene.camera.position_m = [0.0, 0.0, 60.0];
    if ground == Ground::Hills {
        scene.terrain = Some(Terrain::Heightfield(Heightfield {
            mountains: Some(Mountains {
                ridge_scale_m: 3_000.0,
                valley_radius_m: 500.0,
                ..Mountains::default()
            }),
            extent_m: Some(24_000.0),
            height_m: Some(300.0),
            ..Heightfield::default()
        }));
        scene.camera.position_m[2] = 200.0;
    }
    scene
}

/// Lamps that each of a probe's directions asks for, and directions to a side of the view.
const LOOKED_THROUGH: u32 = 100;
const SIDE: u32 = 256;

/// What a pass over the whole screen for each lamp would do, for 256×256 places of the view: a probe has no cells, and
/// asks every lamp along every direction.
fn looked_through(renderer: &dyn Render, ground: Ground, count: u32, turn_deg: f64) -> Result<Work, Failure> {
    let place = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE) - 0.5;
    let directions = (0..SIDE * SIDE)
        .map(|i| Direction::angles(turn_deg + 90.0 * place(i % SIDE), 10.0 + 60.0 * place(i / SIDE)))
        .collect();
    let request = ProbeRequest {
        scene: scene(ground, count, turn_deg),
        directions,
    };
    let watch = Stopwatch::start();
    pollster::block_on(renderer.probe(request.into()))?;
    Ok(Work {
        work: "probe".to_owned(),
        varied: Map::new(),
        spent: watch.stop(),
        passes: Vec::new(),
        error: None,
        flip: None,
        fault: None,
    })
}
