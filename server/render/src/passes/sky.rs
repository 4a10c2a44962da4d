//! Radiance of every pixel of a tile.

use super::Table;
use crate::{
    gpu::Gpu,
    kernel::{Bind, Kernel, Recorder},
    memo::Fingerprint,
    shader,
    uniforms::{Part, TileUniform},
};

pub(crate) struct Sky {
    kernel: Kernel,
}

/// What the pass reads.
#[derive(Clone, Copy)]
pub(crate) struct SkyInputs<'a> {
    pub(crate) air: &'a Part,
    pub(crate) view: &'a Part,
    pub(crate) camera: &'a Part,
    pub(crate) transmittance: &'a Table,
    pub(crate) irradiance: &'a Table,
    pub(crate) sky_view: &'a Table,
}

impl SkyInputs<'_> {
    pub(crate) fn fingerprint(&self, tile: &Part) -> Fingerprint {
        let tables = (
            self.transmittance.made_from,
            self.irradiance.made_from,
            self.sky_view.made_from,
        );
        Fingerprint::of(("sky", self.air, self.view, self.camera, tile, tables))
    }
}

impl Sky {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self {
            kernel: Kernel::new(gpu, &shader::SKY),
        }
    }

    /// Writes one tile into `radiance`, four floats a pixel.
    pub(crate) fn run(
        &self,
        recorder: &mut Recorder<'_>,
        inputs: SkyInputs<'_>,
        tile: TileUniform,
        radiance: &wgpu::Buffer,
    ) {
        let gpu = recorder.gpu;
        let air = inputs.air.upload(gpu, "air");
        let view = inputs.view.upload(gpu, "view");
        let camera = inputs.camera.upload(gpu, "camera");
        let place = Part::new(&tile).upload(gpu, "tile");
        let binds = [
            Bind::Buffer(&air),
            Bind::Buffer(&view),
            Bind::Buffer(&camera),
            Bind::Buffer(&place),
            Bind::Table(&inputs.transmittance.view),
            Bind::LinearClamp,
            Bind::Table(&inputs.irradiance.view),
            Bind::Table(&inputs.sky_view.view),
            Bind::Buffer(radiance),
        ];
        recorder.dispatch(&self.kernel, &binds, [tile.size_px.x, tile.size_px.y, 1]);
    }
}
