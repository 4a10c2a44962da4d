//! Pillars of light: against the oracle, the twin, and what must not change them.

mod cells;
mod chance;
mod laws;
mod obstacles;
mod oracle;
mod parameters;

use super::engine;
use crate::passes::probe::Sight;
use glam::DVec3;
use welkin_scene::{
    Bands, CrystalLayer, IceCrystals, Light, Scene,
    assets::SceneAssets,
    ice_crystals::{GaussianTilt, Tilt},
};

/// A scene with nothing in it that shines: no air, no sun, on a planet so large that it is flat.
fn dark() -> Scene {
    let mut scene = Scene {
        atmosphere: None,
        stars: None,
        moon: None,
        shafts: None,
        ..Scene::clear()
    };
    scene.sun.irradiance_w_m2 = [0.0; 3];
    scene.planet.radius_m = 1e8;
    scene
}

fn lamp(place_m: [f64; 3], watts: f64) -> Light {
    Light {
        position_m: place_m,
        radiant_intensity_w_sr: Some(Bands::Grey(watts)),
        ..Light::default()
    }
}

fn gaussian(sigma_deg: f64, max_deg: f64) -> Tilt {
    Tilt::Gaussian(GaussianTilt { sigma_deg, max_deg })
}

fn with(layer: CrystalLayer, lights: Vec<Light>) -> Scene {
    Scene {
        ice_crystals: Some(IceCrystals::One(layer)),
        lights,
        ..dark()
    }
}

fn sights(directions: &[DVec3]) -> Vec<Sight> {
    let sight = |direction: &DVec3| Sight {
        direction: direction.normalize(),
        disc: true,
    };
    directions.iter().map(sight).collect()
}

/// Radiance in the middle band along directions.
fn radiance(scene: &Scene, assets: &SceneAssets, directions: &[DVec3]) -> Vec<f64> {
    let (seen, _) = engine().probe(scene, assets, &sights(directions)).unwrap();
    seen.iter().map(|seen| seen.radiance[1]).collect()
}
