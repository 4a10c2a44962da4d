//! Whatever a document says of lamps and plates is seen.

use super::{chance::ridge, lamp, sights};
use crate::tests::engine;
use glam::DVec3;
use serde_json::{Value, json};
use std::sync::Arc;
use welkin_scene::{
    Scene,
    assets::{LampList, SceneAssets},
};

/// A lamp, a town by chance and plates in clumps, on a ridge.
fn base() -> Value {
    json!({
        "atmosphere": null, "clouds": null, "moon": null, "stars": null, "shafts": null, "haze": null,
        "sun": {"irradiance_w_m2": [0, 0, 0]},
        "time_s": 60,
        "camera": {"position_m": [0, 0, 40]},
        "terrain": {"kind": "heightfield", "name": "ridge", "centre_m": [250, 0], "edge_fade": 0},
        "lights": [{"position_m": [480, 30, 12], "lamp": "white-led", "colour_temperature_k": 3000, "luminous_intensity_cd": 900,
                    "radius_m": 0.3}],
        "town": {"kind": "procedural", "seed": 3, "count": 4, "centre_m": [460, 0], "radius_m": 60, "height_m": 14},
        "ice_crystals": {"base_m": 5, "top_m": 90, "variation": {}},
    })
}

/// Three bands along views in which all parts are seen.
fn seen(document: &Value, assets: &SceneAssets) -> Vec<f64> {
    let scene = Scene::from_value(document).unwrap();
    let directions: Vec<DVec3> = (0..60_u32)
        .map(|i| {
            let (across, up) = (f64::from(i % 12) - 6.0, f64::from(i / 12));
            DVec3::new(1.0, 0.02 * across, 0.06 * up - 0.03)
        })
        .collect();
    let (seen, _) = engine().probe(&scene, assets, &sights(&directions)).unwrap();
    seen.iter().flat_map(|s| s.radiance).collect()
}

fn assets() -> SceneAssets {
    let (_, grid) = ridge();
    let mut assets = SceneAssets::default();
    assets.heightfields.insert("ridge".into(), Arc::new(grid));
    for (name, east_m) in [("hull", 20.0), ("bergen", -30.0)] {
        let lights = [lamp([east_m, 10.0, 14.0], 3.0)].into();
        let mut digest = [0; 32];
        digest[..name.len()].copy_from_slice(name.as_bytes());
        assets
            .lights
            .insert(name.into(), Arc::new(LampList { lights, digest }));
    }
    assets
}

/// Sets what pointers name, each from what stands before.
fn changed(pointer: &str, value: Value) -> Value {
    let mut document = base();
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    let held = document.pointer_mut(parent).unwrap();
    held.as_object_mut().unwrap().insert(key.to_owned(), value);
    document
}

fn differ(what: &str, a: &[f64], b: &[f64]) {
    let most = a.iter().chain(b).fold(0.0_f64, |m, v| m.max(*v));
    let off = a.iter().zip(b).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    // Far above what f32 rounds.
    assert!(off > 1e-3 * most, "{what} has no effect: {off} of {most}");
}

#[test]
fn every_parameter_has_an_effect() {
    let assets = assets();
    let before = seen(&base(), &assets);
    for (pointer, value) in [
        ("/lights/0/position_m", json!([470, 35, 12])),
        ("/lights/0/above", json!("ground")),
        ("/lights/0/lamp", json!("incandescent")),
        ("/lights/0/colour_temperature_k", json!(6000)),
        ("/lights/0/luminous_intensity_cd", json!(1800)),
        ("/lights/0/radius_m", json!(3)),
        ("/lights/0/emission", json!("cosine-up")),
        ("/lights/0/emission", json!("full-cutoff")),
        (
            "/lights",
            json!([{"position_m": [480, 30, 12], "radiant_intensity_w_sr": [0.001, 0.01, 0.02]}]),
        ),
        ("/town/seed", json!(4)),
        ("/town/count", json!(9)),
        ("/town/centre_m", json!([440, 0])),
        ("/town/radius_m", json!(90)),
        ("/town/height_m", json!(18)),
        ("/town/above", json!("ground")),
        ("/town/lamp", json!("mercury")),
        ("/town/luminous_intensity_cd", json!(3000)),
        ("/town/lamp_radius_m", json!(3)),
        ("/town/emission", json!("full-cutoff")),
        (
            "/town",
            json!({"kind": "asset", "name": "hull", "position_m": [450, 0, 0]}),
        ),
        ("/ice_crystals/base_m", json!(30)),
        ("/ice_crystals/top_m", json!(60)),
        ("/ice_crystals/number_density_per_m3", json!(30_000)),
        ("/ice_crystals/plate_area_m2", json!(1e-8)),
        (
            "/ice_crystals/tilt",
            json!({"kind": "gaussian", "sigma_deg": 2.5}),
        ),
        ("/ice_crystals/tilt", json!({"kind": "gaussian", "max_deg": 1.5})),
        ("/ice_crystals/tilt", json!({"kind": "uniform"})),
        ("/ice_crystals/tilt", json!({"kind": "uniform", "max_deg": 5})),
        (
            "/ice_crystals/tilt",
            json!({"kind": "slope", "sigma_deg": 9, "max_deg": 40}),
        ),
        ("/ice_crystals/reflectance", json!("outer")),
        ("/ice_crystals/extinction_per_m", json!(2e-3)),
        ("/ice_crystals/variation", json!(null)),
        ("/ice_crystals/variation/amount", json!(1)),
        ("/ice_crystals/variation/scale_m", json!(60)),
        ("/ice_crystals/variation/seed", json!(8)),
        ("/ice_crystals/variation/speed_m_s", json!(9)),
        ("/ice_crystals/variation/azimuth_deg", json!(90)),
        ("/time_s", json!(0)),
        (
            "/ice_crystals",
            json!([{"base_m": 5, "top_m": 90, "variation": {}}, {"top_m": 40}]),
        ),
    ] {
        differ(
            &format!("{pointer} {value}"),
            &before,
            &seen(&changed(pointer, value.clone()), &assets),
        );
    }
    // Tilts of one law against each other.
    let tilted = |tilt: Value| seen(&changed("/ice_crystals/tilt", tilt), &assets);
    for kind in ["gaussian", "slope"] {
        let wide = tilted(json!({"kind": kind, "sigma_deg": 9, "max_deg": 40}));
        differ(
            kind,
            &wide,
            &tilted(json!({"kind": kind, "sigma_deg": 6, "max_deg": 40})),
        );
        differ(
            kind,
            &wide,
            &tilted(json!({"kind": kind, "sigma_deg": 9, "max_deg": 5})),
        );
    }
    // At 15° slopes and angles are told apart.
    differ(
        "slope",
        &tilted(json!({"kind": "slope", "sigma_deg": 15, "max_deg": 40})),
        &tilted(json!({"kind": "gaussian", "sigma_deg": 15, "max_deg": 40})),
    );
    let town = |more: Value| {
        let mut town = json!({"kind": "asset", "name": "hull", "position_m": [450, 0, 0]});
        for (key, value) in more.as_object().unwrap() {
            town[key] = value.clone();
        }
        seen(&changed("/town", town), &assets)
    };
    let hull = town(json!({}));
    for more in [
        json!({"name": "bergen"}),
        json!({"position_m": [450, 8, 2]}),
        json!({"azimuth_deg": 120}),
        json!({"factor": 2}),
    ] {
        differ(&more.to_string(), &hull, &town(more.clone()));
    }
}
