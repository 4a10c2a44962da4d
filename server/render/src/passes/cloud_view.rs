//! Which clouds every pixel of a tile sees.

use crate::{
    cloudscape::Cloudscape,
    groundscape::Groundscape,
    kernel::{Bind, Recorder, Variants},
    memo::{Fingerprint, Memo},
    passes::cloud_dome::NODE_FLOATS,
    shader,
    uniforms::{Part, TileUniform},
};
use glam::UVec2;
use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering::Relaxed},
};

/// Places along the ray of each pixel: six vectors, as `Nodes` of `lib/cloud_nodes.wgsl` has them.
pub(crate) struct ViewNodes {
    pub(crate) buffer: wgpu::Buffer,
    /// For a frame that is kept: which pixels are there. Tiles lie elsewhere from frame to frame.
    done: Vec<AtomicBool>,
}

/// Larger frames are not kept whole for when the sun moves, bytes: a frame of 1280×720.
const KEPT_BYTES: u64 = 96 << 20;

pub(crate) struct CloudView {
    kernels: Variants,
    memo: Memo<ViewNodes>,
}

/// Bytes of that many pixels.
fn bytes_of(size_px: UVec2) -> u64 {
    4 * NODE_FLOATS * u64::from(size_px.x) * u64::from(size_px.y)
}

/// The shaders' constant that is 1 where the whole frame has its places in one buffer.
pub(crate) fn whole_frame(frame_px: UVec2) -> (&'static str, f64) {
    let whole = bytes_of(frame_px) <= KEPT_BYTES;
    ("WHOLE_FRAME", f64::from(u8::from(whole)))
}

fn pixels_of(tile: TileUniform, frame_px: UVec2) -> impl Iterator<Item = usize> {
    let TileUniform {
        origin_px,
        size_px,
        stride_px,
    } = tile;
    let column = move |x| origin_px.x + stride_px * x;
    let row = move |y| (origin_px.y + stride_px * y) * frame_px.x;
    (0..size_px.y).flat_map(move |y| (0..size_px.x).map(move |x| (row(y) + column(x)) as usize))
}

impl CloudView {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::CLOUD_VIEW),
            memo: Memo::new(KEPT_BYTES),
        }
    }

    /// Places along the ray of each of a tile's pixels, for once.
    pub(crate) fn look(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Cloudscape,
        (camera, projection): (&Part, u32),
        tile: TileUniform,
    ) -> wgpu::Buffer {
        let size = bytes_of(tile.size_px);
        let seen = recorder
            .gpu
            .buffer("clouds seen", size, wgpu::BufferUsages::STORAGE);
        self.march(recorder, scape, (camera, projection), (tile, 0.0), (&seen, None));
        seen
    }

    /// Nothing is looked for behind what stands on the ground.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Cloudscape,
        (camera, projection): (&Part, u32),
        (tile, frame_px): (TileUniform, UVec2),
        ground: Option<(&Groundscape, &wgpu::Buffer)>,
    ) -> Arc<ViewNodes> {
        let gpu = recorder.gpu;
        let make = |size_px, pixels: u32| ViewNodes {
            buffer: gpu.buffer("cloud_view", bytes_of(size_px), wgpu::BufferUsages::STORAGE),
            done: (0..pixels).map(|_| AtomicBool::new(false)).collect(),
        };
        let whole = whole_frame(frame_px);
        let nodes = if whole.1 > 0.0 {
            let made_from = Fingerprint::of((
                ("cloud_view", scape.shape_fingerprint(), camera, projection),
                ground.map(|(ground, _)| ground.place_fingerprint()),
            ));
            self.memo.get_or_weighing(bytes_of(frame_px), made_from, || {
                make(frame_px, frame_px.x * frame_px.y)
            })
        } else {
            Arc::new(make(tile.size_px, 0))
        };
        if whole.1 > 0.0 && pixels_of(tile, frame_px).all(|at| nodes.done[at].load(Relaxed)) {
            return nodes;
        }
        let before = ground.map(|(_, lit_ground)| lit_ground);
        self.march(
            recorder,
            scape,
            (camera, projection),
            (tile, whole.1),
            (&nodes.buffer, before),
        );
        if whole.1 > 0.0 {
            pixels_of(tile, frame_px).for_each(|at| nodes.done[at].store(true, Relaxed));
        }
        nodes
    }

    fn march(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Cloudscape,
        (camera, projection): (&Part, u32),
        (tile, whole): (TileUniform, f64),
        (nodes, lit_ground): (&wgpu::Buffer, Option<&wgpu::Buffer>),
    ) {
        let gpu = recorder.gpu;
        let parts = scape.upload(gpu);
        let (camera, place) = (camera.upload(gpu, "camera"), Part::new(&tile).upload(gpu, "tile"));
        let nothing = gpu.buffer("unused", 16, wgpu::BufferUsages::STORAGE);
        let mut binds = scape.march_binds(&parts);
        binds.extend([
            Bind::Buffer(&camera),
            Bind::Buffer(&place),
            Bind::Buffer(&parts.observer),
            Bind::Buffer(nodes),
            Bind::Buffer(lit_ground.unwrap_or(&nothing)),
        ]);
        let constants = [
            scape.one_layer(),
            ("WHOLE_FRAME", whole),
            ("PROJECTION", f64::from(projection)),
            ("GROUND", f64::from(u8::from(lit_ground.is_some()))),
        ];
        let kernel = self.kernels.get(gpu, &constants);
        recorder.dispatch(kernel, &binds, [tile.size_px.x, tile.size_px.y, 1]);
    }
}
