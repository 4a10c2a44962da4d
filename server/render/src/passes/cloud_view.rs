//! Which clouds every pixel of a tile sees.

use crate::{
    cloudscape::Cloudscape,
    kernel::{Bind, Recorder, Variants},
    memo::{Fingerprint, Memo},
    passes::cloud_dome::NODE_FLOATS,
    shader,
    uniforms::{Part, TileUniform},
};
use std::sync::Arc;

/// Places along the ray of each pixel of a tile: six vectors, as `Nodes` of `lib/cloud_nodes.wgsl` has them.
pub(crate) struct TileNodes {
    pub(crate) buffer: wgpu::Buffer,
}

/// What is kept for frames under another sun, bytes: a frame of 1280×720.
const KEPT_BYTES: u64 = 96 << 20;

pub(crate) struct CloudView {
    kernels: Variants,
    memo: Memo<TileNodes>,
}

impl CloudView {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::CLOUD_VIEW),
            memo: Memo::new(KEPT_BYTES),
        }
    }

    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Cloudscape,
        (camera, projection): (&Part, u32),
        tile: TileUniform,
    ) -> Arc<TileNodes> {
        let size_px = tile.size_px;
        let bytes = 4 * NODE_FLOATS * u64::from(size_px.x) * u64::from(size_px.y);
        let place = Part::new(&tile);
        let made_from = Fingerprint::of((
            "cloud_view",
            scape.shape_fingerprint(),
            camera,
            projection,
            &place,
        ));
        self.memo.get_or_weighing(bytes, made_from, || {
            let gpu = recorder.gpu;
            let buffer = gpu.buffer("cloud_view", bytes, wgpu::BufferUsages::STORAGE);
            let parts = scape.upload(gpu);
            let (camera, place) = (camera.upload(gpu, "camera"), place.upload(gpu, "tile"));
            let mut binds = scape.march_binds(&parts);
            binds.extend([
                Bind::Buffer(&camera),
                Bind::Buffer(&place),
                Bind::Buffer(&parts.observer),
                Bind::Buffer(&buffer),
            ]);
            let constants = [scape.one_layer(), ("PROJECTION", f64::from(projection))];
            let kernel = self.kernels.get(gpu, &constants);
            recorder.dispatch(kernel, &binds, [size_px.x, size_px.y, 1]);
            TileNodes { buffer }
        })
    }
}
