//! The published figures are those that this program finds.
#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use serde_json::Value;
use std::fs;
use welkin_reference::{DVec3, Effort, Medium, View, diffuse_irradiance, radiance};

const SETS: [&str; 5] = ["thesis", "earth", "above", "turbid", "haze"];
/// Of so many rows one is computed again.
const EVERY: usize = 5;
/// Standard errors. A fault in the physics is many of them; an error that comes from 60 batches of 180 walks is itself
/// uncertain by 9 %, so that beyond 4 there is more than a Gaussian's one number in 16,000.
const ALLOWED: f64 = 5.0;
const EFFORT: Effort = Effort {
    batch: 60,
    relative_error: 0.0,
    most_batches: 60,
    seed: 3,
};

fn triple(value: &Value) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|band| value[band].as_f64().unwrap()))
}

fn view(row: &Value) -> View {
    // A sky has no view; any will do.
    let number = |name: &str| row[name].as_f64().unwrap_or(0.0);
    View {
        altitude_m: number("observer_alt_m"),
        sun_zenith_deg: number("sun_zenith_deg"),
        view_zenith_deg: number("view_zenith_deg"),
        view_azimuth_deg: number("view_azimuth_deg"),
    }
}

fn albedos(totals: &Value) -> Vec<f64> {
    let totals = totals.as_array().unwrap();
    totals
        .iter()
        .map(|total| total["ground_albedo"].as_f64().unwrap())
        .collect()
}

fn agree(found: &welkin_reference::Figure, published: &Value, row: &Value) {
    let (mean, stderr) = (triple(&published["mean"]), triple(&published["stderr"]));
    let sigma = (found.stderr * found.stderr + stderr * stderr).powf(0.5);
    let off = (found.mean - mean).abs();
    assert!(off.cmple(sigma * ALLOWED).all(), "{found:?} for {row}");
}

#[test]
fn every_file_holds_this_program_s_figures() {
    for set in SETS {
        let path = format!(
            "{}/../../tests/oracles/reference_air_{set}.json",
            env!("CARGO_MANIFEST_DIR")
        );
        let file: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
        for group in file["groups"].as_array().unwrap() {
            let scene = serde_json::from_value(group["scene"].clone()).unwrap();
            let air = Medium::from_scene(&scene).unwrap();
            let rows = group["rows"].as_array().unwrap();
            for row in rows.iter().step_by(EVERY) {
                let found = radiance(&air, &view(row), &albedos(&row["totals"]), &EFFORT).unwrap();
                for (exact, name) in [
                    (found.single, "single"),
                    (found.ground, "sunlit_ground"),
                    (found.transmittance, "transmittance"),
                ] {
                    // Seven digits are written.
                    let published = triple(&row[name]);
                    assert!(
                        (exact - published).abs().cmple(published * 1e-6).all(),
                        "{name} {exact} in {row}"
                    );
                }
                for (found, total) in found.totals.iter().zip(row["totals"].as_array().unwrap()) {
                    agree(found, total, row);
                }
            }
            for sky in group["skies"].as_array().unwrap() {
                let totals = &sky["diffuse_irradiance"];
                let found = diffuse_irradiance(&air, &view(sky), &albedos(totals), &EFFORT);
                for (found, total) in found.iter().zip(totals.as_array().unwrap()) {
                    agree(found, total, sky);
                }
            }
        }
    }
}
