//! Where things stand in the picture: a sun of known size as the mark, its centroid against the f64 lens.

use crate::{
    lens::{place, unit},
    scenes::{Radiance, empty_space, luma, radiance, scene},
};
use serde_json::{Value, json};
use welkin_scene::{Camera, Projection, Quality};

/// Centroid of the light, in pixels from the upper left corner.
fn centroid(frame: &Radiance) -> Option<(f64, f64)> {
    let (mut sum, mut x_sum, mut y_sum) = (0.0, 0.0, 0.0);
    for (x, y, c) in frame.pixels() {
        let light = luma(c);
        sum += light;
        x_sum += light * (x as f64 + 0.5);
        y_sum += light * (y as f64 + 0.5);
    }
    (sum > 0.0).then(|| (x_sum / sum, y_sum / sum))
}

/// True where a disc's edge may look over the rim of a fisheye's circle.
fn rim(
    camera: &Camera,
    size: (f64, f64),
    (azimuth_deg, elevation_deg): (f64, f64),
    diameter_deg: f64,
) -> bool {
    let Projection::Fisheye { fov_deg, mapping } = camera.projection else {
        return false;
    };
    let projection = Projection::Fisheye {
        fov_deg: fov_deg + 2.0 * diameter_deg,
        mapping,
    };
    place(
        &Camera {
            projection,
            ..camera.clone()
        },
        size,
        unit(azimuth_deg, elevation_deg),
    )
    .is_some()
}

/// Worst distance in pixels between the sun's centroid and where the lens puts it, over suns that fall well inside.
fn worst(camera: &Value, (width, height): (u32, u32), suns: &[(f64, f64)], diameter_deg: f64) -> f64 {
    let mut worst = 0.0_f64;
    let mut seen = 0;
    for (azimuth_deg, elevation_deg) in suns {
        let sun = json!({"position": {"azimuth_deg": azimuth_deg, "elevation_deg": elevation_deg},
                         "angular_diameter_deg": diameter_deg, "limb_darkening": false});
        let mut scene = empty_space(json!({"sun": sun}));
        let Camera {
            direction,
            roll_deg,
            projection,
            ..
        } = serde_json::from_value(camera.clone()).unwrap();
        scene.camera = Camera {
            direction,
            roll_deg,
            projection,
            ..scene.camera
        };
        let size = (f64::from(width), f64::from(height));
        let expected = place(&scene.camera, size, unit(*azimuth_deg, *elevation_deg));
        let found = centroid(&radiance(&scene, width, height, Quality::Preview));
        let margin = 12.0;
        let inside = |(x, y): (f64, f64)| {
            (margin..size.0 - margin).contains(&x) && (margin..size.1 - margin).contains(&y)
        };
        match expected.filter(|at| inside(*at)) {
            Some(expected) => {
                let found =
                    found.unwrap_or_else(|| panic!("no sun at {azimuth_deg} {elevation_deg} in {camera}"));
                let off = (found.0 - expected.0).hypot(found.1 - expected.1);
                assert!(
                    off < 0.5,
                    "{camera}, sun {azimuth_deg} {elevation_deg}: {found:?} for {expected:?}"
                );
                worst = worst.max(off);
                seen += 1;
            }
            None if expected.is_none()
                && !rim(&scene.camera, size, (*azimuth_deg, *elevation_deg), diameter_deg) =>
            {
                assert_eq!(found, None, "{camera}, sun {azimuth_deg} {elevation_deg}");
            }
            None => {}
        }
    }
    assert!(seen >= 3, "{camera}: only {seen} suns fell into the picture");
    println!("{camera}: worst {worst:.3} px of {seen} suns");
    worst
}

/// Suns about a direction, none of them placed evenly.
fn about(azimuth_deg: f64, elevation_deg: f64, reach_deg: f64) -> Vec<(f64, f64)> {
    [
        (0.0, 0.0),
        (0.55, 0.2),
        (-0.3, 0.6),
        (-0.7, -0.35),
        (0.25, -0.8),
        (3.0, 0.1),
    ]
    .map(|(a, e)| {
        (
            azimuth_deg + a * reach_deg,
            (elevation_deg + e * reach_deg).clamp(-89.0, 89.0),
        )
    })
    .to_vec()
}

#[test]
fn perspective() {
    for (azimuth, elevation, roll, fov) in [
        (180.0, 10.0, 0.0, 60.0),
        (37.0, -25.0, 20.0, 60.0),
        (290.0, 55.0, -75.0, 90.0),
        (5.0, 0.0, 180.0, 25.0),
    ] {
        let camera = json!({"direction": {"azimuth_deg": azimuth, "elevation_deg": elevation}, "roll_deg": roll,
                            "projection": {"kind": "perspective", "vertical_fov_deg": fov}});
        worst(
            &camera,
            (240, 180),
            &about(azimuth, elevation, 0.4 * fov),
            fov / 20.0,
        );
    }
}

#[test]
fn fisheye() {
    for (mapping, fov) in [
        ("equidistant", 180.0),
        ("equisolid", 220.0),
        ("stereographic", 200.0),
    ] {
        for (azimuth, elevation, roll) in [(0.0, 89.0, 0.0), (210.0, 15.0, 33.0)] {
            let camera = json!({"direction": {"azimuth_deg": azimuth, "elevation_deg": elevation}, "roll_deg": roll,
                                "projection": {"kind": "fisheye", "fov_deg": fov, "mapping": mapping}});
            let mut suns = about(azimuth, elevation, 60.0);
            // The whole sky, all round, and one behind.
            suns.extend((0..6).map(|k| (f64::from(k) * 60.0 + 7.0, 20.0)));
            suns.push((azimuth + 180.0, -elevation));
            worst(&camera, (200, 232), &suns, 8.0);
        }
    }
}

#[test]
fn equirectangular() {
    let camera = json!({"projection": {"kind": "equirectangular"}});
    let suns: Vec<_> = (0..12)
        .map(|k| (f64::from(k) * 31.0 + 4.0, f64::from(k) * 11.0 - 62.0))
        .collect();
    worst(&camera, (360, 180), &suns, 6.0);
    // East in the middle, south at three quarters, whatever the camera looks at.
    for (azimuth_deg, share) in [(90.0, 0.5), (180.0, 0.75), (0.0, 0.25)] {
        let turned = json!({"direction": {"azimuth_deg": 123, "elevation_deg": 45}, "roll_deg": 30,
                            "projection": {"kind": "equirectangular"}});
        let sun =
            json!({"position": {"azimuth_deg": azimuth_deg, "elevation_deg": 30}, "angular_diameter_deg": 6});
        let mut scene = empty_space(json!({"sun": sun}));
        let turned: Camera = serde_json::from_value(turned).unwrap();
        scene.camera = Camera {
            position_m: scene.camera.position_m,
            ..turned
        };
        let (x, y) = centroid(&radiance(&scene, 360, 180, Quality::Preview)).unwrap();
        assert!(
            (x - 360.0 * share).abs() < 0.5 && (y - 60.0).abs() < 0.5,
            "{azimuth_deg}: {x} {y}"
        );
    }
}

#[test]
fn cubemap() {
    let camera = json!({"projection": {"kind": "cubemap"}});
    // Two suns on each face.
    let mut suns = vec![(20.0, 75.0), (200.0, 62.0), (45.0, -80.0), (300.0, -58.0)];
    suns.extend(
        [0.0, 90.0, 180.0, 270.0]
            .into_iter()
            .flat_map(|a| [(a + 17.0, 12.0), (a - 23.0, -21.0)]),
    );
    worst(&camera, (6 * 90, 90), &suns, 6.0);
}

#[test]
fn straight_up_and_straight_down_keep_the_heading() {
    for (azimuth, elevation) in [(0.0, 90.0), (120.0, 90.0), (0.0, -90.0), (250.0, -90.0)] {
        let camera = json!({"direction": {"azimuth_deg": azimuth, "elevation_deg": elevation},
                            "projection": {"kind": "perspective", "vertical_fov_deg": 70}});
        let suns = [10.0, 130.0, 250.0].map(|a| (a, 0.75 * elevation));
        worst(&camera, (200, 160), &suns, 4.0);
    }
}

/// The picture turns clockwise: what stood at the top goes to the right.
#[test]
fn roll_turns_the_picture_clockwise() {
    let mut scene =
        scene(json!({"camera": {"direction": {"azimuth_deg": 90, "elevation_deg": 0}, "roll_deg": 90}}));
    scene.atmosphere = None;
    let frame = radiance(&scene, 60, 60, Quality::Preview);
    // The ground was below; now it is on the left.
    assert!(luma(frame.at(5, 30)) > 0.0 && luma(frame.at(55, 30)) == 0.0);
}

#[test]
fn a_larger_field_shows_more() {
    let area = |fov: f64| {
        let sun = json!({"position": {"azimuth_deg": 180, "elevation_deg": 10}, "angular_diameter_deg": 2,
                         "limb_darkening": false});
        let camera = json!({"projection": {"kind": "perspective", "vertical_fov_deg": fov}});
        let mut scene = empty_space(json!({"sun": sun, "camera": camera}));
        scene.camera.direction = welkin_scene::Direction::angles(180.0, 10.0);
        let frame = radiance(&scene, 200, 200, Quality::Preview);
        // Pixels, those at the rim by their share.
        frame.pixels().map(|(_, _, c)| luma(c)).sum::<f64>() / luma(frame.at(100, 100))
    };
    // The area of a small disc goes with 1/tan² of half the field.
    let ratio = area(20.0) / area(40.0);
    let expected = (20_f64.to_radians().tan() / 10_f64.to_radians().tan()).powi(2);
    // A gross of places a pixel round a rim of 30 pixels.
    assert!((ratio / expected - 1.0).abs() < 0.01, "{ratio} {expected}");
}
