//! Wind and time.

use crate::scenes::{Seen, scene, seen};
use serde_json::{Value, json};

fn at(time_s: f64, wind: Value) -> Seen {
    seen(&scene(&json!({"time_s": time_s, "clouds": {"wind": wind}})))
}

#[test]
fn every_control_of_the_wind_acts() {
    let still = json!({"speed_m_s": 0, "evolution_m_s": 0, "shear_m": 0});
    let with = |changes: Value| crate::scenes::merged(still.clone(), &changes);
    let base = at(600.0, still.clone());
    assert!(base == at(0.0, still.clone()), "without wind time does nothing");
    for (changes, least) in [
        (json!({"speed_m_s": 10}), 0.05),
        (json!({"evolution_m_s": 2}), 0.01),
        (json!({"shear_m": 1500}), 0.02),
        (json!({"drift_m": [5000, 0, 0]}), 0.05),
        (json!({"drift_m": [0, 5000, 0]}), 0.05),
        (json!({"drift_m": [0, 0, 900]}), 0.01),
    ] {
        let found = at(600.0, with(changes.clone())).apart(&base);
        println!("{changes}: {found}");
        assert!(found > least, "{changes}: {found}");
    }
    let [west, south] =
        [270.0, 180.0].map(|azimuth: f64| at(600.0, with(json!({"speed_m_s": 10, "azimuth_deg": azimuth}))));
    assert!(west.apart(&south) > 0.05);
}

/// An observer who goes with the wind sees the clouds stand still, but for the planet's bend and for where a preview's
/// wide steps fall, which is a quarter of what standing still shows.
#[test]
fn the_wind_carries_clouds() {
    let layers = json!([{"kind": "volume", "base_m": 1500, "top_m": 3500, "type": 0.8},
                        {"kind": "sheet", "height_m": 8000, "genus": "altocumulus", "coverage": 0.4}]);
    let looking = json!({"azimuth_deg": 180, "elevation_deg": 50});
    let seen_at = |time_s: f64, position_m: [f64; 3]| {
        seen(&scene(&json!({
            "time_s": time_s,
            "camera": {"position_m": position_m, "direction": looking},
            "clouds": {"layers": layers, "wind": {"speed_m_s": 10, "azimuth_deg": 250, "evolution_m_s": 0}},
        })))
    };
    let way_m = 5000.0_f64;
    let (sin, cos) = 70_f64.to_radians().sin_cos();
    let start = seen_at(0.0, [0.0, 0.0, 2.0]);
    let stood = seen_at(way_m / 10.0, [0.0, 0.0, 2.0]);
    let went = seen_at(way_m / 10.0, [way_m * sin, way_m * cos, 2.0]);
    println!("stood {}, went {}", start.apart(&stood), start.apart(&went));
    assert!(
        start.apart(&went) < 0.35 * start.apart(&stood),
        "{}, {}",
        start.apart(&went),
        start.apart(&stood)
    );
}
