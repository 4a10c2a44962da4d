//! Radiance of every pixel of a tile.

use super::Table;
use crate::{
    kernel::{Bind, Recorder, Variants},
    memo::Fingerprint,
    method::Plan,
    shader,
    uniforms::{Part, TileUniform},
};

pub(crate) struct Sky {
    kernels: Variants,
}

/// What the pass reads.
#[derive(Clone, Copy)]
pub(crate) struct SkyInputs<'a> {
    pub(crate) air: &'a Part,
    pub(crate) view: &'a Part,
    pub(crate) camera: &'a Part,
    pub(crate) observer: &'a Part,
    pub(crate) plan: Plan,
    pub(crate) transmittance: &'a Table,
    pub(crate) irradiance: &'a Table,
    /// None where each pixel's ray is followed.
    pub(crate) sky_view: Option<&'a Table>,
    pub(crate) source: &'a Table,
}

impl SkyInputs<'_> {
    pub(crate) fn fingerprint(&self, tile: &Part) -> Fingerprint {
        let tables = (
            self.transmittance.made_from,
            self.irradiance.made_from,
            self.source.made_from,
            self.sky_view.map(|table| table.made_from),
        );
        let parts = (self.air, self.view, self.camera, self.observer, tile);
        Fingerprint::of(("sky", self.plan, parts, tables))
    }
}

impl Sky {
    pub(crate) fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::SKY),
        }
    }

    /// Writes one tile into `radiance`, four floats a pixel.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        inputs: SkyInputs<'_>,
        tile: TileUniform,
        radiance: &wgpu::Buffer,
    ) {
        let gpu = recorder.gpu;
        let air = inputs.air.upload(gpu, "air");
        let view = inputs.view.upload(gpu, "view");
        let camera = inputs.camera.upload(gpu, "camera");
        let observer = inputs.observer.upload(gpu, "observer");
        let place = Part::new(&tile).upload(gpu, "tile");
        let binds = [
            Bind::Buffer(&air),
            Bind::Buffer(&view),
            Bind::Buffer(&camera),
            Bind::Buffer(&place),
            Bind::Buffer(&observer),
            Bind::Table(&inputs.transmittance.view),
            Bind::LinearClamp,
            Bind::Table(&inputs.irradiance.view),
            Bind::Table(&inputs.sky_view.unwrap_or(inputs.source).view),
            Bind::Table(&inputs.source.view),
            Bind::Buffer(radiance),
        ];
        let constants = [
            ("METHOD", inputs.plan.method_code()),
            ("MULTIPLE", f64::from(u8::from(inputs.plan.multiple))),
        ];
        let kernel = self.kernels.get(gpu, &constants);
        recorder.dispatch(kernel, &binds, [tile.size_px.x, tile.size_px.y, 1]);
    }
}
