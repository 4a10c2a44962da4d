//! The moon's disc, its light, and its shadow.

use crate::{
    night::{flux, looking, minus, night},
    scenes::{Rgb, left, luma, probe, radiance, seen, vacuum, whole},
};
use serde_json::{Value, json};
use std::f64::consts::PI;
use welkin_scene::{Direction, Quality, Scene};

#[test]
fn the_moons_disc_holds_its_irradiance_at_any_size_and_phase() {
    let position = json!({"azimuth_deg": 180, "elevation_deg": 40});
    for phase in [0.0, 90.0, 140.0] {
        for (fov, side) in [(1.0, 400), (1.0, 100), (4.0, 64), (20.0, 64), (60.0, 64)] {
            let moon = |disc: bool| json!({"position": position, "phase_angle_deg": phase, "disc": disc, "earthshine": 0});
            let of = |disc: bool| {
                let mut all = night(
                    moon(disc),
                    json!({"camera": looking(180.0, 40.0, fov), "stars": null}),
                );
                all.atmosphere = None;
                let frame = radiance(&all, side, side, Quality::Final);
                (
                    flux(&frame, fov),
                    probe(&all, &[]).irradiance.moon_direct_normal_w_m2,
                )
            };
            let (with, expected) = of(true);
            let found = minus(with, of(false).0);
            // What the product promises; a crescent a fifth of a pixel wide is met by few of its looks.
            let allowed = if phase > 100.0 && fov > 10.0 { 0.02 } else { 0.01 };
            for c in 0..3 {
                assert!(
                    (found[c] / expected[c] - 1.0).abs() < allowed,
                    "{phase} {fov} {side}: {found:?} {expected:?}"
                );
            }
        }
    }
}

#[test]
fn the_air_dims_and_reddens_the_moon() {
    for elevation_deg in [50.0, 10.0, 3.0] {
        let moon =
            json!({"position": {"azimuth_deg": 180, "elevation_deg": elevation_deg}, "phase_angle_deg": 30});
        let camera = looking(180.0, elevation_deg, 1.0);
        let of = |atmosphere: Value| {
            let changes = json!({"camera": camera, "stars": null, "atmosphere": atmosphere});
            radiance(&night(moon.clone(), changes), 33, 33, Quality::Final).at(16, 16)
        };
        let (air, none) = (of(json!({})), of(Value::Null));
        let expected = left(&night(moon.clone(), json!({})), 180.0, elevation_deg);
        for c in 0..3 {
            // The sky view's optical depth between its texels, and the moonlit sky before the disc.
            assert!(
                (air[c] / none[c] / expected[c] - 1.0).abs() < 0.02,
                "{elevation_deg}: {air:?} {none:?} {expected:?}"
            );
        }
    }
}

/// The moon lights the sky as a sun of its irradiance would.
#[test]
fn moonlight_is_the_suns_scattering() {
    let at = json!({"azimuth_deg": 120, "elevation_deg": 35});
    let dark = json!({"stars": null, "atmosphere": {"airglow": null}});
    let moonlit = night(
        json!({"position": at, "phase_angle_deg": 0, "disc": false}),
        dark.clone(),
    );
    let without = night(Value::Null, dark);
    let irradiance = {
        let mut bare = moonlit.clone();
        bare.atmosphere = None;
        probe(&bare, &[]).irradiance.moon_direct_normal_w_m2
    };
    let sun = json!({"position": at, "irradiance_w_m2": irradiance, "disc": false});
    let as_sun = whole(json!({"sun": sun, "stars": null, "atmosphere": {"airglow": null}}));
    for (azimuth_deg, elevation_deg) in [(120.0, 35.0), (300.0, 60.0), (0.0, 2.0), (200.0, -20.0)] {
        let found = minus(
            seen(&moonlit, azimuth_deg, elevation_deg),
            seen(&without, azimuth_deg, elevation_deg),
        );
        let expected = seen(&as_sun, azimuth_deg, elevation_deg);
        for c in 0..3 {
            // The same functions of the same f32 tables.
            assert!(
                (found[c] / expected[c] - 1.0).abs() < 1e-3,
                "{azimuth_deg} {elevation_deg}: {found:?} {expected:?}"
            );
        }
    }
    // In frames as in the probe.
    let camera = looking(300.0, 30.0, 60.0);
    let of = |mut scene: Scene| {
        scene.camera = serde_json::from_value(camera.clone()).unwrap();
        radiance(&scene, 32, 18, Quality::Final)
    };
    let (moon, sun, none) = (of(moonlit), of(as_sun), of(without));
    for (x, y, value) in moon.pixels() {
        let found = minus(value, none.at(x, y));
        for c in 0..3 {
            // As above.
            assert!(
                (found[c] / sun.at(x, y)[c] - 1.0).abs() < 1e-3,
                "{x} {y}: {found:?} {:?}",
                sun.at(x, y)
            );
        }
    }
}

#[test]
fn a_thinner_moon_gives_less_light() {
    let sky = |phase: f64, scale: f64| {
        let position = json!({"azimuth_deg": 90, "elevation_deg": 40});
        let moon = json!({"position": position, "phase_angle_deg": phase, "irradiance_scale": scale});
        let dark = json!({"stars": null, "atmosphere": {"airglow": null}});
        luma(seen(&night(moon, dark), 270.0, 45.0))
    };
    // Allen's magnitudes from full: 2.60 at 90°, 5.92 at 150°.
    for (phase, magnitudes) in [(90.0, 2.60), (150.0, 5.92)] {
        let found = -2.5 * (sky(phase, 1.0) / sky(0.0, 1.0)).log10();
        assert!((found - magnitudes).abs() < 0.03, "{phase}: {found}");
    }
    assert!((sky(0.0, 4.0) / sky(0.0, 1.0) - 4.0).abs() < 1e-3);
}

/// The moon in the way of the sun.
#[test]
fn an_eclipse_darkens_disc_sky_and_ground() {
    let sun = json!({"position": {"azimuth_deg": 180, "elevation_deg": 40}, "angular_diameter_deg": 0.5, "limb_darkening": false});
    let at = |off_deg: f64| {
        let moon = json!({"position": {"azimuth_deg": 180, "elevation_deg": 40.0 + off_deg}, "angular_diameter_deg": 0.55, "earthshine": 0});
        let scene =
            whole(json!({"sun": sun, "moon": moon, "stars": null, "camera": looking(180.0, 40.0, 2.0)}));
        let frame = radiance(&scene, 200, 200, Quality::Preview);
        (
            flux(&frame, 2.0)[1],
            probe(&scene, &[Direction::angles(0.0, 30.0)]),
        )
    };
    let (whole, free) = at(0.6);
    let (half, partly) = at(0.25);
    let (none, total) = at(0.0);
    let share = partly.irradiance.direct_normal_w_m2[1] / free.irradiance.direct_normal_w_m2[1];
    assert!((0.4..0.6).contains(&share), "{share}");
    // 144 looks a pixel; the sky before the disc is some thousandths of it.
    assert!((half / whole - share).abs() < 0.01, "{half} {whole} {share}");
    assert!((partly.radiance_w_m2_sr[0][1] / free.radiance_w_m2_sr[0][1] - share).abs() < 1e-3);
    assert_eq!(total.irradiance.direct_normal_w_m2, [0.0; 3]);
    // Corona and the light from beyond the shadow.
    assert!(none / whole < 1e-5 && none > 0.0, "{}", none / whole);
    let dusk = total.radiance_w_m2_sr[0][1] / free.radiance_w_m2_sr[0][1];
    assert!((1e-4..3e-4).contains(&dusk), "{dusk}");
}

/// A full moon's light on the ground, lux.
#[test]
fn a_full_moon_lights_the_ground_as_measured() {
    let moon = json!({"position": {"azimuth_deg": 180, "elevation_deg": 60}, "phase_angle_deg": 0});
    let light = probe(&night(moon, json!({})), &[]).irradiance;
    let lux = |e: Rgb| 0.2126 * 90231.0 * e[0] + 0.7152 * 71876.0 * e[1] + 0.0722 * 69561.0 * e[2];
    let direct = lux(light.moon_direct_normal_w_m2) * (60.0 * PI / 180.0).sin();
    let sky = lux(light.diffuse_w_m2);
    // 0.1 to 0.3 lx (Kyba et al. 2017), most of it direct.
    assert!(
        (0.1..0.3).contains(&(direct + sky)) && sky < direct,
        "{direct} {sky}"
    );
    let airless = vacuum(json!({"moon": {"position": {"azimuth_deg": 180, "elevation_deg": 60}}}));
    assert!(probe(&airless, &[]).moon.is_some());
}
