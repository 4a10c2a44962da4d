//! Water on a grid: which way it runs, how much comes together, and how it cuts.

use super::mountains::hash;
use std::{cmp::Ordering, collections::BinaryHeap};

/// A grid's rivers; its vectors are kept from step to step.
pub(crate) struct Rivers {
    side: usize,
    spacing_m: f32,
    /// True where water leaves and the ground stays as it is; all edges among them.
    mouths: Vec<bool>,
    /// Of each vertex, the neighbour that its water runs to; itself at the mouths.
    to: Vec<u32>,
    /// Vertices with every one after that which it drains to.
    order: Vec<u32>,
    /// Of each vertex, in grid cells.
    area: Vec<f32>,
    /// The ground with its hollows full of water, a little higher the farther from where they flow over.
    filled: Vec<f32>,
    flood: BinaryHeap<Shore>,
}

/// A vertex whose water level is known, the lowest first.
#[derive(PartialEq)]
struct Shore {
    level: f32,
    vertex: u32,
}

impl Eq for Shore {}

impl Ord for Shore {
    fn cmp(&self, other: &Self) -> Ordering {
        let lower = other.level.total_cmp(&self.level);
        lower.then_with(|| other.vertex.cmp(&self.vertex))
    }
}

impl PartialOrd for Shore {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Grid cells that gather water before it cuts.
const SPRING_CELLS: f32 = 0.0;
/// Share of the difference from its neighbours that creeps away from a place in a step.
const CREEP: f32 = 0.04;
/// Rise of the water's level from cell to cell, so that it runs to where it flows over.
const LEVEL: f32 = 1e-3;

/// The eight neighbours, and how far away they are in grid cells.
const AROUND: [(isize, isize, f32); 8] = [
    (-1, -1, std::f32::consts::SQRT_2),
    (0, -1, 1.0),
    (1, -1, std::f32::consts::SQRT_2),
    (-1, 0, 1.0),
    (1, 0, 1.0),
    (-1, 1, std::f32::consts::SQRT_2),
    (0, 1, 1.0),
    (1, 1, std::f32::consts::SQRT_2),
];

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_possible_wrap,
    reason = "indices of a grid of a few million vertices"
)]
impl Rivers {
    pub(crate) fn new(side: usize, spacing_m: f32, mouths: Vec<bool>) -> Self {
        let count = side * side;
        Self {
            side,
            spacing_m,
            mouths,
            to: vec![0; count],
            order: Vec::with_capacity(count),
            area: vec![1.0; count],
            filled: vec![0.0; count],
            flood: BinaryHeap::new(),
        }
    }

    /// One step of time. `cut` is K Δt, in units in which a lone cell's water cuts back one cell in a time of 1.
    pub(crate) fn step(&mut self, heights: &mut [f32], cut: f32, steepest: f32) {
        self.fill(heights);
        self.find_ways();
        self.sort();
        self.gather();
        for &vertex in &self.order {
            let i = vertex as usize;
            let to = self.to[i] as usize;
            if to == i {
                continue;
            }
            let steps = self.steps_between(i, to);
            // h' = h - KΔt √A (h' - h'_to)/d, solved for h'.
            let pull = cut * (self.area[i] - SPRING_CELLS).max(0.0).sqrt() / steps;
            let settled = (heights[i] + pull * heights[to]) / (1.0 + pull);
            heights[i] = settled.min(heights[to] + steepest * steps * self.spacing_m);
        }
        self.creep(heights);
    }

    /// Water in every hollow up to where it flows over (Barnes, Lehman and Mulla 2014).
    fn fill(&mut self, heights: &[f32]) {
        self.filled.fill(f32::INFINITY);
        for (i, &level) in heights.iter().enumerate() {
            if self.mouths[i] {
                self.filled[i] = level;
                self.flood.push(Shore {
                    level,
                    vertex: i as u32,
                });
            }
        }
        while let Some(Shore { level, vertex }) = self.flood.pop() {
            let i = vertex as usize;
            for (dx, dy, _) in AROUND {
                let (x, y) = ((i % self.side) as isize + dx, (i / self.side) as isize + dy);
                let inside = 0..self.side as isize;
                if !inside.contains(&x) || !inside.contains(&y) {
                    continue;
                }
                let there = y as usize * self.side + x as usize;
                if self.filled[there] == f32::INFINITY {
                    let level = heights[there].max(level + LEVEL);
                    self.filled[there] = level;
                    self.flood.push(Shore {
                        level,
                        vertex: there as u32,
                    });
                }
            }
        }
    }

    /// Soil creeps from crests into hollows.
    fn creep(&mut self, heights: &mut [f32]) {
        self.filled.copy_from_slice(heights);
        for (i, height) in heights.iter_mut().enumerate() {
            if !self.mouths[i] {
                let around = self.filled[i - 1]
                    + self.filled[i + 1]
                    + self.filled[i - self.side]
                    + self.filled[i + self.side];
                *height += CREEP * (0.25 * around - self.filled[i]);
            }
        }
    }

    fn steps_between(&self, a: usize, b: usize) -> f32 {
        let straight = a / self.side == b / self.side || a % self.side == b % self.side;
        if straight { 1.0 } else { std::f32::consts::SQRT_2 }
    }

    /// To the steepest neighbour, with some chance in it: else rivers would keep to eight directions.
    fn find_ways(&mut self) {
        let level = &self.filled;
        for i in 0..level.len() {
            let mut best = (0.0, i);
            if !self.mouths[i] {
                for (k, (dx, dy, steps)) in (0_u32..).zip(AROUND) {
                    let there = (i as isize + dy * self.side as isize + dx) as usize;
                    let chance = 0.6 + 0.8 * (hash(i as u32 * 8 + k) >> 8) as f32 / 16_777_216.0;
                    let fall = chance * (level[i] - level[there]) / steps;
                    if fall > best.0 {
                        best = (fall, there);
                    }
                }
            }
            self.to[i] = best.1 as u32;
        }
    }

    /// Mouths first, then what drains to them, and so on.
    fn sort(&mut self) {
        let count = self.to.len();
        // Where the list of each vertex' donors begins.
        let mut first = vec![0_u32; count + 1];
        for (i, &to) in self.to.iter().enumerate() {
            if to as usize != i {
                first[to as usize + 1] += 1;
            }
        }
        for i in 0..count {
            first[i + 1] += first[i];
        }
        let mut next = first.clone();
        let mut donors = vec![0_u32; first[count] as usize];
        for (i, &to) in self.to.iter().enumerate() {
            if to as usize != i {
                donors[next[to as usize] as usize] = i as u32;
                next[to as usize] += 1;
            }
        }
        self.order.clear();
        self.order
            .extend((0..count as u32).filter(|&i| self.to[i as usize] == i));
        let mut at = 0;
        while at < self.order.len() {
            let i = self.order[at] as usize;
            self.order
                .extend_from_slice(&donors[first[i] as usize..first[i + 1] as usize]);
            at += 1;
        }
    }

    /// Areas from the crests down.
    fn gather(&mut self) {
        self.area.fill(1.0);
        for &vertex in self.order.iter().rev() {
            let i = vertex as usize;
            let to = self.to[i] as usize;
            if to != i {
                self.area[to] += self.area[i];
            }
        }
    }
}
