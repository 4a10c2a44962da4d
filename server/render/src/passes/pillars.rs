//! Pillars of light and their lamps, added to a tile of radiance or summed along directions.

use super::Table;
use crate::{
    cloud_dome::{CloudsSeen, DomeView},
    kernel::{Bind, Recorder, Variants},
    pillars::Pillars,
    shader,
    uniforms::{Part, clouds::DomeUniform, pillars::PolarUniform},
};

use super::ground_view::Looks;

/// What the pass reads beside the pillars.
#[derive(Clone, Copy)]
pub(crate) struct PillarsInputs<'a> {
    pub(crate) air: &'a Part,
    pub(crate) transmittance: &'a Table,
    pub(crate) clouds: Option<CloudsSeen<'a>>,
    /// What stands on the ground before each pixel or direction.
    pub(crate) lit_ground: Option<&'a wgpu::Buffer>,
}

/// Pixels of a column that an invocation looks along, as `pillars.wgsl` has it.
const ROWS: u32 = 4;

pub(crate) struct PillarsPass {
    kernels: Variants,
}

impl PillarsPass {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::PILLARS),
        }
    }

    /// Adds to four floats a pixel or direction.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        inputs: PillarsInputs<'_>,
        pillars: &Pillars,
        looks: Looks<'_>,
        radiance: &wgpu::Buffer,
    ) {
        let gpu = recorder.gpu;
        let air = inputs.air.upload(gpu, "air");
        let ice = pillars.ice.upload(gpu, "ice");
        let scene = pillars.scene.upload(gpu, "pillars");
        // What a variant does not read must still be bound.
        let unused = || {
            gpu.buffer(
                "unused",
                256,
                wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::UNIFORM,
            )
        };
        let nowhere = unused();
        let (dome, table) = match inputs.clouds {
            Some(CloudsSeen::Dome(dome)) => (Some(dome), None),
            Some(CloudsSeen::Tile(table)) => (None, Some(table)),
            Some(CloudsSeen::List(_)) | None => (None, None),
        };
        let listed = match inputs.clouds {
            Some(CloudsSeen::List(seen)) => Some(seen),
            _ => None,
        };
        let dome_uniform = dome
            .map_or_else(|| Part::new(&DomeUniform::default()), DomeView::uniform)
            .upload(gpu, "dome");
        let (pages, seen) = dome.map_or((&nowhere, &inputs.transmittance.view), |d| (&d.pages, &d.seen));
        let [camera, tile, directions] = looks.upload(gpu);
        let none = Part::new(&PolarUniform::default());
        let polar = pillars.polar.as_ref();
        let polar_uniform = polar.map_or(&none, |polar| &polar.uniform).upload(gpu, "polar");
        let shares = pillars.shares.as_ref();
        let binds = [
            Bind::Buffer(&air),
            Bind::Buffer(&ice),
            Bind::Buffer(&polar_uniform),
            Bind::Buffer(polar.map_or(&nowhere, |polar| &polar.words)),
            Bind::LinearClamp,
            Bind::Buffer(&camera),
            Bind::Buffer(radiance),
            Bind::Table(&table.unwrap_or(inputs.transmittance).view),
            Bind::Buffer(&dome_uniform),
            Bind::Buffer(pages),
            Bind::Table(seen),
            Bind::Buffer(inputs.lit_ground.unwrap_or(&nowhere)),
            Bind::Buffer(&tile),
            Bind::Buffer(&pillars.lamps.buffer),
            Bind::Buffer(&pillars.cells.lists),
            Bind::Buffer(shares.map_or(&directions, |shares| &shares.buffer)),
            Bind::Buffer(&scene),
            Bind::Table(&inputs.transmittance.view),
            Bind::Buffer(listed.unwrap_or(&nowhere)),
        ];
        let flag = |on: bool| f64::from(u8::from(on));
        let clouded = inputs.clouds.is_some();
        let mut constants = looks.constants().to_vec();
        constants.extend([
            ("GROUND", flag(inputs.lit_ground.is_some())),
            ("SHARED", flag(shares.is_some())),
            ("SHADED", flag(polar.is_some())),
            ("CLOUDED_LAMPS", flag(clouded && pillars.lamps_clouded)),
            ("CLOUDED_SUN", flag(clouded && pillars.sun_clouded)),
            ("DOME", flag(dome.is_some())),
        ]);
        let kernel = self.kernels.get(gpu, &constants);
        let [across, down, layers] = looks.threads();
        recorder.dispatch(kernel, &binds, [across, down.div_ceil(ROWS), layers]);
    }
}
