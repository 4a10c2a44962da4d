//! Light in the air in every direction from one height.

use super::Table;
use crate::{
    gpu::Gpu,
    kernel::{Bind, Kernel, Recorder},
    memo::{Fingerprint, Memo},
    shader,
    uniforms::{Part, Standpoint},
};
use std::sync::Arc;
use welkin_scene::Quality;

pub(crate) struct SkyView {
    kernel: Kernel,
    memo: Memo<Table>,
}

/// Azimuths over half the sky, rows (half below the horizon, half above), and steps along each ray.
const fn size(quality: Quality) -> ([u32; 2], u32) {
    match quality {
        Quality::Preview => ([32, 128], 32),
        Quality::Final => ([48, 224], 48),
    }
}

impl SkyView {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self {
            kernel: Kernel::new(gpu, &shader::SKY_VIEW),
            memo: Memo::new(16),
        }
    }

    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        air: &Part,
        stand: &Standpoint,
        tables: (&Table, &Table),
        quality: Quality,
    ) -> Arc<Table> {
        let (transmittance, multi_scattering) = tables;
        let ([width, height], steps) = size(quality);
        let observer = Part::new(&stand.observer(steps));
        let reads = (transmittance.made_from, multi_scattering.made_from);
        let made_from = Fingerprint::of(("sky_view", air, &observer, reads, quality));
        self.memo.get_or(made_from, || {
            let gpu = recorder.gpu;
            let view = gpu.table("sky_view", width, height, 3);
            let (air, observer) = (air.upload(gpu, "air"), observer.upload(gpu, "observer"));
            let binds = [
                Bind::Buffer(&air),
                Bind::Buffer(&observer),
                Bind::Table(&transmittance.view),
                Bind::LinearClamp,
                Bind::Table(&multi_scattering.view),
                Bind::Table(&view),
            ];
            recorder.dispatch(&self.kernel, &binds, [width, height, 1]);
            Table { view, made_from }
        })
    }
}
