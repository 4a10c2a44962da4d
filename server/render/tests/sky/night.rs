//! Moon, stars and airglow in frames and probes.

use crate::scenes::{Radiance, Rgb, left, luma, order, picture, probe, radiance, seen, whole};
use serde_json::{Value, json};
use welkin_scene::{Direction, Quality, Scene, renderer::Output};

/// Sun far below, and a moon or none.
pub(crate) fn night(moon: Value, changes: Value) -> Scene {
    let mut all = json!({"sun": {"position": {"azimuth_deg": 0, "elevation_deg": -50}}, "moon": moon});
    all.as_object_mut()
        .unwrap()
        .extend(changes.as_object().unwrap().clone());
    whole(all)
}

pub(crate) fn looking(azimuth_deg: f64, elevation_deg: f64, vertical_fov_deg: f64) -> Value {
    json!({
        "direction": {"azimuth_deg": azimuth_deg, "elevation_deg": elevation_deg},
        "projection": {"kind": "perspective", "vertical_fov_deg": vertical_fov_deg},
    })
}

/// Radiance times solid angle over a small field, where a pixel's solid angle is that of the middle times cos³.
pub(crate) fn flux(frame: &Radiance, vertical_fov_deg: f64) -> Rgb {
    let focal_px = frame.height as f64 / 2.0 / (vertical_fov_deg.to_radians() / 2.0).tan();
    let mut sum = [0.0; 3];
    for (x, y, value) in frame.pixels() {
        let off = [
            x as f64 + 0.5 - frame.width as f64 / 2.0,
            y as f64 + 0.5 - frame.height as f64 / 2.0,
        ];
        let cos = 1.0 / (1.0 + (off[0].powi(2) + off[1].powi(2)) / focal_px.powi(2)).sqrt();
        for c in 0..3 {
            sum[c] += value[c] * cos.powi(3) / focal_px.powi(2);
        }
    }
    sum
}

pub(crate) fn minus(a: Rgb, b: Rgb) -> Rgb {
    [0, 1, 2].map(|c| a[c] - b[c])
}

#[test]
fn stars_hold_their_light_and_the_air_takes_its_share() {
    let with = |stars: Value, atmosphere: Value, camera: Value| {
        let changes = json!({"stars": stars, "camera": camera, "atmosphere": atmosphere});
        radiance(&night(Value::Null, changes), 400, 400, Quality::Preview)
    };
    // Bright stars of the catalogue culminate in the south at 90° - 45° + their declination.
    for (ra, dec, allowed) in [
        (101.287, -16.716, 0.01),
        (88.793, 7.407, 0.01),
        (78.634, -8.202, 0.01),
        (120.896, -40.003, 0.02),
    ] {
        let stars = |on: f64| json!({"intensity": on, "limiting_magnitude": 2.5, "orientation": {"latitude_deg": 45, "sidereal_time_deg": ra}});
        let elevation_deg = 45.0 + dec;
        let camera = looking(180.0, elevation_deg, 0.5);
        let of = |atmosphere: Value| {
            let on = with(stars(1.0), atmosphere.clone(), camera.clone());
            minus(
                flux(&on, 0.5),
                flux(&with(stars(0.0), atmosphere, camera.clone()), 0.5),
            )
        };
        let (air, none) = (of(json!({"airglow": null})), of(Value::Null));
        let expected = left(&night(Value::Null, json!({})), 180.0, elevation_deg);
        for c in 0..3 {
            // The light that the air scatters of all stars, and the table's optical depth near the horizon.
            let off = (air[c] / none[c] / expected[c] - 1.0).abs();
            assert!(off < allowed, "{dec}: {air:?} {none:?} {expected:?}");
        }
        // Low stars are red.
        assert!(
            elevation_deg > 20.0 || air[2] / air[0] < 0.5 * none[2] / none[0],
            "{dec}: {air:?} {none:?}"
        );
    }
}

#[test]
fn no_star_shows_through_the_ground() {
    let camera = looking(180.0, -30.0, 40.0);
    let of = |stars: Value| {
        let scene = night(
            Value::Null,
            json!({"stars": stars, "camera": camera, "planet": {"ground_albedo": [0, 0, 0]}}),
        );
        let frame = radiance(&scene, 64, 64, Quality::Preview);
        frame.pixels().map(|(_, _, c)| c).collect::<Vec<_>>()
    };
    // A star of no light at a place of the sky that is hidden anyway.
    assert_eq!(
        of(json!({"intensity": 1})),
        of(json!({"intensity": 1, "orientation": {"latitude_deg": -30}}))
    );
}

/// In daylight a frame has the very bytes of a frame without stars.
#[test]
fn by_day_there_are_no_stars() {
    let of = |stars: Value, elevation_deg: f64, atmosphere: Value| {
        let sun = json!({"position": {"azimuth_deg": 250, "elevation_deg": elevation_deg}});
        // Ground that sends nothing, since starlight on it is there by day as well.
        let planet = json!({"ground_albedo": [0, 0, 0]});
        let scene = whole(
            json!({"sun": sun, "stars": stars, "atmosphere": atmosphere, "planet": planet, "camera": looking(180.0, 40.0, 60.0)}),
        );
        let frame = crate::scenes::frame(order(scene, 64, 36, Quality::Preview, Output::Linear));
        frame.pixels.clone()
    };
    let bright = json!({"intensity": 1000});
    let quiet = json!({"airglow": null});
    for elevation_deg in [60.0, 5.0, -1.9] {
        assert_eq!(
            of(json!({}), elevation_deg, json!({"airglow": null})),
            of(json!({"limiting_magnitude": -2}), elevation_deg, quiet.clone())
        );
    }
    assert_ne!(
        of(bright.clone(), -8.0, quiet.clone()),
        of(json!({}), -8.0, quiet)
    );
    // Without air they are always there.
    assert_ne!(of(bright, 60.0, Value::Null), of(Value::Null, 60.0, Value::Null));
}

/// Where the stars begin to come out they are lost in the sky: at 0.1° a pixel no star is a hundredth of its pixel.
#[test]
fn stars_come_out_unseen() {
    let of = |stars: Value| {
        let sun = json!({"position": {"azimuth_deg": 290, "elevation_deg": -2.3}});
        let scene = whole(json!({"sun": sun, "stars": stars, "camera": looking(180.0, 25.0, 36.0)}));
        radiance(&scene, 360, 360, Quality::Preview)
    };
    let (with, without) = (of(json!({})), of(json!({"intensity": 0})));
    let most = with
        .pixels()
        .map(|(x, y, value)| luma(value) / luma(without.at(x, y)) - 1.0)
        .fold(0.0, f64::max);
    assert!(most < 0.01, "{most}");
}

#[test]
fn the_night_is_dark_but_not_black() {
    let starless = json!({"stars": null});
    let glowing = night(Value::Null, starless.clone());
    let zenith = seen(&glowing, 0.0, 90.0);
    // 22 mag/arcsec², less what the air takes and does not give back.
    assert!((0.85..1.0).contains(&(zenith[1] / 2.45e-9)), "{zenith:?}");
    // Brighter towards the horizon (van Rhijn), and the ground has some of it.
    let low = seen(&glowing, 0.0, 20.0);
    assert!((1.5..2.7).contains(&(low[1] / zenith[1])), "{low:?}");
    let ground = seen(&glowing, 0.0, -40.0);
    assert!((0.02..0.3).contains(&(ground[1] / zenith[1])), "{ground:?}");
    // Off is off, but for the sun, which is 50° below the horizon.
    let black = night(
        Value::Null,
        json!({"stars": null, "atmosphere": {"airglow": null}}),
    );
    assert!(luma(seen(&black, 0.0, 90.0)) < 1e-6 * luma(zenith));
    // Twice the emission is twice the light.
    let twice = night(
        Value::Null,
        json!({"stars": null, "atmosphere": {"airglow": {"zenith_radiance_w_m2_sr": [3.4e-9, 4.9e-9, 3.72e-9]}}}),
    );
    assert!((seen(&twice, 0.0, 90.0)[1] / zenith[1] - 2.0).abs() < 1e-3);
}

#[test]
fn airglow_is_an_arc_over_the_limb_from_orbit() {
    let mut scene = night(Value::Null, json!({"stars": null}));
    scene.camera.position_m = [0.0, 0.0, 4e5];
    // The tangent height of a ray at an angle from the nadir: (R + h) sin - R.
    let at_tangent = |height_m: f64| {
        let nadir = ((6.36e6 + height_m) / 6.76e6_f64).asin().to_degrees();
        luma(seen(&scene, 0.0, nadir - 90.0))
    };
    let (peak, above, below) = (at_tangent(85_500.0), at_tangent(99_000.0), at_tangent(70_000.0));
    assert!(
        above < 1e-6 * peak && peak > 1.5 * below && below > 0.0,
        "{below} {peak} {above}"
    );
    // The chord through the whole shell at its base: 2 √(2 R 11.5 km) = 772 km of 12 km at the zenith.
    let zenith = 0.2126 * 1.7e-9 + 0.7152 * 2.45e-9 + 0.0722 * 1.86e-9;
    // Above the base by half a kilometre, in nearly clear air.
    assert!((peak / zenith / 64.0 - 1.0).abs() < 0.05, "{}", peak / zenith);
}

/// From daylight to night the light falls without a jump: between steps of 0.02° of the sun it changes by what the steepest
/// part of twilight has, a factor of ten in 2°, and half as much again.
#[test]
fn twilight_passes_into_night_without_a_jump() {
    let moon = json!({"position": {"azimuth_deg": 120, "elevation_deg": 30}, "phase_angle_deg": 40});
    let towards = [
        Direction::angles(270.0, 3.0),
        Direction::angles(270.0, 90.0),
        Direction::angles(90.0, 20.0),
        Direction::angles(0.0, -30.0),
    ];
    let at = |elevation_deg: f64| {
        let sun = json!({"position": {"azimuth_deg": 270, "elevation_deg": elevation_deg}});
        probe(&whole(json!({"sun": sun, "moon": moon})), &towards).radiance_w_m2_sr
    };
    const STEP_DEG: f64 = 0.02;
    let most = 10_f64.powf(1.5 * STEP_DEG / 2.0);
    for begins in [
        5.0, 4.03, 3.99, 2.0, 0.01, -0.83, -3.0, -6.0, -9.0, -12.0, -15.0, -18.0,
    ] {
        let (before, after) = (at(begins), at(begins - STEP_DEG));
        for (i, (a, b)) in before.iter().zip(&after).enumerate() {
            for c in 0..3 {
                let ratio = (a[c] / b[c]).max(b[c] / a[c]);
                assert!(ratio < most, "{begins}, direction {i}, band {c}: {ratio}");
            }
        }
    }
}

#[test]
fn without_moon_stars_and_airglow_nothing_of_them_is_left() {
    let off = json!({"sun": {"position": {"azimuth_deg": 200, "elevation_deg": -7}}, "moon": null, "stars": null, "atmosphere": {"airglow": null}});
    // Moon and stars of no light.
    let mut dim = off.clone();
    dim["moon"] = json!({"position": [0, 1, 1], "irradiance_scale": 0});
    dim["stars"] = json!({"intensity": 0});
    dim["atmosphere"] = json!({"airglow": {"zenith_radiance_w_m2_sr": [0, 0, 0]}});
    let of = |changes: Value| {
        let frame = crate::scenes::frame(order(whole(changes), 48, 27, Quality::Preview, Output::Linear));
        (frame.pixels.clone(), frame.facts.moon)
    };
    let (without, no_moon) = of(off);
    let (with, a_moon) = of(dim);
    assert_eq!(without, with);
    assert!(no_moon.is_none() && a_moon.is_some());
}

/// A moonlit landscape is dark but can be read; under the stars alone it is darker, and the stars are there.
#[test]
fn the_meter_leaves_night_night() {
    let mean = |scene: &Scene| {
        let (pixels, ev) = picture(scene, 96, 54);
        let sum: f64 = pixels.iter().map(|p| luma(p.map(f64::from))).sum();
        (sum / pixels.len() as f64, ev.unwrap())
    };
    let (day, day_ev) = mean(&welkin_scene::preset("clear-noon").unwrap().scene);
    let (moonlit, moonlit_ev) = mean(&welkin_scene::preset("moonlit-night").unwrap().scene);
    let (starry, starry_ev) = mean(&welkin_scene::preset("starry-night").unwrap().scene);
    assert!(
        (20.0..70.0).contains(&moonlit) && (8.0..45.0).contains(&starry) && day > 90.0,
        "{day} {moonlit} {starry}"
    );
    // As photographers do: EV 14 to 16, -2 to -4, -5 to -8.
    assert!(
        day_ev > 12.0 && (-4.0..-1.0).contains(&moonlit_ev) && (-8.0..-4.5).contains(&starry_ev),
        "{day_ev} {moonlit_ev} {starry_ev}"
    );
}
