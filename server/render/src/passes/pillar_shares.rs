//! What each cell of a picture sees of each pillar, as few numbers.

use crate::{
    kernel::{Bind, Recorder, Variants},
    memo::{Fingerprint, Memo},
    passes::pillar_polar::Polar,
    pillars::{CellBuffers, LampBuffer},
    shader,
    uniforms::{
        Part,
        pillars::{PolarUniform, SharingUniform},
    },
};
use std::sync::Arc;

/// Of an entry's share in one layer.
const SHARE_BYTES: u64 = 64;
/// Invocations to a row of the dispatch.
const ROW: u32 = 1 << 20;

/// The shares of all entries, layer after layer.
pub(crate) struct Shares {
    pub(crate) buffer: wgpu::Buffer,
    pub(crate) made_from: Fingerprint,
}

/// What the shares are made from.
pub(crate) struct SharesInputs<'a> {
    pub(crate) air: &'a Part,
    pub(crate) ice: &'a Part,
    pub(crate) layers: usize,
    pub(crate) lamps: &'a LampBuffer,
    pub(crate) cells: &'a CellBuffers,
    pub(crate) polar: Option<&'a Polar>,
    pub(crate) pixel_angle: f32,
}

pub(crate) struct PillarShares {
    kernels: Variants,
    memo: Memo<Shares>,
}

impl PillarShares {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::PILLAR_SHARES),
            memo: Memo::new(3),
        }
    }

    /// None for directions, and where the shares would not fit a buffer of the device.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        inputs: &SharesInputs<'_>,
        cells_from: Fingerprint,
    ) -> Option<Arc<Shares>> {
        let gpu = recorder.gpu;
        let entries = inputs.cells.entries;
        let bytes = (u64::from(entries) * inputs.layers as u64 * SHARE_BYTES).max(SHARE_BYTES);
        if inputs.cells.across == 0 || bytes > gpu.device.limits().max_storage_buffer_binding_size {
            return None;
        }
        let made_from = Fingerprint::of((
            "pillar_shares",
            (inputs.air, inputs.ice),
            (cells_from, inputs.polar.map(|polar| polar.made_from)),
        ));
        Some(self.memo.get_or(made_from, || {
            let buffer = gpu.buffer("pillar_shares", bytes, wgpu::BufferUsages::STORAGE);
            let sharing = Part::new(&SharingUniform {
                first: inputs.cells.first,
                entries,
                pixel_angle: inputs.pixel_angle,
                row: ROW,
            });
            let none = Part::new(&PolarUniform::default());
            let nowhere = gpu.buffer("unused", 256, wgpu::BufferUsages::STORAGE);
            let uniforms = [
                inputs.air.upload(gpu, "air"),
                inputs.ice.upload(gpu, "ice"),
                inputs
                    .polar
                    .map_or(&none, |polar| &polar.uniform)
                    .upload(gpu, "polar"),
                sharing.upload(gpu, "sharing"),
            ];
            let binds = [
                Bind::Buffer(&uniforms[0]),
                Bind::Buffer(&uniforms[1]),
                Bind::Buffer(&uniforms[2]),
                Bind::Buffer(inputs.polar.map_or(&nowhere, |polar| &polar.words)),
                Bind::Buffer(&uniforms[3]),
                Bind::Buffer(&inputs.lamps.buffer),
                Bind::Buffer(&inputs.cells.lists),
                Bind::Buffer(&inputs.cells.owners),
                Bind::Buffer(&inputs.cells.cones),
                Bind::Buffer(&buffer),
            ];
            let shaded = f64::from(u8::from(inputs.polar.is_some()));
            let kernel = self.kernels.get(gpu, &[("SHADED", shaded)]);
            if entries > 0 {
                recorder.dispatch(kernel, &binds, [entries.min(ROW), entries.div_ceil(ROW), 1]);
            }
            Shares { buffer, made_from }
        }))
    }
}
