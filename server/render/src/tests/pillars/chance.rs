//! Against plates thrown by chance (`tests/tools/pillar_oracle.py`), behind a wall.

use super::{
    gaussian, lamp,
    oracle::{black, standing},
    radiance, with,
};
use glam::DVec3;
use serde_json::Value;
use std::{f64::consts::TAU, fs, sync::Arc};
use welkin_scene::{CrystalLayer, assets::SceneAssets};

#[test]
fn plates_thrown_by_chance_shine_as_much() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/oracles/pillar_plates.json"
    );
    let oracle: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let number = |value: &Value| value.as_f64().unwrap();
    let layer = CrystalLayer {
        base_m: 0.0,
        top_m: 220.0,
        number_density_per_m3: 2e4,
        plate_area_m2: 5e-9,
        tilt: gaussian(2.0, 6.0),
        extinction_per_m: 3e-4,
        ..CrystalLayer::default()
    };
    let mut scene = with(layer, vec![lamp([500.0, 0.0, 12.0], 1e3)]);
    let at = |y: f64, z: f64| DVec3::new(430.0, y, z);
    let wall = black(&[[
        at(-100.0, -1.0),
        at(100.0, -1.0),
        at(100.0, 26.0),
        at(-100.0, 26.0),
    ]]);
    let mut assets = SceneAssets::default();
    assets.meshes.insert("wall".into(), Arc::new(wall));
    scene.terrain = Some(standing());
    // The tool counts what meets a disc of a few metres, from a cone of directions: both are averaged here.
    let half = number(&oracle["half_deg"]).to_radians();
    let disc_m = number(&oracle["disc_m"]);
    let values = oracle["values"].as_array().unwrap();
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
    let (places, looks) = (12, 60);
    for (a, b) in spiral(places) {
        for (value, sum) in values.iter().zip(&mut sums) {
            let (forward, up) = frame(number(&value["elevation_deg"]));
            let place = DVec3::new(0.0, 0.0, 40.0) + disc_m * (a * DVec3::Y + b * up);
            scene.camera.position_m = place.to_array();
            let directions: Vec<_> = spiral(looks)
                .map(|(x, y)| forward + half.tan() * (x * DVec3::Y + y * up))
                .collect();
            *sum += radiance(&scene, &assets, &directions).iter().sum::<f64>();
        }
    }
    for (value, sum) in values.iter().zip(sums) {
        let found = sum / f64::from(places * looks);
        let (expected, error) = (number(&value["L"]), number(&value["error"]));
        println!(
            "{}°: {found:.4e} for {expected:.4e} ± {error:.1e}",
            value["elevation_deg"]
        );
        // Three of its standard errors, and 2 % for these sums over few places.
        assert!(
            (found - expected).abs() < 3.0 * error + 0.02 * expected,
            "{value}: {found}"
        );
    }
}
