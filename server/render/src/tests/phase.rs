//! Phase functions: the twin by quadrature, the shader by the twin, the moments by both.

use super::{engine, evaluate};
use crate::{
    cpu::phase::{cornette_shanks, rayleigh, rings},
    phase::{convolved, cornette_shanks_moments},
    shader,
};

const ASYMMETRIES: [f64; 9] = [-0.9, -0.5, 0.0, 0.3, 0.7, 0.76, 0.8, 0.95, 0.999];

#[test]
fn each_twin_integrates_to_one() {
    let sum: f64 = rings().map(|(cos, sr)| sr * rayleigh(cos)).sum();
    // What the product promises; the quadrature itself is good to 1e-8.
    assert!((sum - 1.0).abs() < 1e-6, "Rayleigh: {sum}");
    for g in ASYMMETRIES {
        let sum: f64 = rings().map(|(cos, sr)| sr * cornette_shanks(cos, g)).sum();
        assert!((sum - 1.0).abs() < 1e-6, "g = {g}: {sum}");
    }
}

#[test]
fn the_moments_are_those_of_the_phase_function() {
    for g in ASYMMETRIES {
        let p1: f64 = rings().map(|(c, sr)| sr * cornette_shanks(c, g) * c).sum();
        let p2: f64 = rings()
            .map(|(c, sr)| sr * cornette_shanks(c, g) * 0.5 * (3.0 * c * c - 1.0))
            .sum();
        let moments: Vec<f64> = cornette_shanks_moments(g).take(3).collect();
        // The quadrature's own error.
        assert!((moments[0] - 1.0).abs() < 1e-12, "g = {g}: {moments:?}");
        assert!((moments[1] - p1).abs() < 1e-6, "g = {g}: p1 {moments:?} {p1}");
        assert!((moments[2] - p2).abs() < 1e-6, "g = {g}: p2 {moments:?} {p2}");
    }
}

/// ∫ p(ω·a) p(ω·b) dω by brute force, about the axis a.
#[test]
fn the_convolved_phase_function_is_the_integral() {
    for g in [-0.5, 0.0, 0.5, 0.76, 0.9] {
        let list = convolved(g, 181);
        for degrees in [0_usize, 3, 20, 60, 120, 180] {
            let (sin_b, cos_b) = (degrees as f64).to_radians().sin_cos();
            let mut sum = 0.0;
            for (cos, sr) in rings().step_by(17) {
                let sin = (1.0 - cos * cos).max(0.0).sqrt();
                for k in 0..180 {
                    let nu = cos * cos_b + sin * sin_b * (f64::from(k) + 0.5).to_radians().cos();
                    sum += sr * 17.0 / 180.0 * cornette_shanks(cos, g) * cornette_shanks(nu, g);
                }
            }
            // Every seventeenth ring, on either side of the equator in turn, is a coarser quadrature.
            let off = f64::from(list[degrees]) / sum - 1.0;
            assert!(
                off.abs() < 5e-3,
                "g = {g} at {degrees}°: {} for {sum}",
                list[degrees]
            );
        }
    }
}

#[test]
fn the_shaders_phase_functions_are_their_twins_and_integrate_to_one() {
    let engine = engine();
    let nodes: Vec<_> = rings().collect();
    for g in ASYMMETRIES {
        let rows: Vec<[f32; 8]> = nodes
            .iter()
            .map(|(cos, _)| [*cos as f32, g as f32, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
            .collect();
        let statement = "x = vec4f(rayleigh_phase(a.x), cornette_shanks_phase(a.x, a.y), 0.0, 0.0);";
        let found = evaluate(&engine.gpu, &shader::PROBE, statement, &rows, &[]);
        let (mut rayleigh_sum, mut mie_sum) = (0.0, 0.0);
        for ((row, found), (exact_cos, sr)) in rows.iter().zip(&found).zip(&nodes) {
            // The f32 cosine that the shader was given.
            let (cos, g) = (f64::from(row[0]), f64::from(row[1]));
            let off = (f64::from(found[0]) / rayleigh(cos) - 1.0).abs();
            // A few roundings of f32.
            assert!(off < 1e-6, "Rayleigh at {cos}: {off}");
            let off = (f64::from(found[1]) / cornette_shanks(cos, g) - 1.0).abs();
            // 1 - cos rounds at 6e-8, which g = 0.999 compares with (1-g)² = 1e-6.
            assert!(off < 1e-4, "g = {g} at {cos}: {off}");
            rayleigh_sum += sr * f64::from(found[0]);
            // The quadrature's own cosine: it lies between those of f32, which are too few for the peak of g = 0.999.
            mie_sum += sr * f64::from(found[1]) * cornette_shanks(*exact_cos, g) / cornette_shanks(cos, g);
        }
        // What the product promises.
        assert!((rayleigh_sum - 1.0).abs() < 1e-4, "Rayleigh: {rayleigh_sum}");
        assert!((mie_sum - 1.0).abs() < 1e-4, "g = {g}: {mie_sum}");
    }
}
