//! The sun's disc: its energy, size, limb and absence.

use crate::scenes::{Rgb, empty_space, luma, probe, radiance, scene, seen};
use serde_json::{Value, json};
use std::f64::consts::PI;
use welkin_scene::{Quality, Scene};

const SUN: Rgb = [1.474, 1.8504, 1.91198];

fn sunny(sun: Value, camera: Value) -> Scene {
    let mut scene = empty_space(json!({"sun": sun, "camera": camera}));
    scene.camera.position_m = [0.0, 0.0, 1e8];
    scene
}

/// Of a pixel by the place of its centre in the frame, sr.
type SolidAngle<'a> = &'a dyn Fn(f64, f64) -> f64;

/// Irradiance that a frame of the sun adds up to: Σ radiance × solid angle of the pixel.
fn total(scene: &Scene, (width, height): (u32, u32), solid_angle_sr: SolidAngle<'_>) -> Rgb {
    let frame = radiance(scene, width, height, Quality::Preview);
    frame.pixels().fold([0.0; 3], |sum, (x, y, c)| {
        let sr = solid_angle_sr(x as f64 + 0.5, y as f64 + 0.5);
        [0, 1, 2].map(|i| sum[i] + sr * c[i])
    })
}

/// Of a pixel of a perspective picture: A cos³θ / f².
fn perspective_sr(fov_deg: f64, (width, height): (u32, u32)) -> impl Fn(f64, f64) -> f64 {
    let f = f64::from(height) / 2.0 / (fov_deg.to_radians() / 2.0).tan();
    move |x, y| {
        let (x, y) = (
            (x - f64::from(width) / 2.0) / f,
            (y - f64::from(height) / 2.0) / f,
        );
        (1.0 + x * x + y * y).powf(-1.5) / (f * f)
    }
}

/// Of a pixel of a cubemap whose faces are so high.
fn cubemap_sr(height: u32, x: f64, y: f64) -> f64 {
    let s = 2.0 * (x / f64::from(height)).fract() - 1.0;
    let t = 2.0 * y / f64::from(height) - 1.0;
    (1.0 + s * s + t * t).powf(-1.5) * 4.0 / f64::from(height * height)
}

/// From a disc that fills much of the picture to one that is a tenth of a pixel: maps of the environment are coarse, and
/// light that a renderer takes from them must not depend on where the sun falls between their pixels.
#[test]
fn the_disc_brings_the_suns_irradiance_at_any_size() {
    // Field of view, the sun's diameter and its place beside the axis.
    let cases = [
        (2.0, 0.5357, 0.1),
        (10.0, 0.5357, 2.0),
        (60.0, 0.5357, 3.0),
        (60.0, 0.5357, 22.0),
        (90.0, 0.5357, 30.0),
        (60.0, 5.0, 15.0),
        (60.0, 0.1, 3.0),
        (60.0, 0.01, 3.0),
    ];
    for limb_darkening in [true, false] {
        for (fov_deg, diameter_deg, off_deg) in cases {
            let size = (320, 240);
            let sun = json!({"position": {"azimuth_deg": 180.0 + off_deg, "elevation_deg": 10},
                             "angular_diameter_deg": diameter_deg, "limb_darkening": limb_darkening});
            let camera = json!({"direction": {"azimuth_deg": 180, "elevation_deg": 10},
                                "projection": {"kind": "perspective", "vertical_fov_deg": fov_deg}});
            let found = total(&sunny(sun, camera), size, &perspective_sr(fov_deg, size));
            same_as_sun(
                found,
                &format!("{fov_deg}° with a disc of {diameter_deg}°, limb {limb_darkening}"),
            );
        }
    }
}

/// What the product promises, 2 %: 144 places in each pixel count the area of a disc of one pixel to that.
fn same_as_sun(found: Rgb, case: &str) {
    for c in 0..3 {
        assert!((found[c] / SUN[c] - 1.0).abs() < 0.02, "{case}: {found:?}");
    }
}

#[test]
fn an_environment_map_holds_the_suns_irradiance() {
    for height in [64_u32, 128, 256, 512] {
        for (azimuth_deg, elevation_deg) in [(123.4, 0.3), (200.1, 35.0), (88.0, 36.1), (5.0, 78.0)] {
            let sun = json!({"position": {"azimuth_deg": azimuth_deg, "elevation_deg": elevation_deg}});
            let case = format!("{height} rows, sun {azimuth_deg} {elevation_deg}");
            let equirectangular = sunny(sun.clone(), json!({"projection": {"kind": "equirectangular"}}));
            let side = PI / f64::from(height);
            let sr = |_: f64, y: f64| ((0.5 - y / f64::from(height)) * PI).cos() * side * side;
            same_as_sun(total(&equirectangular, (2 * height, height), &sr), &case);
            let cubemap = sunny(sun, json!({"projection": {"kind": "cubemap"}}));
            let sr = |x: f64, y: f64| cubemap_sr(height, x, y);
            same_as_sun(total(&cubemap, (6 * height, height), &sr), &case);
        }
    }
}

/// Renderers that sample the sun apart take the map without the disc and the irradiance that the frame tells.
#[test]
fn the_disc_of_an_environment_map_is_the_direct_irradiance() {
    // The air's own change across a coarse pixel counts near the horizon: the disc is dimmed as its pixel's centre.
    for (azimuth_deg, elevation_deg, height) in [(123.4, 3.0, 1024_u32), (200.1, 35.0, 128)] {
        let of = |projection: &str, disc: bool| {
            scene(json!({
                "sun": {"position": {"azimuth_deg": azimuth_deg, "elevation_deg": elevation_deg}, "disc": disc},
                "camera": {"projection": {"kind": projection}},
            }))
        };
        let direct = probe(&of("cubemap", true), &[]).irradiance.direct_normal_w_m2;
        let side = PI / f64::from(height);
        let equirectangular = |_: f64, y: f64| ((0.5 - y / f64::from(height)) * PI).cos() * side * side;
        let cubemap = |x: f64, y: f64| cubemap_sr(height, x, y);
        let maps: [(&str, u32, SolidAngle<'_>); 2] =
            [("equirectangular", 2, &equirectangular), ("cubemap", 6, &cubemap)];
        for (projection, wide, sr) in maps {
            let sum = |disc: bool| total(&of(projection, disc), (wide * height, height), sr);
            let (with, without) = (sum(true), sum(false));
            for c in 0..3 {
                // As in `same_as_sun`.
                let off = (with[c] - without[c]) / direct[c] - 1.0;
                assert!(
                    off.abs() < 0.02,
                    "{projection}, sun {elevation_deg}°, band {c}: {off}"
                );
            }
        }
    }
}

#[test]
fn the_limb_is_darker_and_redder_than_the_centre() {
    let of = |limb_darkening: bool, off_deg: f64| {
        let sun = json!({"position": {"azimuth_deg": 180, "elevation_deg": 0}, "angular_diameter_deg": 2,
                         "limb_darkening": limb_darkening});
        seen(&sunny(sun, json!({})), 180.0 + off_deg, 0.0)
    };
    let even = of(false, 0.0);
    let half_sine = f64::to_radians(0.5).sin();
    let (centre, rim) = (of(true, 0.0), of(true, 0.995));
    for c in 0..3 {
        // E over the cap's solid angle 4π sin²(α/2).
        let expected = SUN[c] / (4.0 * PI * half_sine * half_sine);
        assert!((even[c] / expected - 1.0).abs() < 1e-4, "{even:?}");
        assert_eq!(of(false, 0.995)[c], even[c]);
        // (n + 2) / 2 of the exponents at 680, 550 and 440 nm.
        let factor = 1.0 + [0.397, 0.503, 0.652][c] / 2.0;
        assert!((centre[c] / even[c] / factor - 1.0).abs() < 1e-4, "{centre:?}");
        assert!(rim[c] < 0.5 * centre[c], "{rim:?}");
    }
    assert!(
        rim[0] / rim[2] > 1.5 * centre[0] / centre[2],
        "{rim:?} {centre:?}"
    );
    assert_eq!(of(true, 1.005), [0.0; 3]);
}

#[test]
fn a_larger_disc_is_larger_and_fainter() {
    let of = |diameter_deg: f64| {
        let sun = json!({"position": {"azimuth_deg": 180, "elevation_deg": 0}, "angular_diameter_deg": diameter_deg,
                         "limb_darkening": false});
        let camera = json!({"direction": {"azimuth_deg": 180, "elevation_deg": 0},
                            "projection": {"kind": "perspective", "vertical_fov_deg": 10}});
        let frame = radiance(&sunny(sun, camera), 100, 100, Quality::Preview);
        let centre = luma(frame.at(50, 50));
        (
            centre,
            frame.pixels().map(|(_, _, c)| luma(c)).sum::<f64>() / centre,
        )
    };
    let (bright, small) = of(1.0);
    let (faint, large) = of(3.0);
    // Nine times the area; 144 places a pixel round a rim of five pixels.
    assert!((bright / faint / 9.0 - 1.0).abs() < 1e-3, "{bright} {faint}");
    assert!((large / small / 9.0 - 1.0).abs() < 0.02, "{large} {small}");
}

#[test]
fn the_disc_may_be_hidden_and_leaves_the_sky_as_it_is() {
    let of = |disc: bool| {
        let sun = json!({"position": {"azimuth_deg": 180, "elevation_deg": 20}, "disc": disc});
        let camera = json!({"direction": {"azimuth_deg": 180, "elevation_deg": 20},
                            "projection": {"kind": "perspective", "vertical_fov_deg": 5}});
        radiance(
            &scene(json!({"sun": sun, "camera": camera})),
            51,
            51,
            Quality::Preview,
        )
    };
    let (with, without) = (of(true), of(false));
    // The disc is thousands of times brighter than the sky before it.
    assert!(luma(with.at(25, 25)) > 1e3 * luma(without.at(25, 25)));
    for (x, y, sky) in without.pixels() {
        let off_px = (x as f64 - 25.0).hypot(y as f64 - 25.0);
        // 0.268° of 5° over 51 pixels, and one pixel.
        if off_px > 2.74 + 1.0 {
            assert_eq!(with.at(x, y), sky, "{x} {y}");
        }
    }
    // A disc of no size cannot be shown; its light is in the air all the same.
    let sun = json!({"position": {"azimuth_deg": 180, "elevation_deg": 20}, "angular_diameter_deg": 0});
    let point = seen(&scene(json!({"sun": sun})), 180.0, 20.0);
    assert_eq!(
        point,
        seen(
            &scene(json!({"sun": {"position": {"azimuth_deg": 180, "elevation_deg": 20}, "disc": false}})),
            180.0,
            20.0
        )
    );
}

/// The air dims and reddens the disc by its transmittance, in the frame as in the probe.
#[test]
fn the_disc_is_seen_through_the_air() {
    for elevation_deg in [60.0, 10.0, 2.0] {
        let position = json!({"azimuth_deg": 180, "elevation_deg": elevation_deg});
        let of = |air: Value| {
            let camera =
                json!({"direction": position, "projection": {"kind": "perspective", "vertical_fov_deg": 1}});
            let sun = json!({"position": position, "limb_darkening": false});
            let scene: Scene = scene(json!({"sun": sun, "camera": camera, "atmosphere": air}));
            radiance(&scene, 33, 33, Quality::Final).at(16, 16)
        };
        let (air, none) = (of(json!({})), of(Value::Null));
        let left = crate::scenes::left(&scene(json!({})), 180.0, elevation_deg);
        for c in 0..3 {
            // The sky view's optical depth between its texels, and the sky's own light before the disc.
            let found = air[c] / none[c];
            assert!(
                (found / left[c] - 1.0).abs() < 0.01,
                "{elevation_deg}: {found} {left:?}"
            );
        }
    }
}
