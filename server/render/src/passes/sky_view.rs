//! Light in the air in every direction from one height.

use super::Table;
use crate::{
    kernel::{Bind, Recorder, Variants},
    memo::{Fingerprint, Memo},
    method::Plan,
    shader,
    uniforms::{Part, Standpoint},
};
use std::sync::Arc;
use welkin_scene::Quality;

pub(crate) struct SkyView {
    kernels: Variants,
    memo: Memo<Table>,
}

/// Azimuths over half the sky, and rows, half below the horizon, half above.
const fn size(quality: Quality) -> [u32; 2] {
    match quality {
        Quality::Preview => [24, 96],
        Quality::Final => [48, 208],
    }
}

impl SkyView {
    pub(crate) fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::SKY_VIEW),
            memo: Memo::new(16),
        }
    }

    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        air: &Part,
        stand: &Standpoint,
        tables: (&Table, &Table),
        plan: Plan,
        quality: Quality,
    ) -> Arc<Table> {
        let (transmittance, source) = tables;
        let [width, height] = size(quality);
        let observer = Part::new(&stand.observer(plan.sky_view_steps(quality)));
        let reads = (transmittance.made_from, source.made_from);
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
                Bind::Table(&source.view),
                Bind::Table(&view),
            ];
            let kernel = self.kernels.get(gpu, &plan.march_constants());
            recorder.dispatch(kernel, &binds, [width, height, 1]);
            Table { view, made_from }
        })
    }
}
