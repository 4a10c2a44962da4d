//! Against independent programs: `tests/oracles/*.json`.
#![allow(
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    reason = "tests fail by panicking"
)]

use serde_json::{Value, json};
use welkin_render::{Renderer, RendererSettings};
use welkin_scene::{Direction, ProbeAnswer, ProbeRequest, Scene, renderer::Render};

fn oracle(name: &str) -> Value {
    let path = format!("{}/../../tests/oracles/{name}.json", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// The oracles' air: the thesis' constants, a sun of unit irradiance at azimuth 0.
fn scene(altitude_m: f64, sun_zenith_deg: f64, orders: &str, albedo: f64) -> Scene {
    serde_json::from_value(json!({
        "camera": {"position_m": [0, 0, altitude_m]},
        "sun": {"position": {"azimuth_deg": 0, "elevation_deg": 90.0 - sun_zenith_deg},
                "irradiance_w_m2": [1, 1, 1], "disc": false},
        "planet": {"radius_m": 6_371_000, "ground_albedo": [albedo, albedo, albedo]},
        "moon": null,
        "stars": null,
        "atmosphere": {
            "orders": orders,
            "airglow": null,
            "rayleigh": {"scattering_per_m": [5.8e-6, 13.5e-6, 33.1e-6], "scale_height_m": 7994},
            "mie": {"scattering_per_m": 2e-5, "absorption_per_m": 2e-6, "scale_height_m": 1200, "asymmetry": 0.76},
            "ozone": null
        }
    }))
    .unwrap()
}

fn triple(v: &Value) -> [f64; 3] {
    [0, 1, 2].map(|i| v[i].as_f64().unwrap())
}

fn probe(renderer: &Renderer, scene: Scene, directions: Vec<Direction>) -> ProbeAnswer {
    pollster::block_on(renderer.probe(ProbeRequest { scene, directions })).unwrap()
}

/// Rows of one observer and sun, in the order of the file.
fn groups(rows: &[Value]) -> Vec<((f64, f64), Vec<&Value>)> {
    let mut groups: Vec<((f64, f64), Vec<&Value>)> = Vec::new();
    for row in rows {
        let key = (row[0].as_f64().unwrap(), row[1].as_f64().unwrap());
        match groups.iter_mut().find(|(k, _)| *k == key) {
            Some((_, list)) => list.push(row),
            None => groups.push((key, vec![row])),
        }
    }
    groups
}

#[test]
fn single_scattering_matches_the_oracle_in_every_direction() {
    let renderer = Renderer::start(RendererSettings::default()).unwrap();
    let oracle = oracle("single_scattering");
    for ((altitude_m, zenith_deg), rows) in groups(oracle["rows"].as_array().unwrap()) {
        let directions = rows
            .iter()
            .map(|row| Direction::angles(row[3].as_f64().unwrap(), 90.0 - row[2].as_f64().unwrap()))
            .collect();
        let answer = probe(
            &renderer,
            scene(altitude_m, zenith_deg, "single", 0.0),
            directions,
        );
        let allowed = if zenith_deg < 90.0 { 1e-3 } else { 1e-2 };
        for (i, row) in rows.iter().enumerate() {
            assert_eq!(
                answer.distance_m[i].is_some(),
                row[8].as_bool().unwrap(),
                "ground in {row}"
            );
            let (radiance, transmittance) = (triple(&row[6]), triple(&row[7]));
            for c in 0..3 {
                // What the product promises is 1 %, and 3 % with the sun below the horizon. The integrator is within
                // 0.1 % of the one; of the other within 1 %, where the light has come through 600 km of the lowest air
                // and one more table step would show. A loss of that is a fault even where the promise still holds.
                let off = (answer.radiance_w_m2_sr[i][c] - radiance[c]).abs();
                assert!(
                    off <= allowed * radiance[c] + 1e-8,
                    "{} in band {c} for {row}",
                    answer.radiance_w_m2_sr[i][c]
                );
                // f32 optical depths up to 40 are good to 1e-5 of themselves.
                let off = (answer.transmittance[i][c] - transmittance[c]).abs();
                assert!(
                    off <= 1e-3 * transmittance[c] + 1e-9,
                    "{} in band {c} for {row}",
                    answer.transmittance[i][c]
                );
            }
        }
    }
}

#[test]
fn all_orders_match_the_monte_carlo_oracle() {
    let renderer = Renderer::start(RendererSettings::default()).unwrap();
    let oracle = oracle("multiple_scattering");
    let rows = oracle["rows"].as_array().unwrap();
    for (albedo, key) in [(0.0, "total_albedo0"), (0.3, "total_albedo03")] {
        let mut squares = [0.0; 3];
        for row in rows {
            let number = |name: &str| row[name].as_f64().unwrap();
            let direction = Direction::angles(number("view_azimuth_deg"), 90.0 - number("view_zenith_deg"));
            let scene = scene(
                number("observer_alt_m"),
                number("sun_zenith_deg"),
                "multiple",
                albedo,
            );
            let answer = probe(&renderer, scene, vec![direction]);
            let expected = triple(&row[key]);
            for c in 0..3 {
                squares[c] += (answer.radiance_w_m2_sr[0][c] / expected[c] - 1.0).powi(2);
            }
        }
        let rmse = squares.map(|s: f64| (s / rows.len() as f64).sqrt());
        println!("albedo {albedo}: relative RMSE {rmse:.4?}");
        // Measured 1.8 / 1.7 / 1.3 % at albedo 0 and 1.8 / 1.2 / 1.0 % at 0.3. The product promises 5 %; what the two
        // moments of the aerosols' phase function leave out explains 2 %.
        assert!(rmse.iter().all(|e| *e < 0.02), "albedo {albedo}: {rmse:?}");
    }
}

/// The reference's scene with a sun of unit irradiance at azimuth 0 and nothing of the night.
fn reference_scene(group: &Value, altitude_m: f64, sun_zenith_deg: f64, albedo: f64) -> Scene {
    let mut document = group["scene"].clone();
    document["camera"] = json!({"position_m": [0, 0, altitude_m]});
    document["sun"] = json!({
        "position": {"azimuth_deg": 0, "elevation_deg": 90.0 - sun_zenith_deg},
        "irradiance_w_m2": [1, 1, 1], "disc": false,
    });
    document["planet"]["ground_albedo"] = json!([albedo, albedo, albedo]);
    document["atmosphere"]["airglow"] = Value::Null;
    document["moon"] = Value::Null;
    document["stars"] = Value::Null;
    Scene::from_value(&document).unwrap()
}

/// Relative RMSE in R, G and B over the rows of one observer, sun and ground of a reference file.
struct Errors {
    altitude_m: f64,
    sun_zenith_deg: f64,
    albedo: f64,
    rmse: [f64; 3],
}

fn errors(renderer: &Renderer, name: &str) -> Vec<Errors> {
    let mut found: Vec<Errors> = Vec::new();
    for group in oracle(name)["groups"].as_array().unwrap() {
        let rows = group["rows"].as_array().unwrap();
        let number = |row: &Value, name: &str| row[name].as_f64().unwrap();
        let key = |row: &Value| (number(row, "observer_alt_m"), number(row, "sun_zenith_deg"));
        for alike in rows.chunk_by(|a, b| key(a) == key(b)) {
            let (altitude_m, sun_zenith_deg) = key(&alike[0]);
            let directions: Vec<_> = alike
                .iter()
                .map(|row| {
                    Direction::angles(
                        number(row, "view_azimuth_deg"),
                        90.0 - number(row, "view_zenith_deg"),
                    )
                })
                .collect();
            for index in 0..alike[0]["totals"].as_array().unwrap().len() {
                let albedo = number(&alike[0]["totals"][index], "ground_albedo");
                let scene = reference_scene(group, altitude_m, sun_zenith_deg, albedo);
                let answer = probe(renderer, scene, directions.clone());
                let mut squares = [0.0; 3];
                for (row, radiance) in alike.iter().zip(&answer.radiance_w_m2_sr) {
                    let expected = triple(&row["totals"][index]["mean"]);
                    if std::env::var("ROWS").is_ok() {
                        println!(
                            "{name} {altitude_m} sun {sun_zenith_deg} a {albedo} view {} {} {:+.4?}",
                            row["view_zenith_deg"],
                            row["view_azimuth_deg"],
                            [0, 1, 2].map(|c| radiance[c] / expected[c] - 1.0)
                        );
                    }
                    for c in 0..3 {
                        squares[c] += (radiance[c] / expected[c] - 1.0).powi(2);
                    }
                }
                let rmse = squares.map(|s: f64| (s / alike.len() as f64).sqrt());
                println!(
                    "{name}: from {altitude_m} m, sun at {sun_zenith_deg}°, albedo {albedo}: {rmse:.4?}"
                );
                found.push(Errors {
                    altitude_m,
                    sun_zenith_deg,
                    albedo,
                    rmse,
                });
            }
        }
    }
    found
}

#[test]
fn all_orders_match_our_own_monte_carlo() {
    let renderer = Renderer::start(RendererSettings::default()).unwrap();
    for name in [
        "reference_air_thesis",
        "reference_air_earth",
        "reference_air_above",
        "reference_air_turbid",
        "reference_haze",
    ] {
        if !std::path::Path::new(&format!(
            "{}/../../tests/oracles/{name}.json",
            env!("CARGO_MANIFEST_DIR")
        ))
        .exists()
        {
            continue;
        }
        errors(&renderer, name);
    }
}
