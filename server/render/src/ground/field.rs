//! A heightfield as the shaders read it: vertices from the south-west, and a pyramid of greatest heights over them.

use crate::uniforms::narrow;
use glam::{DVec2, USizeVec2};

/// Heights over a rectangle, and what makes rays find them soon.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    /// Patches between four vertices, to the east and to the north.
    pub(crate) cells: USizeVec2,
    /// From the first to the last vertex.
    pub(crate) extent_m: DVec2,
    /// Rows from the south, each from the west.
    pub(crate) heights_m: Vec<f32>,
    /// `peaks_m` of `lib/heightfield.wgsl`.
    pub(crate) peaks_m: Vec<f32>,
    /// Levels among them; the last is a single node.
    pub(crate) levels: u32,
    pub(crate) lowest_m: f32,
    pub(crate) highest_m: f32,
}

/// Where the heights of a grid lie.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lift {
    pub(crate) extent_m: DVec2,
    /// What a height of 1 is above one of 0.
    pub(crate) height_m: f64,
    pub(crate) base_m: f64,
    /// Share of half a side over which the heights go down to the sphere.
    pub(crate) edge_fade: f64,
}

impl Field {
    /// Of heights from 0 to 1, rows from the north.
    pub(crate) fn new(size: USizeVec2, heights: &[f32], lift: Lift) -> Self {
        let cells = size - 1;
        let mut heights_m = Vec::with_capacity(size.x * size.y);
        for row in (0..size.y).rev() {
            for column in 0..size.x {
                let height = lift.base_m + lift.height_m * f64::from(heights[row * size.x + column]);
                let fading =
                    edge_share(row, cells.y, lift.edge_fade).min(edge_share(column, cells.x, lift.edge_fade));
                heights_m.push(narrow(height * fading));
            }
        }
        let (peaks_m, levels) = pyramid(&heights_m, cells);
        let lowest_m = heights_m.iter().copied().fold(f32::INFINITY, f32::min);
        let highest_m = heights_m.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        Self {
            cells,
            extent_m: lift.extent_m,
            heights_m,
            peaks_m,
            levels,
            lowest_m,
            highest_m,
        }
    }

    pub(crate) fn cell_m(&self) -> DVec2 {
        self.extent_m / self.cells.as_dvec2()
    }
}

/// How much of a height is left at a vertex, rising smoothly from 0 at the edges.
fn edge_share(vertex: usize, cells: usize, fade: f64) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "vertices are few")]
    let inwards = vertex.min(cells - vertex) as f64 / (0.5 * cells as f64);
    if inwards >= fade {
        return 1.0;
    }
    let x = inwards / fade;
    x * x * (3.0 - 2.0 * x)
}

/// Greatest heights of 2×2 patches, of 4×4 and so on, down to one node, and the number of these levels.
fn pyramid(heights_m: &[f32], cells: USizeVec2) -> (Vec<f32>, u32) {
    let width = cells.x + 1;
    let mut peaks = Vec::new();
    let mut count = (cells + 1) / 2;
    for y in 0..count.y {
        for x in 0..count.x {
            let mut peak = f32::NEG_INFINITY;
            for row in 2 * y..=(2 * y + 2).min(cells.y) {
                for column in 2 * x..=(2 * x + 2).min(cells.x) {
                    peak = peak.max(heights_m[row * width + column]);
                }
            }
            peaks.push(peak);
        }
    }
    let (mut first, mut levels) = (0, 1);
    while count != USizeVec2::ONE {
        let next = (count + 1) / 2;
        for y in 0..next.y {
            for x in 0..next.x {
                let mut peak = f32::NEG_INFINITY;
                for row in 2 * y..(2 * y + 2).min(count.y) {
                    for column in 2 * x..(2 * x + 2).min(count.x) {
                        peak = peak.max(peaks[first + row * count.x + column]);
                    }
                }
                peaks.push(peak);
            }
        }
        first += count.x * count.y;
        count = next;
        levels += 1;
    }
    (peaks, levels)
}
