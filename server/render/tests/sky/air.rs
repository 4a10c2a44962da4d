//! Every field of planet, air and sun has its effect, in the direction in which it must.

use crate::scenes::{Rgb, left, luma, probe, radiance, scene, seen, vacuum};
use serde_json::{Value, json};
use std::f64::consts::PI;
use welkin_scene::{Direction, Quality};

/// Radiance with these changes to the air, and without.
fn pair(air: Value, azimuth_deg: f64, elevation_deg: f64) -> (Rgb, Rgb) {
    let (with, without) = (scene(json!({"atmosphere": air})), scene(json!({})));
    (
        seen(&with, azimuth_deg, elevation_deg),
        seen(&without, azimuth_deg, elevation_deg),
    )
}

fn depth(transmittance: Rgb) -> Rgb {
    transmittance.map(|t| -t.ln())
}

#[test]
fn rayleigh_scattering_brightens_its_own_band() {
    let (more, less) = pair(
        json!({"rayleigh": {"scattering_per_m": [14.18e-6, 13.75e-6, 33.1e-6]}}),
        0.0,
        80.0,
    );
    // Twice the molecules in the red, which is far from saturation: nearly twice the light.
    assert!((1.6..2.05).contains(&(more[0] / less[0])), "{more:?} {less:?}");
    assert_eq!(more[1..], less[1..]);
}

#[test]
fn scale_heights_raise_the_air() {
    for part in ["rayleigh", "mie"] {
        let at = |scale_m: f64, z: f64| {
            let air = json!({part: {"scale_height_m": scale_m}});
            left(
                &scene(json!({"camera": {"position_m": [0, 0, z]}, "atmosphere": air})),
                0.0,
                90.0,
            )
        };
        let (high, low) = (
            if part == "mie" { 3e3 } else { 1e4 },
            if part == "mie" { 600.0 } else { 6e3 },
        );
        for z in [0.0, 2e3] {
            let (thick, thin) = (depth(at(high, z)), depth(at(low, z)));
            assert!(
                (0..3).all(|c| thick[c] > thin[c]),
                "{part} from {z}: {thick:?} {thin:?}"
            );
        }
    }
}

#[test]
fn aerosols_brighten_the_aureole_and_whiten_the_horizon() {
    let (more, less) = pair(json!({"mie": {"scattering_per_m": 2e-5}}), 175.0, 38.0);
    assert!(
        (0..3).all(|c| more[c] > 1.5 * less[c]),
        "beside the sun: {more:?} {less:?}"
    );
    let (more, less) = pair(json!({"mie": {"scattering_per_m": 2e-5}}), 0.0, 60.0);
    assert!(
        more[2] / more[0] < less[2] / less[0],
        "away from it: {more:?} {less:?}"
    );
}

#[test]
fn aerosols_that_absorb_darken() {
    let (more, less) = pair(json!({"mie": {"absorption_per_m": 8e-6}}), 0.0, 10.0);
    assert!((0..3).all(|c| more[c] < less[c]), "{more:?} {less:?}");
    let change = json!({"atmosphere": {"mie": {"absorption_per_m": 8e-6}}});
    let (dark, clear) = (
        depth(left(&scene(change), 0.0, 90.0)),
        depth(left(&scene(json!({})), 0.0, 90.0)),
    );
    for c in 0..3 {
        // The added absorption times what is left of the scale height 2 m up.
        let expected = (8e-6 - 0.444e-6) * (1200.0 - 2.0);
        assert!(
            ((dark[c] - clear[c]) / expected - 1.0).abs() < 1e-3,
            "{dark:?} {clear:?}"
        );
    }
}

#[test]
fn asymmetry_draws_light_towards_the_sun() {
    let of = |g: f64| {
        let scene =
            scene(json!({"atmosphere": {"rayleigh": null, "mie": {"asymmetry": g}}, "sun": {"disc": false}}));
        probe(
            &scene,
            &[Direction::angles(180.0, 37.0), Direction::angles(0.0, 20.0)],
        )
        .radiance_w_m2_sr
    };
    let (back, even, forward, peaked) = (of(-0.5), of(0.0), of(0.8), of(0.95));
    let ratio = |v: &[Rgb]| v[0][1] / v[1][1];
    let ratios = [&back, &even, &forward, &peaked].map(|v| ratio(v));
    assert!(
        ratios.windows(2).all(|w| w[1] > 1.2 * w[0]),
        "sunward over backward: {ratios:?}"
    );
}

#[test]
fn ozone_absorbs_where_its_layer_lies() {
    let of = |ozone: Value, z: f64| {
        let air = json!({"rayleigh": null, "mie": null, "ozone": ozone});
        depth(left(
            &scene(json!({"camera": {"position_m": [0, 0, z]}, "atmosphere": air})),
            0.0,
            90.0,
        ))
    };
    let plain = of(json!({}), 0.0);
    let double = of(json!({"absorption_per_m": [5.4e-6, 3.32e-6, 0.04e-6]}), 0.0);
    let wide = of(json!({"half_width_m": 22500}), 0.0);
    for c in 0..3 {
        // The tent's area: centre × half width. f32 logarithms of 0.999.
        assert!((double[c] / plain[c] - 2.0).abs() < 2e-3, "{double:?} {plain:?}");
        assert!((wide[c] / plain[c] - 1.5).abs() < 2e-3, "{wide:?} {plain:?}");
    }
    // From 30 km a layer about 60 km lies above, one about 12 km below.
    let (above, below) = (
        of(json!({"centre_m": 60_000}), 30e3),
        of(json!({"centre_m": 12_000}), 30e3),
    );
    assert!(above[1] > 0.02 && below[1] < 1e-6, "{above:?} {below:?}");
    // Chappuis absorption is what keeps the zenith blue when the sun has set (Hulburt 1953).
    let dusk = |ozone: Value| {
        let sun = json!({"position": {"azimuth_deg": 180, "elevation_deg": -4}});
        seen(
            &scene(json!({"sun": sun, "atmosphere": {"ozone": ozone}})),
            0.0,
            90.0,
        )
    };
    let (with, without) = (dusk(json!({})), dusk(Value::Null));
    assert!(
        with[2] / with[1] > 1.15 * without[2] / without[1],
        "{with:?} {without:?}"
    );
}

#[test]
fn the_top_and_the_density_scale_the_depth() {
    let of = |air: Value| depth(left(&scene(json!({"atmosphere": air})), 0.0, 90.0));
    let (plain, low) = (of(json!({})), of(json!({"top_m": 8000})));
    // 1 - 1/e of the molecules is left below one scale height.
    let kept = (low[2] / plain[2] - (1.0 - (-1.0_f64).exp())).abs();
    assert!(kept < 0.01, "{low:?} {plain:?}");
    for factor in [0.7, 1.3, 4.0] {
        let dense = of(json!({"density_factor": factor}));
        for c in 0..3 {
            assert!(
                (dense[c] / plain[c] / factor - 1.0).abs() < 1e-4,
                "{factor}: {dense:?} {plain:?}"
            );
        }
    }
}

#[test]
fn the_planets_radius_sets_the_horizon() {
    let of = |radius_m: f64| {
        let change = json!({"camera": {"position_m": [0, 0, 1000]}, "planet": {"radius_m": radius_m}});
        probe(&scene(change), &[Direction::angles(0.0, -1.5)]).distance_m[0]
    };
    // From 1 km the horizon lies √(2h/R) down: 1.016° on the Earth, 8.1° on a hundred kilometres.
    let to_ground = of(6.36e6).unwrap();
    // h / sin of the angle, and a little farther since the ground curves away.
    assert!(
        (1000.0 / f64::to_radians(1.5)..1.3 * 1000.0 / f64::to_radians(1.5)).contains(&to_ground),
        "{to_ground}"
    );
    assert_eq!(of(1e5), None);
    // On a larger planet the ground curves away less.
    assert!(of(6e7).unwrap() < to_ground);
}

#[test]
fn the_suns_irradiance_is_a_factor_of_each_band() {
    let of = |e: [f64; 3]| {
        let scene = scene(json!({"sun": {"irradiance_w_m2": e}}));
        probe(
            &scene,
            &[Direction::angles(90.0, 30.0), Direction::angles(90.0, -30.0)],
        )
        .radiance_w_m2_sr
    };
    let (unit, other) = (of([1.0, 1.0, 1.0]), of([2.0, 0.5, 0.0]));
    for (unit, other) in unit.iter().zip(other) {
        // Powers of two are exact.
        assert_eq!(other, [2.0 * unit[0], 0.5 * unit[1], 0.0]);
    }
}

#[test]
fn the_sky_turns_with_the_sun_and_darkens_as_it_sinks() {
    let of = |azimuth_deg: f64, elevation_deg: f64, at: f64| {
        let sun = json!({"position": {"azimuth_deg": azimuth_deg, "elevation_deg": elevation_deg}});
        seen(&scene(json!({"sun": sun})), at, 20.0)
    };
    let (a, b) = (of(180.0, 35.0, 150.0), of(100.0, 35.0, 70.0));
    for c in 0..3 {
        // The same place by the sun; f32 directions.
        assert!((a[c] / b[c] - 1.0).abs() < 1e-4, "{a:?} {b:?}");
    }
    let heights = [60.0, 30.0, 10.0, 2.0, -2.0, -6.0, -12.0];
    let lights = heights.map(|elevation| {
        let sun = json!({"position": {"azimuth_deg": 180, "elevation_deg": elevation}});
        luma(probe(&scene(json!({"sun": sun})), &[]).irradiance.diffuse_w_m2)
    });
    assert!(lights.windows(2).all(|w| w[1] < w[0]), "{lights:?}");
    // Civil twilight ends some 400 times darker than day (Meinel 1983: 3.4 lx of about 1e4 lx from the sky); nautical
    // twilight is hundreds of times darker still.
    assert!((1e2..1e4).contains(&(lights[1] / lights[5])), "{lights:?}");
    assert!(lights[5] / lights[6] > 50.0, "{lights:?}");
    // A setting sun is red.
    let low = left(&scene(json!({})), 180.0, 1.0);
    assert!(low[0] > 3.0 * low[1] && low[1] > 3.0 * low[2], "{low:?}");
}

#[test]
fn time_moves_a_sun_that_is_given_by_time_and_place() {
    let of = |time_s: f64, refraction: bool| {
        let position = json!({"time": "2026-03-20T06:00:00Z", "latitude_deg": 0, "longitude_deg": 0,
                              "refraction": refraction});
        let scene = scene(json!({"time_s": time_s, "sun": {"position": position}}));
        (probe(&scene, &[]).sun, luma(seen(&scene, 90.0, 40.0)))
    };
    let (sunrise, dim) = of(0.0, false);
    let (later, bright) = of(3600.0, false);
    // At the equinox on the equator the sun rises due east, straight up, 15° an hour; the equation of time (7 min)
    // sets it 2° back.
    assert!(
        (sunrise.azimuth_deg - 90.0).abs() < 0.5 && sunrise.elevation_deg.abs() < 3.0,
        "{sunrise:?}"
    );
    assert!(
        (later.elevation_deg - sunrise.elevation_deg - 15.0).abs() < 0.1,
        "{later:?}"
    );
    assert!(bright > 1.5 * dim, "{bright} {dim}");
    let lift = of(600.0, true).0.elevation_deg - of(600.0, false).0.elevation_deg;
    // Half a degree at the horizon (Bennett 1982).
    assert!((0.2..0.7).contains(&lift), "{lift}");
    let still = |time_s: f64| seen(&scene(json!({"time_s": time_s})), 90.0, 40.0);
    assert_eq!(still(0.0), still(3600.0), "a sun that is given outright stays");
}

/// Away from the origin the same sun stands at another height: by the angle between the two zeniths.
#[test]
fn the_camera_may_stand_anywhere_on_the_sphere() {
    let (radius, height) = (6.36e6, 3e3);
    for (azimuth_deg, away_deg) in [(180.0, 20.0), (0.0, 15.0), (90.0, 40.0), (0.0, 80.0)] {
        let (s, c) = f64::to_radians(away_deg).sin_cos();
        let (east, north) = f64::to_radians(azimuth_deg).sin_cos();
        let up = [s * east, s * north, c];
        let position = [
            up[0] * (radius + height),
            up[1] * (radius + height),
            c * (radius + height) - radius,
        ];
        let planet = json!({"ground_albedo": [0.3, 0.3, 0.3]});
        let scene = vacuum(json!({"camera": {"position_m": position}, "planet": planet}));
        let down = probe(&scene, &[Direction::Vector(up.map(|u| -u))]);
        // The default sun: azimuth 180, elevation 35.
        let sun = scene.sun_direction();
        let cos = (up[0] * sun[0] + up[1] * sun[1] + up[2] * sun[2]).max(0.0);
        for c in 0..3 {
            let expected = 0.3 / PI * scene.sun.irradiance_w_m2[c] * cos;
            assert!(
                (down.radiance_w_m2_sr[0][c] - expected).abs() < 1e-5,
                "{up:?}: {down:?} {expected}"
            );
        }
        // 1e-3 m of 3 km: what f64 leaves of it.
        assert!((down.distance_m[0].unwrap() - height).abs() < 1e-2, "{down:?}");
    }
}

#[test]
fn rising_darkens_the_zenith_and_lowers_the_horizon() {
    let of = |z: f64| {
        let scene = scene(json!({"camera": {"position_m": [0, 0, z]}}));
        luma(seen(&scene, 0.0, 85.0))
    };
    let lights = [2.0, 3e3, 1e4, 3e4, 6e4, 1.2e5].map(of);
    assert!(lights.windows(2).all(|w| w[1] < w[0]), "{lights:?}");
    assert_eq!(lights[5], 0.0, "over the air the sky is black");
    // Rows of a picture 60° high that see the ground, by the horizon's dip.
    let ground_rows = |z: f64| {
        let change =
            json!({"camera": {"position_m": [0, 0, z], "direction": {"azimuth_deg": 0, "elevation_deg": 0}}});
        let frame = radiance(&vacuum(change), 1, 301, Quality::Preview);
        frame.pixels().filter(|(_, _, c)| c[1] > 0.0).count()
    };
    for z in [2.0, 1e4, 4e5] {
        let dip = f64::acos(6.36e6 / (6.36e6 + z));
        let expected = 150.5 * (1.0 - dip.tan() / f64::to_radians(30.0).tan());
        // The horizon's own row.
        assert!(
            (ground_rows(z) as f64 - expected).abs() <= 1.5,
            "{z}: {} {expected}",
            ground_rows(z)
        );
    }
}
