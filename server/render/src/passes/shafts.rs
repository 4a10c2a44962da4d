//! Light that ground and clouds keep from the air before the observer.

use super::{ground_light::LightInputs, ground_view::Looks};
use crate::{
    groundscape::Groundscape,
    kernel::{Bind, Recorder, Variants},
    shader,
    shafts::ShaftSettings,
    uniforms::{Part, TileUniform, clouds::ShadeUniform},
};
use glam::UVec2;

pub(crate) struct Shafts {
    kernels: Variants,
}

/// What stands and hangs before the places of a lattice, or along the directions of a list.
pub(crate) struct Sees<'a> {
    pub(crate) ground: &'a wgpu::Buffer,
    /// Places along each ray, as `lib/cloud_nodes.wgsl` has them; radial shafts alone ask for them.
    pub(crate) clouds: Option<&'a wgpu::Buffer>,
}

/// Bytes of what one place or direction loses.
pub(crate) const LOST_BYTES: u64 = 32;

/// A frame of more places has a lattice for each tile.
const MOST_PLACES: u32 = 1 << 19;

/// The lattice of a list, which has none.
pub(crate) const ONE_PLACE: TileUniform = TileUniform {
    origin_px: UVec2::ZERO,
    size_px: UVec2::ONE,
    stride_px: 1,
};

/// The places of the frame's lattice about a tile's pixels: one before its edges, and two beyond, so that all about each
/// pixel are there. Places left of the frame wrap round.
fn lattice_of(tile: TileUniform, grain: u32) -> TileUniform {
    let first = tile.origin_px / grain;
    let last = (tile.origin_px + tile.stride_px * (tile.size_px - 1)) / grain;
    let corner = first * grain;
    TileUniform {
        origin_px: UVec2::new(corner.x.wrapping_sub(grain), corner.y.wrapping_sub(grain)),
        size_px: last - first + 4,
        stride_px: grain,
    }
}

/// The lattice that a tile reads, and whether it is that of the whole frame.
pub(crate) fn lattice_for(tile: TileUniform, frame_px: UVec2, grain: u32) -> (TileUniform, bool) {
    let whole = TileUniform {
        origin_px: UVec2::ZERO,
        size_px: frame_px,
        stride_px: 1,
    };
    let whole = lattice_of(whole, grain);
    if whole.size_px.element_product() <= MOST_PLACES {
        (whole, true)
    } else {
        (lattice_of(tile, grain), false)
    }
}

impl Shafts {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::SHAFTS),
        }
    }

    /// What a place of a lattice, or a direction, loses: `Lost` of `lib/shaft_lattice.wgsl`. `seen` tells what stands there.
    /// Clouds count where rays are followed through them; else the air gets what they leave on average.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Groundscape,
        inputs: LightInputs<'_>,
        (looks, sees): (Looks<'_>, Sees<'_>),
        shafts: &ShaftSettings,
    ) -> wgpu::Buffer {
        let gpu = recorder.gpu;
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let lost = gpu.buffer("shafts", LOST_BYTES * looks.count(), usage);
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
        let settings = Part::new(&shafts.uniform()).upload(gpu, "shafts");
        let shade_maps = inputs
            .clouds
            .map_or(&inputs.source.view, |scape| &scape.shadow.view);
        let unused = gpu.buffer("unused", 16, wgpu::BufferUsages::STORAGE);
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
            Bind::Buffer(sees.ground),
            Bind::Buffer(&lost),
            Bind::Buffer(sees.clouds.unwrap_or(&unused)),
        ];
        let [casts, _] = scape.shadow.constants();
        let flag = |on: bool| f64::from(u8::from(on));
        let mut constants = vec![
            casts,
            (
                "CLOUDS",
                flag(inputs.clouds.is_some() && (inputs.followed || shafts.is_radial())),
            ),
            ("RADIAL", flag(shafts.is_radial())),
        ];
        constants.extend(looks.constants());
        let kernel = self.kernels.get(gpu, &constants);
        recorder.dispatch(kernel, &binds, looks.threads());
        lost
    }
}
