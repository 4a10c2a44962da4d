//! Vacuum, absent parts, orders of scattering, and the ground's light.

use crate::scenes::{probe, radiance, scene, seen, vacuum};
use serde_json::json;
use std::f64::consts::PI;
use welkin_scene::{Direction, Quality, Scene};

fn directions() -> Vec<Direction> {
    [
        (180.0, 60.0),
        (180.0, 5.0),
        (90.0, 30.0),
        (0.0, 1.0),
        (0.0, -1.0),
        (45.0, -30.0),
        (0.0, -90.0),
    ]
    .map(|(azimuth, elevation)| Direction::angles(azimuth, elevation))
    .to_vec()
}

#[test]
fn vacuum_is_black_above_and_lit_by_the_sun_alone_below() {
    for (z, elevation_deg) in [(2.0, 35.0), (4e5, 70.0), (1e3, 5.0)] {
        let scene = vacuum(json!({
            "camera": {"position_m": [0, 0, z]},
            "sun": {"position": {"azimuth_deg": 180, "elevation_deg": elevation_deg}},
            "planet": {"ground_albedo": [0.1, 0.5, 0.9]},
        }));
        let down = probe(&scene, &[Direction::angles(0.0, -90.0)]);
        let sin = f64::sin(f64::to_radians(elevation_deg));
        for c in 0..3 {
            let expected = [0.1, 0.5, 0.9][c] / PI * scene.sun.irradiance_w_m2[c] * sin;
            // f32.
            assert!(
                (down.radiance_w_m2_sr[0][c] / expected - 1.0).abs() < 1e-5,
                "{z}: {down:?} {expected}"
            );
        }
        assert!((down.distance_m[0].unwrap() / z - 1.0).abs() < 1e-5);
        let up = probe(
            &scene,
            &[Direction::angles(0.0, 40.0), Direction::angles(77.0, 0.5)],
        );
        assert_eq!(up.radiance_w_m2_sr, [[0.0; 3]; 2]);
        assert_eq!(up.transmittance, [[1.0; 3]; 2]);
        for c in 0..3 {
            // f64 sums.
            assert!(
                (up.irradiance.direct_normal_w_m2[c] / scene.sun.irradiance_w_m2[c] - 1.0).abs() < 1e-12,
                "{up:?}"
            );
        }
        // Ground light alone: none comes down.
        assert!(
            up.irradiance
                .diffuse_w_m2
                .iter()
                .all(|e| *e < 1e-6 * scene.sun.irradiance_w_m2[1])
        );
        let frame = radiance(&scene, 64, 48, Quality::Preview);
        let (_, _, top) = frame.pixels().next().unwrap();
        assert_eq!(top, [0.0; 3]);
    }
}

#[test]
fn air_of_no_density_and_air_of_no_parts_are_vacuum() {
    let expected = probe(&vacuum(json!({})), &directions());
    let nothing = [
        json!({"atmosphere": {"density_factor": 0}}),
        json!({"atmosphere": {"rayleigh": null, "mie": null, "ozone": null}}),
        json!({"atmosphere": {"rayleigh": {"scattering_per_m": [0, 0, 0]}, "ozone": null,
                              "mie": {"scattering_per_m": 0, "absorption_per_m": 0}}}),
    ];
    for changes in nothing {
        let found = probe(&scene(changes.clone()), &directions());
        for (found, expected) in found.radiance_w_m2_sr.iter().zip(&expected.radiance_w_m2_sr) {
            for c in 0..3 {
                // f32.
                assert!(
                    (found[c] - expected[c]).abs() <= 1e-6 * expected[c],
                    "{changes}: {found:?} {expected:?}"
                );
            }
        }
        assert_eq!(found.transmittance, expected.transmittance, "{changes}");
    }
}

/// Each part alone, and what it does.
#[test]
fn each_part_does_its_own_work() {
    let zenith = [Direction::angles(0.0, 90.0)];
    let molecules = probe(
        &scene(json!({"atmosphere": {"mie": null, "ozone": null}})),
        &zenith,
    );
    let aerosols = probe(
        &scene(json!({"atmosphere": {"rayleigh": null, "ozone": null}})),
        &zenith,
    );
    let ozone = probe(
        &scene(json!({"atmosphere": {"rayleigh": null, "mie": null}})),
        &zenith,
    );
    let [r, g, b] = molecules.radiance_w_m2_sr[0];
    assert!(
        b > 1.5 * g && g > 1.5 * r,
        "molecules make the sky blue: {molecules:?}"
    );
    let grey = aerosols.radiance_w_m2_sr[0];
    let suns = Scene::default().sun.irradiance_w_m2;
    // Aerosols are grey; the ground they see is too.
    assert!(
        (grey[0] / suns[0] / (grey[2] / suns[2]) - 1.0).abs() < 1e-3,
        "{grey:?}"
    );
    assert_eq!(ozone.radiance_w_m2_sr[0], [0.0; 3], "ozone does not scatter");
    let [r, g, b] = ozone.transmittance[0];
    // The Chappuis bands lie about 600 nm.
    assert!(r < g && g < b && b < 1.0, "ozone takes red most: {ozone:?}");
}

#[test]
fn more_orders_and_a_brighter_ground_add_light_everywhere() {
    let of = |orders: &str, albedo: f64| {
        let scene = scene(json!({
            "atmosphere": {"orders": orders},
            "planet": {"ground_albedo": [albedo, albedo, albedo]},
            "sun": {"disc": false},
        }));
        probe(&scene, &directions())
    };
    let (single, dark, bright) = (of("single", 0.0), of("multiple", 0.0), of("multiple", 0.8));
    for i in 0..directions().len() {
        for c in 0..3 {
            let values = [&single, &dark, &bright].map(|a| a.radiance_w_m2_sr[i][c]);
            // Downward from 2 m there are 4 m of air at most: the share of the higher orders in it is tiny, but there.
            assert!(
                values[0] <= values[1] && values[1] < values[2],
                "direction {i}, band {c}: {values:?}"
            );
        }
    }
    // At the zenith in the blue the higher orders are a fifth to a half of the whole (Hillaire 2020, figure 8).
    let zenithal = [&single, &dark].map(|a| a.radiance_w_m2_sr[0][2]);
    let share = 1.0 - zenithal[0] / zenithal[1];
    assert!((0.15..0.5).contains(&share), "{share}");
    let lit = [&single, &dark, &bright].map(|a| a.irradiance.diffuse_w_m2[2]);
    assert!(lit[0] < lit[1] && lit[1] < lit[2], "{lit:?}");
}

#[test]
fn a_coloured_ground_colours_the_sky_in_its_own_band_alone() {
    let of = |albedo: [f64; 3]| seen(&scene(json!({"planet": {"ground_albedo": albedo}})), 0.0, 60.0);
    let (grey, red) = (of([0.1, 0.1, 0.1]), of([0.9, 0.1, 0.1]));
    assert!(red[0] > 1.02 * grey[0], "{red:?} {grey:?}");
    assert_eq!(red[1..], grey[1..]);
}
