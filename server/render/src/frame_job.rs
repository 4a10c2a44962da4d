//! One frame, tile by tile.

use crate::{
    engine::{Engine, facts},
    error::Error,
    prepared::Prepared,
    uniforms::TileUniform,
};
use glam::UVec2;
use std::{sync::Arc, time::Instant};
use welkin_scene::renderer::{Frame, FrameOrder, Output, PassTime, Pixels};

#[cfg(test)]
mod tests;

/// How much work a tile may be, so that no dispatch holds the device for long. Follows the device's speed.
#[derive(Debug)]
pub(crate) struct TileBudget {
    /// In pixels that read tables; those that follow rays of their own count for several.
    pixels: u32,
}

/// A tile should take about this long, milliseconds.
const TILE_MS: std::ops::Range<f64> = 8.0..30.0;
/// Sizes between which the budget moves, pixels. The largest keeps 24 MiB of radiance on the device.
const TILE_PIXELS: std::ops::RangeInclusive<u32> = 1 << 13..=3 << 18;

/// Pixels of a row or a column that a pass may compute together.
pub(crate) const RUN: u32 = 8;

/// Fewer would leave a device's lanes idle.
const LEAST_PIXELS: u32 = 64;

impl Default for TileBudget {
    fn default() -> Self {
        Self { pixels: 1 << 18 }
    }
}

impl TileBudget {
    fn learn(&mut self, tile: TileUniform, work_per_pixel: u32, ms: f64) {
        // A tile that the frame's edge cut short says nothing of larger ones.
        let full = tile.size_px.x * tile.size_px.y > self.pixels / work_per_pixel / 2;
        if ms > TILE_MS.end {
            self.pixels = (self.pixels / 2).max(*TILE_PIXELS.start());
        } else if ms < TILE_MS.start && full {
            self.pixels = (self.pixels * 2).min(*TILE_PIXELS.end());
        }
    }

    /// The next tile: as wide as fits, then as high.
    fn next(&self, from: UVec2, frame: UVec2, work_per_pixel: u32) -> TileUniform {
        let pixels = (self.pixels / work_per_pixel).max(LEAST_PIXELS.min(self.pixels));
        // Pixels that share a thread share it in every tile, or the tile would show.
        let whole_runs = if pixels < RUN {
            pixels
        } else {
            pixels - pixels % RUN
        };
        let width = (frame.x - from.x).min(whole_runs);
        let height = if width == frame.x {
            let rows = pixels / width;
            let whole_runs = if rows < RUN { rows } else { rows - rows % RUN };
            whole_runs.clamp(1, frame.y - from.y)
        } else {
            1
        };
        TileUniform {
            origin_px: from,
            size_px: UVec2::new(width, height),
        }
    }
}

/// A frame on its way.
pub(crate) struct FrameJob {
    order: FrameOrder,
    prepared: Option<Prepared>,
    /// Where the next tile begins.
    at: UVec2,
    pixels: Pixels,
    passes: Vec<PassTime>,
    ev100: Option<f64>,
}

impl FrameJob {
    pub(crate) fn new(order: FrameOrder) -> Self {
        // The pixels get their memory with the first work: orders that wait hold none.
        let pixels = Pixels::Display(Vec::new());
        Self {
            order,
            prepared: None,
            at: UVec2::ZERO,
            pixels,
            passes: Vec::new(),
            ev100: None,
        }
    }

    pub(crate) const fn order(&self) -> &FrameOrder {
        &self.order
    }

    /// Does the next piece of work: the tables, or one tile. The frame, once it is whole.
    pub(crate) fn step(
        &mut self,
        engine: &mut Engine,
        budget: &mut TileBudget,
    ) -> Result<Option<Arc<Frame>>, Error> {
        if self
            .prepared
            .as_ref()
            .is_some_and(|p| p.generation != engine.generation)
        {
            // The device that held the tables is gone.
            *self = Self::new(self.order.clone());
        }
        let Some(prepared) = &self.prepared else {
            let (prepared, times) = engine.prepare(&self.order)?;
            add_times(&mut self.passes, times);
            self.prepared = Some(prepared);
            let values = 3 * self.order.width_px as usize * self.order.height_px as usize;
            self.pixels = match self.order.output {
                Output::Display => Pixels::Display(vec![0; values]),
                Output::Linear => Pixels::Linear(vec![0.0; values]),
            };
            return Ok(None);
        };
        let size = UVec2::new(self.order.width_px, self.order.height_px);
        let tile = budget.next(self.at, size, prepared.work_per_pixel());
        let pixels = &mut self.pixels;
        let begun = Instant::now();
        let ((), ev100, times) = engine.tile(&self.order, prepared, tile, |bytes| {
            place(pixels, size, tile, bytes)
        })?;
        budget.learn(
            tile,
            prepared.work_per_pixel(),
            begun.elapsed().as_secs_f64() * 1e3,
        );
        add_times(&mut self.passes, times);
        self.ev100 = ev100;
        self.at.x += tile.size_px.x;
        if self.at.x == size.x {
            self.at = UVec2::new(0, self.at.y + tile.size_px.y);
        }
        if self.at.y < size.y {
            return Ok(None);
        }
        let empty = Pixels::Display(Vec::new());
        Ok(Some(Arc::new(Frame {
            width_px: size.x,
            height_px: size.y,
            pixels: std::mem::replace(&mut self.pixels, empty),
            passes: std::mem::take(&mut self.passes),
            facts: facts(&self.order.scene, &prepared.direct, self.ev100),
        })))
    }
}

/// Copies a tile of four values a pixel into the frame of three.
fn place(pixels: &mut Pixels, frame: UVec2, tile: TileUniform, bytes: &[u8]) {
    let width = tile.size_px.x as usize;
    for row in 0..tile.size_px.y as usize {
        let to = 3 * ((tile.origin_px.y as usize + row) * frame.x as usize + tile.origin_px.x as usize);
        let to = to..to + 3 * width;
        match pixels {
            Pixels::Display(values) => {
                let from = &bytes[4 * row * width..4 * (row + 1) * width];
                for (to, from) in values[to].chunks_exact_mut(3).zip(from.chunks_exact(4)) {
                    to.copy_from_slice(&from[..3]);
                }
            }
            Pixels::Linear(values) => {
                let from: &[f32] = bytemuck::cast_slice(&bytes[16 * row * width..16 * (row + 1) * width]);
                for (to, from) in values[to].chunks_exact_mut(3).zip(from.chunks_exact(4)) {
                    to.copy_from_slice(&from[..3]);
                }
            }
        }
    }
}

fn add_times(all: &mut Vec<PassTime>, more: Vec<PassTime>) {
    for time in more {
        match all.iter_mut().find(|t| t.pass == time.pass) {
            Some(known) => known.ms += time.ms,
            None => all.push(time),
        }
    }
}
