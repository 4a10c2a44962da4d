//! Harmonics of the light that the sky sends on the ground.

use super::Table;
use crate::{
    kernel::{Bind, Recorder, Variants},
    memo::{Fingerprint, Memo},
    method::{Plan, Steps},
    shader,
    uniforms::{Part, Standpoint, ViewUniform, ground::SkyPartUniform},
};
use std::sync::Arc;
use welkin_scene::Sun;

pub(crate) struct GroundSky {
    kernels: Variants,
    memo: Memo<wgpu::Buffer>,
}

/// Of each light.
const HARMONICS: u32 = 9;
/// Along each of its rays.
const STEPS: u32 = 24;

impl GroundSky {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::GROUND_SKY),
            memo: Memo::new(8),
        }
    }

    /// Of up to two lights of unit irradiance, each as it stands over the ground, one after the other.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        air: &Part,
        lights: [Option<Standpoint>; 2],
        (transmittance, source): (&Table, &Table),
        plan: Plan,
    ) -> Arc<wgpu::Buffer> {
        let reads = (transmittance.made_from, source.made_from);
        let made_from = Fingerprint::of(("ground_sky", air, format!("{lights:?}"), reads));
        self.memo.get_or(made_from, || {
            let gpu = recorder.gpu;
            let harmonics = gpu.buffer(
                "ground_sky",
                u64::from(2 * HARMONICS * 16),
                wgpu::BufferUsages::STORAGE,
            );
            let air = air.upload(gpu, "air");
            for (first, stand) in [0, HARMONICS].into_iter().zip(lights) {
                let Some(stand) = stand else { continue };
                let even = Sun {
                    irradiance_w_m2: [1.0; 3],
                    ..Sun::default()
                };
                let view = Part::new(&ViewUniform::new(&even, &stand)).upload(gpu, "view");
                let observer =
                    Part::new(&stand.observer(Steps { view: STEPS, sun: 0 })).upload(gpu, "observer");
                let part = Part::new(&SkyPartUniform { first }).upload(gpu, "part");
                let binds = [
                    Bind::Buffer(&air),
                    Bind::Buffer(&view),
                    Bind::Buffer(&observer),
                    Bind::Table(&transmittance.view),
                    Bind::LinearClamp,
                    Bind::Table(&source.view),
                    Bind::Buffer(&part),
                    Bind::Buffer(&harmonics),
                ];
                let kernel = self.kernels.get(gpu, &plan.march_constants());
                recorder.dispatch_groups(kernel, &binds, [1, 1, 1]);
            }
            harmonics
        })
    }
}
