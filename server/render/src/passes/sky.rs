//! Radiance of every pixel of a tile.

use super::Table;
use crate::{
    kernel::{Bind, Recorder, Variants},
    memo::Fingerprint,
    method::Plan,
    shader,
    uniforms::{Part, TileUniform, night::MoonUniform},
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
    pub(crate) airglow: &'a Part,
    pub(crate) moon: Option<MoonInputs<'a>>,
}

/// The moon as the pass reads it.
#[derive(Clone, Copy)]
pub(crate) struct MoonInputs<'a> {
    pub(crate) moon: &'a Part,
    /// The moon in the sun's place.
    pub(crate) view: &'a Part,
    pub(crate) face: &'a wgpu::TextureView,
    /// True where its light on air and ground counts.
    pub(crate) lights: bool,
    /// That light in the air, for those who read it from a table.
    pub(crate) sky_view: Option<&'a Table>,
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
        let moon = self
            .moon
            .map(|m| (m.moon, m.view, m.lights, m.sky_view.map(|table| table.made_from)));
        Fingerprint::of(("sky", self.plan, parts, tables, self.airglow, moon))
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
        // A variant reads nothing of what it is not for; anything stands there.
        let none = Part::new(&MoonUniform::default());
        let moon = inputs.moon.map_or(&none, |m| m.moon).upload(gpu, "moon");
        let moon_view = inputs
            .moon
            .map_or(inputs.view, |m| m.view)
            .upload(gpu, "moon view");
        let moon_sky_view = inputs.moon.and_then(|m| m.sky_view);
        let face = inputs.moon.map_or(&inputs.transmittance.view, |m| m.face);
        let airglow = inputs.airglow.upload(gpu, "airglow");
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
            Bind::Buffer(&airglow),
            Bind::Buffer(&moon),
            Bind::Buffer(&moon_view),
            Bind::Table(&moon_sky_view.unwrap_or(inputs.source).view),
            Bind::Table(face),
        ];
        let flag = |on: bool| f64::from(u8::from(on));
        let mut constants = vec![
            ("METHOD", inputs.plan.method_code()),
            ("PROJECTION", f64::from(inputs.plan.projection)),
            ("AIRGLOW", flag(inputs.plan.airglow)),
            ("MOON", flag(inputs.moon.is_some())),
            ("MOONLIGHT", flag(moon_sky_view.is_some())),
        ];
        if inputs.sky_view.is_none() {
            constants.extend(inputs.plan.march_constants());
        }
        let kernel = self.kernels.get(gpu, &constants);
        recorder.dispatch(kernel, &binds, [tile.size_px.x, tile.size_px.y, 1]);
    }
}
