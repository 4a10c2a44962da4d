//! The shapes of clouds: a volume that their march samples.

use crate::{
    cloud_noise::Recipe,
    gpu::Shape,
    shader,
    spread::{even, interleaved, stretched},
    uniforms::Part,
};
use encase::ShaderType;

/// Texels to a side.
pub(crate) const SIDE: u32 = 128;

/// Cells of four texels: smaller ones would flicker from texel to texel.
const FINEST: u32 = SIDE / 4;

/// Cells to the volume's side, 1 to 32.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ShapeFrequencies {
    pub(crate) perlin: u32,
    pub(crate) worley: u32,
}

#[derive(ShaderType)]
struct ShapeUniform {
    seed: u32,
    perlin_frequency: u32,
    worley_frequency: u32,
    finest: u32,
}

/// R: Perlin-Worley noise, spread evenly: of the volume, the share c lies over 1 - c.
///
/// G, B, A: Worley noise of three octaves, from one, two and four times the frequency on, high in the middle of billows.
/// Each is stretched to 0..1: at frequencies of 4 the means are 0.50, 0.49 and 0.50; a tenth lies below 0.26, 0.26 and
/// 0.27, half below 0.50, 0.49 and 0.49, nine tenths below 0.74, 0.73 and 0.73.
pub(crate) fn cloud_shape(seed: u32, frequencies: ShapeFrequencies) -> Recipe {
    Recipe {
        shader: &shader::CLOUD_SHAPE,
        uniform: Part::new(&ShapeUniform {
            seed,
            perlin_frequency: frequencies.perlin,
            worley_frequency: frequencies.worley,
            finest: FINEST,
        }),
        size: [SIDE; 3],
        shape: Shape::Volume,
        to_bytes: |texels| {
            interleaved([
                even(texels, 0),
                stretched(texels, 1),
                stretched(texels, 2),
                stretched(texels, 3),
            ])
        },
    }
}
