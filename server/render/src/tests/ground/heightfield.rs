//! Rays against heightfields: the shader against patches in f64, one after the other.

use super::{RADIUS_M, compare, random, random3, rows};
use crate::{
    cpu::heightfield::Caster,
    ground::{Field, Lift},
    shader,
    tests::{engine, evaluate},
    uniforms::{Part, ground::GroundUniform},
};
use glam::{DVec2, DVec3, USizeVec2};
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};
use wgpu::BufferUsages;

/// Hills of several sizes, spikes and plains.
fn field(size: USizeVec2, extent_m: DVec2, seed: u64) -> Field {
    let mut source = Xoshiro256PlusPlus::seed_from_u64(seed);
    let heights: Vec<f32> = (0..size.x * size.y)
        .map(|i| {
            let (x, y) = ((i % size.x) as f64, (i / size.x) as f64);
            let hills = 0.5 + 0.3 * (x * 0.21).sin() * (y * 0.13).cos() + 0.1 * (x * 0.9 + y * 0.7).sin();
            let spike = if random(&mut source) < 0.02 { 0.3 } else { 0.0 };
            if y > 0.7 * size.y as f64 {
                0.1
            } else {
                (hills + spike) as f32
            }
        })
        .collect();
    let lift = Lift {
        extent_m,
        height_m: 0.06 * extent_m.x,
        base_m: 0.0,
        edge_fade: 0.0,
    };
    Field::new(size, &heights, lift)
}

fn uniform(field: &Field) -> GroundUniform {
    GroundUniform {
        east: glam::Vec3::X,
        north: glam::Vec3::Y,
        up: glam::Vec3::Z,
        radius_m: RADIUS_M as f32,
        highest_m: field.highest_m,
        lowest_m: field.lowest_m,
        bend_per_m: (1.0 / (8.0 * RADIUS_M)) as f32,
        corner_m: (-field.extent_m / 2.0).as_vec2(),
        cell_m: field.cell_m().as_vec2(),
        cells: field.cells.as_uvec2(),
        levels: field.levels,
        ..GroundUniform::default()
    }
}

/// Rays from over the field, from beside it and from far away, towards places on it and over it.
fn rays(field: &Field, count: usize, seed: u64) -> Vec<(DVec3, DVec3)> {
    let mut source = Xoshiro256PlusPlus::seed_from_u64(seed);
    let extent = field.extent_m.extend(f64::from(field.highest_m));
    let mut place = |wide: f64, low: f64, high: f64| {
        let at = random3(&mut source);
        DVec3::new(
            (at.x - 0.5) * wide,
            (at.y - 0.5) * wide,
            low + (high - low) * at.z,
        ) * extent
    };
    (0..count)
        .map(|i| {
            let from = match i % 3 {
                0 => place(0.9, 1.2, 3.0),
                1 => place(3.0, 0.0, 2.0),
                _ => place(100.0, 20.0, 3000.0),
            };
            let to = place(1.0, 0.0, 1.1);
            // As the shader will have it.
            let from = from.as_vec3().as_dvec3();
            // Some straight down, or along an axis.
            let towards = match i % 20 {
                18 => DVec3::NEG_Z,
                19 => DVec3::new(0.0, from.y - to.y, to.z - from.z),
                _ => to - from,
            };
            (from, towards.normalize().as_vec3().as_dvec3())
        })
        .collect()
}

#[test]
fn rays_meet_heightfields_where_patches_in_f64_are() {
    let engine = engine();
    let mut met = 0;
    let mut loose = 0;
    let mut all = 0;
    for (size, extent_m) in [
        (USizeVec2::new(2, 2), DVec2::new(900.0, 900.0)),
        (USizeVec2::new(65, 33), DVec2::new(8e3, 4e3)),
        (USizeVec2::new(300, 301), DVec2::new(4e4, 4e4)),
        (USizeVec2::new(100, 128), DVec2::new(6e5, 6e5)),
    ] {
        let field = field(size, extent_m, 7);
        let caster = Caster {
            field: &field,
            radius_m: RADIUS_M,
        };
        let rays = rays(&field, 1500, 11);
        let gpu = &engine.gpu;
        let ground = Part::new(&uniform(&field)).upload(gpu, "ground");
        let storage = |words: &[f32]| gpu.filled("words", bytemuck::cast_slice(words), BufferUsages::STORAGE);
        let (heights, peaks) = (storage(&field.heights_m), storage(&field.peaks_m));
        let binds = [
            (0, ground.as_entire_binding()),
            (3, heights.as_entire_binding()),
            (4, peaks.as_entire_binding()),
        ];
        let statements = "x.x = cast_heightfield(a.xyz, b.xyz, 0.0, 1e12);";
        let found = evaluate(gpu, &shader::GROUND_SHADOW, statements, &rows(&rays), &binds);
        let found: Vec<_> = found
            .iter()
            .map(|x| Some(f64::from(x[0])).filter(|t| *t >= 0.0))
            .collect();
        let (hits, edges) = compare(&rays, &found, |p, d| caster.cast(p, d));
        met += hits;
        loose += edges;
        all += rays.len();
    }
    // The test would be empty if most rays missed or grazed.
    assert!(
        met > all / 2 && loose < all / 10,
        "{met} met, {loose} grazed of {all}"
    );
}
