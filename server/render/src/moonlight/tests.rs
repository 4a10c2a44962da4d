use super::*;
use serde_json::json;

fn lit(phase_angle_deg: f64, changes: &serde_json::Value) -> (Moonlight, MoonSeen) {
    let mut moon =
        json!({"position": {"azimuth_deg": 180, "elevation_deg": 30}, "phase_angle_deg": phase_angle_deg});
    moon.as_object_mut()
        .unwrap()
        .extend(changes.as_object().unwrap().clone());
    let scene = Scene::from_value(&json!({"moon": moon})).unwrap();
    let seen = scene.moon_seen().unwrap();
    (
        Moonlight::new(scene.moon.as_ref().unwrap(), &seen, &scene.sun),
        seen,
    )
}

#[test]
fn the_full_moon_is_as_bright_as_it_is() {
    let (full, _) = lit(0.0, &json!({}));
    // The sun outshines it by 26.74 - 12.73 magnitudes: 4.0e5; our sun is 1.8504 W/m²/nm, 3 % from that magnitude.
    let ratio = 1.8504 / full.irradiance_w_m2.y;
    assert!((ratio / 4.02e5 - 1.0).abs() < 0.04, "{ratio}");
    // A quarter of a lux by the luminous efficacy of the bands.
    let lux = full
        .irradiance_w_m2
        .dot(DVec3::new(0.2126 * 90231.0, 0.7152 * 71876.0, 0.0722 * 69561.0));
    assert!((0.2..0.4).contains(&lux), "{lux}");
}

#[test]
fn light_falls_with_the_phase_as_measured() {
    // Allen's table of magnitudes from full: 30° 0.78, 60° 1.61, 90° 2.60, 120° 3.95, 150° 5.92.
    for (angle_deg, magnitudes) in [
        (0.0, 0.0),
        (30.0, 0.78),
        (60.0, 1.61),
        (90.0, 2.60),
        (120.0, 3.95),
        (150.0, 5.92),
    ] {
        let found = -2.5 * phase_law(angle_deg).log10();
        assert!((found - magnitudes).abs() < 0.02, "{angle_deg}: {found}");
    }
    let mut before = 1.0;
    for angle_deg in 1..=180 {
        let now = phase_law(f64::from(angle_deg));
        assert!(now < before, "{angle_deg}");
        before = now;
    }
    assert!(before < 1e-6, "{before}");
}

/// The disc's radiance over all directions is the irradiance, at every phase.
#[test]
fn the_disc_sends_the_irradiance() {
    const SIDE: u32 = 1200;
    for phase_angle_deg in [0.0, 20.0, 60.0, 90.0, 120.0, 150.0, 165.0] {
        let (moon, seen) = lit(phase_angle_deg, &json!({"earthshine": 0}));
        let across = |i: u32| 2.0 * (f64::from(i) + 0.5) / f64::from(SIDE) - 1.0;
        let mut sum = DVec3::ZERO;
        for (x, y) in (0..SIDE * SIDE).map(|i| (across(i % SIDE), across(i / SIDE))) {
            sum += crate::cpu::moon::on_disc(&moon, x, y);
        }
        let disc_sr = 4.0 * PI * (seen.angular_diameter_deg.to_radians() / 4.0).sin().powi(2);
        let sent = sum * disc_sr * 4.0 / PI / f64::from(SIDE * SIDE);
        let off = (sent / moon.irradiance_w_m2 - 1.0).abs().max_element();
        // A square grid of 1200² points, most of them off a thin crescent.
        assert!(off < 0.003, "{phase_angle_deg}: {off}");
    }
}

#[test]
fn the_terminator_is_on_the_side_of_the_sun() {
    let scene = Scene::from_value(&json!({
        "sun": {"position": {"azimuth_deg": 270, "elevation_deg": 30}},
        "moon": {"position": {"azimuth_deg": 180, "elevation_deg": 30}},
        "stars": {"orientation": {"latitude_deg": 45, "sidereal_time_deg": 90}},
    }))
    .unwrap();
    let seen = scene.moon_seen().unwrap();
    let moon = Moonlight::new(scene.moon.as_ref().unwrap(), &seen, &scene.sun);
    // The sun stands to the right; so is the lit half, and Mare Crisium's side of the moon.
    assert!(moon.light.y > 0.8, "{:?}", moon.light);
    let [left, right] = [-0.7, 0.7].map(|x| crate::cpu::moon::on_disc(&moon, x, 0.0).y);
    assert!(left < 1e-3 * right, "{left} {right}");
    // North is up in the south of a northern sky.
    assert!(moon.axes[2].z > 0.7, "{:?}", moon.axes);
}

#[test]
fn the_dark_side_has_the_earths_light() {
    let dark = |phase_deg: f64, earthshine: f64| {
        lit(phase_deg, &json!({"earthshine": earthshine}))
            .0
            .earthshine_w_m2_sr
            .y
    };
    let (full, _) = lit(0.0, &json!({}));
    // The ashen light at a thin crescent is about 1e-4 of the full moon's radiance.
    let ratio = dark(170.0, 1.0) / full.radiance_w_m2_sr.y;
    assert!((0.5e-4..1.5e-4).contains(&ratio), "{ratio}");
    // At full moon the Earth is new.
    assert!(dark(0.0, 1.0) < 1e-6 * full.radiance_w_m2_sr.y);
    assert!((dark(150.0, 3.0) / dark(150.0, 1.0) - 3.0).abs() < 1e-12);
    assert_eq!(dark(150.0, 0.0), 0.0);
}

#[test]
fn settings_scale_the_light() {
    let of = |changes: serde_json::Value| lit(40.0, &changes).0;
    let (one, two) = (of(json!({})), of(json!({"irradiance_scale": 2})));
    assert!(
        (two.irradiance_w_m2 / one.irradiance_w_m2 - 2.0)
            .abs()
            .max_element()
            < 1e-12
    );
    // A larger disc sends the same light.
    let large = of(json!({"angular_diameter_deg": 5.18}));
    assert_eq!(large.irradiance_w_m2, one.irradiance_w_m2);
    // Ten times as wide: a hundred times the solid angle, but for the sphere's curvature.
    assert!((one.radiance_w_m2_sr.y / large.radiance_w_m2_sr.y / 100.0 - 1.0).abs() < 1e-3);
}

#[test]
fn eclipses() {
    assert_eq!(covered(1.0, 1.0, 2.0), 0.0);
    assert_eq!(covered(1.0, 1.1, 0.05), 1.0);
    assert!((covered(1.0, 0.9, 0.05) - 0.81).abs() < 1e-12);
    // Equal discs half a diameter apart: 2/π acos(1/2) - √3/(2π).
    let expected = 2.0 / PI * 0.5_f64.acos() - 3_f64.sqrt() / (2.0 * PI);
    assert!((covered(1.0, 1.0, 1.0) - expected).abs() < 1e-12);
    let mut before = 1.0;
    for step in 0..=200 {
        let now = covered(1.0, 1.02, f64::from(step) * 0.0101);
        assert!(now <= before && before - now < 0.02, "{step}");
        before = now;
    }
}
