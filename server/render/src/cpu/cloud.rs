//! Twins of `lib/cloud_light.wgsl` and of functions of `lib/cloud.wgsl` and `lib/cloud_shade.wgsl`.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "cells are few and their numbers not negative"
)]

use std::f64::consts::PI;

/// Henyey and Greenstein's phase function, per steradian.
pub(crate) fn henyey_greenstein(cos: f64, g: f64) -> f64 {
    (1.0 - g * g) / (4.0 * PI * (1.0 + g * g - 2.0 * g * cos).powf(1.5))
}

/// Draine's phase function, per steradian.
pub(crate) fn draine(cos: f64, g: f64, alpha: f64) -> f64 {
    henyey_greenstein(cos, g) * (1.0 + alpha * cos * cos) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0)
}

/// Of light on a slab's top, at a cosine, the share that leaves below, by diffusion.
pub(crate) fn slab_transmission(asymmetry: f64, mu: f64, optical_depth: f64) -> f64 {
    let whole = (1.0 - asymmetry) * optical_depth;
    (2.0 + 3.0 * mu + (2.0 - 3.0 * mu) * (-whole / mu).exp()) / (4.0 + 3.0 * whole)
}

/// P(a + k b < v) of a and b that are even over 0..1, by quadrature over b.
pub(crate) fn share_below(v: f64, k: f64) -> f64 {
    const STEPS: u32 = 20_000;
    let share = |i: u32| (v - k * (f64::from(i) + 0.5) / f64::from(STEPS)).clamp(0.0, 1.0);
    (0..STEPS).map(share).sum::<f64>() / f64::from(STEPS)
}

/// Radiation in a slab without absorption in the diffusion limit: the integral U over all directions, by finite volumes.
/// The flux is F = -U'/3 in optical depth of even scattering; no light but what is told comes in: at the top
/// U/4 + F/2 = `on_top`, at the base U/4 - F/2 = 0. A beam of unit irradiance that falls at a cosine μ feeds e^{-τ/μ}, and
/// `lost` of U leaves at the sides.
pub(crate) fn diffused(whole: f64, beam: Option<f64>, on_top: f64, lost: f64, at: f64) -> f64 {
    const CELLS: usize = 4000;
    let step = whole / CELLS as f64;
    // (F out - F in) of each cell is its source, a tridiagonal system solved from the top: U[i] = p[i] + q[i] U[i+1].
    let source = |i: usize| {
        let edge = |k: usize, mu: f64| mu * (-step * k as f64 / mu).exp();
        beam.map_or(0.0, |mu| edge(i, mu) - edge(i + 1, mu))
    };
    let between = 1.0 / (3.0 * step);
    // Half a cell to the face, then U/4 = F/2 there: F = U / (2 + 3 step / 2).
    let face = 1.0 / (2.0 + 1.5 * step);
    let (mut p, mut q) = (vec![0.0; CELLS], vec![0.0; CELLS]);
    for i in 0..CELLS {
        let below = if i + 1 < CELLS { between } else { face };
        let (above, brought) = if i == 0 {
            (face, source(i) + 4.0 * on_top * face)
        } else {
            (between * (1.0 - q[i - 1]), source(i) + between * p[i - 1])
        };
        let out = above + below + lost * step;
        p[i] = brought / out;
        q[i] = if i + 1 < CELLS { below / out } else { 0.0 };
    }
    let mut u = vec![0.0; CELLS];
    for i in (0..CELLS).rev() {
        u[i] = p[i] + if i + 1 < CELLS { q[i] * u[i + 1] } else { 0.0 };
    }
    u[((at / step) as usize).min(CELLS - 1)]
}
