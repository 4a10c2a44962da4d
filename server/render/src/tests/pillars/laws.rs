//! What must not change a pillar, and the mistakes of the first formulas, one test each.

use super::{dark, gaussian, lamp, radiance, with};
use crate::uniforms::pillars::law;
use glam::DVec3;
use std::f64::consts::TAU;
use welkin_scene::{
    CrystalLayer, Scene,
    assets::SceneAssets,
    ice_crystals::{GaussianTilt, Reflectance, Tilt, UniformTilt},
};

fn everywhere(tilt: Tilt) -> CrystalLayer {
    CrystalLayer {
        base_m: 0.0,
        top_m: 3e4,
        extinction_per_m: 0.0,
        reflectance: Reflectance::Outer,
        tilt,
        ..CrystalLayer::default()
    }
}

fn seen(scene: &Scene, directions: &[DVec3]) -> Vec<f64> {
    radiance(scene, &SceneAssets::default(), directions)
}

/// Of an azimuth from the lamp's and an elevation, degrees, with the lamp towards x.
fn towards(across_deg: f64, elevation_deg: f64) -> DVec3 {
    let (sin, cos) = elevation_deg.to_radians().sin_cos();
    let (across, along) = across_deg.to_radians().sin_cos();
    DVec3::new(cos * along, cos * across, sin)
}

fn simple(watts: f64) -> Scene {
    let mut scene = with(
        everywhere(gaussian(1.5, 6.0)),
        vec![lamp([800.0, 0.0, 10.0], watts)],
    );
    scene.camera.position_m = [0.0, 0.0, 10.0];
    scene
}

const VIEWS: [(f64, f64); 4] = [(0.0, 1.0), (0.2, 4.0), (-0.5, 12.0), (1.0, 30.0)];

fn views(turn_deg: f64) -> Vec<DVec3> {
    VIEWS.map(|(a, e)| towards(a + turn_deg, e)).to_vec()
}

#[test]
fn neither_place_nor_azimuth_matters() {
    let still = seen(&simple(1.0), &views(0.0));
    let mut moved = simple(1.0);
    moved.camera.position_m = [300.0, -200.0, 10.0];
    moved.lights[0].position_m = [1_100.0, -200.0, 10.0];
    let mut turned = simple(1.0);
    let (sin, cos) = 37_f64.to_radians().sin_cos();
    turned.lights[0].position_m = [800.0 * cos, 800.0 * sin, 10.0];
    for (what, found) in [
        ("moved", seen(&moved, &views(0.0))),
        ("turned", seen(&turned, &views(37.0))),
    ] {
        for (a, b) in still.iter().zip(found) {
            // The planet of 1e8 m bends by some millimetres on the way.
            assert!((b / a - 1.0).abs() < 2e-3, "{what}: {a} {b}");
        }
    }
}

#[test]
fn twice_as_far_is_half_as_bright() {
    let near = seen(&simple(1.0), &views(0.0));
    let mut far = simple(1.0);
    far.lights[0].position_m[0] = 1_600.0;
    for (near, far) in near.iter().zip(seen(&far, &views(0.0))) {
        // As above; the layer's base is 10 m below both, which cuts nothing off.
        assert!((2.0 * far / near - 1.0).abs() < 2e-3, "{near} {far}");
    }
}

/// The seed's equation 14 took a midpoint where a direction belongs: a wedge twice as wide.
#[test]
fn the_wedge_is_as_wide_as_the_largest_tilt() {
    let scene = with(
        everywhere(gaussian(3.0, 5.0)),
        vec![lamp([1_000.0, 0.0, 2.0], 1e6)],
    );
    // At an angle δ from the upright plane about the axis to the lamp.
    let at = |beta_deg: f64, tilt_deg: f64| {
        let (sin, cos) = beta_deg.to_radians().sin_cos();
        let (across, up) = tilt_deg.to_radians().sin_cos();
        DVec3::new(cos, sin * across, sin * up)
    };
    for beta_deg in [2.0, 10.0, 35.0] {
        let found = seen(
            &scene,
            &[4.9, -4.9, 5.1, -5.1, 9.0].map(|tilt| at(beta_deg, tilt)),
        );
        assert!(found[0] > 0.0 && found[1] > 0.0, "{beta_deg}: {found:?}");
        assert_eq!(found[2..], [0.0; 3], "{beta_deg}");
    }
}

/// Bounds sorted without regard to sign left the pillars of lamps about as high as the eye black.
#[test]
fn lamps_at_the_height_of_the_eye_have_pillars() {
    for height_m in [9.0, 9.99, 10.0, 10.01, 11.0, 60.0] {
        let mut scene = simple(1e3);
        scene.lights[0].position_m[2] = height_m;
        let elevation_deg = ((height_m - 10.0) / 800.0_f64).atan().to_degrees();
        let found = seen(
            &scene,
            &[
                towards(0.0, elevation_deg + 1.5),
                towards(0.0, elevation_deg + 8.0),
            ],
        );
        assert!(found[0] > found[1] && found[1] > 0.0, "{height_m}: {found:?}");
    }
}

/// The tilt's density is one of directions, for each steradian: a half-normal in δ has no value on the axis.
#[test]
fn plates_are_as_many_as_there_are() {
    let spread = |sigma_deg, max_deg| GaussianTilt { sigma_deg, max_deg };
    for (tilt, allowed) in [
        (Tilt::Gaussian(spread(1.5, 6.0)), 1e-6),
        (Tilt::Gaussian(spread(15.0, 10.0)), 1e-6),
        (Tilt::Uniform(UniformTilt { max_deg: 4.0 }), 1e-6),
        // What lies beyond six spreads is left out.
        (Tilt::Slope(spread(1.5, 9.0)), 1e-6),
    ] {
        let (kind, sigma, peak) = law(&tilt);
        let density = |x: f64| match kind {
            0 => peak * (-0.5 * (x / sigma).powi(2)).exp(),
            1 => peak,
            _ => peak * (-0.5 * (x.tan() / sigma).powi(2)).exp() / x.cos().powi(3),
        };
        let end = tilt.max_deg().to_radians();
        let steps = 20_000_u32;
        let step = end / f64::from(steps);
        let sum: f64 = (0..steps)
            .map(|i| {
                let x = (f64::from(i) + 0.5) * step;
                TAU * density(x) * x.sin() * step
            })
            .sum();
        assert!((sum - 1.0).abs() < allowed, "{tilt:?}: {sum}");
        assert!(peak.is_finite());
    }
}

/// Absorption goes with the way, not with the pillar's width.
#[test]
fn plates_take_their_part_of_the_way() {
    let clear = seen(&simple(1.0), &views(0.0));
    let mut dim = simple(1.0);
    dim.ice_crystals = Some(welkin_scene::IceCrystals::One(CrystalLayer {
        extinction_per_m: 1e-3,
        ..everywhere(gaussian(1.5, 6.0))
    }));
    for ((_, elevation_deg), (clear, dim)) in VIEWS.iter().zip(clear.iter().zip(seen(&dim, &views(0.0)))) {
        // Level plates mirror at half way: d / cos(elevation) altogether, within what 6° of tilt make of it.
        let way_m = 800.0 / elevation_deg.to_radians().cos();
        let depth = -(dim / clear).ln();
        assert!(
            (depth / (1e-3 * way_m) - 1.0).abs() < 0.05,
            "{elevation_deg}: {depth}"
        );
    }
}

#[test]
fn without_plates_or_lamps_nothing_shines() {
    let mut scene = simple(1e6);
    scene.ice_crystals = None;
    assert_eq!(seen(&scene, &views(0.0)), [0.0; 4]);
    let mut scene = simple(0.0);
    scene.camera.position_m[2] = 50.0;
    assert_eq!(seen(&scene, &views(0.0)), [0.0; 4]);
    assert_eq!(seen(&dark(), &views(0.0)), [0.0; 4]);
}
