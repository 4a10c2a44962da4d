//! Mountains by seed: ridges of noise that rise, and rivers that cut into them as they rise, until both balance.
//!
//! Erosion is the stream-power law dh/dt = u - K √A dh/dx (Whipple and Tucker 1999) with the area A that drains through a
//! place, solved implicitly from the rivers' mouths upwards (Braun and Willett 2013), which is stable for any time step.
//! Slopes steeper than loose rock allows slide. It runs on ever finer grids, so that great valleys are settled early.

use super::rivers::Rivers;
use crate::uniforms::narrow;
use glam::{DVec2, USizeVec2, Vec2};
use welkin_scene::terrain::Mountains;

/// Vertices along each side of the finest grid, and of the coarsest that water works on; each is twice the one before.
const SIDE: usize = 2048;
const COARSEST: usize = 128;
/// Finest grid on which water works.
const FINEST_WET: usize = 1024;
/// Steps of time on each of them, and how long they are together, in times in which the water of a lone cell cuts back by
/// one cell.
const STEPS: u16 = 10;
const TIME: f32 = 1.0;

/// What is to be made.
#[derive(Clone, Debug)]
pub(crate) struct Range {
    pub(crate) mountains: Mountains,
    pub(crate) extent_m: f64,
    pub(crate) height_m: f64,
    /// The scene's origin from the middle of the field, in the field's axes, metres.
    pub(crate) origin_m: DVec2,
}

impl Range {
    /// Heights from 0 to 1 in rows from the north, and how many.
    pub(crate) fn make(&self) -> (USizeVec2, Vec<f32>) {
        let mut side = COARSEST;
        let mut heights = self.risen(side);
        loop {
            if side <= FINEST_WET && self.mountains.erosion > 0.0 {
                self.erode(side, &mut heights);
            }
            if side == SIDE {
                break;
            }
            heights = doubled(side, &heights);
            side *= 2;
            self.roughen(side, &mut heights);
        }
        let most = heights.iter().copied().fold(1e-3, f32::max);
        let shares = heights.iter().map(|h| (h / most).max(0.0)).collect();
        (USizeVec2::splat(side), shares)
    }

    /// East and north of the field's middle, metres; rows begin in the north.
    fn place(&self, side: usize, index: usize) -> DVec2 {
        #[allow(clippy::cast_precision_loss, reason = "vertices are few")]
        let share = |i: usize| i as f64 / (side - 1) as f64 - 0.5;
        DVec2::new(share(index % side), -share(index / side)) * self.extent_m
    }

    /// How far the ground is free to rise: not at the edges, nor about the scene's origin.
    fn freedom(&self, at: DVec2) -> f64 {
        let inwards = 1.0 - 2.0 * at.abs().max_element() / self.extent_m;
        let inside = smooth(
            0.02,
            0.45,
            inwards * (1.0 + 0.5 * f64::from(self.noise(at, 0.9, 11))),
        );
        let radius = self.mountains.valley_radius_m;
        if radius <= 0.0 {
            return inside;
        }
        // A valley is no circle.
        let away = at.distance(self.origin_m) / radius * (1.0 + 0.5 * f64::from(self.noise(at, 0.5, 12)));
        inside * smooth(0.8, 3.0, away)
    }

    /// Gradient noise from -1 to 1 whose waves are as long as that many ridges are apart.
    fn noise(&self, at: DVec2, ridges: f64, stream: u32) -> f32 {
        let p = at / (ridges * self.mountains.ridge_scale_m);
        gradient_noise(
            p,
            self.mountains.seed.wrapping_mul(0x9e37_79b9).wrapping_add(stream),
        )
    }

    fn warped(&self, at: DVec2) -> DVec2 {
        let by = self.mountains.warp * self.mountains.ridge_scale_m;
        let bend = |ridges: f64, s: u32| {
            DVec2::new(
                self.noise(at, ridges, s).into(),
                self.noise(at, ridges, s + 1).into(),
            )
        };
        at + by * (0.8 * bend(1.3, 21) + 0.3 * bend(0.4, 23))
    }

    /// Ridged multifractal noise (Musgrave 1994), 0 to about 1: finer ridges stand on coarser ones.
    fn ridges(&self, at: DVec2, octaves: u32) -> f32 {
        let (mut sum, mut weight, mut scale, mut share) = (0.0, 1.0, 1.0, 1.0);
        let falling = 0.38 + 0.2 * narrow(self.mountains.roughness);
        let mut all = 0.0;
        for k in 0..octaves {
            let crest = (1.0 - self.noise(at, scale, 31 + k).abs()).powi(2);
            sum += share * weight * crest;
            all += share;
            weight = (crest * 1.6).min(1.0);
            share *= falling;
            scale /= 2.1;
        }
        sum / all
    }

    /// Before any water: metres.
    fn risen(&self, side: usize) -> Vec<f32> {
        (0..side * side)
            .map(|i| {
                let at = self.place(side, i);
                let massif = 0.62 + 0.38 * self.noise(at, 2.7, 41) + 0.16 * self.noise(at, 0.6, 42);
                let shape = self.ridges(self.warped(at), 5);
                narrow(self.height_m * self.freedom(at)) * massif * (0.15 + 0.85 * shape)
            })
            .collect()
    }

    /// Lets rivers work for some time.
    fn erode(&self, side: usize, heights: &mut [f32]) {
        #[allow(clippy::cast_precision_loss, reason = "vertices are few")]
        let spacing_m = narrow(self.extent_m / (side - 1) as f64);
        let mouths = (0..side * side)
            .map(|i| self.freedom(self.place(side, i)) <= 0.0)
            .collect();
        let mut rivers = Rivers::new(side, spacing_m, mouths);
        let steepest = 0.9 + 0.5 * narrow(self.mountains.roughness);
        for _ in 0..STEPS {
            rivers.step(
                heights,
                TIME * narrow(self.mountains.erosion) / f32::from(STEPS),
                steepest,
            );
        }
    }

    /// Finer shapes than the grid before could hold, where the ground is not level.
    fn roughen(&self, side: usize, heights: &mut [f32]) {
        #[allow(clippy::cast_precision_loss, reason = "vertices are few")]
        let spacing_m = self.extent_m / (side - 1) as f64;
        let waves = 5.0 * spacing_m / self.mountains.ridge_scale_m;
        let before = heights.to_vec();
        let amount = narrow(spacing_m * (0.02 + 0.16 * self.mountains.roughness));
        for y in 1..side - 1 {
            for x in 1..side - 1 {
                let i = y * side + x;
                let rise = Vec2::new(before[i + 1] - before[i - 1], before[i + side] - before[i - side])
                    / narrow(2.0 * spacing_m);
                let steep = (rise.length() * 1.5).min(1.0).powi(2);
                let at = self.place(side, i);
                let crest = 1.0 - 2.0 * self.noise(at, waves, 61).abs();
                heights[i] += amount * steep * crest;
            }
        }
    }
}

/// A grid of twice the side: cubic between the vertices (Catmull and Rom 1974).
fn doubled(side: usize, heights: &[f32]) -> Vec<f32> {
    let twice = 2 * side;
    #[allow(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "vertices are few and their numbers not negative"
    )]
    let taps: Vec<([usize; 4], [f32; 4])> = (0..twice)
        .map(|i| {
            let x = i as f32 * (side - 1) as f32 / (twice - 1) as f32;
            let at = x as usize;
            let t = x - at as f32;
            let place = |k: usize| (at + k).saturating_sub(1).min(side - 1);
            let (t2, t3) = (t * t, t * t * t);
            let weights = [
                -0.5 * t + t2 - 0.5 * t3,
                1.0 - 2.5 * t2 + 1.5 * t3,
                0.5 * t + 2.0 * t2 - 1.5 * t3,
                -0.5 * t2 + 0.5 * t3,
            ];
            ([0, 1, 2, 3].map(place), weights)
        })
        .collect();
    let mut wide = vec![0.0; twice * side];
    for (row, to) in heights.chunks_exact(side).zip(wide.chunks_exact_mut(twice)) {
        for (to, (places, weights)) in to.iter_mut().zip(&taps) {
            *to = (0..4).map(|k| weights[k] * row[places[k]]).sum();
        }
    }
    let mut both = vec![0.0; twice * twice];
    for (to, (places, weights)) in both.chunks_exact_mut(twice).zip(&taps) {
        for (x, to) in to.iter_mut().enumerate() {
            *to = (0..4).map(|k| weights[k] * wide[places[k] * twice + x]).sum();
        }
    }
    both
}

fn smooth(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

pub(super) fn hash(x: u32) -> u32 {
    let h = (x ^ x >> 16).wrapping_mul(0x7feb_352d);
    let h = (h ^ h >> 15).wrapping_mul(0x846c_a68b);
    h ^ h >> 16
}

/// Perlin's noise (2002) without a period: about -1 to 1.
fn gradient_noise(p: DVec2, stream: u32) -> f32 {
    let floor = p.floor();
    let part = (p - floor).as_vec2();
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "cells of one field are few; their numbers may wrap"
    )]
    let (x, y) = (floor.x as i32 as u32, floor.y as i32 as u32);
    let fade = part * part * part * (part * (6.0 * part - 15.0) + 10.0);
    let corner = |dx: u32, dy: u32| {
        let h = hash(hash(x.wrapping_add(dx).wrapping_add(stream)).wrapping_add(y.wrapping_add(dy)));
        #[allow(clippy::cast_precision_loss, reason = "an angle")]
        let (sin, cos) = ((h >> 8) as f32 * (std::f32::consts::TAU / 16_777_216.0)).sin_cos();
        #[allow(clippy::cast_precision_loss, reason = "0 or 1")]
        let away = part - Vec2::new(dx as f32, dy as f32);
        Vec2::new(cos, sin).dot(away)
    };
    let south = corner(0, 0) + fade.x * (corner(1, 0) - corner(0, 0));
    let north = corner(0, 1) + fade.x * (corner(1, 1) - corner(0, 1));
    1.5 * (south + fade.y * (north - south))
}
