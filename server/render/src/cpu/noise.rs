//! Twin of `lib/noise.wgsl`.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "cells are few, and their numbers are not negative"
)]

use std::f64::consts::TAU;

pub(crate) fn hash(x: u32) -> u32 {
    let h = (x ^ x >> 16).wrapping_mul(0x7feb_352d);
    let h = (h ^ h >> 15).wrapping_mul(0x846c_a68b);
    h ^ h >> 16
}

pub(crate) fn stream_of(seed: u32, index: u32) -> u32 {
    let step = 0x9e37_79b9_u32.wrapping_mul(index.wrapping_add(1));
    hash(hash(seed).wrapping_add(step))
}

fn thousandths(h: u32) -> [f64; 3] {
    [h, h >> 10, h >> 20].map(|part| (f64::from(part & 1023) + 0.5) / 1024.0)
}

fn fade(t: f64) -> f64 {
    t * t * t * (t * (6.0 * t - 15.0) + 10.0)
}

fn mix(a: f64, b: f64, share: f64) -> f64 {
    a + share * (b - a)
}

/// The number that a cell of a cubic lattice has in its hash.
fn key(cell: [i64; 3], frequency: u32, stream: u32) -> u32 {
    let side = i64::from(frequency);
    let [x, y, z] = cell.map(|c| c.rem_euclid(side));
    hash(stream.wrapping_add((x + side * (y + side * z)) as u32))
}

/// The corners of a cube or square, each coordinate 0 or 1.
fn corners<const N: usize>() -> impl Iterator<Item = [i64; N]> {
    (0..1_i64 << N).map(|k| std::array::from_fn(|axis| k >> axis & 1))
}

pub(crate) fn perlin3(place: [f64; 3], frequency: u32, stream: u32) -> f64 {
    let p = place.map(|x| x * f64::from(frequency));
    let cell = p.map(|x| x.floor() as i64);
    let mut sum = 0.0;
    for corner in corners::<3>() {
        let h = key(std::array::from_fn(|i| cell[i] + corner[i]), frequency, stream);
        let z = f64::from(h & 0xffff) / 32767.5 - 1.0;
        let turn = f64::from(h >> 16) * TAU / 65536.0;
        let across = (1.0 - z * z).max(0.0).sqrt();
        let gradient = [across * turn.cos(), across * turn.sin(), z];
        let mut weight = 1.0;
        let mut rise = 0.0;
        for i in 0..3 {
            let t = p[i] - p[i].floor();
            weight *= if corner[i] == 1 { fade(t) } else { 1.0 - fade(t) };
            rise += gradient[i] * (t - corner[i] as f64);
        }
        sum += weight * rise;
    }
    sum
}

/// By the two cells to either side, so that the shader's one is put to the test.
pub(crate) fn worley3(place: [f64; 3], frequency: u32, stream: u32) -> f64 {
    let p = place.map(|x| x * f64::from(frequency));
    let mut nearest: f64 = 1.0;
    for k in 0..125 {
        let cell: [i64; 3] = std::array::from_fn(|i| p[i].floor() as i64 + [k % 5, k / 5 % 5, k / 25][i] - 2);
        let point = thousandths(key(cell, frequency, stream));
        let away = (0..3).map(|i| (cell[i] as f64 + point[i] - p[i]).powi(2));
        nearest = nearest.min(away.sum());
    }
    1.0 - nearest.sqrt()
}

/// Rows (a, b) and (c, d) of the matrix from places to cells.
pub(crate) type Lattice = [i64; 4];

pub(crate) const fn turned([x, y]: [i64; 2]) -> Lattice {
    [x, -y, y, x]
}

pub(crate) const fn finer([x, y]: [i64; 2]) -> [i64; 2] {
    [2 * x - y, x + 2 * y]
}

/// The cell's number in its tile.
pub(crate) fn number([a, b, c, d]: Lattice, [x, y]: [i64; 2]) -> u32 {
    (d * x - b * y).rem_euclid(a * d - b * c) as u32
}

fn in_cells(lattice: Lattice, [x, y]: [f64; 2]) -> [f64; 2] {
    let [a, b, c, d] = lattice.map(|entry| entry as f64);
    [a * x + b * y, c * x + d * y]
}

/// The value alone.
pub(crate) fn perlin2(place: [f64; 2], lattice: Lattice, stream: u32) -> f64 {
    let p = in_cells(lattice, place);
    let cell = p.map(|x| x.floor() as i64);
    let t = [p[0] - p[0].floor(), p[1] - p[1].floor()];
    let heights: Vec<f64> = corners::<2>()
        .map(|corner| {
            let at = number(lattice, [cell[0] + corner[0], cell[1] + corner[1]]);
            let turn = f64::from(hash(stream.wrapping_add(at))) * TAU / 4_294_967_296.0;
            turn.cos() * (t[0] - corner[0] as f64) + turn.sin() * (t[1] - corner[1] as f64)
        })
        .collect();
    let near = mix(heights[0], heights[1], fade(t[0]));
    let far = mix(heights[2], heights[3], fade(t[0]));
    mix(near, far, fade(t[1]))
}

pub(crate) fn worley2(place: [f64; 2], lattice: Lattice, stream: u32) -> f64 {
    let p = in_cells(lattice, place);
    let mut nearest: f64 = 1.0;
    for k in 0..25 {
        let cell = [p[0].floor() as i64 + k % 5 - 2, p[1].floor() as i64 + k / 5 - 2];
        let point = thousandths(hash(stream.wrapping_add(number(lattice, cell))));
        let away = (0..2).map(|i| (cell[i] as f64 + point[i] - p[i]).powi(2));
        nearest = nearest.min(away.sum());
    }
    1.0 - nearest.sqrt()
}

pub(crate) fn fbm2(place: [f64; 2], first: [i64; 2], octaves: u32, gain: f64, stream: u32) -> f64 {
    let mut z = first;
    let mut sum = 0.0;
    for k in 0..octaves {
        sum += gain.powi(k as i32) * perlin2(place, turned(z), hash(stream.wrapping_add(k)));
        z = finer(z);
    }
    sum
}

/// By central differences of the potential, where the shader has its derivatives.
pub(crate) fn curl2(place: [f64; 2], first: [i64; 2], octaves: u32, gain: f64, stream: u32) -> [f64; 3] {
    const STEP: f64 = 1e-6;
    let slope = |index: u32, axis: usize| {
        let at = |by: f64| {
            let mut moved = place;
            moved[axis] += by;
            fbm2(moved, first, octaves, gain, stream_of(stream, index))
        };
        (at(STEP) - at(-STEP)) / (2.0 * STEP)
    };
    [slope(2, 1), -slope(2, 0), slope(1, 0) - slope(0, 1)]
}
