//! From radiance to the picture.

use super::Table;
use crate::{
    kernel::{Bind, Recorder, Variants},
    shader,
    uniforms::{Part, ToneUniform},
};
use welkin_scene::ToneCurve;

/// How radiance becomes the picture.
#[derive(Clone, Copy)]
pub(crate) struct ToneInputs<'a> {
    pub(crate) curve: ToneCurve,
    pub(crate) settings: &'a ToneUniform,
    pub(crate) exposure: &'a wgpu::Buffer,
    /// What clouds let through of the disc that glares, in alpha.
    pub(crate) disc_clouds: Option<&'a Table>,
    /// Anything, where there are none.
    pub(crate) any_table: &'a Table,
}

pub(crate) struct Tone {
    /// By curve.
    kernels: Variants,
}

impl Tone {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::TONE),
        }
    }

    /// Writes one tile of the picture, four bytes a pixel.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        inputs: ToneInputs<'_>,
        radiance: &wgpu::Buffer,
        picture: &wgpu::Buffer,
    ) {
        let clouds = f64::from(u8::from(inputs.disc_clouds.is_some()));
        let constants = [("CURVE", curve_code(inputs.curve)), ("CLOUDS", clouds)];
        let kernel = self.kernels.get(recorder.gpu, &constants);
        let uniform = Part::new(inputs.settings).upload(recorder.gpu, "tone");
        let binds = [
            Bind::Buffer(&uniform),
            Bind::Buffer(inputs.exposure),
            Bind::Buffer(radiance),
            Bind::Buffer(picture),
            Bind::Table(&inputs.disc_clouds.unwrap_or(inputs.any_table).view),
            Bind::LinearClamp,
        ];
        let size = inputs.settings.size_px;
        recorder.dispatch(kernel, &binds, [size.x, size.y, 1]);
    }
}

/// As the shaders number it.
pub(crate) const fn curve_code(curve: ToneCurve) -> f64 {
    match curve {
        ToneCurve::Reinhard => 0.0,
        ToneCurve::Exponential => 1.0,
        ToneCurve::Aces => 2.0,
        ToneCurve::Agx => 3.0,
    }
}
