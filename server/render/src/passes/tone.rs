//! From radiance to the picture.

use crate::{
    kernel::{Bind, Kernel, Recorder},
    shader,
    uniforms::{Part, ToneUniform},
};
use std::cell::OnceCell;
use welkin_scene::ToneCurve;

/// One variant of the shader for each curve, made when first asked for.
#[derive(Default)]
pub(crate) struct Tone {
    variants: [OnceCell<Kernel>; 4],
}

impl Tone {
    /// Writes one tile of the picture, four bytes a pixel.
    pub(crate) fn run(
        &self,
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
        let kernel = self.variants[usize::from(code)]
            .get_or_init(|| Kernel::variant(recorder.gpu, &shader::TONE, &[("CURVE", f64::from(code))]));
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
