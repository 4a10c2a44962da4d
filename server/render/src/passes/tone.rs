//! From radiance to the picture.

use crate::{
    kernel::{Bind, Recorder, Variants},
    shader,
    uniforms::{Part, ToneUniform},
};
use welkin_scene::ToneCurve;

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
        curve: ToneCurve,
        settings: &ToneUniform,
        exposure: &wgpu::Buffer,
        radiance: &wgpu::Buffer,
        picture: &wgpu::Buffer,
    ) {
        let code: u8 = match curve {
            ToneCurve::Reinhard => 0,
            ToneCurve::Exponential => 1,
            ToneCurve::Aces => 2,
            ToneCurve::Agx => 3,
        };
        let kernel = self.kernels.get(recorder.gpu, &[("CURVE", f64::from(code))]);
        let uniform = Part::new(settings).upload(recorder.gpu, "tone");
        let binds = [
            Bind::Buffer(&uniform),
            Bind::Buffer(exposure),
            Bind::Buffer(radiance),
            Bind::Buffer(picture),
        ];
        recorder.dispatch(kernel, &binds, [settings.size_px.x, settings.size_px.y, 1]);
    }
}
