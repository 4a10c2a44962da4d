//! The second and higher orders of scattering, and the sky's light on the ground.

use super::Table;
use crate::{
    gpu::Gpu,
    kernel::{Bind, Kernel, Recorder},
    memo::{Fingerprint, Memo},
    shader,
    uniforms::{OrderUniform, Part},
};
use std::sync::Arc;
use welkin_scene::Quality;

/// Orders that are followed; the rest is a geometric series.
const ORDERS: u32 = 4;

/// Moments of the light about a point.
const MOMENTS: u32 = 6;

/// Moments of the light by sun and height (layers as in `lib/moments.wgsl`), and irradiance of the ground by sun, for a sun of unit irradiance.
pub(crate) struct MultiScattering {
    pub(crate) moments: Table,
    pub(crate) irradiance: Table,
}

pub(crate) struct MultiScatteringPass {
    first: Kernel,
    later: Kernel,
    memo: Memo<MultiScattering>,
}

/// Sun cosines, heights, and steps along each ray.
const fn size(quality: Quality) -> ([u32; 2], u32) {
    match quality {
        Quality::Preview => ([24, 12], 10),
        Quality::Final => ([48, 24], 14),
    }
}

impl MultiScatteringPass {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let variant = |first: f64| Kernel::variant(gpu, &shader::MULTI_SCATTERING, &[("FIRST", first)]);
        Self {
            first: variant(1.0),
            later: variant(0.0),
            memo: Memo::new(8),
        }
    }

    /// `wanted` false gives zeros: the first order alone, or no air.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        air: &Part,
        transmittance: &Table,
        quality: Quality,
        wanted: bool,
    ) -> Arc<MultiScattering> {
        let made_from = Fingerprint::of(("multi_scattering", air, transmittance.made_from, quality, wanted));
        self.memo.get_or(made_from, || {
            let gpu = recorder.gpu;
            if !wanted {
                let moments = Table {
                    view: gpu.table("no multiple scattering", 2, 2, MOMENTS),
                    made_from,
                };
                let irradiance = Table {
                    view: gpu.table("no sky irradiance", 2, 1, 1),
                    made_from,
                };
                return MultiScattering { moments, irradiance };
            }
            let ([width, height], steps) = size(quality);
            let air = air.upload(gpu, "air");
            let cells = 2 * u64::from((MOMENTS + 1) * width * height);
            let sums = gpu.buffer("sums of the orders", 16 * cells, wgpu::BufferUsages::STORAGE);
            let new_pair = || {
                (
                    gpu.table("multi_scattering", width, height, MOMENTS),
                    gpu.table("irradiance", width, 1, 1),
                )
            };
            let mut before = new_pair();
            for index in 1..=ORDERS {
                let order = OrderUniform {
                    last: u32::from(index == ORDERS),
                    steps,
                };
                let order = Part::new(&order).upload(gpu, "order");
                let after = new_pair();
                let binds = [
                    Bind::Buffer(&air),
                    Bind::Buffer(&order),
                    Bind::Table(&transmittance.view),
                    Bind::LinearClamp,
                    Bind::Table(&before.0),
                    Bind::Table(&before.1),
                    Bind::Table(&after.0),
                    Bind::Table(&after.1),
                    Bind::Buffer(&sums),
                ];
                let kernel = if index == 1 { &self.first } else { &self.later };
                recorder.dispatch_groups(kernel, &binds, [width, height, 1]);
                before = after;
            }
            MultiScattering {
                moments: Table {
                    view: before.0,
                    made_from,
                },
                irradiance: Table {
                    view: before.1,
                    made_from,
                },
            }
        })
    }
}
