//! What of a frame is computed in one go, tile by tile: all of it, or the pixels of one pass of its refinement.

use crate::{frame_job::TileBudget, uniforms::TileUniform};
use glam::UVec2;
use welkin_scene::{
    job::Window,
    refinement::{PASSES, STRIDE, first_of},
};

/// Pixels of a frame, evenly apart.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Area {
    first: UVec2,
    stride: u32,
    /// Pixels across and down.
    size: UVec2,
    /// The pass that is done with them, from 1.
    pub(crate) pass: u16,
}

impl Area {
    /// A part of a frame.
    pub(crate) const fn window(window: Window) -> Self {
        Self {
            first: UVec2::new(window.x_px, window.y_px),
            stride: 1,
            size: UVec2::new(window.width_px, window.height_px),
            pass: PASSES,
        }
    }

    /// One after the other; a frame of less than [`STRIDE`] to a side has fewer.
    pub(crate) fn passes(frame: UVec2) -> Vec<Self> {
        let area = |pass| {
            let first = UVec2::from_array(first_of(pass));
            Self {
                first,
                stride: STRIDE,
                size: (frame.saturating_sub(first) + STRIDE - 1) / STRIDE,
                pass,
            }
        };
        let all = (1..=PASSES).map(area);
        all.filter(|area| area.size.min_element() > 0).collect()
    }

    /// The tile that begins `at` a pixel of the area, and where the next begins.
    pub(crate) fn tile(
        self,
        budget: &TileBudget,
        at: UVec2,
        work_per_pixel: u32,
    ) -> (TileUniform, Option<UVec2>) {
        let size_px = budget.next(at, self.size, work_per_pixel);
        let tile = TileUniform {
            origin_px: self.first + self.stride * at,
            size_px,
            stride_px: self.stride,
        };
        let beside = UVec2::new(at.x + size_px.x, at.y);
        let below = UVec2::new(0, at.y + size_px.y);
        let next = if beside.x < self.size.x { beside } else { below };
        (tile, (next.y < self.size.y).then_some(next))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use welkin_scene::refinement::pass_of;

    /// The pass in which each pixel is computed, and that it is in one only.
    fn passes_of(areas: &[Area], frame: UVec2, budget: u32) -> Vec<u16> {
        let mut passes = vec![0; (frame.x * frame.y) as usize];
        for area in areas {
            let mut at = Some(UVec2::ZERO);
            while let Some(begin) = at {
                let tile;
                (tile, at) = area.tile(&TileBudget::of(budget), begin, 1);
                for y in 0..tile.size_px.y {
                    for x in 0..tile.size_px.x {
                        let pixel = tile.origin_px + tile.stride_px * UVec2::new(x, y);
                        let pass = &mut passes[(pixel.y * frame.x + pixel.x) as usize];
                        assert_eq!(*pass, 0, "{pixel} of {frame} a second time");
                        *pass = area.pass;
                    }
                }
            }
        }
        passes
    }

    #[test]
    fn every_pixel_is_computed_once_and_in_its_pass() {
        for (width, height) in [(1, 1), (3, 2), (5, 4), (64, 36), (97, 61), (640, 3)] {
            let frame = UVec2::new(width, height);
            let whole = Window {
                x_px: 0,
                y_px: 0,
                width_px: width,
                height_px: height,
            };
            for budget in [7, 100, 1 << 9, 1 << 18] {
                let pixels = (0..height).flat_map(|y| (0..width).map(move |x| pass_of(x, y)));
                assert_eq!(
                    passes_of(&Area::passes(frame), frame, budget),
                    pixels.collect::<Vec<_>>()
                );
                assert_eq!(
                    passes_of(&[Area::window(whole)], frame, budget),
                    vec![PASSES; (width * height) as usize]
                );
            }
        }
    }
}
