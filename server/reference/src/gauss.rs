//! Gauss-Legendre quadrature.

use std::f64::consts::PI;

/// Nodes and weights on [0, 1], exact for polynomials up to degree 2N - 1.
#[derive(Clone, Debug)]
pub(crate) struct Rule<const N: usize>([(f64, f64); N]);

impl<const N: usize> Rule<N> {
    /// The roots of the Legendre polynomial P_N by Newton's method from Tricomi's guess cos(π(i + 3/4)/(N + 1/2)).
    pub(crate) fn new() -> Self {
        let n = N as f64;
        Self(std::array::from_fn(|i| {
            let mut x = (PI * (i as f64 + 0.75) / (n + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..20 {
                // (k + 1) P_{k+1} = (2k + 1) x P_k - k P_{k-1}
                let (mut before, mut value) = (1.0, x);
                for k in 1..N {
                    let k = k as f64;
                    (before, value) = (value, ((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0));
                }
                slope = n * (x * value - before) / (x * x - 1.0);
                x -= value / slope;
            }
            (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
        }))
    }

    /// ∫ f over [a, b], with f's values summed by `add` from `zero`.
    pub(crate) fn integrate<T>(&self, a: f64, b: f64, f: impl Fn(f64) -> T) -> T
    where
        T: Default + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
    {
        self.0.iter().fold(T::default(), |sum, (x, weight)| {
            sum + f(a + (b - a) * x) * (weight * (b - a))
        })
    }
}

impl<const N: usize> Default for Rule<N> {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_up_to_degree_2n_minus_1_are_exact() {
        let rule = Rule::<12>::new();
        for degree in 0..24 {
            let exact = (3.0_f64.powi(degree + 1) - 1.0) / f64::from(degree + 1);
            let found: f64 = rule.integrate(1.0, 3.0, |x| x.powi(degree));
            // Rounding alone.
            assert!(
                (found / exact - 1.0).abs() < 1e-13,
                "degree {degree}: {found} for {exact}"
            );
        }
    }
}
