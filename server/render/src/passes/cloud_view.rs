//! The clouds before every pixel of a tile.

use super::Table;
use crate::{
    cloudscape::Cloudscape,
    gpu::Shape,
    kernel::{Bind, Recorder, Variants},
    memo::Fingerprint,
    shader::{self, Texel},
    uniforms::{Part, TileUniform},
};

pub(crate) struct CloudView {
    kernels: Variants,
}

impl CloudView {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::CLOUD_VIEW),
        }
    }

    /// A table of the tile's size: what to add in R, G and B, and what comes through in alpha. Nothing is looked for behind
    /// what stands on the ground.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Cloudscape,
        (camera, projection): (&Part, u32),
        tile: TileUniform,
        lit_ground: Option<&wgpu::Buffer>,
    ) -> Table {
        let gpu = recorder.gpu;
        let size_px = tile.size_px;
        let view = gpu.written("cloud_view", [size_px.x, size_px.y, 1], Shape::Flat, Texel::Float);
        let parts = scape.upload(gpu);
        let place = Part::new(&tile);
        let (camera, place) = (camera.upload(gpu, "camera"), place.upload(gpu, "tile"));
        let nothing = gpu.buffer("unused", 16, wgpu::BufferUsages::STORAGE);
        let mut binds = scape.binds(&parts);
        binds.extend([
            Bind::Buffer(&camera),
            Bind::Buffer(&place),
            Bind::Buffer(&parts.observer),
            Bind::Table(&view),
            Bind::Buffer(lit_ground.unwrap_or(&nothing)),
        ]);
        let constants = [
            ("PROJECTION", f64::from(projection)),
            ("GROUND", f64::from(u8::from(lit_ground.is_some()))),
        ];
        let kernel = self.kernels.get(gpu, &constants);
        recorder.dispatch(kernel, &binds, [size_px.x, size_px.y, 1]);
        Table {
            view,
            made_from: Fingerprint::of("one tile"),
        }
    }
}
