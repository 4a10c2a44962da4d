//! Light that ground and clouds keep from the air before the observer.

use super::{ground_light::LightInputs, ground_view::Looks};
use crate::{
    groundscape::Groundscape,
    kernel::{Bind, Recorder, Variants},
    shader,
    uniforms::{Part, clouds::ShadeUniform, ground::ShaftsUniform},
};
use glam::UVec2;

pub(crate) struct Shafts {
    kernels: Variants,
}

/// `lattice_count` of `lib/shaft_lattice.wgsl`.
fn lattice_count(size_px: UVec2, grain: u32) -> UVec2 {
    (size_px + grain - 1) / grain + 3
}

impl Shafts {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::SHAFTS),
        }
    }

    /// Four floats a place of the lattice, or a direction.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Groundscape,
        inputs: LightInputs<'_>,
        (looks, seen): (Looks<'_>, &wgpu::Buffer),
        shafts: ShaftsUniform,
    ) -> wgpu::Buffer {
        let gpu = recorder.gpu;
        let count = match looks {
            Looks::Tile(_, _, tile) => lattice_count(tile.size_px, shafts.grain),
            Looks::List(_, count) => UVec2::new(count, 1),
        };
        let size = 16 * u64::from(count.x) * u64::from(count.y);
        let lost = gpu.buffer(
            "shafts",
            size,
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        );
        let [camera, tile, directions] = looks.upload(gpu);
        let ground = scape.ground.upload(gpu, "ground");
        let shadow = scape.shadow.upload(gpu);
        let air = inputs.air.upload(gpu, "air");
        let by_moon = inputs.moon_view.filter(|_| scape.by_moon);
        let view = by_moon.unwrap_or(inputs.view).upload(gpu, "view");
        let shade = inputs
            .clouds
            .map_or_else(|| Part::new(&ShadeUniform::default()), |c| c.shade.clone());
        let shade = shade.upload(gpu, "shade");
        let cloud_frame = Part::new(&scape.frame).upload(gpu, "clouds");
        let settings = Part::new(&shafts).upload(gpu, "shafts");
        let shade_maps = inputs
            .clouds
            .map_or(&inputs.source.view, |scape| &scape.shadow.view);
        let binds = [
            Bind::Buffer(&ground),
            Bind::Buffer(&shadow.0),
            Bind::Buffer(&shadow.1),
            Bind::Buffer(&air),
            Bind::Buffer(&view),
            Bind::Buffer(&camera),
            Bind::Buffer(&tile),
            Bind::Table(&inputs.transmittance.view),
            Bind::LinearClamp,
            Bind::Buffer(&shade),
            Bind::Table(shade_maps),
            Bind::Buffer(&cloud_frame),
            Bind::Buffer(&settings),
            Bind::Buffer(&directions),
            Bind::Buffer(seen),
            Bind::Buffer(&lost),
        ];
        let [casts, _] = scape.shadow.constants();
        let mut constants = vec![casts, ("CLOUDS", f64::from(u8::from(inputs.clouds.is_some())))];
        constants.extend(looks.constants());
        let kernel = self.kernels.get(gpu, &constants);
        recorder.dispatch(kernel, &binds, [count.x, count.y, 1]);
        lost
    }
}
