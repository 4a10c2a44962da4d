//! One frame, tile by tile.

use crate::{
    area::Area,
    engine::Engine,
    error::Error,
    prepared::Prepared,
    silhouettes::{APRON_PX, smooth},
    sunlight::Direct,
    uniforms::TileUniform,
};
use glam::UVec2;
use std::{collections::VecDeque, ops::Range, sync::Arc, time::Instant};
use welkin_scene::{
    Quality, Scene,
    job::Window,
    renderer::{Frame, FrameFacts, FrameOrder, OnPass, Output, PassTime, Pixels, Refined},
};

#[cfg(test)]
mod tests;

/// How much work a tile may be, so that no dispatch holds the device for long. Follows the device's speed.
#[derive(Debug)]
pub(crate) struct TileBudget {
    /// In pixels that read tables; those that follow rays of their own count for several.
    pixels: u32,
}

/// A tile should take about this long, milliseconds.
const TILE_MS: Range<f64> = 8.0..30.0;
/// Sizes between which the budget moves, pixels. The largest keeps 24 MiB of radiance on the device.
const TILE_PIXELS: std::ops::RangeInclusive<u32> = 1 << 13..=3 << 18;

/// Pixels of a row or a column that a pass may compute together.
pub(crate) const RUN: u32 = 8;

/// Fewer would leave a device's lanes idle.
const LEAST_PIXELS: u32 = 64;

/// A frame of no more tiles is not refined in passes: it takes a sixth of a second at most.
const QUICK_TILES: u64 = 5;

impl Default for TileBudget {
    fn default() -> Self {
        Self { pixels: 1 << 18 }
    }
}

impl TileBudget {
    #[cfg(test)]
    pub(crate) const fn of(pixels: u32) -> Self {
        Self { pixels }
    }

    fn learn(&mut self, tile_px: UVec2, work_per_pixel: u32, ms: f64) {
        // A tile that the frame's edge cut short says nothing of larger ones.
        let full = tile_px.x * tile_px.y > self.pixels / work_per_pixel / 2;
        if ms > TILE_MS.end {
            self.pixels = (self.pixels / 2).max(*TILE_PIXELS.start());
        } else if ms < TILE_MS.start && full {
            self.pixels = (self.pixels * 2).min(*TILE_PIXELS.end());
        }
    }

    fn is_quick(&self, frame: UVec2, work_per_pixel: u32) -> bool {
        let work = u64::from(frame.x) * u64::from(frame.y) * u64::from(work_per_pixel);
        work <= QUICK_TILES * u64::from(self.pixels)
    }

    /// Pixels across and down of the next tile of an area: as wide as fits, then as high.
    pub(crate) fn next(&self, from: UVec2, area: UVec2, work_per_pixel: u32) -> UVec2 {
        let pixels = (self.pixels / work_per_pixel).max(LEAST_PIXELS.min(self.pixels));
        // Pixels that share a thread share it in every tile, or the tile would show.
        let whole_runs = if pixels < RUN {
            pixels
        } else {
            pixels - pixels % RUN
        };
        let width = (area.x - from.x).min(whole_runs);
        let height = if width == area.x {
            let rows = pixels / width;
            let whole_runs = if rows < RUN { rows } else { rows - rows % RUN };
            whole_runs.clamp(1, area.y - from.y)
        } else {
            1
        };
        UVec2::new(width, height)
    }
}

/// A frame on its way.
pub(crate) struct FrameJob {
    order: FrameOrder,
    /// The part of the frame that was asked for.
    window: Window,
    /// Told of each pass but the last, where the frame is to be refined.
    seen: Option<OnPass>,
    prepared: Option<Prepared>,
    /// What is still to be computed.
    areas: VecDeque<Area>,
    /// Where the next tile begins in the first of them.
    at: UVec2,
    pixels: Pixels,
    /// The part of the frame that is drawn: what was asked for, and as much about it as its silhouettes need.
    drawn: Window,
    /// How far away what stands on the ground is before each pixel; empty where silhouettes are not smoothed.
    ways_m: Vec<f32>,
    passes: Vec<PassTime>,
    ev100: Option<f64>,
}

impl FrameJob {
    pub(crate) fn new(order: FrameOrder, seen: Option<OnPass>) -> Self {
        let window = whole(&order);
        Self::windowed(order, window, seen)
    }

    /// A part of a frame: the same pixels as the whole frame has there.
    pub(crate) fn windowed(order: FrameOrder, window: Window, seen: Option<OnPass>) -> Self {
        // The pixels get their memory with the first work: orders that wait hold none.
        let pixels = Pixels::Display(Vec::new());
        Self {
            order,
            window,
            seen,
            prepared: None,
            areas: VecDeque::new(),
            at: UVec2::ZERO,
            pixels,
            drawn: window,
            ways_m: Vec::new(),
            passes: Vec::new(),
            ev100: None,
        }
    }

    /// True where all of the frame was asked for.
    pub(crate) fn is_whole(&self) -> bool {
        self.window == whole(&self.order)
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
            *self = Self::windowed(self.order.clone(), self.window, self.seen.take());
        }
        let size = UVec2::new(self.drawn.width_px, self.drawn.height_px);
        let (Some(prepared), Some(area)) = (&self.prepared, self.areas.front().copied()) else {
            let (prepared, times) = engine.prepare(&self.order)?;
            add_times(&mut self.passes, times);
            let in_passes = self.seen.is_some()
                && self.is_whole()
                && self.order.quality == Quality::Final
                && !budget.is_quick(size, prepared.work_per_pixel());
            let smooth = prepared.has_silhouettes();
            if smooth {
                self.drawn = with_apron(self.window, &self.order);
            }
            self.areas = if in_passes {
                Area::passes(size).into()
            } else {
                VecDeque::from([Area::window(self.drawn)])
            };
            self.prepared = Some(prepared);
            let drawn = self.drawn.width_px as usize * self.drawn.height_px as usize;
            self.ways_m = vec![-1.0; if smooth { drawn } else { 0 }];
            let values = 3 * drawn;
            self.pixels = match self.order.output {
                Output::Display => Pixels::Display(vec![0; values]),
                Output::Linear => Pixels::Linear(vec![0.0; values]),
            };
            return Ok(None);
        };
        let work = prepared.work_per_pixel();
        let (tile, next) = area.tile(budget, self.at, work);
        let (pixels, ways_m) = (&mut self.pixels, &mut self.ways_m);
        let corner = UVec2::new(self.drawn.x_px, self.drawn.y_px);
        let placed = TileUniform {
            origin_px: tile.origin_px - corner,
            ..tile
        };
        let begun = Instant::now();
        let ((), ev100, times) = engine.tile(&self.order, prepared, tile, |bytes| {
            place(pixels, size, placed, bytes.pixels);
            if let Some(ground) = bytes.ground {
                place_ways(ways_m, size, placed, bytemuck::cast_slice(ground));
            }
        })?;
        budget.learn(tile.size_px, work, begun.elapsed().as_secs_f64() * 1e3);
        add_times(&mut self.passes, times);
        self.ev100 = ev100;
        self.at = next.unwrap_or_default();
        if next.is_some() {
            return Ok(None);
        }
        self.areas.pop_front();
        let facts = facts(&self.order.scene, &prepared.direct, self.ev100);
        let frame = |pixels, passes| {
            Arc::new(Frame {
                width_px: self.window.width_px,
                height_px: self.window.height_px,
                pixels,
                passes,
                facts,
            })
        };
        if self.areas.is_empty() {
            let mut pixels = std::mem::replace(&mut self.pixels, Pixels::Display(Vec::new()));
            if !self.ways_m.is_empty() {
                smooth(&mut pixels, &self.ways_m, size);
                pixels = cut(pixels, size, corner, self.window);
            }
            return Ok(Some(frame(pixels, std::mem::take(&mut self.passes))));
        }
        if let Some(seen) = &self.seen {
            seen(Refined {
                pass: area.pass,
                frame: frame(self.pixels.clone(), self.passes.clone()),
            });
        }
        Ok(None)
    }
}

/// What must be drawn so that a window's silhouettes are those of the whole frame.
fn with_apron(window: Window, order: &FrameOrder) -> Window {
    let side = |first: u32, length: u32, whole: u32| {
        let begin = first.saturating_sub(APRON_PX);
        (begin, (first + length + APRON_PX).min(whole) - begin)
    };
    let (x_px, width_px) = side(window.x_px, window.width_px, order.width_px);
    let (y_px, height_px) = side(window.y_px, window.height_px, order.height_px);
    Window {
        x_px,
        y_px,
        width_px,
        height_px,
    }
}

/// A window's pixels of those drawn from a corner on.
fn cut(drawn: Pixels, size: UVec2, corner: UVec2, window: Window) -> Pixels {
    if size == UVec2::new(window.width_px, window.height_px) {
        return drawn;
    }
    fn rows<T: Copy>(values: &[T], width: u32, first: UVec2, window: Window) -> Vec<T> {
        let (skip, length) = (3 * first.x as usize, 3 * window.width_px as usize);
        values
            .chunks_exact(3 * width as usize)
            .skip(first.y as usize)
            .take(window.height_px as usize)
            .flat_map(|row| row[skip..skip + length].iter().copied())
            .collect()
    }
    let first = UVec2::new(window.x_px, window.y_px) - corner;
    match drawn {
        Pixels::Display(values) => Pixels::Display(rows(&values, size.x, first, window)),
        Pixels::Linear(values) => Pixels::Linear(rows(&values, size.x, first, window)),
    }
}

fn whole(order: &FrameOrder) -> Window {
    Window {
        x_px: 0,
        y_px: 0,
        width_px: order.width_px,
        height_px: order.height_px,
    }
}

/// Copies a tile of four values a pixel into the frame of three.
fn place(pixels: &mut Pixels, frame: UVec2, tile: TileUniform, bytes: &[u8]) {
    match pixels {
        Pixels::Display(values) => place_values(values, frame, tile, bytes),
        Pixels::Linear(values) => place_values(values, frame, tile, bytemuck::cast_slice(bytes)),
    }
}

fn place_values<T: Copy>(values: &mut [T], frame: UVec2, tile: TileUniform, from: &[T]) {
    let (width, stride) = (tile.size_px.x as usize, tile.stride_px as usize);
    for (row, from) in from.chunks_exact(4 * width).enumerate() {
        let y = tile.origin_px.y as usize + stride * row;
        let first = 3 * (y * frame.x as usize + tile.origin_px.x as usize);
        let to = values[first..].chunks_mut(3).step_by(stride);
        for (to, from) in to.zip(from.chunks_exact(4)) {
            to.copy_from_slice(&from[..3]);
        }
    }
}

/// The last of each four values is the way.
fn place_ways(ways_m: &mut [f32], frame: UVec2, tile: TileUniform, from: &[f32]) {
    let (width, stride) = (tile.size_px.x as usize, tile.stride_px as usize);
    for (row, from) in from.chunks_exact(4 * width).enumerate() {
        let y = tile.origin_px.y as usize + stride * row;
        let first = y * frame.x as usize + tile.origin_px.x as usize;
        let to = ways_m[first..].iter_mut().step_by(stride);
        for (to, from) in to.zip(from.chunks_exact(4)) {
            *to = from[3];
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

/// What a frame says of itself.
fn facts(scene: &Scene, direct: &Direct, ev100: Option<f64>) -> FrameFacts {
    FrameFacts {
        sun: scene.sun_place(),
        sun_irradiance_w_m2: direct.sun,
        moon: scene.moon_place(),
        moon_irradiance_w_m2: direct.moon,
        ev100,
    }
}
