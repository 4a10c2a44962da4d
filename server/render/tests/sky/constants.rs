//! The constants of Iniesta and Pérez 2015 §6.3, each by what it must do.

use crate::scenes::{Rgb, left, picture, probe, scene, seen};
use serde_json::{Value, json};
use welkin_scene::Direction;

/// The thesis' air over black ground, light scattered once.
fn thesis(changes: &[(&str, Value)]) -> Value {
    let mut air = json!({
        "orders": "single", "ozone": null, "airglow": null,
        "rayleigh": {"scattering_per_m": [5.8e-6, 13.5e-6, 33.1e-6], "scale_height_m": 7994},
        "mie": {"scattering_per_m": 2e-5, "absorption_per_m": 2e-6, "scale_height_m": 1200, "asymmetry": 0.76},
    });
    for (pointer, value) in changes {
        *air.pointer_mut(pointer).unwrap() = value.clone();
    }
    json!({
        "camera": {"position_m": [0, 0, 0]},
        "planet": {"radius_m": 6_371_000, "ground_albedo": [0, 0, 0]},
        "sun": {"irradiance_w_m2": [30, 30, 30], "disc": false},
        "moon": null, "stars": null, "atmosphere": air,
    })
}

fn depth(transmittance: Rgb) -> Rgb {
    transmittance.map(|t| -t.ln())
}

#[test]
fn each_constant_is_in_the_zeniths_optical_depth() {
    let scattering = [5.8e-6, 13.5e-6, 33.1e-6];
    // What is set, and the closed form Σ β H (1 - e^{-top/H}) of each part, R, G and B.
    let depth_of = |rayleigh: Rgb, h_r: f64, mie: Rgb, h_m: f64, factor: f64| -> Rgb {
        let column = |h: f64| h * (1.0 - (-1e5 / h).exp());
        [0, 1, 2].map(|c| factor * (rayleigh[c] * column(h_r) + mie[c] * column(h_m)))
    };
    let mie = [2.2e-5; 3];
    let cases = [
        (vec![], depth_of(scattering, 7994.0, mie, 1200.0, 1.0)),
        (
            vec![("/rayleigh/scattering_per_m", json!([1e-5, 2e-5, 4e-5]))],
            depth_of([1e-5, 2e-5, 4e-5], 7994.0, mie, 1200.0, 1.0),
        ),
        (
            vec![(
                "/rayleigh",
                json!({"scattering_per_m": scattering, "scale_height_m": 7994,
                                      "absorption_per_m": [1e-5, 2e-6, 5e-5]}),
            )],
            depth_of([15.8e-6, 15.5e-6, 83.1e-6], 7994.0, mie, 1200.0, 1.0),
        ),
        (
            vec![("/mie/scattering_per_m", json!([1e-5, 3e-5, 9e-5]))],
            depth_of(scattering, 7994.0, [1.2e-5, 3.2e-5, 9.2e-5], 1200.0, 1.0),
        ),
        (
            vec![("/mie/scattering_per_m", json!(6e-5))],
            depth_of(scattering, 7994.0, [6.2e-5; 3], 1200.0, 1.0),
        ),
        (
            vec![("/mie/absorption_per_m", json!([2e-6, 1e-5, 4e-5]))],
            depth_of(scattering, 7994.0, [2.2e-5, 3e-5, 6e-5], 1200.0, 1.0),
        ),
        (
            vec![("/rayleigh/scale_height_m", json!(9500))],
            depth_of(scattering, 9500.0, mie, 1200.0, 1.0),
        ),
        (
            vec![("/mie/scale_height_m", json!(2500))],
            depth_of(scattering, 7994.0, mie, 2500.0, 1.0),
        ),
    ];
    let found_at = |document: Value| depth(left(&scene(document), 0.0, 90.0));
    let check = |document: Value, expected: Rgb| {
        let found = found_at(document.clone());
        for c in 0..3 {
            // f32 sums of 256 steps.
            assert!(
                (found[c] / expected[c] - 1.0).abs() < 1e-3,
                "{document}: {found:?} for {expected:?}"
            );
        }
    };
    for (changes, expected) in cases {
        check(thesis(&changes), expected);
    }
    for factor in [0.7, 1.0, 1.3] {
        let mut document = thesis(&[]);
        document["atmosphere"]["density_factor"] = json!(factor);
        check(document, depth_of(scattering, 7994.0, mie, 1200.0, factor));
    }
}

/// Light that is taken between two heights is gone by e^{-τ}: what molecules absorb darkens ground seen from above.
#[test]
fn absorbing_molecules_darken_the_ground_seen_from_above() {
    let of = |absorption: f64| {
        let mut document = thesis(&[
            (
                "/rayleigh",
                json!({"scattering_per_m": [0, 0, 0], "absorption_per_m": [0, 0, absorption],
                                 "scale_height_m": 7994}),
            ),
            ("/mie", Value::Null),
        ]);
        document["camera"]["position_m"] = json!([0, 0, 5e5]);
        document["planet"]["ground_albedo"] = json!([0.4, 0.4, 0.4]);
        document["sun"]["position"] = json!([0, 0, 1]);
        seen(&scene(document), 0.0, -90.0)
    };
    let (clear, dark) = (of(0.0), of(5e-5));
    // Down and up again.
    let expected = (-2.0 * 5e-5 * 7994.0_f64).exp();
    assert_eq!(clear[..2], dark[..2]);
    // f32, and the table of optical depth: 1e-3 of a depth of 0.8.
    assert!(
        (dark[2] / clear[2] / expected - 1.0).abs() < 2e-3,
        "{dark:?} {clear:?} {expected}"
    );
}

/// 1 - least / most: 0 grey.
fn saturation(c: Rgb) -> f64 {
    1.0 - c.iter().fold(f64::MAX, |a, b| a.min(*b)) / c.iter().fold(0.0, |a: f64, b| a.max(*b))
}

#[test]
fn more_aerosols_grey_the_sky() {
    for (azimuth_deg, elevation_deg) in [(0.0, 60.0), (90.0, 30.0), (180.0, 70.0)] {
        let greyer = [0.0, 5e-6, 2e-5, 6e-5, 2e-4].map(|scattering| {
            let absorption = 0.1 * scattering;
            let mie = [
                ("/mie/scattering_per_m", json!(scattering)),
                ("/mie/absorption_per_m", json!(absorption)),
            ];
            saturation(seen(&scene(thesis(&mie)), azimuth_deg, elevation_deg))
        });
        assert!(
            greyer.windows(2).all(|w| w[1] < w[0] - 0.003),
            "{azimuth_deg} {elevation_deg}: {greyer:?}"
        );
    }
}

/// With more molecules the spectrum moves to lower frequencies: blue is scattered away before it arrives.
#[test]
fn more_molecules_redden_the_horizon() {
    let ratios = [1.0, 2.0, 4.0].map(|times: f64| {
        let scattering = json!([5.8e-6 * times, 13.5e-6 * times, 33.1e-6 * times]);
        let sky = seen(
            &scene(thesis(&[("/rayleigh/scattering_per_m", scattering)])),
            90.0,
            4.0,
        );
        sky[2] / sky[0]
    });
    assert!(ratios.windows(2).all(|w| w[1] < 0.8 * w[0]), "{ratios:?}");
}

/// A thin air scatters in proportion to its density; P0 does the same to both parts.
#[test]
fn the_density_factor_scales_thin_air() {
    let of = |factor: f64, part: &str| {
        let mut document = thesis(&[(part, Value::Null)]);
        document["atmosphere"]["density_factor"] = json!(1e-3 * factor);
        seen(&scene(document), 90.0, 40.0)
    };
    for part in ["/rayleigh", "/mie"] {
        let plain = of(1.0, part);
        for factor in [0.7, 1.3] {
            let found = of(factor, part);
            for c in 0..3 {
                // Optical depths of 3e-4.
                assert!(
                    (found[c] / plain[c] / factor - 1.0).abs() < 1e-3,
                    "{part} {factor}: {found:?} {plain:?}"
                );
            }
        }
    }
}

#[test]
fn the_suns_light_is_a_factor_of_all_radiance() {
    let of = |e: f64| {
        let mut document = thesis(&[("/orders", json!("multiple"))]);
        document["sun"]["irradiance_w_m2"] = json!([e, e, e]);
        document["planet"]["ground_albedo"] = json!([0.3, 0.3, 0.3]);
        probe(
            &scene(document),
            &[Direction::angles(180.0, 30.0), Direction::angles(20.0, -20.0)],
        )
    };
    let low = of(30.0);
    for e in [65.0, 100.0] {
        let high = of(e);
        for (low, high) in low.radiance_w_m2_sr.iter().zip(&high.radiance_w_m2_sr) {
            for c in 0..3 {
                // f32 products.
                assert!(
                    (high[c] / low[c] * 30.0 / e - 1.0).abs() < 1e-6,
                    "{high:?} {low:?}"
                );
            }
        }
    }
}

/// At the sun's own height an even air sends light in proportion to its phase function, whatever the azimuth.
#[test]
fn g_narrows_the_aureole_as_the_phase_function_does() {
    const SUN_DEG: f64 = 35.0;
    let cos_off = |azimuth_deg: f64| {
        let e = SUN_DEG.to_radians();
        e.sin().powi(2) + e.cos().powi(2) * azimuth_deg.to_radians().cos()
    };
    // Azimuths from the sun that are 2° and 20° away along the circle of its height.
    let at = |off_deg: f64| {
        let (e, off) = (SUN_DEG.to_radians(), off_deg.to_radians());
        ((off.cos() - e.sin().powi(2)) / e.cos().powi(2))
            .acos()
            .to_degrees()
    };
    let phase = |nu: f64, g: f64| (1.0 + nu * nu) / (1.0 + g * g - 2.0 * g * nu).powf(1.5);
    let mut before = 0.0;
    for g in [0.70, 0.76, 0.85, 0.95, 0.999] {
        let document = thesis(&[("/rayleigh", Value::Null), ("/mie/asymmetry", json!(g))]);
        let [near, far] = [2.0, 20.0].map(|off| seen(&scene(document.clone()), 180.0 + at(off), SUN_DEG)[1]);
        let expected = phase(cos_off(at(2.0)), g) / phase(cos_off(at(20.0)), g);
        // f32 cosines: 1e-7 of 6e-4 beside the sun.
        assert!(
            (near / far / expected - 1.0).abs() < 2e-3,
            "{g}: {} for {expected}",
            near / far
        );
        assert!(near / far > before, "{g}");
        before = near / far;
    }
}

/// colour = 1 - exp(-pupil · L), pupil = clamp(1 - cos γ / 4, 0, 1): equations of §2.1.2.3.
#[test]
fn the_pupil_is_the_thesis_formula_at_every_angle() {
    for angle_deg in [0.0, 30.0, 60.0, 85.0, 95.0, 140.0] {
        // The camera looks south, 50° up; the sun stands so far below or beyond that.
        let sun_deg: f64 = 50.0 - angle_deg;
        let (sun_azimuth_deg, sun_deg) = if angle_deg > 60.0 {
            (180.0, 50.0 + angle_deg)
        } else {
            (180.0, sun_deg)
        };
        let (y, z) = (-sun_deg.to_radians().cos(), sun_deg.to_radians().sin());
        let mut document = thesis(&[]);
        document["camera"]["direction"] = json!({"azimuth_deg": sun_azimuth_deg, "elevation_deg": 50});
        document["camera"]["projection"] = json!({"kind": "perspective", "vertical_fov_deg": 0.1});
        document["sun"]["position"] = json!([0, y, z]);
        document["display"] = json!({"exposure": {"kind": "pupil", "gain": 1}, "tone_curve": "exponential", "dither": false, "glare": 0});
        let scene = scene(document);
        let (pixels, _) = picture(&scene, 8, 8);
        let light = seen(&scene, 180.0, 50.0);
        let pupil = (1.0 - angle_deg.to_radians().cos() / 4.0).clamp(0.0, 1.0);
        for c in 0..3 {
            let value = 1.0 - (-pupil * light[c]).exp();
            let expected = 255.0
                * if value <= 0.003_130_8 {
                    12.92 * value
                } else {
                    1.055 * value.powf(1.0 / 2.4) - 0.055
                };
            // A preview's radiance is within 2 % of the probe's: one to two steps; and the rounding.
            let off = (f64::from(pixels[27][c]) - expected).abs();
            assert!(
                off < 2.0,
                "{angle_deg}°, band {c}: {} for {expected}",
                pixels[27][c]
            );
        }
    }
}
