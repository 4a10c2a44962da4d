//! The light of the clouds that every pixel of a tile sees.

use super::{
    Table,
    cloud_view::{ViewNodes, whole_frame},
    ground_light::LitGround,
    shafts::LOST_BYTES,
};
use crate::{
    cloudscape::Cloudscape,
    gpu::Shape,
    kernel::{Bind, Recorder, Variants},
    memo::Fingerprint,
    shader::{self, Texel},
    uniforms::{Part, TileUniform},
};
use glam::UVec2;

pub(crate) struct CloudViewLight {
    kernels: Variants,
}

impl CloudViewLight {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::CLOUD_VIEW_LIGHT),
        }
    }

    /// A table of the tile's size: what to add in R, G and B, and what comes through in alpha.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Cloudscape,
        (camera, projection): (&Part, u32),
        (tile, frame_px): (TileUniform, UVec2),
        (nodes, ground): (&ViewNodes, Option<&LitGround>),
    ) -> Table {
        let gpu = recorder.gpu;
        let size_px = tile.size_px;
        let view = gpu.written(
            "cloud_view_light",
            [size_px.x, size_px.y, 1],
            Shape::Flat,
            Texel::Float,
        );
        let parts = scape.upload(gpu);
        let place = Part::new(&tile);
        let (camera, place) = (camera.upload(gpu, "camera"), place.upload(gpu, "tile"));
        let nothing = gpu.buffer("unused", LOST_BYTES, wgpu::BufferUsages::STORAGE);
        let lost = ground.and_then(|ground| ground.lost.as_ref());
        let mut binds = scape.binds(&parts);
        binds.extend([
            Bind::Buffer(&camera),
            Bind::Buffer(&place),
            Bind::Buffer(&parts.observer),
            Bind::Buffer(&nodes.buffer),
            Bind::Table(&view),
            Bind::Buffer(ground.map_or(&nothing, |ground| &ground.light)),
            Bind::Buffer(lost.unwrap_or(&nothing)),
        ]);
        let mut constants = scape.light_constants().to_vec();
        constants.extend([
            whole_frame(frame_px),
            ("PROJECTION", f64::from(projection)),
            ("GROUND", f64::from(u8::from(ground.is_some()))),
            ("SHAFTS", f64::from(u8::from(lost.is_some()))),
        ]);
        recorder.dispatch(
            self.kernels.get(gpu, &constants),
            &binds,
            [size_px.x, size_px.y, 1],
        );
        Table {
            view,
            made_from: Fingerprint::of("one tile"),
        }
    }
}
