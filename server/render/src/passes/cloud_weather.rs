//! Where clouds stand, of what type, and where it rains.

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
struct WeatherUniform {
    seed: u32,
}

/// R coverage, G type, B rain, A a finer coverage, each spread evenly over the map: the share c of its area lies over
/// 1 - c, to 1/256.
pub(crate) fn cloud_weather(seed: u32) -> Recipe {
    Recipe {
        shader: &shader::CLOUD_WEATHER,
        uniform: Part::new(&WeatherUniform { seed }),
        size: [SIDE, SIDE, 1],
        shape: Shape::Flat,
        to_bytes: |texels| interleaved([0, 1, 2, 3].map(|channel| even(texels, channel))),
    }
}
