//! Against plates thrown by chance (`tests/tools/pillar_oracle.py`), behind a wall and behind a ridge.

use super::{
    gaussian, lamp,
    oracle::{black, standing},
    radiance, with,
};
use glam::DVec3;
use serde_json::Value;
use std::{f64::consts::TAU, fs, sync::Arc};
use welkin_scene::{
    CrystalLayer, Scene, Terrain,
    assets::{HeightGrid, SceneAssets},
    terrain::Heightfield,
};

/// Side of the ridge's square, metres, and its samples: 2 m apart, between which it bends by 2 cm.
const SIDE_M: f64 = 1_000.0;
const SAMPLES: u32 = 501;
const MOST_M: f64 = 40.0;

/// The tool's own ridge.
fn ridge_m(x: f64, y: f64) -> f64 {
    let off = (x - 380.0 - 0.4 * y) / 50.0;
    (28.0 + 6.0 * (y / 15.0).sin()) * (-off * off).exp()
}

pub(super) fn ridge() -> (Terrain, HeightGrid) {
    let at = |i: u32| SIDE_M * (f64::from(i) / f64::from(SAMPLES - 1) - 0.5);
    let heights: Vec<f32> = (0..SAMPLES * SAMPLES)
        .map(|i| (ridge_m(250.0 + at(i % SAMPLES), -at(i / SAMPLES)) / MOST_M) as f32)
        .collect();
    let grid = HeightGrid {
        width: SAMPLES,
        height: SAMPLES,
        heights: heights.into(),
        range_m: Some([0.0, MOST_M]),
        extent_m: Some([SIDE_M; 2]),
        digest: [9; 32],
    };
    let field = Heightfield {
        name: Some("ridge".into()),
        centre_m: [250.0, 0.0],
        extent_m: Some(SIDE_M),
        height_m: Some(MOST_M),
        edge_fade: 0.0,
        shadow: None,
        ..Heightfield::default()
    };
    (Terrain::Heightfield(field), grid)
}

fn scene() -> Scene {
    let layer = CrystalLayer {
        base_m: 0.0,
        top_m: 220.0,
        number_density_per_m3: 2e4,
        plate_area_m2: 5e-9,
        tilt: gaussian(2.0, 6.0),
        extinction_per_m: 3e-4,
        ..CrystalLayer::default()
    };
    with(layer, vec![lamp([500.0, 0.0, 12.0], 1e3)])
}

fn compare(mut scene: Scene, assets: &SceneAssets, name: &str) {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/oracles/pillar_plates.json"
    );
    let oracle: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let number = |value: &Value| value.as_f64().unwrap();
    // The tool counts what meets a disc of a few metres, from a cone of directions: both are averaged here.
    let half = number(&oracle["half_deg"]).to_radians();
    let disc_m = number(&oracle["disc_m"]);
    let values = oracle["scenes"][name].as_array().unwrap();
    let spiral = |count: u32| {
        (0..count).map(move |i| {
            let share = (f64::from(i) + 0.5) / f64::from(count);
            let (y, x) = (f64::from(i) * 0.381_966 * TAU).sin_cos();
            (share.sqrt() * x, share.sqrt() * y)
        })
    };
    let frame = |elevation_deg: f64| {
        let (sin, cos) = elevation_deg.to_radians().sin_cos();
        (DVec3::new(cos, 0.0, sin), DVec3::new(-sin, 0.0, cos))
    };
    let mut sums = vec![0.0; values.len()];
    let (places, looks) = (60, 96);
    for (a, b) in spiral(places) {
        for (value, sum) in values.iter().zip(&mut sums) {
            let (forward, up) = frame(number(&value["elevation_deg"]));
            let place = DVec3::new(0.0, 0.0, 40.0) + disc_m * (a * DVec3::Y + b * up);
            scene.camera.position_m = place.to_array();
            let directions: Vec<_> = spiral(looks)
                .map(|(x, y)| forward + half.tan() * (x * DVec3::Y + y * up))
                .collect();
            *sum += radiance(&scene, assets, &directions).iter().sum::<f64>();
        }
    }
    for (value, sum) in values.iter().zip(sums) {
        let found = sum / f64::from(places * looks);
        let (expected, error) = (number(&value["L"]), number(&value["error"]));
        println!(
            "{name} {}°: {found:.4e} for {expected:.4e} ± {error:.1e}, {:+.1} of them",
            value["elevation_deg"],
            (found - expected) / error.max(1e-12)
        );
        // Three of its standard errors, and 1 % for these sums over few places.
        assert!(
            (found - expected).abs() <= 3.0 * error + 0.01 * expected,
            "{name} {value}: {found}"
        );
    }
}

#[test]
fn plates_thrown_by_chance_shine_as_much_behind_a_wall() {
    let at = |y: f64, z: f64| DVec3::new(430.0, y, z);
    let corners = [[-100.0, -1.0], [100.0, -1.0], [100.0, 26.0], [-100.0, 26.0]];
    let mut assets = SceneAssets::default();
    let wall = black(&[corners.map(|[y, z]| at(y, z))]);
    assets.meshes.insert("wall".into(), Arc::new(wall));
    let terrain = Some(standing());
    compare(Scene { terrain, ..scene() }, &assets, "wall");
}

#[test]
fn plates_thrown_by_chance_shine_as_much_behind_a_ridge() {
    let (terrain, grid) = ridge();
    let mut assets = SceneAssets::default();
    assets.heightfields.insert("ridge".into(), Arc::new(grid));
    let terrain = Some(terrain);
    compare(Scene { terrain, ..scene() }, &assets, "ridge");
}
