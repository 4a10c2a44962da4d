//! Against an independent program: `tests/oracles/{single,multiple}_scattering.json`.
#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use serde_json::{Value, json};
use welkin_reference::{DVec3, Effort, Medium, View, radiance};

fn oracle(name: &str) -> Vec<Value> {
    let path = format!("{}/../../tests/oracles/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    let mut file: Value = serde_json::from_str(&text).unwrap();
    serde_json::from_value(file["rows"].take()).unwrap()
}

/// The oracles' air: the thesis' constants.
fn air() -> Medium {
    let scene = json!({
        "planet": {"radius_m": 6_371_000},
        "atmosphere": {
            "rayleigh": {"scattering_per_m": [5.8e-6, 13.5e-6, 33.1e-6], "scale_height_m": 7994},
            "mie": {"scattering_per_m": 2e-5, "absorption_per_m": 2e-6, "scale_height_m": 1200, "asymmetry": 0.76},
            "ozone": null
        }
    });
    Medium::from_scene(&serde_json::from_value(scene).unwrap()).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn triple(value: &Value) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|band| number(&value[band])))
}

/// Two batches, which is next to nothing: for what does not come from them.
const NONE: Effort = Effort {
    batch: 1,
    relative_error: 1.0,
    most_batches: 2,
    seed: 0,
};

#[test]
fn single_scattering_is_the_oracle_s_to_its_last_digits() {
    let air = air();
    for row in oracle("single_scattering") {
        let view = View {
            altitude_m: number(&row[0]),
            sun_zenith_deg: number(&row[1]),
            view_zenith_deg: number(&row[2]),
            view_azimuth_deg: number(&row[3]),
        };
        let Some(found) = radiance(&air, &view, &[0.0], &NONE) else {
            assert_eq!(triple(&row[6]), DVec3::ZERO, "{row}");
            continue;
        };
        assert_eq!(found.distance_m.is_some(), row[8].as_bool().unwrap(), "{row}");
        // The file has seven digits, and the worst row is off by 5e-7. Radiances below 1e-9, of light through optical
        // depths of 40, are zero for the product.
        for (found, expected) in [(found.single, &row[6]), (found.transmittance, &row[7])] {
            let expected = triple(expected);
            let allowed = expected * 1e-6 + 1e-15;
            assert!((found - expected).abs().cmple(allowed).all(), "{found} for {row}");
        }
    }
}

#[test]
fn all_orders_are_the_oracle_s_within_their_errors() {
    let air = air();
    // 36,000 walks a row: 0.3 % of each total, twice the oracle's own errors.
    let effort = Effort {
        batch: 200,
        relative_error: 0.0,
        most_batches: 60,
        seed: 1,
    };
    let (mut squares, mut count) = (0.0, 0.0);
    for row in oracle("multiple_scattering") {
        let view = View {
            altitude_m: number(&row["observer_alt_m"]),
            sun_zenith_deg: number(&row["sun_zenith_deg"]),
            view_zenith_deg: number(&row["view_zenith_deg"]),
            view_azimuth_deg: number(&row["view_azimuth_deg"]),
        };
        let found = radiance(&air, &view, &[0.0, 0.3], &effort).unwrap();
        for (i, albedo) in ["albedo0", "albedo03"].iter().enumerate() {
            let expected = triple(&row[format!("total_{albedo}")]);
            let theirs = triple(&row[format!("stderr_{albedo}")]);
            let ours = found.totals[i];
            let sigma = (theirs * theirs + ours.stderr * ours.stderr).powf(0.5);
            let off = (ours.mean - expected) / sigma;
            squares += (off * off).element_sum();
            count += 3.0;
            // Four standard errors: one of 78 numbers in 200 runs, and the seeds are fixed.
            assert!(
                off.abs().max_element() < 4.0,
                "{off} errors off at {albedo} for {row}"
            );
        }
    }
    println!(
        "{:.2} errors off in the root mean square",
        (squares / count).sqrt()
    );
}
