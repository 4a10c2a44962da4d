//! The sun's place against pvlib's NREL SPA.

use serde_json::{Value, json};
use welkin_scene::{Direction, Scene};

const ORACLE: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../tests/oracles/sun_position.json"
));

/// Welkin promises 0.01°. Both sides run the same algorithm; they differ by delta-T alone (67 s there, the estimate for
/// the date here; 20 s move the sun by 0.0002° along the ecliptic) and by the oracle's five decimals.
const TOLERANCE_DEG: f64 = 0.001;

fn scene(row: &Value, refraction: bool, time_s: f64) -> Scene {
    let position = json!({
        "time": row["time"], "latitude_deg": row["latitude_deg"], "longitude_deg": row["longitude_deg"],
        "refraction": refraction,
    });
    Scene::from_value(&json!({"time_s": time_s, "sun": {"position": position}})).unwrap()
}

fn angle_deg(a: [f64; 3], b: [f64; 3]) -> f64 {
    // The chord; arccos would lose half the digits at small angles.
    let chord = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    2.0 * (chord / 2.0).asin().to_degrees()
}

#[test]
fn every_row_of_the_oracle() {
    let oracle: Value = serde_json::from_str(ORACLE).unwrap();
    let rows = oracle["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 24);
    for row in rows {
        for (refraction, elevation) in [(false, "elevation_true_deg"), (true, "elevation_refracted_deg")] {
            let expected = Direction::angles(
                row["azimuth_deg"].as_f64().unwrap(),
                row[elevation].as_f64().unwrap(),
            );
            let scene = scene(row, refraction, 0.0);
            let off = angle_deg(scene.sun_direction(), expected.unit());
            assert!(off < TOLERANCE_DEG, "{row}: {off}°, {:?}", scene.sun_place());
            let place = scene.sun_place();
            assert!(
                (place.elevation_deg - row[elevation].as_f64().unwrap()).abs() < TOLERANCE_DEG,
                "{row}"
            );
        }
    }
}

#[test]
fn time_moves_the_sun() {
    let noon = json!({"time": "2026-03-20T12:00:00Z", "latitude_deg": 0, "longitude_deg": 0});
    let one = json!({"time": "2026-03-20T13:00:00Z", "latitude_deg": 0, "longitude_deg": 0});
    let moved = scene(&noon, false, 3600.0).sun_direction();
    // The same moment, by the clock or by the scene's time.
    assert!(angle_deg(moved, scene(&one, false, 0.0).sun_direction()) < 1e-9);
    // At an equinox the sun runs along the celestial equator: 15° an hour, less by its own 0.041° a hour eastwards.
    let hour = angle_deg(scene(&noon, false, 0.0).sun_direction(), moved);
    assert!((hour - 15.0).abs() < 0.05, "{hour}");
    let back = scene(&one, false, -3600.0).sun_direction();
    assert!(angle_deg(back, scene(&noon, false, 0.0).sun_direction()) < 1e-9);
}

#[test]
fn time_leaves_a_fixed_sun_alone() {
    let at = |time_s: f64| {
        Scene::from_value(&json!({"time_s": time_s}))
            .unwrap()
            .sun_direction()
    };
    assert_eq!(at(0.0).map(f64::to_bits), at(3600.0).map(f64::to_bits));
}

#[test]
fn offsets_of_the_clock_count() {
    let utc = json!({"time": "2026-06-21T05:00:00Z", "latitude_deg": 60, "longitude_deg": 30});
    let local = json!({"time": "2026-06-21T08:00:00+03:00", "latitude_deg": 60, "longitude_deg": 30});
    let [utc, local] = [utc, local].map(|row| scene(&row, true, 0.0).sun_direction());
    assert_eq!(utc.map(f64::to_bits), local.map(f64::to_bits));
}
