//! The camera's meter.

use super::sky::{Sky, SkyInputs, SkyTo};
use crate::{
    gpu::Gpu,
    kernel::{Bind, Kernel, Recorder},
    memo::{Fingerprint, Memo},
    shader,
    uniforms::{MeterUniform, Part, TileUniform},
};
use glam::UVec2;
use std::sync::Arc;

/// Size of the exposure on the device, bytes: scale and EV.
pub(crate) const EXPOSURE_BYTES: u64 = 8;

/// Longer side of the small picture that is metered, pixels.
const METER_SIDE_PX: u32 = 64;

pub(crate) struct ExposurePass {
    kernel: Kernel,
    memo: Memo<wgpu::Buffer>,
}

/// Size of the metered picture: the frame's shape, small, so that every size of one scene is exposed alike.
pub(crate) fn meter_size(frame_px: UVec2) -> UVec2 {
    let longest = frame_px.max_element();
    let scaled = |side: u32| (side * METER_SIDE_PX).div_ceil(longest).clamp(1, METER_SIDE_PX);
    UVec2::new(scaled(frame_px.x), scaled(frame_px.y))
}

impl ExposurePass {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self {
            kernel: Kernel::new(gpu, &shader::EXPOSURE),
            memo: Memo::new(16),
        }
    }

    /// An exposure that is not metered: the tone pass then takes its gain from its settings.
    pub(crate) fn none(&mut self, gpu: &Gpu) -> Arc<wgpu::Buffer> {
        self.memo
            .get_or(Fingerprint::of("no exposure"), || new_exposure(gpu))
    }

    /// Renders the scene small through `sky`, its inputs made for `meter_size`, and meters it.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        sky: &mut Sky,
        inputs: SkyInputs<'_>,
        size_px: UVec2,
        compensation_ev: f32,
    ) -> Arc<wgpu::Buffer> {
        let tile = TileUniform {
            origin_px: UVec2::ZERO,
            size_px,
            stride_px: 1,
        };
        let meter = Part::new(&MeterUniform {
            size_px,
            compensation_ev,
        });
        let made_from = Fingerprint::of(("exposure", &meter, inputs.fingerprint(&Part::new(&tile))));
        self.memo.get_or(made_from, || {
            let gpu = recorder.gpu;
            let pixels = u64::from(size_px.x) * u64::from(size_px.y);
            let radiance = gpu.buffer("metered picture", 16 * pixels, wgpu::BufferUsages::STORAGE);
            drop(sky.run(recorder, inputs, tile, SkyTo::Radiance(&radiance)));
            let exposure = new_exposure(gpu);
            let meter = meter.upload(gpu, "meter");
            let binds = [
                Bind::Buffer(&meter),
                Bind::Buffer(&radiance),
                Bind::Buffer(&exposure),
            ];
            recorder.dispatch_groups(&self.kernel, &binds, [1, 1, 1]);
            exposure
        })
    }
}

fn new_exposure(gpu: &Gpu) -> wgpu::Buffer {
    gpu.buffer(
        "exposure",
        EXPOSURE_BYTES,
        wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
    )
}
