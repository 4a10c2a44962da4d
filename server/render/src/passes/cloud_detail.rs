//! What erodes the edges of clouds: a small volume, repeated often.

use crate::{
    cloud_noise::Recipe,
    gpu::Shape,
    shader,
    spread::{interleaved, stretched},
    uniforms::Part,
};
use encase::ShaderType;

/// Texels to a side.
pub(crate) const SIDE: u32 = 32;

/// Cells of two texels, the least that a sampler can tell apart: this is the finest there is in a cloud.
const FINEST: u32 = SIDE / 2;

#[derive(ShaderType)]
struct DetailUniform {
    seed: u32,
    frequency: u32,
    finest: u32,
}

/// R, G, B: Worley noise of three octaves from one, two and four times `frequency` on (cells to the volume's side, 1 to
/// 16). A: 0.625 R + 0.25 G + 0.125 B. All stretched to 0..1: at a frequency of 2 the means are 0.47, 0.50, 0.49 and 0.47;
/// a tenth lies below 0.23, 0.27, 0.26 and 0.25, nine tenths below 0.71, 0.74, 0.73 and 0.69.
pub(crate) fn cloud_detail(seed: u32, frequency: u32) -> Recipe {
    Recipe {
        shader: &shader::CLOUD_DETAIL,
        uniform: Part::new(&DetailUniform {
            seed,
            frequency,
            finest: FINEST,
        }),
        size: [SIDE; 3],
        shape: Shape::Volume,
        to_bytes: |texels| interleaved([0, 1, 2, 3].map(|channel| stretched(texels, channel))),
    }
}
