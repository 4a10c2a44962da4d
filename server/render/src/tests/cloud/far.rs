//! Clouds of which a pixel holds many heaps and gaps, against the means that stand for them.

use super::{Ready, VOLUME, cloudy, passes};
use crate::{
    shader,
    tests::{engine, evaluate},
};
use serde_json::json;

/// Share and mean of what is above 0 of a ramp that is cut off, and the mean over clumps and gaps, by quadrature.
#[test]
fn clumps_are_the_mean_of_what_they_stand_for() {
    const STEPS: u32 = 100_000;
    let mut rows = Vec::new();
    for least in [-1.5_f32, -0.4, 0.0, 0.2] {
        for width in [0.1_f32, 0.5, 2.0] {
            for full in [0.2_f32, 1.0] {
                rows.push([least, least + width, full, 0.004, 0.0, 0.0, 0.0, 0.0]);
            }
        }
    }
    let engine = engine();
    let statements = "let c = clumps_between(a.x, a.y, a.z);
        x = vec4f(c.share, c.density, clumped_extinction(c.share, a.w, 960.0), 0.0);";
    let found = evaluate(&engine.gpu, &shader::CLOUD_VIEW, statements, &rows, &[]);
    for (row, found) in rows.iter().zip(found) {
        let [least, most, full, extinction] = [row[0], row[1], row[2], row[3]].map(f64::from);
        let ramp = |i: u32| least + (most - least) * (f64::from(i) + 0.5) / f64::from(STEPS);
        let share = (0..STEPS).filter(|i| ramp(*i) > 0.0).count() as f64 / f64::from(STEPS);
        let mean = (0..STEPS).map(|i| ramp(i).clamp(0.0, full)).sum::<f64>() / f64::from(STEPS);
        let even = -(1.0 - share * (1.0 - (-extinction * 960.0).exp())).ln() / 960.0;
        // f32, and a step of the quadrature.
        assert!((f64::from(found[0]) - share).abs() < 2e-5, "{row:?}: {found:?}");
        assert!(
            (f64::from(found[0] * found[1]) - mean).abs() < 2e-5,
            "{row:?}: {found:?}"
        );
        assert!(
            (f64::from(found[2]) - even).abs() < 2e-5 * extinction + 1e-8,
            "{row:?}: {found:?} {even}"
        );
    }
}

/// The coarse noise's billows are spread evenly, as is taken for granted where their mean is taken.
#[test]
fn billows_are_spread_evenly() {
    let engine = engine();
    for seed in [1, 77] {
        let scene = cloudy(json!({"seed": seed}));
        let ready = Ready::new(&engine.gpu, &mut passes(), &scene);
        let rows: Vec<[f32; 8]> = (0..20_000)
            .map(|k| {
                let moved = |a: f64| (f64::from(k) * a).fract() as f32;
                [
                    moved(0.819_172_5),
                    moved(0.671_043_6),
                    moved(0.549_700_5),
                    0.0,
                    0.0,
                    0.0,
                    0.0,
                    0.0,
                ]
            })
            .collect();
        let statements = "let noise = textureSampleLevel(shape_volume, linear_repeat, a.xyz, 0.0);
            let fbm = dot(noise.gba, vec3f(0.625, 0.25, 0.125));
            x = vec4f((noise.r + 1.0 - fbm) / (2.0 - fbm), BILLOWS, 0.0);";
        let mut found = evaluate(
            &engine.gpu,
            &shader::CLOUD_VIEW,
            statements,
            &rows,
            &ready.binds(&engine.gpu, &[1, 2]),
        );
        found.sort_by(|a, b| a[0].total_cmp(&b[0]));
        for (i, row) in (0..).zip(&found) {
            let share = f64::from(i) / found.len() as f64;
            let even = ((row[0] - row[1]) / (row[2] - row[1])).clamp(0.0, 1.0);
            // Kolmogorov's distance; twice that of seeds and of eight bits.
            assert!((f64::from(even) - share).abs() < 0.06, "{share}: {even}");
        }
    }
}

/// From so far that heaps and gaps are one, a sky lets through what it does on average over places.
#[test]
fn the_mean_lets_through_what_places_do() {
    const SIDE: u32 = 48;
    let engine = engine();
    let mut passes = passes();
    for coverage in [0.2, 0.5, 0.8] {
        let scene = cloudy(json!({"coverage": coverage,
            "layers": [{"kind": "volume", "base_m": 1500, "top_m": 3000, "type": 0.8}]}));
        let ready = Ready::new(&engine.gpu, &mut passes, &scene);
        let rows: Vec<[f32; 8]> = (0..SIDE * SIDE)
            .map(|k| {
                let at = |k: u32| (5000.0 * f64::from(k) - 120_000.0) as f32;
                [at(k % SIDE), at(k / SIDE), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
            })
            .collect();
        let statements = "let band = clouds.bands[0];
            let step_m = (band.top_m - band.base_m) / 64.0;
            for (var k = 0u; k < 64u; k++) {
                let h = band.base_m + (f32(k) + 0.5) * step_m;
                x.x += step_m * band_extinction(band, vec3f(a.xy, h), h, Look(true, 0.0, 0.0)).value;
                x.y += step_m * band_extinction(band, vec3f(a.xy, h), h, Look(true, 0.0, 5000.0)).value;
            }";
        let found = evaluate(
            &engine.gpu,
            &shader::CLOUD_VIEW,
            statements,
            &rows,
            &ready.binds(&engine.gpu, &VOLUME),
        );
        let mean =
            |i: usize| found.iter().map(|row| f64::from((-row[i]).exp())).sum::<f64>() / found.len() as f64;
        println!("{coverage}: {} {}", mean(0), mean(1));
        assert!(
            (mean(0) - mean(1)).abs() < 0.05,
            "{coverage}: {} {}",
            mean(0),
            mean(1)
        );
    }
}
