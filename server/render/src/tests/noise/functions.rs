//! The functions of `lib/noise.wgsl`.

use super::super::{engine, evaluate};
use crate::{
    cpu::noise::{Lattice, curl2, finer, number, perlin2, perlin3, stream_of, turned, worley2, worley3},
    shader,
};
use rand_xoshiro::{
    Xoshiro256PlusPlus,
    rand_core::{RngCore, SeedableRng},
};
use std::collections::BTreeSet;

/// Random places in and a little outside the tile, as f32 has them.
fn places(count: usize) -> Vec<[f32; 3]> {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(5);
    let mut coordinate = || (random.next_u32() >> 8) as f32 / 2_f32.powi(24) * 1.5 - 0.25;
    (0..count)
        .map(|_| std::array::from_fn(|_| coordinate()))
        .collect()
}

fn rows(places: &[[f32; 3]]) -> Vec<[f32; 8]> {
    places
        .iter()
        .map(|[x, y, z]| [*x, *y, *z, 0.0, 0.0, 0.0, 0.0, 0.0])
        .collect()
}

/// WGSL allows a sine 2⁻¹¹ of error. The weights of the corners sum to 1 and their distances stay below √3.
const GRADIENT_NOISE: f64 = 1e-3;
/// A place in 32 cells is known to 2e-6 of a cell, the square root of a small distance to less.
const CELLULAR_NOISE: f64 = 1e-4;

#[test]
fn volumes_are_their_twins() {
    let places = places(2000);
    let engine = engine();
    for frequency in [1_u32, 2, 5, 32] {
        let statement = format!(
            "x = vec4f(perlin3(a.xyz, {frequency}u, 77u), worley3(a.xyz, {frequency}u, 78u),
                perlin3(a.xyz + vec3f(1.0, 0.0, -1.0), {frequency}u, 77u),
                worley3(a.xyz + vec3f(0.0, 1.0, 1.0), {frequency}u, 78u));"
        );
        let found = evaluate(&engine.gpu, &shader::CLOUD_SHAPE, &statement, &rows(&places), &[]);
        for (place, found) in places.iter().zip(found) {
            let at = place.map(f64::from);
            let [perlin, worley] = [perlin3(at, frequency, 77), worley3(at, frequency, 78)];
            // Whole tiles away the noise is the same.
            for (c, expected, allowed) in [
                (0, perlin, GRADIENT_NOISE),
                (1, worley, CELLULAR_NOISE),
                (2, perlin, GRADIENT_NOISE),
                (3, worley, CELLULAR_NOISE),
            ] {
                let off = f64::from(found[c]) - expected;
                assert!(
                    off.abs() < allowed,
                    "{frequency} {place:?}: {found:?}, not {expected}"
                );
            }
        }
    }
}

const LATTICES: [Lattice; 5] = [
    turned([2, 1]),
    turned([9, 4]),
    turned([50, 21]),
    [3, 1, 2, 23],
    [27, 10, -13, 41],
];

#[test]
fn flat_noise_is_its_twin() {
    let places = places(2000);
    let engine = engine();
    for lattice in LATTICES {
        let [a, b, c, d] = lattice;
        let statement = format!(
            "let lattice = vec4i({a}, {b}, {c}, {d});
            x = vec4f(perlin2(a.xy, lattice, 7u), worley2(a.xy, lattice, 8u));
            y = vec4f(perlin2(a.xy + vec2f(-1.0, 1.0), lattice, 7u), worley2(a.xy + vec2f(1.0, 0.0), lattice, 8u));"
        );
        let fineness = lattice.iter().map(|entry| entry.abs()).max().unwrap() as f64;
        let found = evaluate(&engine.gpu, &shader::CLOUD_SHEET, &statement, &rows(&places), &[]);
        for (place, found) in places.iter().zip(found) {
            let at = [f64::from(place[0]), f64::from(place[1])];
            const STEP: f64 = 1e-6;
            let slope = |x: f64, y: f64| {
                let to = |by: f64| perlin2([at[0] + by * x, at[1] + by * y], lattice, 7);
                (to(STEP) - to(-STEP)) / (2.0 * STEP)
            };
            let expected = [
                perlin2(at, lattice, 7),
                slope(1.0, 0.0),
                slope(0.0, 1.0),
                worley2(at, lattice, 8),
            ];
            // Slopes go with the fineness and are up to six times as sensitive as values.
            let slopes = 6.0 * fineness * GRADIENT_NOISE;
            let allowed = [GRADIENT_NOISE, slopes, slopes, CELLULAR_NOISE];
            for (c, value) in found.iter().enumerate() {
                let off = f64::from(*value) - expected[c % 4];
                assert!(
                    off.abs() < allowed[c % 4],
                    "{lattice:?} {place:?}: {found:?}, not {expected:?}"
                );
            }
        }
    }
}

/// The heart of turned lattices: a tile has as many cells as numbers, and its neighbours have the same ones.
#[test]
fn every_cell_of_a_tile_has_a_number_of_its_own() {
    for lattice @ [a, b, c, d] in LATTICES {
        let cells = a * d - b * c;
        let mut numbers = BTreeSet::new();
        let reach = a.abs() + b.abs() + c.abs() + d.abs();
        for x in -reach..=reach {
            for y in -reach..=reach {
                // The cell's corner in the tile: 0 <= M⁻¹ (x, y) < 1.
                let inside = |v: i64| (0..cells).contains(&v);
                if inside(d * x - b * y) && inside(a * y - c * x) {
                    assert!(
                        numbers.insert(number(lattice, [x, y])),
                        "{lattice:?}: ({x}, {y}) is not alone"
                    );
                }
                let same = number(lattice, [x, y]);
                assert_eq!(number(lattice, [x + a, y + c]), same, "{lattice:?}");
                assert_eq!(number(lattice, [x + b, y + d]), same, "{lattice:?}");
            }
        }
        assert_eq!(numbers.len() as i64, cells, "{lattice:?}");
    }
}

/// Whole numbers in brackets after a word of a shader.
fn written<const N: usize>(text: &str, word: &str) -> Vec<[i64; N]> {
    let brackets = text.split(word).skip(1).filter_map(|rest| rest.split(')').next());
    brackets
        .filter_map(|inside| {
            let numbers: Result<Vec<i64>, _> = inside.split(',').map(|n| n.trim().parse()).collect();
            numbers.ok()?.try_into().ok()
        })
        .collect()
}

#[test]
fn every_lattice_in_use_numbers_its_cells() {
    let common = |a: i64, b: i64| (1..=a.abs() + b.abs()).filter(|n| a % n == 0 && b % n == 0).max();
    let (mut octaves, mut lattices) = (0, 0);
    for shader in [&shader::CLOUD_CURL, &shader::CLOUD_WEATHER, &shader::CLOUD_SHEET] {
        for mut z in written::<2>(shader.wgsl, "vec2i(") {
            for _ in 0..6 {
                assert_eq!(common(z[0], z[1]), Some(1), "{}: {z:?}", shader.name);
                z = finer(z);
                octaves += 1;
            }
        }
        for [a, b, c, d] in written::<4>(shader.wgsl, "Lattice(") {
            assert!(
                a * d > b * c && common(b, d) == Some(1),
                "{}: {a} {b} {c} {d}",
                shader.name
            );
            lattices += 1;
        }
    }
    assert!(
        octaves > 60 && lattices > 3,
        "{octaves} octaves, {lattices} lattices"
    );
}

#[test]
fn the_curl_is_its_twin_and_has_no_sources() {
    let places = places(1000);
    let engine = engine();
    // A step across which the flow is nearly straight, far above the rounding of a place.
    const STEP: f32 = 1.0 / 1024.0;
    let statement = format!(
        "let dx = vec2f({STEP}, 0.0);
        let flow = curl2(a.xy, vec2i(3, 4), 3u, 0.25, 9u);
        let along_x = curl2(a.xy + dx, vec2i(3, 4), 3u, 0.25, 9u) - curl2(a.xy - dx, vec2i(3, 4), 3u, 0.25, 9u);
        let along_y = curl2(a.xy + dx.yx, vec2i(3, 4), 3u, 0.25, 9u) - curl2(a.xy - dx.yx, vec2i(3, 4), 3u, 0.25, 9u);
        x = vec4f(flow, 0.0);
        y = vec4f(along_x.x + along_y.y, along_x.x, along_x.y, along_y.x);"
    );
    let found = evaluate(&engine.gpu, &shader::CLOUD_CURL, &statement, &rows(&places), &[]);
    let (mut sources, mut shear) = (0.0, 0.0);
    for (place, found) in places.iter().zip(found) {
        let at = [f64::from(place[0]), f64::from(place[1])];
        let expected = curl2(at, [3, 4], 3, 0.25, 9);
        for c in 0..3 {
            let off = f64::from(found[c]) - expected[c];
            // As in two dimensions, for the sum of the octaves: 5 + 11/4 + 25/16 cells, twice in the last component.
            assert!(off.abs() < 0.1, "{place:?}: {found:?}, not {expected:?}");
        }
        sources += f64::from(found[4]).powi(2);
        shear += found[5..8].iter().map(|v| f64::from(*v).powi(2)).sum::<f64>();
    }
    // A flow of any other kind has as much of the one as of the other. What is left, 2e-3 of it, comes from the step's length.
    assert!(shear > 1.0 && sources < 1e-5 * shear, "{sources} of {shear}");
}

#[test]
fn streams_have_nothing_in_common() {
    let streams: BTreeSet<u32> = (0..64)
        .flat_map(|seed| (0..64).map(move |index| stream_of(seed, index)))
        .collect();
    assert_eq!(streams.len(), 64 * 64);
    let mean = |f: &dyn Fn([f64; 3]) -> f64| {
        let all = places(4000);
        all.iter().map(|p| f(p.map(f64::from))).sum::<f64>() / 4000.0
    };
    let of = |p, stream| perlin3(p, 4, stream);
    let power = mean(&|p| of(p, 1).powi(2));
    // 4000 places in 64 cells: the mean product of unlike fields strays by about 1/√64 of the power.
    for other in [0, 2, 3, 65, 1 << 20, u32::MAX] {
        let product = mean(&|p| of(p, stream_of(1, 0)) * of(p, stream_of(other, 0)));
        assert!(product.abs() < 0.4 * power, "{other}: {product} of {power}");
    }
}
