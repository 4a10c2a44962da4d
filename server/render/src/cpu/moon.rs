//! Twin of `lib/moon.wgsl`.

use crate::{moon_face, moonlight::Moonlight};
use glam::DVec3;

/// Radiance at a place on the disc, x east and y north in radii; zero beside it.
pub(crate) fn on_disc(moon: &Moonlight, x: f64, y: f64) -> DVec3 {
    let off = x * x + y * y;
    if off >= 1.0 {
        return DVec3::ZERO;
    }
    let at = DVec3::new((1.0 - off).sqrt(), x, y);
    let (mu, mu0) = (at.x, at.dot(moon.light));
    let lit = if mu0 > 0.0 { 2.0 * mu0 / (mu0 + mu) } else { 0.0 };
    moon_face::at(x, y) * (moon.radiance_w_m2_sr * lit + moon.earthshine_w_m2_sr)
}
