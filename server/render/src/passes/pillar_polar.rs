//! How far the light of lamps goes before it meets something, about the axis from each to the observer.

use crate::{
    groundscape::Groundscape,
    kernel::{Bind, Recorder, Variants},
    memo::{Fingerprint, Memo},
    shader,
    uniforms::{Part, pillars::PolarUniform},
};
use std::sync::Arc;

/// The tables of all lamps.
pub(crate) struct Polar {
    pub(crate) words: wgpu::Buffer,
    pub(crate) uniform: Part,
    pub(crate) made_from: Fingerprint,
}

pub(crate) struct PillarPolar {
    kernels: Variants,
    memo: Memo<Polar>,
}

/// Planes to a side and rows of a table: fewer where there are many lamps, so that the rays of all are about a million.
const fn fineness(lamps: usize) -> (u32, u32) {
    match lamps {
        0..=400 => (9, 72),
        401..=2_000 => (5, 48),
        _ => (3, 24),
    }
}

impl PillarPolar {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::PILLAR_POLAR),
            memo: Memo::new(3),
        }
    }

    /// Of `count` lamps; `ice` is what the plates are, `own` the observer's frame.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Groundscape,
        (lamps, count): (&wgpu::Buffer, usize),
        (ice, own, sin_max): (&Part, &Part, f32),
        lamps_from: Fingerprint,
    ) -> Arc<Polar> {
        let (columns, rows) = fineness(count);
        let words = 2 * columns * (rows + 1) + 1;
        let uniform = Part::new(&PolarUniform {
            columns,
            rows,
            sin_max,
            words,
        });
        let shape = scape.terrains.shape.made_from;
        let made_from = Fingerprint::of((
            "pillar_polar",
            shape,
            (&scape.ground, ice, own, &uniform),
            lamps_from,
        ));
        self.memo.get_or(made_from, || {
            let gpu = recorder.gpu;
            let table = gpu.buffer(
                "pillar_polar",
                4 * u64::from(words) * count.max(1) as u64,
                wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            );
            let ground = scape.ground.upload(gpu, "ground");
            let (ice, own) = (ice.upload(gpu, "ice"), own.upload(gpu, "own"));
            let polar = uniform.upload(gpu, "polar");
            let binds = [
                Bind::Buffer(&ground),
                Bind::Buffer(&ice),
                Bind::Buffer(lamps),
                Bind::Buffer(&scape.terrains.shape.words),
                Bind::Buffer(&scape.terrains.shape.finder),
                Bind::Buffer(&own),
                Bind::Buffer(&table),
                Bind::Buffer(&polar),
            ];
            let kernel = self.kernels.get(gpu, &[("SHAPE", scape.terrains.shape.code)]);
            let count = u32::try_from(count).unwrap_or(u32::MAX);
            recorder.dispatch(kernel, &binds, [words, count, 1]);
            Polar {
                words: table,
                uniform: uniform.clone(),
                made_from,
            }
        })
    }
}
