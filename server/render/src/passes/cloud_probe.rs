//! The clouds at exact directions.

use crate::{
    cloudscape::Cloudscape,
    kernel::{Bind, Recorder, Variants},
    shader,
};

pub(crate) struct CloudProbe {
    kernels: Variants,
}

impl CloudProbe {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::CLOUD_PROBE),
        }
    }

    /// Four floats a direction: what to add in R, G and B, and what comes through. Nothing is looked for behind what stands
    /// on the ground.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Cloudscape,
        directions: &wgpu::Buffer,
        count: u32,
        lit_ground: Option<&wgpu::Buffer>,
    ) -> wgpu::Buffer {
        let gpu = recorder.gpu;
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let answers = gpu.buffer("clouds seen", 16 * u64::from(count), usage);
        let nothing = gpu.buffer("unused", 16, wgpu::BufferUsages::STORAGE);
        let parts = scape.upload(gpu);
        let mut binds = scape.binds(&parts);
        binds.extend([
            Bind::Buffer(directions),
            Bind::Buffer(&parts.observer),
            Bind::Buffer(&answers),
            Bind::Buffer(lit_ground.unwrap_or(&nothing)),
        ]);
        let ground = ("GROUND", f64::from(u8::from(lit_ground.is_some())));
        let [layers, shaded] = scape.light_constants();
        let kernel = self.kernels.get(gpu, &[layers, shaded, ground]);
        recorder.dispatch(kernel, &binds, [count, 1, 1]);
        answers
    }
}
