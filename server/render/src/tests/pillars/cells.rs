//! Pictures, whose cells of 16×16 pixels share what they see of a pillar, against sums for each pixel.

use super::{chance::ridge, dark, engine, gaussian, lamp};
use crate::frame_job::{FrameJob, TileBudget};
use std::sync::Arc;
use welkin_scene::{
    CrystalLayer, IceCrystals, Projection, Quality, Scene,
    assets::SceneAssets,
    ice_crystals::{CrystalVariation, GaussianTilt, Tilt, UniformTilt},
    renderer::{FrameOrder, Output, Pixels, Priority},
};

const WIDTH: usize = 384;
const HEIGHT: usize = 256;

/// Radiance in the middle band of each pixel.
fn picture(scene: &Scene, assets: &SceneAssets) -> Vec<f64> {
    let order = FrameOrder {
        scene: Arc::new(scene.clone()),
        assets: Arc::new(assets.clone()),
        width_px: u32::try_from(WIDTH).unwrap(),
        height_px: u32::try_from(HEIGHT).unwrap(),
        quality: Quality::Final,
        output: Output::Linear,
        priority: Priority::Interactive,
    };
    let mut job = FrameJob::new(order, None);
    let mut budget = TileBudget::default();
    loop {
        if let Some(frame) = job.step(&mut engine(), &mut budget).unwrap() {
            match &frame.pixels {
                Pixels::Linear(values) => {
                    return values
                        .chunks_exact(values.len() / (WIDTH * HEIGHT))
                        .map(|p| f64::from(p[1]))
                        .collect();
                }
                Pixels::Display(_) => unreachable!("radiance was ordered"),
            }
        }
    }
}

/// Two lamps over the plain, looked at from 40 m.
fn base(tilt: Tilt) -> Scene {
    let mut scene = dark();
    scene.camera.position_m = [0.0, 0.0, 40.0];
    scene.camera.direction = welkin_scene::Direction::angles(90.0, 6.0);
    scene.camera.projection = Projection::Perspective {
        vertical_fov_deg: 14.0,
    };
    scene.lights = vec![
        lamp([900.0, -90.0, 8.0], 40.0),
        lamp([2_500.0, 400.0, 60.0], 300.0),
    ];
    scene.ice_crystals = Some(IceCrystals::One(CrystalLayer {
        base_m: 5.0,
        top_m: 260.0,
        tilt,
        ..CrystalLayer::default()
    }));
    scene
}

/// The farthest that a cell is off, in parts of what is allowed.
fn off(mut scene: Scene, assets: &SceneAssets) -> f64 {
    let shared = picture(&scene, assets);
    // Plates in clumps are summed in each pixel; these clumps are a millionth.
    let Some(IceCrystals::One(layer)) = &mut scene.ice_crystals else {
        unreachable!("one layer was given")
    };
    layer.variation = Some(CrystalVariation {
        amount: 1e-6,
        ..CrystalVariation::default()
    });
    let alone = picture(&scene, assets);
    assert!(shared != alone, "nothing is shared");
    let rows: Vec<f64> = alone
        .chunks_exact(WIDTH)
        .map(|row| row.iter().copied().fold(0.0, f64::max))
        .collect();
    let mut worst: f64 = 0.0;
    for (i, (shared, alone)) in shared.iter().zip(&alone).enumerate() {
        let row = i / WIDTH;
        let about = &rows[row.saturating_sub(60)..(row + 60).min(HEIGHT)];
        let brightest = about.iter().copied().fold(0.0, f64::max);
        // 0.2 % of the pillar's axis and 0.05 % of the whole pillar are what the cell's own trial allows between its rays;
        // in the cell's corners twice that.
        let allowed = 0.004 * rows[row] + 0.004 * alone + 0.001 * brightest;
        worst = worst.max((shared - alone).abs() / allowed.max(1e-30));
    }
    println!("{worst:.3}");
    worst
}

#[test]
fn cells_give_what_each_pixel_would() {
    let none = SceneAssets::default();
    for tilt in [
        gaussian(1.5, 6.0),
        gaussian(0.4, 2.0),
        Tilt::Uniform(UniformTilt { max_deg: 3.0 }),
        Tilt::Slope(GaussianTilt {
            sigma_deg: 4.0,
            max_deg: 20.0,
        }),
    ] {
        assert!(off(base(tilt.clone()), &none) < 1.0, "{tilt:?}");
    }
}

#[test]
fn cells_give_what_each_pixel_would_behind_a_ridge() {
    let (terrain, grid) = ridge();
    let mut assets = SceneAssets::default();
    if let welkin_scene::Terrain::Heightfield(field) = &terrain
        && let Some(name) = &field.name
    {
        assets.heightfields.insert(name.clone(), Arc::new(grid));
    }
    let mut scene = base(gaussian(1.5, 6.0));
    // One behind it, and one before.
    scene.lights = vec![lamp([480.0, 10.0, 14.0], 40.0), lamp([240.0, 6.0, 10.0], 2.0)];
    scene.terrain = Some(terrain);
    assert!(off(scene, &assets) < 1.0);
}
