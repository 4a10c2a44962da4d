//! Phase functions: probability per steradian that light turns by an angle whose cosine is μ.

use crate::random::Random;
use std::f64::consts::PI;

/// Molecules: 3/(16π) (1 + μ²).
pub(crate) fn rayleigh(mu: f64) -> f64 {
    3.0 / (16.0 * PI) * (1.0 + mu * mu)
}

/// Aerosols (Cornette and Shanks 1992): 3/(8π) (1 - g²)(1 + μ²) / ((2 + g²)(1 + g² - 2gμ)^1.5).
pub(crate) fn cornette_shanks(mu: f64, g: f64) -> f64 {
    let base = 1.0 + g * g - 2.0 * g * mu;
    3.0 / (8.0 * PI) * (1.0 - g * g) * (1.0 + mu * mu) / ((2.0 + g * g) * base * base.sqrt())
}

/// μ with the molecules' density. Its integral is a cubic in μ with one real root (Cardano): with z = 4ξ - 2 and
/// a³ = z + √(z² + 1), μ = a - 1/a.
pub(crate) fn sample_rayleigh(random: &mut Random) -> f64 {
    let z = 4.0 * random.unit() - 2.0;
    let a = (z + (z * z + 1.0).sqrt()).cbrt();
    (a - 1.0 / a).clamp(-1.0, 1.0)
}

/// μ with the aerosols' density: Henyey and Greenstein's is inverted exactly, and of its values a share
/// (1 + μ²)/2 is kept, which leaves the density above.
pub(crate) fn sample_cornette_shanks(g: f64, random: &mut Random) -> f64 {
    loop {
        let u = 2.0 * random.unit() - 1.0;
        let mu = if g.abs() < 1e-3 {
            // To first order in g; the kept share below is exact, the error O(g²) = 1e-6.
            u + 1.5 * g * (1.0 - u * u)
        } else {
            let ratio = (1.0 - g * g) / (1.0 + g * u);
            (1.0 + g * g - ratio * ratio) / (2.0 * g)
        };
        let mu = mu.clamp(-1.0, 1.0);
        if random.unit() < 0.5 * (1.0 + mu * mu) {
            return mu;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gauss::Rule;

    fn moment(density: impl Fn(f64) -> f64, power: i32) -> f64 {
        let rule = Rule::<12>::new();
        (0..2000)
            .map(|i| {
                let a = -1.0 + f64::from(i) / 1000.0;
                rule.integrate(a, a + 0.001, |mu| 2.0 * PI * density(mu) * mu.powi(power))
            })
            .sum()
    }

    #[test]
    fn each_integrates_to_one() {
        assert!((moment(rayleigh, 0) - 1.0).abs() < 1e-12);
        for g in [-0.9, 0.0, 0.5, 0.76, 0.8, 0.95] {
            let integral = moment(|mu| cornette_shanks(mu, g), 0);
            assert!((integral - 1.0).abs() < 1e-10, "g {g}: {integral}");
        }
    }

    #[test]
    fn samples_have_the_density_s_moments() {
        const SAMPLES: u32 = 200_000;
        let mut random = Random::new(1, 0);
        let mut check = |density: &dyn Fn(f64) -> f64, sample: &dyn Fn(&mut Random) -> f64| {
            let samples: Vec<f64> = (0..SAMPLES).map(|_| sample(&mut random)).collect();
            for power in 1..=3 {
                let exact = moment(density, power);
                let spread = (moment(density, 2 * power) - exact * exact).sqrt();
                let mean: f64 = samples.iter().map(|mu| mu.powi(power)).sum::<f64>() / f64::from(SAMPLES);
                // Four standard errors of the mean.
                let allowed = 4.0 * spread / f64::from(SAMPLES).sqrt();
                assert!(
                    (mean - exact).abs() < allowed,
                    "moment {power}: {mean} for {exact}"
                );
            }
        };
        check(&rayleigh, &sample_rayleigh);
        for g in [-0.5, 0.0, 0.76, 0.95] {
            check(&|mu| cornette_shanks(mu, g), &|random| {
                sample_cornette_shanks(g, random)
            });
        }
    }
}
