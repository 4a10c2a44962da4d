//! From radiance to the picture: every field of `display`, by what it promises.

use crate::scenes::{frame, order, picture, probe, scene};
use serde_json::{Value, json};
use std::f64::consts::PI;
use welkin_scene::{Quality, Scene, renderer::Output};

/// A field of even radiance: white ground straight below, no air, the sun at the zenith.
fn even(radiance: [f64; 3], display: Value) -> Scene {
    let display = {
        let mut all = json!({"dither": false, "glare": 0});
        all.as_object_mut()
            .unwrap()
            .extend(display.as_object().unwrap().clone());
        all
    };
    let mut scene = scene(json!({
        "camera": {"direction": [0, 0, -1], "projection": {"kind": "perspective", "vertical_fov_deg": 0.1}},
        "sun": {"position": [0, 0, 1], "irradiance_w_m2": radiance.map(|l| l * PI), "disc": false},
        "planet": {"ground_albedo": [1, 1, 1]},
        "display": display,
    }));
    scene.atmosphere = None;
    scene
}

/// The one colour of an even field.
fn colour(scene: &Scene) -> [u8; 3] {
    let (pixels, _) = picture(scene, 16, 16);
    assert!(pixels.iter().all(|p| *p == pixels[0]), "the field is even");
    pixels[0]
}

/// IEC 61966-2-1.
fn srgb(linear: f64) -> f64 {
    255.0
        * if linear <= 0.003_130_8 {
            12.92 * linear
        } else {
            1.055 * linear.powf(1.0 / 2.4) - 0.055
        }
}

fn pupil(gain: f64, curve: &str) -> Value {
    json!({"exposure": {"kind": "pupil", "gain": gain}, "tone_curve": curve})
}

const LIGHTS: [f64; 9] = [0.0, 1e-4, 2e-3, 0.01, 0.05, 0.18, 0.7, 3.0, 40.0];

#[test]
fn reinhard_and_exponential_are_their_formulas_in_exact_srgb() {
    for (curve, f) in [
        ("reinhard", (|c: f64| c / (1.0 + c)) as fn(f64) -> f64),
        ("exponential", |c: f64| 1.0 - (-c).exp()),
    ] {
        for light in LIGHTS {
            // Looking straight away from the sun the pupil is wide open: clamp(1 + 1/4, 0, 1).
            let found = colour(&even([light; 3], pupil(1.0, curve)));
            for byte in found {
                // Half a step of rounding, and f32's pow.
                let off = (f64::from(byte) - srgb(f(light))).abs();
                assert!(off < 0.51, "{curve} of {light}: {byte} for {}", srgb(f(light)));
            }
        }
    }
}

#[test]
fn every_curve_rises_keeps_grey_grey_and_ends_in_white() {
    for curve in ["reinhard", "exponential", "aces", "agx"] {
        let shown = LIGHTS.map(|light| colour(&even([light; 3], pupil(1.0, curve))));
        for pair in shown.windows(2) {
            assert!((0..3).all(|c| pair[1][c] >= pair[0][c]), "{curve}: {shown:?}");
        }
        for grey in shown {
            // The matrices of ACES and AgX have rows that sum to one, to four digits and to all.
            assert!(
                grey.iter().max().unwrap() - grey.iter().min().unwrap() <= 1,
                "{curve}: {grey:?}"
            );
        }
        assert!(shown[0][0] <= 1 && shown[8][0] >= 245, "{curve}: {shown:?}");
        // Mid-grey stays in the middle of the scale: reinhard and exponential 0.15 and 0.16 of light, the film curves
        // somewhat below or above.
        assert!((80..=140).contains(&shown[5][1]), "{curve}: {shown:?}");
    }
    // Bright red fades to white in the film curves, and stays red where each band goes its own way.
    let red = |curve: &str| colour(&even([300.0, 3.0, 3.0], pupil(1.0, curve)));
    assert!(
        red("agx")[1] > 200 && red("reinhard")[1] < 240,
        "{:?} {:?}",
        red("agx"),
        red("reinhard")
    );
    assert_ne!(red("aces"), red("agx"));
}

#[test]
fn the_pupil_closes_towards_the_sun() {
    // Sun at elevations that make angles of 180, 90, 60 and 0 degrees with a camera that looks at a ground of even
    // light: turn the camera, not the light.
    let byte = |towards: [f64; 3]| {
        let mut scene = even([0.2; 3], pupil(1.0, "reinhard"));
        scene.sun.position = serde_json::from_value(json!([0, 0, 1])).unwrap();
        scene.camera.position_m = [0.0, 0.0, 4e7];
        // From so far every part of the day side in view would differ; a sky without air is black. So the light is the
        // disc's own: as wide as the picture.
        scene.camera.direction = serde_json::from_value(json!(towards)).unwrap();
        scene.sun.disc = true;
        scene.sun.limb_darkening = false;
        scene.sun.angular_diameter_deg = 20.0;
        colour(&scene)[1]
    };
    // The disc is 20° wide: its centre and, 9° away, near its rim.
    let (centre, aside) = (
        byte([0.0, 0.0, 1.0]),
        byte([0.0, f64::sin(0.157), f64::cos(0.157)]),
    );
    let radiance = 0.2 * PI / (4.0 * PI * f64::to_radians(5.0).sin().powi(2));
    for (byte, cos) in [(centre, 1.0), (aside, f64::cos(0.157))] {
        let c = radiance * (1.0 - cos / 4.0);
        assert!(
            (f64::from(byte) - srgb(c / (1.0 + c))).abs() < 0.6,
            "{byte} at cos {cos}"
        );
    }
    let wide = colour(&even([0.2; 3], pupil(1.0, "reinhard")))[1];
    assert!((f64::from(wide) - srgb(0.2 / 1.2)).abs() < 0.51);
    let doubled = colour(&even([0.2; 3], pupil(2.0, "reinhard")))[1];
    assert!((f64::from(doubled) - srgb(0.4 / 1.4)).abs() < 0.51);
}

#[test]
fn a_stop_of_exposure_is_a_factor_of_two() {
    let at = |light: f64, ev: f64| {
        let display = json!({"exposure": {"kind": "ev", "ev": ev}, "tone_curve": "reinhard"});
        let scene = even([light; 3], display);
        (colour(&scene), picture(&scene, 16, 16).1)
    };
    for ev in [-3.0, 8.0, 14.0] {
        let light = 0.5 * f64::exp2(ev - 15.0);
        let (a, known) = at(light, ev);
        assert_eq!(known, Some(ev));
        assert_eq!(a, at(2.0 * light, ev + 1.0).0);
        assert!(a[1] > at(light, ev + 1.0).0[1]);
    }
    // Full scale is 1.2 · 2^EV cd/m² (ISO 12232). The sun above the air gives 133 klx (ASTM E490): a white ground then
    // sends 133e3 / π cd/m², which is full scale at EV 15.1; reinhard shows full scale as a half.
    let ev = f64::log2(133e3 / PI / 1.2);
    let light = Scene::default().sun.irradiance_w_m2.map(|e| e / PI);
    let display = json!({"exposure": {"kind": "ev", "ev": ev}, "tone_curve": "reinhard"});
    for byte in colour(&even(light, display)) {
        // One per cent of the illuminance is half a step here.
        assert!(
            (f64::from(byte) - srgb(0.5)).abs() <= 1.5,
            "{byte} for {}",
            srgb(0.5)
        );
    }
}

/// EV of a picture that meters itself.
fn metered(changes: Value) -> f64 {
    picture(&scene(changes), 96, 54).1.unwrap()
}

fn mean(scene: &Scene) -> f64 {
    let (pixels, _) = picture(scene, 96, 54);
    pixels
        .iter()
        .map(|p| f64::from(p[0]) + f64::from(p[1]) + f64::from(p[2]))
        .sum::<f64>()
        / (3.0 * pixels.len() as f64)
}

#[test]
fn the_meter_follows_the_light() {
    let plain = metered(json!({}));
    // A sunny day's sky: EV 12 to 16.
    assert!((12.0..16.0).contains(&plain), "{plain}");
    let bright = metered(json!({"sun": {"irradiance_w_m2": [2.948, 3.7008, 3.82396]}}));
    // Above the meter's daylight it follows fully.
    assert!((bright - plain - 1.0).abs() < 0.01, "{bright} {plain}");
    let exposure = |ev: f64| json!({"display": {"exposure": {"kind": "auto", "compensation_ev": ev}}});
    assert!((metered(exposure(1.5)) - (plain - 1.5)).abs() < 1e-3);
    assert!(mean(&scene(exposure(1.5))) > mean(&scene(exposure(0.0))) + 10.0);
    // Dusk is exposed for longer, and looks darker all the same.
    let at = |elevation: f64| json!({"sun": {"position": {"azimuth_deg": 300, "elevation_deg": elevation}}});
    let evs = [40.0, 5.0, -4.0, -8.0].map(|e| metered(at(e)));
    assert!(evs.windows(2).all(|w| w[1] < w[0]), "{evs:?}");
    let means = [40.0, -4.0, -8.0, -16.0].map(|e| mean(&scene(at(e))));
    assert!(means.windows(2).all(|w| w[1] < w[0]), "{means:?}");
    // The sun's disc in the picture does not count, nor does the picture's size.
    let sunward =
        |disc: bool| json!({"sun": {"position": {"azimuth_deg": 180, "elevation_deg": 12}, "disc": disc}});
    assert_eq!(metered(sunward(true)), metered(sunward(false)));
    let large = picture(&scene(json!({})), 480, 270).1.unwrap();
    assert!((large - plain).abs() < 0.05, "{large} {plain}");
}

#[test]
fn radiance_has_no_exposure() {
    let linear = frame(order(scene(json!({})), 16, 16, Quality::Preview, Output::Linear));
    assert_eq!(linear.facts.ev100, None);
    let exposed = scene(
        json!({"display": {"exposure": {"kind": "ev", "ev": 3}, "tone_curve": "aces",
                                           "white_balance_k": 3000}}),
    );
    assert_eq!(
        frame(order(exposed, 16, 16, Quality::Preview, Output::Linear)).pixels,
        linear.pixels
    );
}

#[test]
fn white_balance_warms_and_cools() {
    let at = |kelvin: f64| {
        let mut display = pupil(1.0, "reinhard");
        display["white_balance_k"] = json!(kelvin);
        colour(&even([0.2; 3], display)).map(f64::from)
    };
    let shown = [2500.0, 4000.0, 6500.0, 9000.0, 20_000.0].map(at);
    // Light of 2500 K shall look white, so light of 6500 K looks blue; and the other way round.
    let warmth = shown.map(|[r, _, b]| r / b);
    assert!(warmth.windows(2).all(|w| w[1] > w[0] * 1.02), "{shown:?}");
    assert!((warmth[2] - 1.0).abs() < 0.01, "{shown:?}");
}

#[test]
fn dither_is_one_step_of_noise_about_the_true_value() {
    let of = |dither: bool| {
        let mut display = pupil(1.0, "exponential");
        display["dither"] = json!(dither);
        picture(&even([0.0837; 3], display), 128, 128).0
    };
    let expected = srgb(1.0 - f64::exp(-0.0837));
    assert!(of(false).iter().all(|p| *p == of(false)[0]));
    let noisy = of(true);
    for c in 0..3 {
        let values: Vec<f64> = noisy.iter().map(|p| f64::from(p[c])).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64;
        // Triangular noise of ±1 and the rounding: variance 1/6 + 1/12 = 1/4 whatever the value. The mean of 16384
        // samples is good to 0.004, their variance to 0.005.
        assert!((mean - expected).abs() < 0.02, "{mean} {expected}");
        assert!((variance - 0.25).abs() < 0.02, "{variance}");
        assert!(values.iter().all(|v| (v - expected).abs() <= 1.5));
    }
    // The three bands do not share their noise, nor do rows and columns.
    assert!(noisy.iter().filter(|p| p[0] == p[1] && p[1] == p[2]).count() < noisy.len() * 3 / 4);
    let rows: Vec<_> = noisy.chunks_exact(128).collect();
    assert!(rows.windows(2).all(|w| w[0] != w[1]));
}

#[test]
fn glare_veils_the_sky_about_a_visible_sun() {
    let of = |glare: f64, disc: bool| {
        let scene = scene(json!({
            "camera": {"direction": {"azimuth_deg": 180, "elevation_deg": 30},
                       "projection": {"kind": "perspective", "vertical_fov_deg": 20}},
            "sun": {"position": {"azimuth_deg": 180, "elevation_deg": 30}, "disc": disc},
            "display": {"exposure": {"kind": "ev", "ev": 15}, "tone_curve": "reinhard", "dither": false, "glare": glare},
        }));
        picture(&scene, 101, 101).0
    };
    let (none, clean, dirty) = (of(0.0, true), of(1.0, true), of(5.0, true));
    // Pixels of 0.2°: one degree beside the sun, and nine.
    let (near, far) = (50 * 101 + 55, 50 * 101 + 95);
    for c in 0..3 {
        assert!(
            clean[near][c] > none[near][c] && dirty[near][c] > clean[near][c],
            "{:?}",
            [none[near], clean[near]]
        );
        let added = |at: usize| i32::from(dirty[at][c]) - i32::from(none[at][c]);
        assert!(added(near) > 2 * added(far), "{} {}", added(near), added(far));
    }
    assert_eq!(of(5.0, false), of(0.0, false), "no sun, no glare");
}

#[test]
fn outside_a_fisheyes_circle_the_picture_is_black() {
    let fisheye = json!({"camera": {"direction": [0, 0, 1], "projection": {"kind": "fisheye"}}});
    let (pixels, _) = picture(&scene(fisheye), 80, 60);
    for (i, pixel) in pixels.iter().enumerate() {
        let (x, y) = ((i % 80) as f64 + 0.5 - 40.0, (i / 80) as f64 + 0.5 - 30.0);
        if x.hypot(y) > 30.0 {
            assert_eq!(*pixel, [0; 3], "{x} {y}");
        } else {
            assert_ne!(*pixel, [0; 3], "{x} {y}");
        }
    }
}

#[test]
fn a_frame_says_where_the_sun_stands_and_what_it_sends() {
    for elevation in [70.0, 10.0, 0.1, -0.1, -3.0] {
        let scene = scene(json!({"sun": {"position": {"azimuth_deg": 222, "elevation_deg": elevation}}}));
        let facts = frame(order(scene.clone(), 8, 8, Quality::Preview, Output::Linear)).facts;
        assert!(
            (facts.sun.azimuth_deg - 222.0).abs() < 1e-9
                && (facts.sun.elevation_deg - elevation).abs() < 1e-9
        );
        let irradiance = probe(&scene, &[]).irradiance;
        assert_eq!(facts.sun_irradiance_w_m2, irradiance.direct_normal_w_m2);
        for c in 0..3 {
            let fallen = irradiance.direct_normal_w_m2[c] * f64::to_radians(elevation).sin().max(0.0);
            assert!((irradiance.direct_w_m2[c] - fallen).abs() < 1e-12);
        }
        let lit = facts.sun_irradiance_w_m2[0] > 0.0;
        // Half the disc is 0.27° high; from 2 m the horizon lies 0.05° down.
        assert_eq!(lit, elevation > -0.3, "{elevation}");
    }
}
