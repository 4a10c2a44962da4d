//! The clouds at exact directions.

use super::{ground_light::LitGround, shafts::LOST_BYTES};
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
        ground: Option<&LitGround>,
    ) -> wgpu::Buffer {
        let gpu = recorder.gpu;
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let answers = gpu.buffer("clouds seen", 16 * u64::from(count), usage);
        let nothing = gpu.buffer("unused", LOST_BYTES, wgpu::BufferUsages::STORAGE);
        let lost = ground.and_then(|ground| ground.lost.as_ref());
        let parts = scape.upload(gpu);
        let mut binds = scape.binds(&parts);
        binds.extend([
            Bind::Buffer(directions),
            Bind::Buffer(&parts.observer),
            Bind::Buffer(&answers),
            Bind::Buffer(ground.map_or(&nothing, |ground| &ground.light)),
            Bind::Buffer(lost.unwrap_or(&nothing)),
        ]);
        let mut constants = scape.light_constants().to_vec();
        constants.extend([
            ("GROUND", f64::from(u8::from(ground.is_some()))),
            ("SHAFTS", f64::from(u8::from(lost.is_some()))),
        ]);
        let kernel = self.kernels.get(gpu, &constants);
        recorder.dispatch(kernel, &binds, [count, 1, 1]);
        answers
    }
}
