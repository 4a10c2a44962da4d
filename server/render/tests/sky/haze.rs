//! Haze and fog: closed forms, limits, and every extreme.

use crate::scenes::{Rgb, left, probe, radiance, scene};
use serde_json::{Value, json};
use welkin_scene::{Direction, Orders, Quality, Scene};

fn hazy(haze: Value, altitude_m: f64, sun_deg: f64) -> Scene {
    scene(json!({
        "camera": {"position_m": [0, 0, altitude_m]},
        "sun": {"position": {"azimuth_deg": 180, "elevation_deg": sun_deg}, "disc": false},
        "haze": haze, "moon": null, "stars": null,
    }))
}

/// Haze alone: no molecules, aerosols or ozone, though their phase function stays.
fn alone(haze: Value, altitude_m: f64, sun_deg: f64, albedo: f64) -> Scene {
    scene(json!({
        "camera": {"position_m": [0, 0, altitude_m]},
        "sun": {"position": {"azimuth_deg": 180, "elevation_deg": sun_deg}, "irradiance_w_m2": [1, 1, 1], "disc": false},
        "planet": {"ground_albedo": [albedo, albedo, albedo]},
        "atmosphere": {"rayleigh": null, "ozone": null, "airglow": null,
                       "mie": {"scattering_per_m": 0, "absorption_per_m": 0, "asymmetry": 0.8}},
        "haze": haze, "moon": null, "stars": null,
    }))
}

/// The same with the first order alone.
fn single(mut scene: Scene) -> Scene {
    scene.atmosphere.as_mut().unwrap().orders = Orders::Single;
    scene
}

#[test]
fn transmittance_is_beers_law_of_the_length_in_the_layer() {
    for (visibility_m, top_m) in [(50.0, 20.0), (200.0, 300.0), (5e3, 1e3), (3e5, 1e5)] {
        let haze = json!({"visibility_m": visibility_m, "top_m": top_m});
        let sigma = 3.912 / visibility_m;
        for altitude_m in [0.0, 0.3 * top_m, 0.9 * top_m] {
            let clear = left(&single(hazy(Value::Null, altitude_m, 35.0)), 0.0, 90.0);
            let found = left(&single(hazy(haze.clone(), altitude_m, 35.0)), 0.0, 90.0);
            let expected = (-sigma * (top_m - altitude_m)).exp();
            for c in 0..3 {
                // f32 depths, of up to 6 here, and a table's 1e-3 of the clear air's.
                assert!(
                    (found[c] / clear[c] / expected - 1.0).abs() < 2e-3,
                    "{haze} from {altitude_m}: {found:?} {clear:?}"
                );
            }
        }
        // Rays to the ground within the layer: nearly level ones, and straight down.
        let scene = single(alone(haze, 0.5 * f64::min(top_m, 50.0), 35.0, 0.0));
        let directions = [-1.0, -3.0, -20.0, -90.0].map(|e| Direction::angles(90.0, e));
        let answer = probe(&scene, &directions);
        for (t, d) in answer.transmittance.iter().zip(&answer.distance_m) {
            let expected = (-sigma * d.unwrap()).exp();
            // f32 depths of up to 113 steps of rounding.
            assert!(
                (t[1] - expected).abs() < 1e-3 * expected + 1e-9,
                "{visibility_m}: {t:?} for {expected}"
            );
        }
    }
}

#[test]
fn visibility_and_extinction_are_two_words_for_one_thing() {
    let of = |haze: Value| {
        let document =
            json!({"haze": haze, "camera": {"direction": {"azimuth_deg": 160, "elevation_deg": 5}}});
        radiance(&scene(document), 32, 18, Quality::Preview)
    };
    let (a, b) = (
        of(json!({"visibility_m": 978})),
        of(json!({"extinction_per_m": 3.912 / 978.0})),
    );
    assert!(a.pixels().eq(b.pixels()));
    let (clear, none) = (of(Value::Null), of(json!({"extinction_per_m": 0})));
    assert!(
        clear.pixels().eq(none.pixels()),
        "no haze and haze of nothing are one"
    );
}

/// Koschmieder 1924: against the horizon black ground at distance d has the contrast e^{-σd}, so 2 % at the visibility.
#[test]
fn contrast_falls_to_a_fiftieth_at_the_visibility() {
    const VISIBILITY_M: f64 = 5e3;
    for method in ["nested", "table", "lut"] {
        let mut scene = alone(
            json!({"visibility_m": VISIBILITY_M, "top_m": 1000, "albedo": 1}),
            2.0,
            40.0,
            0.0,
        );
        scene.atmosphere.as_mut().unwrap().method = serde_json::from_value(json!(method)).unwrap();
        for d in [0.2 * VISIBILITY_M, 0.5 * VISIBILITY_M, VISIBILITY_M] {
            // From 2 m up, a ray that meets the ground d away.
            let directions = [
                Direction::angles(
                    90.0,
                    -(2.0 / d).asin().to_degrees() - 0.5 * (d / 6.36e6).to_degrees(),
                ),
                Direction::angles(90.0, 0.0),
            ];
            let answer = probe(&scene, &directions);
            let met_m = answer.distance_m[0].unwrap();
            assert!((met_m / d - 1.0).abs() < 0.05, "{met_m} for {d}");
            let [ground, horizon] = [0, 1].map(|i| answer.radiance_w_m2_sr[i][1]);
            let contrast = (horizon - ground) / horizon;
            let expected = (-3.912 / VISIBILITY_M * met_m).exp();
            // Koschmieder has light even along the ray and in direction: what it gains and loses in the lowest 2 m
            // and within a quarter of a degree is a hundredth.
            assert!(
                (contrast - expected).abs() < 0.02,
                "{method} at {met_m} m: {contrast} for {expected}"
            );
        }
    }
}

#[test]
fn the_sky_is_continuous_across_the_layers_top() {
    for (visibility_m, top_m) in [(1e3, 500.0), (2e4, 1e3), (200.0, 300.0)] {
        for sun_deg in [60.0, 10.0] {
            let directions: Vec<_> = [(180.0, 80.0), (90.0, 45.0), (0.0, 20.0), (90.0, 12.0)]
                .map(|(a, e)| Direction::angles(a, e))
                .to_vec();
            // A centimetre to either side; 2 mm is what f32 leaves of the height.
            let [below, above] = [-0.01, 0.01].map(|off| {
                let haze = json!({"visibility_m": visibility_m, "top_m": top_m});
                probe(&hazy(haze, top_m + off, sun_deg), &directions)
            });
            for (a, b) in below.radiance_w_m2_sr.iter().zip(&above.radiance_w_m2_sr) {
                for c in 0..3 {
                    // 1 cm of haze at 12°, of a visibility of 200 m, is a depth of 1e-3 in light of 0.5 W/m²/sr.
                    assert!(
                        (a[c] - b[c]).abs() < 5e-4 + 2e-3 * b[c],
                        "{visibility_m} {top_m} {sun_deg}: {a:?} {b:?}"
                    );
                }
            }
        }
    }
}

fn sphere(mut scene: Scene, method: &str, quality: Quality) -> crate::scenes::Radiance {
    scene.camera.projection = serde_json::from_value(json!({"kind": "equirectangular"})).unwrap();
    if let Some(air) = &mut scene.atmosphere {
        air.method = serde_json::from_value(json!(method)).unwrap();
    }
    // `radiance` refuses what is not finite or negative.
    radiance(&scene, 12, 6, quality)
}

#[test]
fn every_visibility_sun_height_and_top_gives_numbers() {
    let methods = ["lut", "table", "nested"];
    let mut turn = 0;
    for visibility_m in [50.0, 1e3, 3e4, 1e6] {
        for sun_deg in [90.0, 20.0, 0.0, -10.0] {
            for altitude_m in [0.0, 2.0, 500.0, 1001.0, 1e4, 4e5] {
                for top_m in [1.0, 1e3, 1e5] {
                    // Every fourth; what 4, 9 and 5 share with the loops' lengths leaves no pair of values out.
                    turn += 1;
                    if turn % 4 != 0 {
                        continue;
                    }
                    let mut scene = hazy(
                        json!({"visibility_m": visibility_m, "top_m": top_m}),
                        altitude_m,
                        sun_deg,
                    );
                    let quality = if turn % 8 == 0 {
                        Quality::Final
                    } else {
                        Quality::Preview
                    };
                    if turn % 20 != 0 {
                        scene = single(scene);
                    }
                    let frame = sphere(scene.clone(), methods[turn / 12 % 3], quality);
                    let case =
                        format!("{visibility_m} m, sun {sun_deg}°, from {altitude_m} m, top {top_m} m");
                    // In a layer of a depth of thousands there is no light left.
                    let thickest = 3.912 / visibility_m * (top_m - altitude_m).max(0.0);
                    if sun_deg > 0.0 && altitude_m < 9e4 && thickest < 20.0 {
                        assert!(
                            frame.pixels().all(|(_, _, c)| c.iter().all(|v| *v > 0.0)),
                            "black by day: {case}"
                        );
                    }
                    let directions = [
                        (0.0, 90.0),
                        (180.0, 20.0),
                        (90.0, 0.1),
                        (90.0, -0.5),
                        (0.0, -80.0),
                    ];
                    let answer = probe(&scene, &directions.map(|(a, e)| Direction::angles(a, e)));
                    let all = answer.radiance_w_m2_sr.iter().chain(&answer.transmittance);
                    let all = all.chain([&answer.irradiance.diffuse_w_m2, &answer.irradiance.direct_w_m2]);
                    assert!(
                        all.flatten().all(|v| v.is_finite() && *v >= 0.0),
                        "{case}: {answer:?}"
                    );
                }
            }
        }
    }
}

/// xorshift64*, from 0 to 1: the same scenes every time.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Evenly in the logarithm.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.roll())
    }
}

#[test]
fn two_hundred_random_hazes_give_numbers() {
    let mut dice = Dice(20_261_122);
    for round in 0..200 {
        let haze = json!({
            "extinction_per_m": dice.between(1e-7, 0.1), "top_m": dice.between(1.0, 1e5),
            "albedo": [dice.roll(), dice.roll(), dice.roll()],
        });
        let mut scene = hazy(haze, dice.between(0.1, 1e6) - 0.1, 180.0 * dice.roll() - 90.0);
        scene.planet.ground_albedo = [dice.roll(), dice.roll(), dice.roll()];
        if round % 20 != 0 {
            // Light scattered once is cheap, and no part of the haze's own integrals is missing in it.
            scene.atmosphere.as_mut().unwrap().orders = Orders::Single;
        }
        let method = ["lut", "table", "nested"][round % 3];
        let frame = sphere(scene.clone(), method, Quality::Preview);
        assert_eq!(frame.pixels().count(), 72);
        let answer = probe(
            &scene,
            &[Direction::angles(360.0 * dice.roll(), 180.0 * dice.roll() - 90.0)],
        );
        let all = answer.radiance_w_m2_sr.iter().chain(&answer.transmittance);
        assert!(
            all.flatten().all(|v| v.is_finite() && *v >= 0.0),
            "{scene:?}: {answer:?}"
        );
    }
}

#[test]
fn the_methods_agree_in_haze_on_light_scattered_once() {
    for (visibility_m, top_m) in [(300.0, 200.0), (3e3, 1e3), (3e4, 2e3)] {
        for (altitude_m, sun_deg) in [
            (2.0, 60.0),
            (2.0, 12.0),
            (0.5 * top_m, 30.0),
            (1.5 * top_m, 30.0),
            (1e5, 20.0),
        ] {
            let by = |method: &str, view_steps: Option<u32>| {
                let mut scene = hazy(
                    json!({"visibility_m": visibility_m, "top_m": top_m}),
                    altitude_m,
                    sun_deg,
                );
                scene.camera.direction = Direction::angles(150.0, 0.0);
                let air = scene.atmosphere.as_mut().unwrap();
                air.orders = Orders::Single;
                air.airglow = None;
                air.view_steps = view_steps;
                air.method = serde_json::from_value(json!(method)).unwrap();
                radiance(&scene, 40, 40, Quality::Final)
            };
            // As many steps as there can be: what all methods share shows too.
            let truth = by("table", Some(256));
            for method in ["nested", "table", "lut"] {
                let (mut off, mut all) = (0.0, 0.0);
                for ((_, _, a), (_, _, b)) in by(method, None).pixels().zip(truth.pixels()) {
                    for c in 0..3 {
                        off += (a[c] - b[c]).powi(2);
                        all += b[c].powi(2);
                    }
                }
                let rmse = (off / all).sqrt();
                println!("{visibility_m} {top_m} from {altitude_m} sun {sun_deg}: {method} {rmse:.4}");
                assert!(
                    rmse < 0.01,
                    "{visibility_m} {top_m} from {altitude_m} sun {sun_deg}: {method} {rmse}"
                );
            }
        }
    }
}

/// Share of the sun's light that a layer of depth τ which absorbs nothing lets through to black ground: Eddington's
/// approximation with the beam's own term, [2 + 3μ + (2 - 3μ) e^{-τ/μ}] / [4 + 3(1 - g)τ] (Shettle and Weinman 1970,
/// delta-scaled by Joseph et al. 1976: τ' = (1 - g²)τ, g' = g / (1 + g)).
fn eddington(mu: f64, g: f64, depth: f64) -> f64 {
    let (scaled, g_scaled) = ((1.0 - g * g) * depth, g / (1.0 + g));
    (2.0 + 3.0 * mu + (2.0 - 3.0 * mu) * (-scaled / mu).exp()) / (4.0 + 3.0 * (1.0 - g_scaled) * scaled)
}

#[test]
fn fog_lets_through_what_diffusion_says() {
    for (visibility_m, top_m) in [(2e3, 500.0), (200.0, 100.0), (200.0, 500.0)] {
        for sun_deg in [70.0, 30.0] {
            let scene = alone(
                json!({"visibility_m": visibility_m, "top_m": top_m, "albedo": 1}),
                0.0,
                sun_deg,
                0.0,
            );
            let mu = f64::to_radians(sun_deg).sin();
            let depth = 3.912 / visibility_m * top_m;
            let irradiance = probe(&scene, &[]).irradiance;
            let found = (irradiance.diffuse_w_m2[1] + irradiance.direct_w_m2[1]) / mu;
            // Cornette and Shanks' mean cosine is 3g(4 + g²) / (5(2 + g²)).
            let g = 0.8;
            let mean_cosine = 3.0 * g * (4.0 + g * g) / (5.0 * (2.0 + g * g));
            let expected = eddington(mu, mean_cosine, depth);
            println!("depth {depth:.2}, sun {sun_deg}: {found:.4} for {expected:.4}");
            // The approximation is good to some 5 % (King and Harshvardhan 1986), our orders to 10 % at a depth of 10.
            assert!(
                (found / expected - 1.0).abs() < 0.15,
                "depth {depth}, sun {sun_deg}: {found} for {expected}"
            );
        }
    }
}

/// What falls on white ground under white fog leaves again: seen from above, the disc of the layer sends up all that
/// the sun sends down.
#[test]
fn white_fog_over_white_ground_loses_nothing() {
    for (visibility_m, top_m) in [(2e3, 500.0), (500.0, 500.0)] {
        let sun_deg = 50.0;
        let haze = json!({"visibility_m": visibility_m, "top_m": top_m, "albedo": 1});
        let scene = alone(haze, top_m + 1.0, sun_deg, 1.0);
        // Light upwards through a plane over the layer: midpoints in cos² and azimuth, so that each counts alike. Rays
        // within 6° of the horizon, a hundredth of it, lie beyond the plane.
        let (rings, azimuths) = (12, 24);
        let directions: Vec<_> = (0..rings * azimuths)
            .map(|i| {
                let squared = (f64::from(i / azimuths) + 0.5) / f64::from(rings);
                let elevation_deg = -squared.sqrt().asin().to_degrees();
                Direction::angles(
                    360.0 * (f64::from(i % azimuths) + 0.5) / f64::from(azimuths),
                    elevation_deg,
                )
            })
            .collect();
        let answer = probe(&scene, &directions);
        let mean: Rgb = [0, 1, 2]
            .map(|c| answer.radiance_w_m2_sr.iter().map(|l| l[c]).sum::<f64>() / f64::from(rings * azimuths));
        let back = std::f64::consts::PI * mean[1] / f64::to_radians(sun_deg).sin();
        println!("{visibility_m}: {back:.4}");
        // The aerosols' orders keep their energy within some per cent each way.
        assert!((back - 1.0).abs() < 0.08, "{visibility_m}: {back}");
    }
}
