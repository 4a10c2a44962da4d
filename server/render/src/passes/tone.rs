//! From radiance to the picture.

use crate::{
    gpu::Gpu,
    kernel::{Bind, Kernel, Recorder},
    shader,
    uniforms::{Part, ToneUniform},
};

pub(crate) struct Tone {
    kernel: Kernel,
}

impl Tone {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self {
            kernel: Kernel::new(gpu, &shader::TONE),
        }
    }

    /// Writes one tile of the picture, four bytes a pixel.
    pub(crate) fn run(
        &self,
        recorder: &mut Recorder<'_>,
        settings: &ToneUniform,
        exposure: &wgpu::Buffer,
        camera: &Part,
        radiance: &wgpu::Buffer,
        picture: &wgpu::Buffer,
    ) {
        let uniform = Part::new(settings).upload(recorder.gpu, "tone");
        let camera = camera.upload(recorder.gpu, "camera");
        let binds = [
            Bind::Buffer(&uniform),
            Bind::Buffer(exposure),
            Bind::Buffer(&camera),
            Bind::Buffer(radiance),
            Bind::Buffer(picture),
        ];
        recorder.dispatch(&self.kernel, &binds, [settings.size_px.x, settings.size_px.y, 1]);
    }
}
