//! The share of the area that clouds cover.

use super::{Ready, SHEET, VOLUME, cloudy, passes};
use crate::{
    gpu::Gpu,
    shader,
    tests::{engine, evaluate},
};
use serde_json::{Value, json};

/// Side of the square that is looked at, metres: far more than the weather's tile, so that many clusters are met.
const AREA_M: f64 = 240_000.0;
/// Columns along it.
const COLUMNS: u32 = 48;

/// Optical depths of columns on a lattice, moved at random inside its cells.
fn columns() -> Vec<[f32; 8]> {
    let cell = AREA_M / f64::from(COLUMNS);
    (0..COLUMNS * COLUMNS)
        .map(|k| {
            let (x, y) = (f64::from(k % COLUMNS), f64::from(k / COLUMNS));
            let moved = |a: f64| (f64::from(k) * a).fract();
            let at = [(x + moved(0.754_877_7), 0), (y + moved(0.569_840_3), 1)];
            let [x, y] = at.map(|(v, _)| (v * cell - 0.5 * AREA_M) as f32);
            [x, y, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
        })
        .collect()
}

/// Cirrus of a smaller optical depth cannot be seen (Sassen and Cho 1992).
const LEAST_VISIBLE: f32 = 0.03;

/// Share of columns in which a volume lets less than half of vertical light through, or a sheet is seen.
fn cover(gpu: &Gpu, ready: &Ready, volume: bool) -> f64 {
    let statements = if volume {
        "let band = clouds.bands[0];
        let step_m = (band.top_m - band.base_m) / 64.0;
        for (var k = 0u; k < 64u; k++) {
            let h = band.base_m + (f32(k) + 0.5) * step_m;
            x.x += step_m * band_extinction(band, vec3f(a.xy, h), h, Look(true, 0.0, 0.0)).value;
        }"
    } else {
        "x.x = sheet_optical_depth(clouds.sheets[0], vec3f(a.xy, clouds.sheets[0].height_m), clouds.sheets[0].height_m);"
    };
    let (least, used): (f32, &[u32]) = if volume {
        (std::f32::consts::LN_2, &VOLUME)
    } else {
        (LEAST_VISIBLE, &SHEET)
    };
    let found = evaluate(
        gpu,
        &shader::CLOUD_VIEW_LIGHT,
        statements,
        &columns(),
        &ready.binds(gpu, used),
    );
    let covered = found.iter().filter(|row| row[0] > least).count();
    covered as f64 / found.len() as f64
}

const COVERAGES: [f64; 9] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9];

/// Mean cover over ten seeds at each coverage.
fn table(name: &str, layer: &Value, volume: bool) -> Vec<f64> {
    let engine = engine();
    let gpu = &engine.gpu;
    let mut passes = passes();
    let mut sums = [0.0; COVERAGES.len()];
    let mut squares = [0.0; COVERAGES.len()];
    for seed in 1..=10 {
        for (i, coverage) in COVERAGES.iter().enumerate() {
            let scene = cloudy(json!({"coverage": coverage, "seed": seed, "layers": [layer]}));
            let found = cover(gpu, &Ready::new(gpu, &mut passes, &scene), volume);
            sums[i] += found / 10.0;
            squares[i] += found * found / 10.0;
        }
    }
    for (i, coverage) in COVERAGES.iter().enumerate() {
        let spread = (squares[i] - sums[i] * sums[i]).max(0.0).sqrt();
        println!(
            "{name}: coverage {coverage:.1} covers {:.3} (seeds ± {spread:.3})",
            sums[i]
        );
    }
    sums.to_vec()
}

/// Whether it follows within 0.03 and rises.
fn follows(name: &str, layer: &Value, volume: bool) {
    let found = table(name, layer, volume);
    assert!(
        found.windows(2).all(|pair| pair[0] < pair[1]),
        "{name}: {found:?}"
    );
    for (found, coverage) in found.iter().zip(COVERAGES) {
        // What the product promises.
        assert!((found - coverage).abs() < 0.03, "{name}: {found} for {coverage}");
    }
}

#[test]
fn cumulus_cover_what_they_are_asked_to() {
    follows(
        "fair weather's cumulus",
        &json!({"kind": "volume", "base_m": 1500, "top_m": 4000, "type": 0.8}),
        true,
    );
}

#[test]
fn stratocumulus_cover_what_they_are_asked_to() {
    follows(
        "stratocumulus",
        &json!({"kind": "volume", "base_m": 1000, "top_m": 1700, "type": 0.5}),
        true,
    );
}

#[test]
fn sheets_cover_what_they_are_asked_to() {
    for genus in ["cirrus", "altocumulus", "altostratus"] {
        follows(
            genus,
            &json!({"kind": "sheet", "height_m": 8000, "genus": genus}),
            false,
        );
    }
}
