//! The sun's and the moon's own light at the observer.

use crate::{
    cpu::air::transmittance_to_space, night::Night, quadrature::horizon_cosine, uniforms::Standpoint,
};
use glam::DVec3;
use std::f64::consts::PI;
use welkin_scene::Scene;

/// Strips across the disc, for a sun half below the horizon.
const STRIPS: u32 = 9;
/// Rays across a disc to see how much of it clouds hide.
const DISC_RAYS: u32 = 32;

/// Share of the light of sun and moon that clouds let through to the observer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DiscsLeft {
    pub(crate) sun: f64,
    pub(crate) moon: f64,
}

impl Default for DiscsLeft {
    fn default() -> Self {
        Self { sun: 1.0, moon: 1.0 }
    }
}

/// Light that reaches the observer straight from sun and moon, on planes that face them, in R, G and B, W/m².
#[derive(Clone, Copy, Debug)]
pub(crate) struct Direct {
    pub(crate) sun: [f64; 3],
    pub(crate) moon: [f64; 3],
}

impl Direct {
    pub(crate) fn new(scene: &Scene, stand: &Standpoint, night: &Night) -> Self {
        Self {
            sun: direct_normal(scene, stand, night),
            moon: moon_direct_normal(scene, stand, night),
        }
    }

    /// Behind clouds.
    pub(crate) fn behind(&self, left: DiscsLeft) -> Self {
        Self {
            sun: self.sun.map(|e| left.sun * e),
            moon: self.moon.map(|e| left.moon * e),
        }
    }
}

/// Directions evenly across what the ground does not hide of a disc, on Vogel's spiral (1979); `stand` has the disc in
/// the sun's place. As everywhere here, the disc is taken as even.
pub(crate) fn across_disc(stand: &Standpoint, radius_m: f64, diameter_deg: f64) -> Vec<DVec3> {
    let turn = PI * (3.0 - 5_f64.sqrt());
    let (a, b) = stand.sun.any_orthonormal_pair();
    let horizon = horizon_cosine(stand, radius_m);
    let rays = (0..DISC_RAYS).map(|k| {
        let rim = ((f64::from(k) + 0.5) / f64::from(DISC_RAYS)).sqrt();
        let (sin, cos) = (rim * (diameter_deg / 2.0).to_radians()).sin_cos();
        let (s, c) = (turn * f64::from(k)).sin_cos();
        stand.sun * cos + (a * c + b * s) * sin
    });
    rays.filter(|ray| ray.dot(stand.up) > horizon).collect()
}

/// Irradiance from the disc on a plane that faces it, in R, G and B, W/m²: what the air and the horizon leave of it.
/// The disc is taken as even; strips at heights cos φ have areas in proportion to sin²φ dφ.
/// A moon before the sun takes its share.
fn direct_normal(scene: &Scene, stand: &Standpoint, night: &Night) -> [f64; 3] {
    let left = disc_left(scene, stand, scene.sun.angular_diameter_deg);
    [0, 1, 2].map(|i| scene.sun.irradiance_w_m2[i] * night.uncovered.disc * left[i])
}

/// The same of the moon; zero where there is none.
fn moon_direct_normal(scene: &Scene, stand: &Standpoint, night: &Night) -> [f64; 3] {
    night.moon.map_or([0.0; 3], |moon| {
        let left = disc_left(scene, &moon.stand(stand), moon.seen.angular_diameter_deg);
        [0, 1, 2].map(|i| moon.light.irradiance_w_m2[i] * left[i])
    })
}

/// Share of a disc's light that reaches the observer; `stand` has it in the sun's place.
fn disc_left(scene: &Scene, stand: &Standpoint, diameter_deg: f64) -> [f64; 3] {
    let centre = stand.up.cross(stand.sun).length().atan2(stand.up.dot(stand.sun));
    let radius = (diameter_deg / 2.0).to_radians();
    let mut left = [0.0; 3];
    for strip in 0..STRIPS {
        let phi = PI * (f64::from(strip) + 0.5) / f64::from(STRIPS);
        let share = 2.0 / f64::from(STRIPS) * phi.sin().powi(2);
        let mu = (centre + radius * phi.cos()).cos();
        let transmittance = transmittance_to_space(scene, stand.altitude_m, mu);
        for (sum, t) in left.iter_mut().zip(transmittance) {
            *sum += share * t;
        }
    }
    left
}
