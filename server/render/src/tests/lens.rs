//! The camera both ways, in f64: against the shader, against itself, and the light of stars through it.

use super::{engine, evaluate};
use crate::{
    camera::{CameraUniform, projection_code},
    gpu::Gpu,
    lens::Lens,
    shader,
    starfield::{Screen, glints},
    uniforms::Part,
};
use glam::{DVec2, DVec3, UVec2};
use proptest::prelude::*;
use serde_json::{Value, json};
use std::f64::consts::PI;
use welkin_scene::{Camera, Firmament, Scene, Stars};

fn camera(projection: Value, azimuth_deg: f64, elevation_deg: f64, roll_deg: f64) -> Camera {
    let direction = json!({"azimuth_deg": azimuth_deg, "elevation_deg": elevation_deg});
    let camera = json!({"projection": projection, "direction": direction, "roll_deg": roll_deg});
    Scene::from_value(&json!({"camera": camera})).unwrap().camera
}

fn projections() -> Vec<(Value, UVec2)> {
    vec![
        (
            json!({"kind": "perspective", "vertical_fov_deg": 60}),
            UVec2::new(160, 90),
        ),
        (
            json!({"kind": "perspective", "vertical_fov_deg": 1}),
            UVec2::new(90, 160),
        ),
        (
            json!({"kind": "fisheye", "fov_deg": 180, "mapping": "equidistant"}),
            UVec2::new(120, 100),
        ),
        (
            json!({"kind": "fisheye", "fov_deg": 360, "mapping": "equidistant"}),
            UVec2::new(100, 100),
        ),
        (
            json!({"kind": "fisheye", "fov_deg": 220, "mapping": "equisolid"}),
            UVec2::new(100, 120),
        ),
        (
            json!({"kind": "fisheye", "fov_deg": 200, "mapping": "stereographic"}),
            UVec2::new(100, 100),
        ),
        (json!({"kind": "equirectangular"}), UVec2::new(128, 64)),
        (json!({"kind": "cubemap"}), UVec2::new(240, 40)),
    ]
}

/// Centres of pixels and a place within each.
fn places(size: UVec2, within: DVec2) -> impl Iterator<Item = DVec2> {
    (0..size.y).flat_map(move |y| (0..size.x).map(move |x| DVec2::new(f64::from(x), f64::from(y)) + within))
}

#[test]
fn the_twin_looks_where_the_shader_looks() {
    let engine = engine();
    let gpu: &Gpu = &engine.gpu;
    for (projection, size) in projections() {
        let camera = camera(projection, 213.0, 31.0, 17.0);
        let uniform = Part::new(&CameraUniform::new(&camera, size)).upload(gpu, "camera");
        let code = projection_code(&camera.projection);
        let lens = Lens::new(&camera, size);
        let rows: Vec<_> = places(size, DVec2::new(0.3, 0.7))
            .map(|p| [p.x as f32, p.y as f32, code as f32, 0.0, 0.0, 0.0, 0.0, 0.0])
            .collect();
        let statement =
            "let s = sight_at(camera, u32(a.z), a.xy); x = vec4f(s.direction, select(0.0, 1.0, s.seen));";
        let binds = [(2, uniform.as_entire_binding())];
        for (row, found) in rows
            .iter()
            .zip(evaluate(gpu, &shader::SKY, statement, &rows, &binds))
        {
            let place = DVec2::new(f64::from(row[0]), f64::from(row[1]));
            let from_rim = lens.sight(place).is_some() == (found[3] > 0.5);
            // A place within a rounding of a fisheye's rim may fall on either side.
            let sights = from_rim || (place - size.as_dvec2() / 2.0).length() > 49.99;
            assert!(sights, "{camera:?} {place}");
            if let Some(exact) = lens.sight(place).filter(|_| found[3] > 0.5) {
                let seen = DVec3::new(f64::from(found[0]), f64::from(found[1]), f64::from(found[2]));
                // f32, and drivers' trigonometry, which may be off by 5e-6.
                assert!(exact.distance(seen) < 2e-5, "{camera:?} {place}: {exact} {seen}");
            }
        }
    }
}

proptest! {
    #[test]
    fn a_place_is_found_again(
        which in 0..8_usize,
        x in 0.0..1.0,
        y in 0.0..1.0,
        azimuth in -360.0..360.0,
        elevation in -90.0..=90.0,
        roll in -180.0..180.0,
    ) {
        let (projection, size) = projections()[which].clone();
        let lens = Lens::new(&camera(projection, azimuth, elevation, roll), size);
        let place = DVec2::new(x, y) * size.as_dvec2();
        if let Some(direction) = lens.sight(place) {
            prop_assert!((direction.length() - 1.0).abs() < 1e-12);
            // The rim of a fisheye, the seam of a full turn, the edge of a face: rounding may lead beyond.
            if let Some(found) = lens.place(direction) {
                let gap = (found - place).abs();
                let across_the_seam = (gap.x - size.as_dvec2().x).abs() < 1e-3 || !(1e-9..=1.0 - 1e-9).contains(&y);
                prop_assert!(gap.max_element() < 1e-6 || across_the_seam, "{place} {found}");
            } else {
                let off = (place / size.as_dvec2() - 0.5).abs();
                let rim = (place - size.as_dvec2() / 2.0).length() / size.as_dvec2().min_element();
                prop_assert!(off.max_element() > 0.4999 || rim > 0.4999, "{place}");
            }
        }
    }

    /// Projections of the whole sphere see every direction.
    #[test]
    fn every_direction_has_its_place(z in -1.0_f64..=1.0, turn in 0.0..std::f64::consts::TAU, whole in 0..3_usize) {
        let level = (1.0 - z * z).sqrt();
        let direction = DVec3::new(level * turn.cos(), level * turn.sin(), z);
        let (projection, size) = projections()[[3, 6, 7][whole]].clone();
        let lens = Lens::new(&camera(projection, 10.0, 20.0, 0.0), size);
        let found = lens.place(direction).and_then(|place| lens.sight(place)).unwrap();
        prop_assert!(found.distance(direction) < 1e-6, "{direction} {found}");
    }
}

#[test]
fn solid_angles_are_those_of_the_pixels() {
    for (projection, size) in projections() {
        let whole = ["equirectangular", "cubemap"]
            .iter()
            .any(|kind| projection["kind"] == **kind)
            || projection["fov_deg"] == 360;
        let lens = Lens::new(&camera(projection.clone(), 213.0, 31.0, 17.0), size);
        let mut sum = 0.0;
        for centre in places(size, DVec2::splat(0.5)) {
            let Some(direction) = lens.sight(centre) else {
                continue;
            };
            let solid_angle_sr = lens.solid_angle_sr(direction);
            sum += solid_angle_sr;
            const STEP: f64 = 1e-3;
            let corners =
                [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y].map(|by| lens.sight(centre + by * STEP));
            if let [Some(a), Some(b), Some(c), Some(d)] = corners {
                let expected = (a - b).cross(c - d).length() / (4.0 * STEP * STEP);
                // A pixel of some degrees is not the plane that the difference takes it for; at the back of a full
                // fisheye it is nearly nothing.
                assert!(
                    (solid_angle_sr - expected).abs() < 1e-3 * expected + 1e-7,
                    "{projection} {centre}"
                );
            }
        }
        if whole {
            // The rim of the full fisheye cuts pixels in two.
            assert!((sum / (4.0 * PI) - 1.0).abs() < 2e-3, "{projection}: {sum}");
        }
    }
}

fn northern() -> Firmament {
    Scene::default().firmament()
}

/// Sum of radiance times solid angle.
fn light(stars: &Stars, lens: &Lens, size: UVec2, screens: &[Screen]) -> DVec3 {
    glints(stars, &northern(), lens, size.x, screens)
        .iter()
        .map(|g| {
            let pixel = DVec2::new(f64::from(g.pixel % size.x), f64::from(g.pixel / size.x)) + 0.5;
            DVec3::from_array(g.radiance.map(f64::from)) * lens.solid_angle_sr(lens.sight(pixel).unwrap())
        })
        .sum()
}

#[test]
fn pictures_of_the_whole_sphere_hold_the_whole_catalogue() {
    let all: DVec3 = crate::catalogue::stars()
        .iter()
        .map(|s| DVec3::from_array(s.irradiance_w_m2))
        .sum();
    for (projection, size) in [
        (json!({"kind": "equirectangular"}), UVec2::new(64, 32)),
        (json!({"kind": "equirectangular"}), UVec2::new(1024, 512)),
        (json!({"kind": "cubemap"}), UVec2::new(60, 10)),
        (json!({"kind": "cubemap"}), UVec2::new(1536, 256)),
        (json!({"kind": "fisheye", "fov_deg": 360}), UVec2::new(300, 300)),
    ] {
        let lens = Lens::new(&camera(projection.clone(), 0.0, 20.0, 0.0), size);
        let found = light(&Stars::default(), &lens, size, &[]);
        // Sums of a hundred thousand f32.
        assert!(
            (found / all - 1.0).abs().max_element() < 1e-5,
            "{projection} {size}: {found} {all}"
        );
    }
}

#[test]
fn each_pixel_is_listed_once_in_order() {
    for (projection, size) in projections() {
        let lens = Lens::new(&camera(projection, 180.0, 20.0, 5.0), size);
        let list = glints(&Stars::default(), &northern(), &lens, size.x, &[]);
        assert!(list.iter().all(|g| g.pixel < size.x * size.y));
        assert!(list.is_sorted_by(|a, b| a.pixel < b.pixel));
        assert!(
            list.iter()
                .all(|g| g.radiance.iter().all(|r| r.is_finite() && *r >= 0.0))
        );
    }
}

#[test]
fn settings_choose_and_scale_the_stars() {
    let (size, sphere) = (UVec2::new(256, 128), json!({"kind": "equirectangular"}));
    let lens = Lens::new(&camera(sphere, 0.0, 0.0, 0.0), size);
    let of = |limiting_magnitude: f64, intensity: f64| {
        let stars = Stars {
            intensity,
            limiting_magnitude,
            ..Stars::default()
        };
        light(&stars, &lens, size, &[])
    };
    let brighter: DVec3 = crate::catalogue::stars()
        .iter()
        .filter(|s| s.magnitude <= 2.0)
        .map(|s| DVec3::from_array(s.irradiance_w_m2))
        .sum();
    // Sums of f32.
    assert!((of(2.0, 1.0) / brighter - 1.0).abs().max_element() < 1e-5);
    assert!((of(7.0, 3.0) / of(7.0, 1.0) - 3.0).abs().max_element() < 1e-4);
    assert_eq!(of(7.0, 0.0), DVec3::ZERO);
    assert_eq!(of(-2.0, 1.0), DVec3::ZERO);
    // A screen hides what lies behind it, and nothing else.
    let orion = Screen {
        towards: DVec3::from_array(northern().direction(83.8, -1.0)),
        angular_radius: 0.2,
    };
    let hidden: DVec3 = crate::catalogue::stars()
        .iter()
        .filter(|s| {
            let at = DVec3::from_array(northern().direction(s.right_ascension_deg, s.declination_deg));
            at.angle_between(orion.towards) < orion.angular_radius
        })
        .map(|s| DVec3::from_array(s.irradiance_w_m2))
        .sum();
    let left = light(&Stars::default(), &lens, size, &[orion]) + hidden;
    assert!((left / of(7.0, 1.0) - 1.0).abs().max_element() < 1e-5 && hidden.y > 0.0);
}
