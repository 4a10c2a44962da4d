//! The stars, added to a tile of the picture.

use super::Table;
use crate::{
    cloud_dome::{CloudsSeen, DomeView},
    gpu::Gpu,
    kernel::{Bind, Recorder, Variants},
    lens::Lens,
    memo::{Fingerprint, Memo},
    shader,
    starfield::{Glint, Screen, glints, within},
    uniforms::{Part, TileUniform, clouds::DomeUniform, night::StretchUniform},
};
use bytemuck::Zeroable;
use glam::UVec2;
use std::sync::Arc;
use welkin_scene::{Camera, Firmament, Stars};

pub(crate) struct StarsPass {
    kernels: Variants,
    memo: Memo<Starfield>,
}

/// The stars of one picture, on the host and on the device.
pub(crate) struct Starfield {
    glints: Vec<Glint>,
    buffer: wgpu::Buffer,
    width_px: u32,
    made_from: Fingerprint,
}

/// A picture's stars, and how far they are out.
#[derive(Clone)]
pub(crate) struct StarsOut {
    pub(crate) field: Arc<Starfield>,
    pub(crate) out: f32,
}

impl StarsOut {
    pub(crate) fn fingerprint(&self) -> Fingerprint {
        Fingerprint::of((self.field.made_from, self.out.to_bits()))
    }
}

/// What the pass reads beside the stars.
#[derive(Clone, Copy)]
pub(crate) struct StarsInputs<'a> {
    pub(crate) air: &'a Part,
    pub(crate) view: &'a Part,
    pub(crate) transmittance: &'a Table,
    pub(crate) clouds: Option<CloudsSeen<'a>>,
    /// What stands on the ground before each pixel.
    pub(crate) lit_ground: Option<&'a wgpu::Buffer>,
}

impl StarsPass {
    pub(crate) fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::STARS),
            memo: Memo::new(4),
        }
    }

    /// The stars as a camera sees them from above the air, without those that the `screens` hide.
    pub(crate) fn field(
        &mut self,
        gpu: &Gpu,
        stars: &Stars,
        firmament: &Firmament,
        (camera, size_px): (&Camera, UVec2),
        screens: &[Screen],
    ) -> Arc<Starfield> {
        // Nothing in these types has a hash; what they print tells all of it.
        let made_from = Fingerprint::of(format!(
            "{stars:?} {firmament:?} {camera:?} {size_px} {screens:?}"
        ));
        self.memo.get_or(made_from, || {
            let glints = glints(stars, firmament, &Lens::new(camera, size_px), size_px.x, screens);
            // A buffer cannot be empty.
            let least = [Glint::zeroed()];
            let held = if glints.is_empty() { &least[..] } else { &glints };
            Starfield {
                buffer: gpu.filled("stars", bytemuck::cast_slice(held), wgpu::BufferUsages::STORAGE),
                glints,
                width_px: size_px.x,
                made_from,
            }
        })
    }

    /// Adds the stars of one tile to its radiance.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        inputs: StarsInputs<'_>,
        stars: &StarsOut,
        tile: TileUniform,
        radiance: &wgpu::Buffer,
    ) {
        let field = &stars.field;
        let index = |pixel: UVec2| pixel.y * field.width_px + pixel.x;
        let last = tile.origin_px + tile.stride_px * (tile.size_px - 1);
        let part = within(&field.glints, index(tile.origin_px)..index(last) + 1);
        let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        let stretch = StretchUniform {
            first: count(part.start),
            count: count(part.len()),
            frame_width: field.width_px,
            out: stars.out,
            origin_px: tile.origin_px,
            size_px: tile.size_px,
            stride_px: tile.stride_px,
        };
        if part.is_empty() {
            return;
        }
        let gpu = recorder.gpu;
        let air = inputs.air.upload(gpu, "air");
        let view = inputs.view.upload(gpu, "view");
        let threads = stretch.count;
        let stretch = Part::new(&stretch).upload(gpu, "stretch");
        let (dome, table) = match inputs.clouds {
            Some(CloudsSeen::Dome(dome)) => (Some(dome), None),
            Some(CloudsSeen::Tile(table)) => (None, Some(table)),
            None => (None, None),
        };
        let uniform = dome.map_or_else(|| Part::new(&DomeUniform::default()), DomeView::uniform);
        let dome_uniform = uniform.upload(gpu, "dome");
        // What a variant does not read must still be bound.
        let nowhere = gpu.buffer("unused", 16, wgpu::BufferUsages::STORAGE);
        let (pages, seen) = dome.map_or((&nowhere, &inputs.transmittance.view), |d| (&d.pages, &d.seen));
        let binds = [
            Bind::Buffer(&air),
            Bind::Buffer(&view),
            Bind::Buffer(&stretch),
            Bind::Table(&inputs.transmittance.view),
            Bind::LinearClamp,
            Bind::Buffer(&field.buffer),
            Bind::Buffer(radiance),
            Bind::Table(&table.unwrap_or(inputs.transmittance).view),
            Bind::Buffer(&dome_uniform),
            Bind::Buffer(pages),
            Bind::Table(seen),
            Bind::Buffer(inputs.lit_ground.unwrap_or(&nowhere)),
        ];
        let flag = |on: bool| f64::from(u8::from(on));
        let constants = [
            ("CLOUDS", flag(inputs.clouds.is_some())),
            ("DOME", flag(dome.is_some())),
            ("GROUND", flag(inputs.lit_ground.is_some())),
        ];
        let kernel = self.kernels.get(gpu, &constants);
        recorder.dispatch(kernel, &binds, [threads, 1, 1]);
    }
}
