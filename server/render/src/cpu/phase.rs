//! Twin of `lib/phase.wgsl`.

use std::f64::consts::PI;

/// Rayleigh's phase function, per steradian.
pub(crate) fn rayleigh(cos: f64) -> f64 {
    3.0 / (16.0 * PI) * (1.0 + cos * cos)
}

/// Cornette and Shanks' phase function, per steradian.
pub(crate) fn cornette_shanks(cos: f64, g: f64) -> f64 {
    let base = 1.0 + g * g - 2.0 * g * cos;
    3.0 / (8.0 * PI) * (1.0 - g * g) * (1.0 + cos * cos) / ((2.0 + g * g) * base.powf(1.5))
}

/// Cosines and solid angles over the sphere, crowded towards both ends of the axis, where phase functions have their
/// peaks: 1 - |cos| = x⁴, by midpoints in x.
pub(crate) fn rings() -> impl Iterator<Item = (f64, f64)> {
    const HALF: u32 = 20_000;
    (0..HALF).flat_map(|k| {
        let x = (f64::from(k) + 0.5) / f64::from(HALF);
        let cos = 1.0 - x.powi(4);
        let solid_angle_sr = 2.0 * PI * 4.0 * x.powi(3) / f64::from(HALF);
        [(cos, solid_angle_sr), (-cos, solid_angle_sr)]
    })
}
