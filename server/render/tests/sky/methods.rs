//! `nested`, `table` and `lut` render one scene.

use crate::scenes::{Radiance, radiance, scene};
use serde_json::{Value, json};
use welkin_scene::{Quality, Scene};

const SIDE_PX: u32 = 48;

/// Angle of the horizon below the level, degrees.
fn dip_deg(altitude_m: f64) -> f64 {
    (6.36e6 / (6.36e6 + altitude_m)).acos().to_degrees()
}

/// Light scattered once, seen from an altitude over a ground of albedo 0.2, by one method.
fn once(method: &str, altitude_m: f64, sun_deg: f64, camera: &Value) -> Scene {
    let mut camera = camera.clone();
    camera["position_m"] = json!([0, 0, altitude_m]);
    scene(json!({
        "camera": camera,
        "sun": {"position": {"azimuth_deg": 0, "elevation_deg": sun_deg}, "disc": false},
        "planet": {"ground_albedo": [0.2, 0.2, 0.2]},
        "moon": null,
        "stars": null,
        "atmosphere": {"method": method, "orders": "single", "airglow": null},
    }))
}

/// Relative RMSE over a picture, and the worst pixel. The product promises 1e-6 /sr besides the share: what is darker
/// counts as that.
fn difference(a: &Radiance, b: &Radiance) -> (f64, f64, String) {
    const DARK: f64 = 1e-6;
    let (mut off, mut all, mut worst) = (0.0, 0.0, 0.0);
    let mut place = String::new();
    for (x, y, truth) in b.pixels() {
        let found = a.at(x, y);
        for c in 0..3 {
            off += (found[c] - truth[c]).powi(2);
            all += truth[c].max(DARK).powi(2);
            let share = (found[c] - truth[c]).abs() / truth[c].max(DARK);
            if share > worst {
                worst = share;
                place = format!("({x}, {y}) band {c}: {} for {}", found[c], truth[c]);
            }
        }
    }
    ((off / all).sqrt(), worst, place)
}

/// A look along the horizon and one down to the ground.
fn cameras(altitude_m: f64) -> [Value; 2] {
    let dip = dip_deg(altitude_m);
    // From afar the planet is small.
    let wide = if altitude_m > 1e6 { 20.0 } else { 70.0 };
    let camera = |azimuth_deg: f64, elevation_deg: f64, fov_deg: f64| {
        json!({
            "direction": {"azimuth_deg": azimuth_deg, "elevation_deg": f64::max(elevation_deg, -90.0)},
            "projection": {"kind": "perspective", "vertical_fov_deg": fov_deg},
        })
    };
    [
        camera(20.0, 0.4 * wide - dip, 0.7 * wide),
        camera(120.0, -0.5 * wide - dip, 0.9 * wide),
    ]
}

#[test]
fn the_methods_agree_on_light_scattered_once() {
    let mut report = Vec::new();
    for altitude_m in [2.0, 500.0, 1e4, 4e4, 1.1e5, 4e5, 4e7] {
        for sun_deg in [70.0, 20.0, 3.0, 0.0, -4.0, -10.0] {
            for (index, camera) in cameras(altitude_m).iter().enumerate() {
                let by = |method: &str| {
                    let scene = once(method, altitude_m, sun_deg, camera);
                    radiance(&scene, SIDE_PX, SIDE_PX, Quality::Final)
                };
                let nested = by("nested");
                for method in ["table", "lut"] {
                    let (rmse, worst, place) = difference(&by(method), &nested);
                    let case = format!(
                        "{method} from {altitude_m} m, sun {sun_deg}°, camera {index}: rmse {rmse:.5}, worst {worst:.4} at {place}"
                    );
                    // What the product promises; measured 0.4 %.
                    assert!(rmse < 0.01, "{case}");
                    // No pixel stands out. From 40,000 km one pixel is three times as wide as the air is thick, and the
                    // table's last rows are of rays that such a pixel only touches.
                    assert!(worst < 0.025 || altitude_m > 1e7, "{case}");
                    report.push((rmse, case));
                }
            }
        }
    }
    report.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (_, line) in report.iter().take(6) {
        println!("{line}");
    }
}

/// A scene of one method with steps of its own, at sunset over half the sky.
fn with_steps(method: &str, view_steps: Option<u32>, sun_steps: Option<u32>) -> Radiance {
    let camera = json!({"direction": {"azimuth_deg": 20, "elevation_deg": 20}});
    let mut scene = once(method, 2.0, 2.0, &camera);
    let air = scene.atmosphere.as_mut().unwrap();
    air.view_steps = view_steps;
    air.sun_steps = sun_steps;
    radiance(&scene, SIDE_PX, SIDE_PX, Quality::Final)
}

#[test]
fn more_steps_come_closer() {
    let truth = with_steps("nested", Some(256), Some(256));
    for method in ["nested", "table", "lut"] {
        let off = |view: Option<u32>, sun: Option<u32>| difference(&with_steps(method, view, sun), &truth).0;
        let usual = off(None, None);
        let (few_view, few_sun) = (off(Some(6), None), off(None, Some(4)));
        println!("{method}: {usual:.5}; 6 steps of view {few_view:.5}; 4 steps to the sun {few_sun:.5}");
        // The errors of midpoint sums fall with the square of the steps: a few of them cost far more than the usual
        // number.
        assert!(usual < 0.003, "{method}: {usual}");
        assert!(
            few_view > 3.0 * usual && few_sun > 3.0 * usual,
            "{method}: {usual} {few_view} {few_sun}"
        );
    }
}
