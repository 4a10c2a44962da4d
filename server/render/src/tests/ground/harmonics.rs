//! The sky's light on a surface by harmonics.

use crate::{
    quadrature::harmonics,
    shader,
    tests::{engine, evaluate},
};
use glam::DVec3;
use std::f64::consts::PI;

/// A white Lambert plane under a uniform sky sends back π L, and one that leans sees so much less of it: π L (1 + cos)/2.
/// Three bands are exact for that: a hemisphere has nothing of the even bands above the first, and the clamped cosine
/// nothing of the odd ones above the second (Ramamoorthi and Hanrahan 2001).
#[test]
fn a_white_plane_under_a_uniform_sky_sends_back_pi_times_its_radiance() {
    let engine = engine();
    let mut rows = Vec::new();
    for deg in [0.0_f32, 20.0, 45.0, 70.0, 90.0, 120.0, 180.0] {
        let (sin, cos) = deg.to_radians().sin_cos();
        rows.push([sin, 0.0, cos, 0.0, 0.0, 0.0, 0.0, 0.0]);
    }
    // Of radiance 2 over the hemisphere, looked at as `ground_sky.wgsl` does.
    let statements = "var c: array<vec3f, 9>;
        for (var i = 0u; i < 9u; i++) {
            var sum = 0.0;
            for (var k = 0u; k < 256u; k++) {
                let mu = (f32(k) + 0.5) / 256.0;
                let turn = 2.39996323 * f32(k);
                let y = harmonics(vec3f(sqrt(1.0 - mu * mu) * vec2f(cos(turn), sin(turn)), mu));
                sum += y[i] * 2.0;
            }
            c[i] = vec3f(2.0 * 3.14159265 / 256.0 * sum);
        }
        x = vec4f(irradiance_towards(c, a.xyz), 0.0);";
    let found = evaluate(&engine.gpu, &shader::GROUND_LIGHT, statements, &rows, &[]);
    for (row, found) in rows.iter().zip(found) {
        let expected = 2.0 * PI * (1.0 + f64::from(row[2])) / 2.0;
        // 256 looks over the hemisphere.
        assert!(
            (f64::from(found[0]) - expected).abs() < 0.01 * 2.0 * PI,
            "{row:?}: {} {expected}",
            found[0]
        );
    }
}

#[test]
fn the_shaders_harmonics_are_those_of_the_probe() {
    let engine = engine();
    let mut rows = Vec::new();
    let mut expected = Vec::new();
    for d in [
        DVec3::X,
        DVec3::Y,
        DVec3::Z,
        DVec3::new(0.3, -0.5, 0.7),
        DVec3::new(-0.6, 0.2, -0.4),
    ] {
        let d = d.normalize();
        let v = d.as_vec3();
        rows.push([v.x, v.y, v.z, 0.0, 0.0, 0.0, 0.0, 0.0]);
        expected.push(harmonics(d));
    }
    let statements = "let h = harmonics(a.xyz);
        x = vec4f(h[1], h[2], h[3], h[4]);
        y = vec4f(h[5], h[6], h[7], h[8]);";
    let found = evaluate(&engine.gpu, &shader::GROUND_SKY, statements, &rows, &[]);
    for (found, expected) in found.iter().zip(expected) {
        for k in 0..8 {
            // Rounding of f32.
            assert!(
                (f64::from(found[k]) - expected[k + 1]).abs() < 1e-5,
                "{found:?} {expected:?}"
            );
        }
    }
}
