//! Phase functions and source functions.

use super::cloudy;
use crate::{
    cpu::{
        cloud::{diffused, draine, henyey_greenstein, share_below, slab_transmission},
        phase::rings,
    },
    gpu::Gpu,
    shader,
    tests::{engine, evaluate},
    uniforms::{Part, clouds::CloudsUniform},
};
use proptest::{
    prelude::*,
    test_runner::{Config, RngSeed, TestRunner},
};
use serde_json::{Value, json};

fn uniform(clouds: Value) -> CloudsUniform {
    let scene = cloudy(clouds);
    crate::cloud_sky::CloudSky::new(&scene).unwrap().uniform(1.0)
}

/// Statements that use nothing but the clouds' uniform.
fn with(gpu: &Gpu, clouds: &CloudsUniform, statements: &str, rows: &[[f32; 8]]) -> Vec<[f32; 8]> {
    let buffer = Part::new(clouds).upload(gpu, "clouds");
    evaluate(
        gpu,
        &shader::CLOUD_VIEW_LIGHT,
        statements,
        rows,
        &[(0, buffer.as_entire_binding())],
    )
}

fn row(values: &[f64]) -> [f32; 8] {
    std::array::from_fn(|i| values.get(i).map_or(0.0, |v| *v as f32))
}

#[test]
fn the_lobes_are_their_twins() {
    let mut rows = Vec::new();
    for g in [-0.9, -0.25, 0.0, 0.5, 0.8, 0.97] {
        for alpha in [0.0, 0.5, 1.0, 20.0] {
            rows.extend([-1.0, -0.6, 0.0, 0.3, 0.9, 0.999].map(|cos| row(&[cos, g, alpha])));
        }
    }
    let engine = engine();
    let statement = "x = vec4f(henyey_greenstein(a.x, a.y), draine(a.x, a.y, a.z), 0.0, 0.0);";
    let found = evaluate(&engine.gpu, &shader::CLOUD_VIEW_LIGHT, statement, &rows, &[]);
    for (row, found) in rows.iter().zip(found) {
        let [cos, g, alpha] = [row[0], row[1], row[2]].map(f64::from);
        for (found, expected) in found
            .iter()
            .zip([henyey_greenstein(cos, g), draine(cos, g, alpha)])
        {
            // A few roundings of f32; near the peak of g = 0.97, 1 - cos of 1e-3 rounds at 6e-5.
            let off = f64::from(*found) / expected - 1.0;
            assert!(off.abs() < 1e-4, "{row:?}: {off}");
        }
    }
}

fn any_phase() -> impl Strategy<Value = Value> {
    let lobes = (0.0..0.99_f64, -0.99..0.0_f64, 0.0..1.0_f64).prop_map(|(forward, backward, blend)| {
        json!({"kind": "dual-henyey-greenstein", "forward": forward, "backward": backward, "blend": blend})
    });
    let droplets = (5e-6..5e-5_f64).prop_map(|d| json!({"kind": "droplets", "diameter_m": d}));
    prop_oneof![lobes, droplets]
}

/// And its mean cosine is what the source functions take it for.
#[test]
fn every_phase_function_integrates_to_one() {
    let config = Config {
        cases: 24,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(7),
        ..Config::default()
    };
    let engine = engine();
    // Every seventh ring, so that those of either hemisphere are among them.
    let nodes: Vec<_> = rings().step_by(7).map(|(cos, sr)| (cos, 7.0 * sr)).collect();
    let rows: Vec<_> = nodes.iter().map(|(cos, _)| row(&[*cos])).collect();
    let found = TestRunner::new(config).run(&any_phase(), |phase| {
        let clouds = uniform(json!({ "phase": phase }));
        let [forward, other, share, alpha] =
            [clouds.forward, clouds.other, clouds.other_share, clouds.alpha].map(f64::from);
        let twin =
            |cos: f64| (1.0 - share) * henyey_greenstein(cos, forward) + share * draine(cos, other, alpha);
        let found = with(&engine.gpu, &clouds, "x.x = cloud_phase(a.x);", &rows);
        let (mut whole, mut cosine) = (0.0, 0.0);
        for ((cos, sr), (row, found)) in nodes.iter().zip(rows.iter().zip(&found)) {
            // The quadrature's own cosine: it lies between those of f32.
            let value = f64::from(found[0]) * twin(*cos) / twin(f64::from(row[0]));
            whole += sr * value;
            cosine += sr * value * cos;
        }
        // What the product promises; the mean cosine as well.
        prop_assert!((whole - 1.0).abs() < 1e-3, "{}", whole);
        prop_assert!(
            (cosine - f64::from(clouds.asymmetry)).abs() < 1e-3,
            "{} {}",
            cosine,
            clouds.asymmetry
        );
        Ok(())
    });
    found.unwrap();
}

/// Even scattering, no absorption, no powder, and the first order of the forward light alone.
fn plain() -> CloudsUniform {
    CloudsUniform {
        powder: 0.0,
        octaves: 1,
        albedo: glam::Vec3::ONE,
        ..uniform(json!({"phase": {"kind": "dual-henyey-greenstein", "forward": 0, "backward": 0}}))
    }
}

const DEPTHS: [f64; 6] = [0.0, 0.05, 0.4, 1.5, 6.0, 30.0];

fn pairs() -> Vec<[f32; 8]> {
    let pair = |a: f64| DEPTHS.map(|b| row(&[a, b]));
    DEPTHS
        .iter()
        .flat_map(|a| pair(*a))
        .filter(|row| row[0] + row[1] > 0.0)
        .collect()
}

/// Diffusion solved by finite volumes, which share nothing with the shader's closed form.
#[test]
fn light_in_a_slab_is_the_solution_of_diffusion() {
    let engine = engine();
    let statement = "x = 4.0 * PI * vec4f(lit_source(forward_lobes(0.3), a.z, a.x, a.y, 0.0).x, ambient_source(a.x, a.y).x, 0.0, 0.0);";
    for mu in [1.0, 0.4, 0.1] {
        let slanted = |[before, behind, ..]: [f32; 8]| row(&[before.into(), behind.into(), mu]);
        let rows: Vec<_> = pairs().into_iter().map(slanted).collect();
        for (row, found) in rows.iter().zip(with(&engine.gpu, &plain(), statement, &rows)) {
            let (before, behind) = (f64::from(row[0]), f64::from(row[1]));
            let whole = before + behind;
            // The depths of light are along its own way.
            let lit = (-before).exp() + diffused(mu * whole, Some(mu), 0.0, 0.0, mu * before);
            let even = diffused(whole, None, 1.0, 0.0, before);
            // The cells' size: values at the slab's edge stand half a cell inside, of U' = 3 F there.
            let allowed = 2e-3 * (1.0 + whole);
            assert!(
                (f64::from(found[0]) - lit).abs() < allowed,
                "{row:?}: lit {}, not {lit}",
                found[0]
            );
            assert!(
                (f64::from(found[1]) - even).abs() < allowed,
                "{row:?}: even {}, not {even}",
                found[1]
            );
        }
    }
}

/// U'' = m² U less its sources: m²/3 of U leaves at the sides. The more of a heap a cloud is, the less light's slant counts.
#[test]
fn light_in_a_heap_is_the_solution_of_diffusion_with_losses() {
    let engine = engine();
    let statement =
        "x = vec4f(4.0 * PI * lit_source(forward_lobes(0.3), a.z, a.x, a.y, a.w).x, HEAP, 0.0, 0.0);";
    for (mu, leak) in [(1.0, 1.0), (0.3, 1.0), (0.3, 0.5), (0.8, 0.2)] {
        let heaped = |[before, behind, ..]: [f32; 8]| row(&[before.into(), behind.into(), mu, leak]);
        let rows: Vec<_> = pairs().into_iter().map(heaped).collect();
        for (row, found) in rows.iter().zip(with(&engine.gpu, &plain(), statement, &rows)) {
            let upright = mu + (1.0 - mu) * leak;
            let (before, whole) = (
                upright * f64::from(row[0]),
                upright * (f64::from(row[0]) + f64::from(row[1])),
            );
            let m = leak * f64::from(found[1]) / (1.0 + whole);
            let lit = (-f64::from(row[0])).exp() + diffused(whole, Some(upright), 0.0, m * m / 3.0, before);
            // As above, and what moves the pole aside.
            let allowed = 2e-3 * (1.0 + whole) + 0.01 * lit;
            assert!(
                (f64::from(found[0]) - lit).abs() < allowed,
                "{row:?}: {}, not {lit}",
                found[0]
            );
        }
    }
}

/// The mean depth of what a look at a slab sees, weighted by how much of it comes out.
#[test]
fn of_a_slab_is_seen_what_light_leaves_it() {
    let engine = engine();
    let mut rows = Vec::new();
    for mu in [0.05, 0.3, 1.0] {
        rows.extend(DEPTHS.map(|whole| row(&[mu, whole])));
    }
    let found = with(&engine.gpu, &plain(), "x.x = depth_seen(a.x, a.y);", &rows);
    for (row, found) in rows.iter().zip(found) {
        let [mu, whole] = [row[0], row[1]].map(f64::from);
        const STEPS: u32 = 100_000;
        let (mut moment, mut sum) = (0.0, f64::MIN_POSITIVE);
        for k in 0..STEPS {
            let x = whole * (f64::from(k) + 0.5) / f64::from(STEPS);
            moment += x * (-x / mu).exp();
            sum += (-x / mu).exp();
        }
        // What f32 leaves of the difference of two nearly alike.
        assert!(
            (f64::from(found[0]) - moment / sum).abs() < 1e-3 * mu,
            "{row:?}: {} {}",
            found[0],
            moment / sum
        );
    }
}

/// Even surroundings of irradiance 1 on both sides have radiance 1/π, and so has what scatters without absorbing among
/// them: a furnace.
#[test]
fn a_cloud_in_a_furnace_is_as_bright_as_the_furnace() {
    let engine = engine();
    let rows = pairs();
    for phase in [
        json!({"kind": "dual-henyey-greenstein"}),
        json!({"kind": "dual-henyey-greenstein", "forward": 0.95, "blend": 0}),
        json!({"kind": "droplets"}),
    ] {
        let clouds = uniform(json!({"albedo": 1, "phase": phase}));
        let statement = "x.x = PI * (ambient_source(a.x, a.y) + ambient_source(a.y, a.x)).x;";
        for (row, found) in rows.iter().zip(with(&engine.gpu, &clouds, statement, &rows)) {
            // Roundings; the product promises 1 %.
            assert!((found[0] - 1.0).abs() < 1e-5, "{phase} {row:?}: {}", found[0]);
        }
    }
}

/// A photon has to go somewhere: over all directions a thin cloud scatters what it takes, once.
#[test]
fn a_thin_cloud_scatters_what_it_takes() {
    let engine = engine();
    let nodes: Vec<_> = rings().step_by(7).map(|(cos, sr)| (cos, 7.0 * sr)).collect();
    let rows: Vec<_> = nodes.iter().map(|(cos, _)| row(&[*cos, 1e-5, 1e-5])).collect();
    for forward in [0.0, 0.5, 0.85] {
        let clouds = uniform(json!({"albedo": 1, "powder": 0,
            "phase": {"kind": "dual-henyey-greenstein", "forward": forward}}));
        let found = with(
            &engine.gpu,
            &clouds,
            "x.x = lit_source(forward_lobes(a.x), 1.0, a.y, a.z, 0.0).x;",
            &rows,
        );
        let sum: f64 = nodes
            .iter()
            .zip(found)
            .map(|((_, sr), found)| sr * f64::from(found[0]))
            .sum();
        // Light that comes back from so thin a cloud is of the order of its depth.
        assert!((sum - 1.0).abs() < 1e-3, "forward {forward}: {sum}");
    }
}

#[test]
fn what_a_slab_lets_through_is_its_twin_and_what_is_left_inside() {
    let engine = engine();
    let mut rows = Vec::new();
    for g in [0.0, 0.5, 0.85] {
        for mu in [0.05, 0.3, 0.7, 1.0] {
            rows.extend(DEPTHS.map(|depth| row(&[g, mu, depth])));
        }
    }
    let statement = "x.x = slab_transmission(a.x, a.y, a.z);";
    let found = evaluate(&engine.gpu, &shader::SKY, statement, &rows, &[]);
    for (row, found) in rows.iter().zip(found) {
        let [g, mu, depth] = [row[0], row[1], row[2]].map(f64::from);
        let expected = slab_transmission(g, mu, depth);
        // A few roundings of f32.
        assert!(
            (f64::from(found[0]) - expected).abs() < 1e-5,
            "{row:?}: {} {expected}",
            found[0]
        );
        assert!((0.0..1.0 + 1e-6).contains(&found[0]), "{row:?}: {}", found[0]);
        if mu == 1.0 && g == 0.0 && depth > 0.0 {
            // Straight through, and half of U at the base.
            let inside = (-depth).exp() + 0.5 * diffused(depth, Some(mu), 0.0, 0.0, depth);
            assert!((expected - inside).abs() < 3e-3, "{depth}: {expected}, {inside}");
        }
    }
}

#[test]
fn the_sum_of_two_looks_is_spread_evenly() {
    let engine = engine();
    let rows: Vec<_> = (0..=27).map(|k| row(&[f64::from(k) * 0.05])).collect();
    let found = evaluate(
        &engine.gpu,
        &shader::CLOUD_VIEW_LIGHT,
        "x = vec4f(share_below(a.xxx), SECOND_WEIGHT);",
        &rows,
        &[],
    );
    for (row, found) in rows.iter().zip(found) {
        let expected = share_below(f64::from(row[0]), f64::from(found[3]));
        // The quadrature's steps.
        assert!(
            (f64::from(found[0]) - expected).abs() < 1e-4,
            "{row:?}: {} {expected}",
            found[0]
        );
    }
}
