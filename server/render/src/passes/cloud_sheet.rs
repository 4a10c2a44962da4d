//! Thin high clouds.

use crate::{
    cloud_noise::Recipe,
    gpu::Shape,
    shader,
    spread::{even, interleaved},
    uniforms::Part,
};
use encase::ShaderType;

/// Texels to a side.
pub(crate) const SIDE: u32 = 512;

#[derive(ShaderType)]
struct SheetUniform {
    seed: u32,
}

/// R cirrus, G cirrocumulus and altocumulus, B cirrostratus and altostratus, A fine wisps, each spread evenly over the
/// tile: the share c of its area lies over 1 - c, to 1/256. Streaks lie along x.
pub(crate) fn cloud_sheet(seed: u32) -> Recipe {
    Recipe {
        shader: &shader::CLOUD_SHEET,
        uniform: Part::new(&SheetUniform { seed }),
        size: [SIDE, SIDE, 1],
        shape: Shape::Flat,
        to_bytes: |texels| interleaved([0, 1, 2, 3].map(|channel| even(texels, channel))),
    }
}
