//! Directions and weights over the whole sphere, for irradiance and spherical harmonics.

use crate::uniforms::Standpoint;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// A direction and its solid angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) direction: DVec3,
    pub(crate) weight_sr: f64,
}

/// How close the nodes stand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fineness {
    /// Rings from the horizon to the zenith, to the nadir, and about the sun.
    polar: usize,
    /// Nodes of a ring.
    azimuths: u32,
    /// Turn of each ring against the one before it, in shares of the way between two nodes.
    turn: f64,
}

/// For clear air, which is smooth.
pub(crate) const CLEAR: Fineness = Fineness {
    polar: 24,
    azimuths: 64,
    turn: 0.0,
};

/// For clouds, which have edges: three times as many, and no two rings alike (the golden ratio).
pub(crate) const CLOUDED: Fineness = Fineness {
    polar: 48,
    azimuths: 144,
    turn: 0.618_033_988_749_895,
};

/// Half-angle of the cap about the sun that has its own nodes, for the aureole is narrower than the others are apart.
const CAP_RAD: f64 = 0.6;

/// Gauss-Legendre nodes and weights on 0..1, by Newton's method on the Legendre polynomial.
pub(crate) fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    #[allow(clippy::cast_precision_loss, reason = "a few dozen nodes")]
    let float = |i: usize| i as f64;
    (0..n)
        .map(|i| {
            let mut x = (PI * (float(i) + 0.75) / (float(n) + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..100 {
                let (mut p, mut before) = (x, 1.0);
                for k in 2..=n {
                    (p, before) = (
                        ((2.0 * float(k) - 1.0) * x * p - (float(k) - 1.0) * before) / float(k),
                        p,
                    );
                }
                slope = float(n) * (x * p - before) / (x * x - 1.0);
                let step = p / slope;
                x -= step;
                if step.abs() < 1e-15 {
                    break;
                }
            }
            (0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

/// Two unit vectors across `axis`.
fn across(axis: DVec3) -> (DVec3, DVec3) {
    axis.any_orthonormal_pair()
}

/// Falls smoothly from 1 at the sun to 0 at the rim of its cap.
fn cap_share(angle: f64) -> f64 {
    let x = (1.0 - angle / CAP_RAD).clamp(0.0, 1.0);
    x * x * x * (x * (6.0 * x - 15.0) + 10.0)
}

/// Cosine between the zenith and the horizon.
pub(crate) fn horizon_cosine(stand: &Standpoint, radius_m: f64) -> f64 {
    -(stand.altitude_m * (2.0 * radius_m + stand.altitude_m)).sqrt() / (radius_m + stand.altitude_m)
}

/// Nodes about the zenith, closer at the horizon, and nodes about the sun, closer at its centre; a smooth share
/// divides the light between the two sets, so that neither sees an edge.
pub(crate) fn sphere(stand: &Standpoint, radius_m: f64, fineness: Fineness) -> Vec<Node> {
    let horizon = horizon_cosine(stand, radius_m);
    let gauss = gauss_legendre(fineness.polar);
    let azimuths = f64::from(fineness.azimuths);
    let mut rings = 0.0;
    let mut nodes = Vec::new();
    let mut ring =
        |axis: DVec3, cos: f64, weight: f64, nodes: &mut Vec<Node>, share: &dyn Fn(DVec3) -> f64| {
            let (a, b) = across(axis);
            let sin = (1.0 - cos * cos).max(0.0).sqrt();
            let turned = 0.5 + (rings * fineness.turn).fract();
            rings += 1.0;
            for k in 0..fineness.azimuths {
                let (s, c) = (TAU * (f64::from(k) + turned) / azimuths).sin_cos();
                let direction = axis * cos + (a * c + b * s) * sin;
                nodes.push(Node {
                    direction,
                    weight_sr: weight / azimuths * share(direction),
                });
            }
        };
    let off_sun = |d: DVec3| 1.0 - cap_share(d.angle_between(stand.sun));
    for reach in [1.0 - horizon, -1.0 - horizon] {
        for (x, w) in &gauss {
            // mu = horizon + reach x², dmu = 2 reach x dx
            let weight = TAU * w * 2.0 * reach.abs() * x;
            ring(
                stand.up,
                (horizon + reach * x * x).clamp(-1.0, 1.0),
                weight,
                &mut nodes,
                &off_sun,
            );
        }
    }
    for (x, w) in &gauss {
        // angle = cap x², d cos = sin(angle) 2 cap x dx
        let angle = CAP_RAD * x * x;
        let weight = TAU * w * angle.sin() * 2.0 * CAP_RAD * x;
        ring(stand.sun, angle.cos(), weight, &mut nodes, &|d| {
            cap_share(d.angle_between(stand.sun))
        });
    }
    nodes
}

/// Real orthonormal spherical harmonics up to the second degree, in the order that the probe's answer states.
pub(crate) fn harmonics(d: DVec3) -> [f64; 9] {
    let c1 = (3.0 / (4.0 * PI)).sqrt();
    let c2 = (15.0 / (4.0 * PI)).sqrt();
    [
        (1.0 / (4.0 * PI)).sqrt(),
        c1 * d.y,
        c1 * d.z,
        c1 * d.x,
        c2 * d.x * d.y,
        c2 * d.y * d.z,
        (5.0 / (16.0 * PI)).sqrt() * (3.0 * d.z * d.z - 1.0),
        c2 * d.x * d.z,
        0.5 * c2 * (d.x * d.x - d.y * d.y),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stand(altitude_m: f64, sun: DVec3) -> Standpoint {
        Standpoint {
            altitude_m,
            up: DVec3::Z,
            sun: sun.normalize(),
        }
    }

    #[test]
    fn the_weights_cover_the_sphere() {
        let suns = [DVec3::Z, DVec3::X, DVec3::new(0.3, -0.5, 0.1)];
        for altitude_m in [0.0, 2.0, 1e4, 4e5, 4e7] {
            for (sun, fineness) in suns.into_iter().flat_map(|sun| [(sun, CLEAR), (sun, CLOUDED)]) {
                let total: f64 = sphere(&stand(altitude_m, sun), 6.36e6, fineness)
                    .iter()
                    .map(|n| n.weight_sr)
                    .sum();
                // The share between the sets is smooth, not polynomial: 1e-3 is what 24 by 64 nodes resolve.
                assert!(
                    (total / (4.0 * PI) - 1.0).abs() < 1e-3,
                    "{altitude_m} {sun}: {total}"
                );
            }
        }
    }

    #[test]
    fn harmonics_are_orthonormal() {
        let nodes = sphere(&stand(0.0, DVec3::new(1.0, 1.0, 0.5)), 6.36e6, CLEAR);
        for i in 0..9 {
            for j in 0..9 {
                let dot: f64 = nodes
                    .iter()
                    .map(|n| n.weight_sr * harmonics(n.direction)[i] * harmonics(n.direction)[j])
                    .sum();
                // As above.
                assert!((dot - f64::from(u8::from(i == j))).abs() < 2e-3, "{i} {j}: {dot}");
            }
        }
    }
}
