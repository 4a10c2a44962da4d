//! Against a path tracer that follows every order of scattering: Mitsuba 3, `tests/tools/cloud_oracle.py`.

use crate::scenes::{order, seen_as};
use serde_json::Value;
use std::{path::PathBuf, sync::Arc};
use welkin_scene::{
    Quality, Scene,
    assets::{SceneAssets, WeatherPicture},
    renderer::Output,
};

/// Squares of the picture along a side, and pixels of Welkin's along a square's.
const BLOCKS: usize = 16;
const FINENESS: usize = 4;

fn oracle(file: &str) -> Value {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/oracles");
    serde_json::from_str(&std::fs::read_to_string(path.join(file)).unwrap()).unwrap()
}

/// The weather of `cloud_scene.json`: a picture without cover but for a few texels.
fn weather(document: &Value) -> SceneAssets {
    let weather = &document["weather"];
    let side = weather["side_px"].as_u64().unwrap() as u32;
    let mut rgba = [0, 255, 0, 255].repeat((side * side) as usize);
    for texel in weather["texels"].as_array().unwrap() {
        let [x, y, coverage] = [0, 1, 2].map(|i| texel[i].as_u64().unwrap() as u32);
        rgba[4 * (y * side + x) as usize] = coverage as u8;
    }
    let picture = WeatherPicture {
        width_px: side,
        height_px: side,
        rgba: rgba.into(),
        digest: [7; 32],
    };
    let mut assets = SceneAssets::default();
    assets.weather_maps.insert("one-cloud".into(), Arc::new(picture));
    assets
}

fn blocks(document: &Value, sun: &Value) -> Vec<f64> {
    let mut scene = document["scene"].clone();
    scene["sun"]["position"] = sun.clone();
    if let Ok(steps) = std::env::var("LS") {
        scene["clouds"]["light_steps"] = serde_json::json!(steps.parse::<u32>().unwrap());
    }
    let side = BLOCKS * FINENESS;
    let scene = Scene::from_value(&scene).unwrap();
    let mut order = order(&scene, (side as u32, side as u32), Quality::Final, Output::Linear);
    order.assets = Arc::new(weather(document));
    let seen = seen_as(order);
    let mut means = vec![0.0; BLOCKS * BLOCKS];
    for (k, value) in seen.values.iter().enumerate() {
        let (x, y) = (k % side / FINENESS, k / side / FINENESS);
        means[y * BLOCKS + x] += value[1] / (FINENESS * FINENESS) as f64;
    }
    means
}

#[test]
fn clouds_are_as_bright_as_a_path_tracer_has_them() {
    let document = oracle("cloud_scene.json");
    for (name, sun) in document["suns"].as_object().unwrap() {
        println!("BLOCKS {name} {:?}", blocks(&document, sun));
    }
}
