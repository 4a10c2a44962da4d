//! The aerosols' phase function convolved with itself: the directions of light that they scatter twice.

use crate::uniforms::narrow;
use std::f64::consts::PI;

/// Terms of the Legendre series that are summed at most; with g = 0.999 the last is e⁻⁸ of the first.
const MOST_TERMS: u32 = 4096;

/// Legendre moments χ_l of the Cornette-Shanks phase function, p(μ) = Σ (2l+1)/4π χ_l P_l(μ).
///
/// It is k (1+μ²) times that of Henyey and Greenstein, whose moments are g^l, with k = 3/2 / (2+g²); and μ² P_l is a sum
/// of P_{l+2}, P_l and P_{l-2} by μ P_l = ((l+1) P_{l+1} + l P_{l-1}) / (2l+1), used twice.
pub(crate) fn cornette_shanks_moments(g: f64) -> impl Iterator<Item = f64> {
    let k = 1.5 / (2.0 + g * g);
    // g^(l-2), g^(l-1), g^l
    let mut powers = [0.0, 0.0, 1.0];
    (0..MOST_TERMS).map(f64::from).map(move |l| {
        let above = (2.0 * l + 1.0) * (2.0 * l + 3.0);
        let below = (2.0 * l + 1.0) * (2.0 * l - 1.0);
        let up = (l + 1.0) * (l + 2.0) / above;
        let same = (l + 1.0).powi(2) / above + l * l / below;
        let down = l * (l - 1.0) / below;
        let moment = k * ((1.0 + same + up * g * g) * powers[2] + down * powers[0]);
        powers = [powers[1], powers[2], powers[2] * g];
        moment
    })
}

/// The phase function convolved with itself, per steradian, at `count` even angles from 0 to π: moments multiply.
pub(crate) fn convolved(g: f64, count: usize) -> Vec<f32> {
    let terms: Vec<f64> = cornette_shanks_moments(g)
        .enumerate()
        .map(|(l, moment)| (l, moment * moment))
        .take_while(|(l, square)| *l < 4 || *square > 1e-9)
        .map(|(_, square)| square)
        .collect();
    let last = f64::from(u32::try_from(count).unwrap_or(u32::MAX) - 1);
    (0_u32..)
        .take(count)
        .map(|i| narrow(series(&terms, (PI * f64::from(i) / last).cos())))
        .collect()
}

fn series(moments: &[f64], mu: f64) -> f64 {
    let (mut p, mut before) = (1.0, 0.0);
    let mut sum = 0.0;
    for (l, moment) in (0_u32..).map(f64::from).zip(moments) {
        sum += (2.0 * l + 1.0) / (4.0 * PI) * moment * p;
        (p, before) = (((2.0 * l + 1.0) * mu * p - l * before) / (l + 1.0), p);
    }
    sum.max(0.0)
}
