//! Light in the air up to every distance from one height.

use super::Table;
use crate::{
    gpu::Shape,
    kernel::{Bind, Recorder, Variants},
    memo::{Fingerprint, Memo},
    method::Plan,
    shader::{self, Texel},
    uniforms::{Part, Standpoint},
};
use std::sync::Arc;
use welkin_scene::Quality;

pub(crate) struct Aerial {
    kernels: Variants,
    memo: Memo<AerialVolumes>,
}

/// By azimuth from the light, row and depth: what is scattered once by molecules, by aerosols, and more than once.
pub(crate) struct AerialVolumes {
    pub(crate) rayleigh: wgpu::TextureView,
    pub(crate) mie: wgpu::TextureView,
    pub(crate) multiple: wgpu::TextureView,
    pub(crate) made_from: Fingerprint,
}

/// Azimuths over half the sky; rows, half below the horizon, half above; slices of depth.
const fn size(quality: Quality) -> [u32; 3] {
    match quality {
        Quality::Preview => [12, 32, 20],
        Quality::Final => [32, 64, 32],
    }
}

/// Steps in a slice.
const SLICE_STEPS: u32 = 4;

impl Aerial {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::AERIAL),
            memo: Memo::new(4),
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
    ) -> Arc<AerialVolumes> {
        let (transmittance, source) = tables;
        let observer = Part::new(&stand.observer(crate::method::Steps {
            view: SLICE_STEPS,
            sun: 0,
        }));
        let reads = (transmittance.made_from, source.made_from);
        let made_from = Fingerprint::of(("aerial", air, &observer, reads, quality));
        self.memo.get_or(made_from, || {
            let gpu = recorder.gpu;
            let [width, height, _] = size(quality);
            let volume = |label| gpu.written(label, size(quality), Shape::Volume, Texel::Float);
            let volumes = AerialVolumes {
                rayleigh: volume("aerial rayleigh"),
                mie: volume("aerial mie"),
                multiple: volume("aerial multiple"),
                made_from,
            };
            let (air, observer) = (air.upload(gpu, "air"), observer.upload(gpu, "observer"));
            let binds = [
                Bind::Buffer(&air),
                Bind::Buffer(&observer),
                Bind::Table(&transmittance.view),
                Bind::LinearClamp,
                Bind::Table(&source.view),
                Bind::Table(&volumes.rayleigh),
                Bind::Table(&volumes.mie),
                Bind::Table(&volumes.multiple),
            ];
            let kernel = self.kernels.get(gpu, &plan.march_constants());
            recorder.dispatch(kernel, &binds, [width, height, 1]);
            volumes
        })
    }
}
