//! Weather maps: every control, both conventions of pictures, and blends.

use crate::scenes::{Seen, clear, clouds, seen, seen_with};
use serde_json::{Value, json};
use std::{
    hash::{DefaultHasher, Hash, Hasher},
    sync::Arc,
};
use welkin_scene::assets::{SceneAssets, WeatherPicture};

fn of(map: Value) -> Seen {
    seen(&clouds(
        json!({"layers": [{"kind": "volume", "base_m": 1500, "top_m": 3500}], "weather_map": map}),
    ))
}

#[test]
fn every_control_of_a_map_from_noise_acts() {
    let base = of(json!({"kind": "procedural"}));
    for changes in [
        json!({"kind": "procedural", "extent_m": 30_000}),
        json!({"kind": "procedural", "seed": 9}),
    ] {
        let found = of(changes.clone()).apart(&base);
        println!("{changes}: {found}");
        assert!(found > 0.05, "{changes}: {found}");
    }
}

#[test]
fn every_control_of_an_even_map_acts() {
    let clear = seen(&clear());
    let even = |coverage: f64, cloud_type: f64| {
        of(json!({"kind": "uniform", "coverage": coverage, "type": cloud_type}))
    };
    let found = [0.4, 0.7, 1.0].map(|coverage| even(coverage, 0.5).changed(&clear));
    println!("even coverage: {found:?}");
    assert!(
        found[2] > found[0] + 0.05 && found[1] >= found[0] && found[2] >= found[1],
        "{found:?}"
    );
    assert!(even(1.0, 0.0).apart(&even(1.0, 0.5)) > 0.01);
    assert!(even(1.0, 1.0).apart(&even(1.0, 0.5)) > 0.01);
}

/// A picture of a few texels, rows from the top.
fn picture(width_px: u32, rgba: Vec<u8>) -> SceneAssets {
    let mut digest = [0; 32];
    let mut hasher = DefaultHasher::new();
    rgba.hash(&mut hasher);
    digest[..8].copy_from_slice(&hasher.finish().to_le_bytes());
    let height_px = rgba.len() as u32 / 4 / width_px;
    let picture = WeatherPicture {
        width_px,
        height_px,
        rgba: rgba.into(),
        digest,
    };
    let mut assets = SceneAssets::default();
    assets.weather_maps.insert("front".into(), Arc::new(picture));
    assets
}

fn shown(convention: &str, texel: [u8; 4], layer: Value) -> Seen {
    // The second convention's high cover counts beyond a half.
    let coverage = if convention == "coverage-type-rain" {
        0.5
    } else {
        0.8
    };
    let scene = clouds(json!({
        "coverage": coverage,
        "layers": [layer],
        "precipitation": 1,
        "weather_map": {"kind": "asset", "name": "front", "convention": convention, "extent_m": 20_000},
    }));
    seen_with(&scene, picture(16, texel.repeat(256)))
}

fn volume() -> Value {
    json!({"kind": "volume", "base_m": 1500, "top_m": 3500})
}

#[test]
fn channels_of_the_first_convention_are_coverage_type_and_rain() {
    let clear = seen(&clear());
    let of = |r: u8, g: u8, b: u8| shown("coverage-type-rain", [r, g, b, 255], volume());
    let [none, all] = [0, 255].map(|r| of(r, 128, 0).changed(&clear));
    assert!(none < 0.01 && all > 0.5, "coverage: {none}, {all}");
    let types = of(255, 0, 0).apart(&of(255, 255, 0));
    // That it acts; nothing else differs.
    assert!(types > 0.01, "type: {types}");
    let [dry, wet] = [0, 255].map(|b| of(255, 128, b).light());
    assert!(wet < 0.95 * dry, "rain: {wet}, {dry}");
}

#[test]
fn channels_of_the_second_convention_are_low_high_height_and_density() {
    let clear = seen(&clear());
    let of = |texel: [u8; 4]| shown("low-high-height-density", texel, volume());
    let none = of([0, 0, 255, 255]).changed(&clear);
    let low = of([255, 0, 255, 255]);
    let high = of([0, 255, 255, 255]);
    assert!(none < 0.01, "none: {none}");
    assert!(low.changed(&clear) > 0.5 && high.changed(&clear) > 0.1);
    let found = [
        ("low or high", low.apart(&high), 0.01),
        ("height", low.apart(&of([255, 0, 80, 255])), 0.01),
        ("density", low.apart(&of([255, 0, 255, 40])), 0.01),
    ];
    println!("{found:?}");
    assert!(found.iter().all(|(_, apart, least)| apart > least), "{found:?}");
}

/// North is up, and the origin is in the middle: cloud in the picture's upper half stands to the north.
#[test]
fn pictures_have_north_at_the_top() {
    let half =
        |upper: u8, lower: u8| [[upper, 128, 0, 255].repeat(128), [lower, 128, 0, 255].repeat(128)].concat();
    let towards = |azimuth_deg: f64, texels: Vec<u8>| {
        let scene = crate::scenes::scene(&json!({
            "camera": {"direction": {"azimuth_deg": azimuth_deg, "elevation_deg": 35}, "projection": {"vertical_fov_deg": 40}},
            "clouds": {"coverage": 0.3, "layers": [volume()], "shadows": false,
                       "weather_map": {"kind": "asset", "name": "front", "extent_m": 200_000}},
        }));
        let without = welkin_scene::Scene {
            clouds: None,
            ..scene.clone()
        };
        seen_with(&scene, picture(16, texels)).changed(&seen(&without))
    };
    let found = [
        towards(0.0, half(255, 0)),
        towards(180.0, half(255, 0)),
        towards(0.0, half(0, 255)),
        towards(180.0, half(0, 255)),
    ];
    println!("{found:?}");
    assert!(
        found[0] > 0.5 && found[1] < 0.2 && found[2] < 0.2 && found[3] > 0.5,
        "{found:?}"
    );
}

#[test]
fn a_blend_goes_from_one_map_to_the_other() {
    let (from, to) = (
        json!({"kind": "procedural", "seed": 3}),
        json!({"kind": "procedural", "seed": 8}),
    );
    let [first, middle, last] =
        [0.0, 0.5, 1.0].map(|share| of(json!({"kind": "blend", "from": from, "to": to, "share": share})));
    assert!(first == of(from));
    // The second map comes with the roundings of a mix.
    assert!(
        last.apart(&of(to)) < 1e-3,
        "{}",
        last.apart(&of(json!({"kind": "procedural", "seed": 8})))
    );
    assert!(middle.apart(&first) > 0.02 && middle.apart(&last) > 0.02);
}

/// Clouds that the weather keeps away darken nothing.
#[test]
fn an_empty_map_casts_no_shadow() {
    let empty = clouds(json!({
        "shadows": true,
        "layers": [volume()],
        "weather_map": {"kind": "uniform", "coverage": 0, "type": 0.5},
    }));
    let found = seen(&empty).apart(&seen(&clear()));
    println!("empty map: {found}");
    // A preview's own error in the air.
    assert!(found < 0.01, "{found}");
}
