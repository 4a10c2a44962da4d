//! The flow that bends the lookup of the detail.

use crate::{cloud_noise::Recipe, gpu::Shape, shader, spread::around_the_middle, uniforms::Part};
use encase::ShaderType;

/// Texels to a side.
pub(crate) const SIDE: u32 = 128;

#[derive(ShaderType)]
struct CurlUniform {
    seed: u32,
}

/// R, G, B: 0.5 + v/2 of a flow v without sources, the fastest component of which is 1 (RMS 0.25). A is 0.5.
pub(crate) fn cloud_curl(seed: u32) -> Recipe {
    Recipe {
        shader: &shader::CLOUD_CURL,
        uniform: Part::new(&CurlUniform { seed }),
        size: [SIDE, SIDE, 1],
        shape: Shape::Flat,
        to_bytes: around_the_middle,
    }
}
