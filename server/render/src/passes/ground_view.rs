//! What stands on the ground before every pixel of a tile, or along each direction of a list.

use crate::{
    groundscape::Groundscape,
    kernel::{Bind, Recorder, Variants},
    shader,
    uniforms::{Part, TileUniform},
};
use glam::UVec2;

/// Where it is looked.
#[derive(Clone, Copy)]
pub(crate) enum Looks<'a> {
    /// Through each pixel: the camera, its projection, the tile, and the size of the whole frame.
    Tile(&'a Part, u32, TileUniform, UVec2),
    /// A direction in a vector of four floats, and how many there are.
    List(&'a wgpu::Buffer, u32),
}

impl Looks<'_> {
    pub(crate) fn threads(&self) -> [u32; 3] {
        match self {
            Self::Tile(_, _, tile, _) => [tile.size_px.x, tile.size_px.y, 1],
            Self::List(_, count) => [*count, 1, 1],
        }
    }

    pub(crate) fn count(&self) -> u64 {
        let [x, y, _] = self.threads();
        u64::from(x) * u64::from(y)
    }

    pub(crate) fn constants(&self) -> [(&'static str, f64); 2] {
        match self {
            Self::Tile(_, projection, ..) => [("PROJECTION", f64::from(*projection)), ("LIST", 0.0)],
            Self::List(..) => [("PROJECTION", 0.0), ("LIST", 1.0)],
        }
    }

    /// Camera, tile, and directions; what a variant does not read is empty.
    pub(crate) fn upload(&self, gpu: &crate::gpu::Gpu) -> [wgpu::Buffer; 3] {
        let nothing = TileUniform {
            origin_px: UVec2::ZERO,
            size_px: UVec2::ONE,
            stride_px: 1,
        };
        let empty = || {
            gpu.buffer(
                "unused",
                256,
                wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::UNIFORM,
            )
        };
        match self {
            Self::Tile(camera, _, tile, _) => [
                camera.upload(gpu, "camera"),
                Part::new(tile).upload(gpu, "tile"),
                empty(),
            ],
            Self::List(directions, _) => [
                empty(),
                Part::new(&nothing).upload(gpu, "tile"),
                (*directions).clone(),
            ],
        }
    }
}

/// Of what is seen in one direction; the first four are the distance.
pub(crate) const SEEN_BYTES: u64 = 24;

pub(crate) struct GroundView {
    kernels: Variants,
}

impl GroundView {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::GROUND_VIEW),
        }
    }

    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Groundscape,
        looks: Looks<'_>,
    ) -> wgpu::Buffer {
        let gpu = recorder.gpu;
        let seen = gpu.buffer(
            "ground_view",
            SEEN_BYTES * looks.count(),
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        );
        let [camera, tile, directions] = looks.upload(gpu);
        let ground = scape.ground.upload(gpu, "ground");
        let (stand, skin) = (scape.stand.upload(gpu, "stand"), scape.skin.upload(gpu, "skin"));
        let shadow = scape.shadow.upload(gpu);
        let binds = [
            Bind::Buffer(&ground),
            Bind::Buffer(&shadow.0),
            Bind::Buffer(&shadow.1),
            Bind::Buffer(&scape.terrains.shape.words),
            Bind::Buffer(&scape.terrains.shape.finder),
            Bind::Buffer(&camera),
            Bind::Buffer(&tile),
            Bind::Buffer(&stand),
            Bind::Buffer(&skin),
            Bind::Buffer(&directions),
            Bind::Buffer(&seen),
            Bind::Buffer(&scape.terrains.shape.cover[0]),
            Bind::Buffer(&scape.terrains.shape.cover[1]),
            Bind::Buffer(&scape.terrains.shape.cover[2]),
        ];
        let mut constants = vec![("SHAPE", scape.terrains.shape.code)];
        constants.extend(scape.shadow.constants());
        constants.extend(looks.constants());
        let kernel = self.kernels.get(gpu, &constants);
        recorder.dispatch(kernel, &binds, looks.threads());
        seen
    }
}
