//! Optical depth to the top of the air by height and direction.

use super::Table;
use crate::{
    gpu::Gpu,
    kernel::{Bind, Kernel, Recorder},
    memo::{Fingerprint, Memo},
    shader,
    uniforms::{IntegralUniform, Part},
};
use std::sync::Arc;

/// Directions and heights. Bruneton's size with twice the heights: aerosols lie in the lowest rows.
const SIZE: [u32; 2] = [256, 128];

pub(crate) struct Transmittance {
    kernel: Kernel,
    memo: Memo<Table>,
}

impl Transmittance {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self {
            kernel: Kernel::new(gpu, &shader::TRANSMITTANCE),
            memo: Memo::new(8),
        }
    }

    pub(crate) fn run(&mut self, recorder: &mut Recorder<'_>, air: &Part, steps: u32) -> Arc<Table> {
        let made_from = Fingerprint::of(("transmittance", air, steps));
        self.memo.get_or(made_from, || {
            let view = recorder.gpu.table("transmittance", SIZE[0], SIZE[1], 1);
            let air = air.upload(recorder.gpu, "air");
            let integral = Part::new(&IntegralUniform { steps }).upload(recorder.gpu, "integral");
            let binds = [Bind::Buffer(&air), Bind::Buffer(&integral), Bind::Table(&view)];
            recorder.dispatch(&self.kernel, &binds, [SIZE[0], SIZE[1], 1]);
            Table { view, made_from }
        })
    }
}
