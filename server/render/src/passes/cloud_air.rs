//! What rays in all directions lose of the light in the air to clouds, where no shafts tell it.

use super::Table;
use crate::{
    gpu::Shape,
    kernel::{Bind, Kernel, Recorder},
    memo::{Fingerprint, Memo},
    shader::{self, Texel},
    uniforms::Part,
};
use std::{cell::OnceCell, sync::Arc};

/// Directions around, the first of them twice, and from the horizon up and down.
const SIZE: [u32; 2] = [37, 24];

pub(crate) struct CloudAir {
    kernel: OnceCell<Kernel>,
    memo: Memo<Table>,
}

/// What the pass reads.
pub(crate) struct CloudAirInputs<'a> {
    pub(crate) air: &'a Part,
    /// The light that counts.
    pub(crate) view: &'a Part,
    pub(crate) transmittance: &'a Table,
    pub(crate) shade: &'a Part,
    pub(crate) shadow: &'a Table,
    /// Where the clouds' shadows fall.
    pub(crate) frame: &'a Part,
}

impl CloudAir {
    pub(crate) const fn new() -> Self {
        Self {
            kernel: OnceCell::new(),
            memo: Memo::new(4),
        }
    }

    /// `LostInAir` of `lib/cloud_air.wgsl`, in three layers.
    pub(crate) fn run(&mut self, recorder: &mut Recorder<'_>, inputs: &CloudAirInputs<'_>) -> Arc<Table> {
        let made_from = Fingerprint::of((
            "cloud_air",
            (inputs.air, inputs.view, inputs.shade, inputs.frame),
            (inputs.transmittance.made_from, inputs.shadow.made_from),
        ));
        self.memo.get_or(made_from, || {
            let gpu = recorder.gpu;
            let [width, height] = SIZE;
            let view = gpu.written("cloud_air", [width, height, 3], Shape::Layers, Texel::Float);
            let air = inputs.air.upload(gpu, "air");
            let seen_from = inputs.view.upload(gpu, "view");
            let shade = inputs.shade.upload(gpu, "shade");
            let frame = inputs.frame.upload(gpu, "clouds");
            let binds = [
                Bind::Buffer(&air),
                Bind::Buffer(&seen_from),
                Bind::Table(&inputs.transmittance.view),
                Bind::LinearClamp,
                Bind::Buffer(&shade),
                Bind::Table(&inputs.shadow.view),
                Bind::Buffer(&frame),
                Bind::Table(&view),
            ];
            let kernel = self.kernel.get_or_init(|| Kernel::new(gpu, &shader::CLOUD_AIR));
            recorder.dispatch(kernel, &binds, [width, height, 1]);
            Table { view, made_from }
        })
    }
}
