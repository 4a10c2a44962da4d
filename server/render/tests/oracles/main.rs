//! Against independent programs: `tests/oracles/*.json`.
#![allow(
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    reason = "tests fail by panicking"
)]

mod multiple;
mod reference;
mod single;

use serde_json::{Value, json};
use std::sync::{Arc, LazyLock};
use welkin_render::{Renderer, RendererSettings};
use welkin_scene::{
    Direction, ProbeAnswer, ProbeRequest, Projection, Quality, Scene,
    renderer::{FrameOrder, Output, Pixels, Priority, Render},
};

type Rgb = [f64; 3];

fn oracle(name: &str) -> Value {
    let path = format!("{}/../../tests/oracles/{name}.json", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn number(row: &Value, name: &str) -> f64 {
    row[name].as_f64().unwrap()
}

fn triple(v: &Value) -> Rgb {
    [0, 1, 2].map(|i| v[i].as_f64().unwrap())
}

/// The air of the thesis, as both published oracles have it.
fn thesis(orders: &str) -> Value {
    json!({
        "planet": {"radius_m": 6_371_000},
        "atmosphere": {
            "orders": orders,
            "rayleigh": {"scattering_per_m": [5.8e-6, 13.5e-6, 33.1e-6], "scale_height_m": 7994},
            "mie": {"scattering_per_m": 2e-5, "absorption_per_m": 2e-6, "scale_height_m": 1200, "asymmetry": 0.76},
            "ozone": null
        }
    })
}

/// A document with an observer over a grey ground, a sun of unit irradiance at azimuth 0, and nothing of the night.
fn lit(document: &Value, altitude_m: f64, sun_zenith_deg: f64, albedo: f64) -> Scene {
    let mut document = document.clone();
    document["camera"] = json!({"position_m": [0, 0, altitude_m]});
    document["sun"] = json!({
        "position": {"azimuth_deg": 0, "elevation_deg": 90.0 - sun_zenith_deg},
        "irradiance_w_m2": [1, 1, 1], "disc": false,
    });
    document["planet"]["ground_albedo"] = json!([albedo, albedo, albedo]);
    document["atmosphere"]["airglow"] = Value::Null;
    document["moon"] = Value::Null;
    document["stars"] = Value::Null;
    document["clouds"] = Value::Null;
    Scene::from_value(&document).unwrap()
}

/// One renderer for all tests of this binary.
fn renderer() -> &'static Renderer {
    static RENDERER: LazyLock<Renderer> =
        LazyLock::new(|| Renderer::start(RendererSettings::default()).unwrap());
    &RENDERER
}

fn probe(scene: Scene, directions: Vec<Direction>) -> ProbeAnswer {
    let request = ProbeRequest { scene, directions };
    pollster::block_on(renderer().probe(request.into())).unwrap()
}

/// A frame of one pixel, so narrow that it is one direction.
fn pixel(mut scene: Scene, direction: Direction, quality: Quality) -> Rgb {
    scene.camera.direction = direction;
    scene.camera.projection = Projection::Perspective {
        vertical_fov_deg: 0.01,
    };
    let order = FrameOrder {
        scene: Arc::new(scene),
        assets: Arc::default(),
        width_px: 1,
        height_px: 1,
        quality,
        output: Output::Linear,
        priority: Priority::Interactive,
    };
    let frame = pollster::block_on(renderer().frame(order)).unwrap();
    let Pixels::Linear(values) = &frame.pixels else {
        unreachable!("ordered linear")
    };
    [0, 1, 2].map(|c| f64::from(values[c]))
}

/// Relative RMSE in R, G and B.
fn relative_rmse(found: &[Rgb], truth: &[Rgb]) -> Rgb {
    let square = |c: usize| {
        let pairs = found.iter().zip(truth);
        pairs.map(|(f, t)| (f[c] / t[c] - 1.0).powi(2)).sum::<f64>()
    };
    [0, 1, 2].map(|c| (square(c) / truth.len() as f64).sqrt())
}

/// Fails where a band is further off than it may be.
fn within(error: Rgb, allowed: Rgb, case: &str) {
    println!("{case}: relative RMSE {:.4?} %", error.map(|e| 100.0 * e));
    assert!(
        error.iter().zip(allowed).all(|(error, allowed)| *error < allowed),
        "{case}: {error:?}, allowed {allowed:?}"
    );
}
