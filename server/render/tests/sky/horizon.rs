//! Horizon, limb, zenith, and the top of the air: where systems like this one break first.

use crate::scenes::{Radiance, luma, radiance, scene};
use serde_json::{Value, json};
use welkin_scene::{Quality, Scene};

const HEIGHTS_M: [f64; 7] = [0.0, 2.0, 100.0, 1e4, 1.0001e5, 4e5, 4e7];
const SUNS_DEG: [f64; 5] = [90.0, 30.0, 0.0, -4.0, -90.0];

fn dip_deg(z: f64) -> f64 {
    f64::acos(6.36e6 / (6.36e6 + z)).to_degrees()
}

/// A strip three pixels wide, its middle on the horizon, without the sun's disc.
fn strip(z: f64, sun_deg: f64, azimuth_deg: f64, fov_deg: f64) -> Radiance {
    let scene = scene(json!({
        "camera": {"position_m": [0, 0, z], "direction": {"azimuth_deg": azimuth_deg, "elevation_deg": -dip_deg(z)},
                   "projection": {"kind": "perspective", "vertical_fov_deg": fov_deg}},
        "sun": {"position": {"azimuth_deg": 180, "elevation_deg": sun_deg}, "disc": false},
    }));
    radiance(&scene, 3, 241, Quality::Final)
}

/// No row is a line: none lies above or below both of its neighbours, and what they lead to, by more than the
/// tolerance. A sky that brightens down to the horizon goes on doing so in the last row.
fn no_lines(strip: &Radiance, case: &str) {
    let column: Vec<_> = (0..strip.height).map(|y| strip.at(1, y)).collect();
    let brightest = column.iter().map(|c| luma(*c)).fold(0.0, f64::max);
    for y in 2..strip.height - 2 {
        for c in 0..3 {
            let [two_above, above, here, below, two_below] = [0, 1, 2, 3, 4].map(|d| column[y + d - 2][c]);
            let (slope_above, slope_below) = ((above - two_above).abs(), (below - two_below).abs());
            let least = (above - slope_above).min(below - slope_below);
            let most = (above + slope_above).max(below + slope_below);
            // 2 % is twice what the eye sees between two fields side by side; a ten-thousandth of the brightest row is
            // less than the last step of an 8-bit picture.
            let slack = 0.02 * here + 1e-4 * brightest;
            assert!(
                here > least - slack && here < most + slack,
                "{case}, row {y}, band {c}: {two_above} {above} {here} {below} {two_below}"
            );
        }
    }
}

#[test]
fn no_line_stands_at_the_horizon() {
    for z in HEIGHTS_M {
        for sun_deg in SUNS_DEG {
            for azimuth_deg in [180.0, 270.0, 0.0] {
                // Rows must be finer than the limb, whose glow has a true ridge: 0.13° from 40,000 km.
                let fields_deg = if z > 1e7 { [0.4, 0.1] } else { [3.0, 0.1] };
                for fov_deg in fields_deg {
                    let case = format!("{z} m, sun {sun_deg}°, azimuth {azimuth_deg}°, field {fov_deg}°");
                    no_lines(&strip(z, sun_deg, azimuth_deg, fov_deg), &case);
                }
            }
        }
    }
}

/// Sky and ground are both there, with the horizon where geometry has it.
#[test]
fn the_horizon_lies_where_the_ground_begins() {
    for z in [2.0, 1e4, 4e5, 4e7] {
        for fov_deg in [10.0, 1.0] {
            let scene = Scene {
                atmosphere: None,
                ..scene(json!({
                    "camera": {"position_m": [0, 0, z],
                               "direction": {"azimuth_deg": 0, "elevation_deg": -dip_deg(z)},
                               "projection": {"kind": "perspective", "vertical_fov_deg": fov_deg}},
                    "sun": {"position": {"azimuth_deg": 0, "elevation_deg": 60}},
                }))
            };
            let column = radiance(&scene, 1, 101, Quality::Preview);
            // Row 50 is half sky, half ground; from far up the ground darkens towards the limb as the sun sinks there.
            assert_eq!(column.at(0, 48), [0.0; 3], "{z} {fov_deg}");
            assert!(luma(column.at(0, 52)) > 0.0, "{z} {fov_deg}");
            let half = luma(column.at(0, 50)) / luma(column.at(0, 51));
            assert!((half - 0.5).abs() < 0.1, "{z} {fov_deg}: {half}");
        }
    }
}

fn sphere(position_m: [f64; 3], sun: Value) -> Radiance {
    let scene = scene(json!({
        "camera": {"position_m": position_m, "projection": {"kind": "equirectangular"}},
        "sun": {"position": sun, "disc": false},
    }));
    // `radiance` refuses what is not finite or negative.
    radiance(&scene, 48, 24, Quality::Preview)
}

#[test]
fn every_place_and_sun_gives_numbers() {
    let places = [
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 2.0],
        [3e3, -4e3, 10.0],
        [0.0, 0.0, 1e5],
        [2e6, 1e6, 4e5],
        [-6.36e6, 0.0, 1e5],
        [0.0, 3e6, -1.27e7],
        [1e3, 0.0, 4e7],
        [7e7, -7e7, 1e8],
    ];
    let suns = [
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
        [1.0, 0.0, 0.0],
        [0.6, -0.8, 0.0],
        [1e-9, 0.0, 1.0],
        [-1.0, 2.0, 1e-7],
    ];
    for place in places {
        for sun in suns {
            let frame = sphere(place, json!(sun));
            let observer = scene(json!({"camera": {"position_m": place}})).observer();
            let up = observer.up;
            let sun_height = up[0] * sun[0] + up[1] * sun[1] + up[2] * sun[2];
            // On the day side the day is seen; from very far the planet falls between the pixels.
            if sun_height > 0.0 && observer.altitude_m < 1e7 {
                assert!(
                    frame.pixels().any(|(_, _, c)| luma(c) > 1e-3),
                    "{place:?} {sun:?}"
                );
            }
        }
    }
}

#[test]
fn extreme_air_gives_numbers() {
    let airs = [
        json!({"density_factor": 100}),
        json!({"rayleigh": {"scattering_per_m": [0.1, 0.1, 0.1], "scale_height_m": 10}}),
        json!({"rayleigh": {"scale_height_m": 1e5}, "mie": {"scattering_per_m": 0.1, "scale_height_m": 1e5}}),
        json!({"mie": {"asymmetry": 0.999}}),
        json!({"mie": {"asymmetry": -0.999}}),
        json!({"top_m": 1000}),
        json!({"top_m": 1e6}),
        json!({"ozone": {"absorption_per_m": [0.1, 0.1, 0.1], "centre_m": 0, "half_width_m": 1}}),
    ];
    for air in airs {
        for (z, radius_m) in [(0.0, 6.36e6), (2.0, 1e5), (5e5, 1e8)] {
            for sun_deg in [90.0, 3.0, -2.0] {
                let scene = scene(json!({
                    "camera": {"position_m": [0, 0, z], "projection": {"kind": "equirectangular"}},
                    "planet": {"radius_m": radius_m},
                    "atmosphere": air,
                    "sun": {"position": {"azimuth_deg": 10, "elevation_deg": sun_deg}},
                }));
                // `radiance` refuses what is not finite or negative.
                let frame = radiance(&scene, 24, 12, Quality::Preview);
                assert_eq!(frame.pixels().count(), 24 * 12);
            }
        }
    }
}

/// Rising through a height, nothing jumps: the top of the air, and heights where tables change their form.
#[test]
fn the_sky_is_continuous_as_the_camera_rises() {
    for sun_deg in [60.0, 5.0, -3.0] {
        for (low, high) in [
            (0.0, 0.01),
            (99_900.0, 100_100.0),
            (99_999.9, 100_000.1),
            (399_900.0, 400_100.0),
        ] {
            let [below, above] = [low, high].map(|z| {
                sphere(
                    [0.0, 0.0, z],
                    json!({"azimuth_deg": 100, "elevation_deg": sun_deg}),
                )
            });
            let brightest = below.pixels().map(|(_, _, c)| luma(c)).fold(0.0, f64::max);
            for ((x, y, a), (_, _, b)) in below.pixels().zip(above.pixels()) {
                for c in 0..3 {
                    // Two hundred metres of the thinnest air, or 0.05 % of the height; and the share of a pixel on the
                    // horizon, which moves by 0.02° of 7.5°.
                    let slack = 0.03 * a[c].max(b[c]) + 1e-3 * brightest;
                    assert!(
                        (a[c] - b[c]).abs() < slack,
                        "{low} to {high}, sun {sun_deg}, {x} {y}: {a:?} {b:?}"
                    );
                }
            }
        }
    }
}

/// With the sun at the zenith or the nadir the sky is even all round; no azimuth is special.
#[test]
fn a_sun_overhead_lights_all_sides_alike() {
    for sun in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]] {
        for z in [2.0, 4e5] {
            let frame = sphere([0.0, 0.0, z], json!(sun));
            let brightest = frame.pixels().map(|(_, _, c)| luma(c)).fold(0.0, f64::max);
            for (x, y, c) in frame.pixels() {
                let first = frame.at(0, y);
                for i in 0..3 {
                    // f32 azimuths of a sun that has none.
                    assert!(
                        (c[i] - first[i]).abs() < 2e-3 * first[i] + 1e-6 * brightest,
                        "{sun:?} {z} {x} {y}"
                    );
                }
            }
        }
    }
}

/// Both sides of the sun are mirror images.
#[test]
fn the_sky_is_even_about_the_sun() {
    for sun_deg in [40.0, 0.0, -5.0] {
        // The sun at the picture's middle: azimuth 90.
        let frame = sphere(
            [0.0, 0.0, 1e3],
            json!({"azimuth_deg": 90, "elevation_deg": sun_deg}),
        );
        for (x, y, c) in frame.pixels() {
            let mirrored = frame.at(frame.width - 1 - x, y);
            for i in 0..3 {
                assert!(
                    (c[i] - mirrored[i]).abs() <= 1e-3 * c[i],
                    "sun {sun_deg}, {x} {y}: {c:?} {mirrored:?}"
                );
            }
        }
    }
}
