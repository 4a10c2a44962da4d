//! What stands on the sphere: rays against the shape, its shadow, its light.

mod harmonics;
mod heightfield;
mod mesh;
mod mountains;
mod shafts;
mod water;

use glam::DVec3;
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::RngCore};

pub(super) const RADIUS_M: f64 = 6.36e6;

/// From 0 to 1.
fn random(source: &mut Xoshiro256PlusPlus) -> f64 {
    source.next_u64() as f64 / u64::MAX as f64
}

fn random3(source: &mut Xoshiro256PlusPlus) -> DVec3 {
    DVec3::new(random(source), random(source), random(source))
}

/// Compares a shader's ways with those of a caster in f64, 1e-4 apart as the issue asks. A ray stands for those beside it by
/// what f32 makes of its start and its direction: where these disagree it grazes, and no answer is the right one. Gives how
/// many met something and how many grazed.
fn compare(
    rays: &[(DVec3, DVec3)],
    found: &[Option<f64>],
    cast: impl Fn(DVec3, DVec3) -> Option<f64>,
) -> (usize, usize) {
    let (mut met, mut grazed) = (0, 0);
    for ((p, d), found) in rays.iter().zip(found) {
        let expected = cast(*p, *d);
        let close = |t: Option<f64>, share: f64| match (t, expected) {
            (Some(t), Some(e)) => (t - e).abs() <= share * e,
            (None, None) => true,
            _ => false,
        };
        let sides = [
            DVec3::X,
            DVec3::NEG_X,
            DVec3::Y,
            DVec3::NEG_Y,
            DVec3::Z,
            DVec3::NEG_Z,
        ];
        let beside = |side: DVec3| cast(p + side * 2e-7 * p.length(), (d + side * 2e-7).normalize());
        if !sides.into_iter().all(|side| close(beside(side), 0.5e-4)) {
            grazed += 1;
            continue;
        }
        met += usize::from(expected.is_some());
        assert!(close(*found, 1e-4), "{p} {d}: {found:?} {expected:?}");
    }
    (met, grazed)
}

/// Rays as rows for a shader: place and direction.
fn rows(rays: &[(DVec3, DVec3)]) -> Vec<[f32; 8]> {
    rays.iter()
        .map(|(p, d)| {
            let (p, d) = (p.as_vec3(), d.as_vec3());
            [p.x, p.y, p.z, 0.0, d.x, d.y, d.z, 0.0]
        })
        .collect()
}
