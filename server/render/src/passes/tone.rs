//! From radiance to the picture.

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
        let constants = [("CURVE", curve_code(inputs.curve))];
        let kernel = self.kernels.get(recorder.gpu, &constants);
        let uniform = Part::new(inputs.settings).upload(recorder.gpu, "tone");
        let binds = [
            Bind::Buffer(&uniform),
            Bind::Buffer(inputs.exposure),
            Bind::Buffer(radiance),
            Bind::Buffer(picture),
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
