//! The dome of a preview's clouds: the sphere of directions in blocks, each followed when somebody first looks there. When
//! the camera turns, what is there stays; when the sun moves, the blocks before the camera are lit anew and no ray is
//! followed again.

use crate::{
    cloudscape::Cloudscape,
    gpu::{Gpu, Shape},
    kernel::Recorder,
    lens::Lens,
    memo::Fingerprint,
    passes::{
        Table,
        cloud_dome::{CloudDome, NODE_FLOATS},
        cloud_dome_light::CloudDomeLight,
    },
    shader::Texel,
    sunlight::DiscsLeft,
    uniforms::{Part, clouds::DomeUniform, narrow},
};
use glam::{DVec2, DVec3, UVec2};
use std::collections::{HashMap, VecDeque};

/// `BLOCK_CELLS` of `lib/dome.wgsl`.
const BLOCK_CELLS: u32 = 16;
const BLOCK_SIDE: u32 = BLOCK_CELLS + 1;
const BLOCK_CORNERS: u32 = BLOCK_SIDE * BLOCK_SIDE;
/// `BLOCKS_IN_ROW` of `lib/dome.wgsl`.
const BLOCKS_IN_ROW: u32 = 32;
/// Domes that are kept: several viewers share the device.
const MOST_DOMES: usize = 2;
/// Blocks of one dome, 32 KB each.
const BLOCKS: std::ops::RangeInclusive<u32> = 256..=3072;
/// Cells to the side of a dome.
const CELLS: std::ops::RangeInclusive<u32> = 64..=4096;
/// Longer side of the smallest picture whose cells are as large as its pixels warrant. A smaller preview is enlarged where
/// it is shown: its cells are up to twice as fine, as if it were of that size.
const SEEN_PX: f64 = 900.0;
/// Pixels between the places at which the picture is asked where it looks.
const ASK_PX: u32 = 8;
/// Cells about such a place that are looked at: they are closer than pixels by no more than a projection stretches.
const REACH_CELLS: f64 = 6.0;

/// Where a frame finds its clouds.
#[derive(Clone)]
pub(crate) struct DomeView {
    pub(crate) cells: u32,
    /// True for an observer under all clouds.
    pub(crate) under_clouds: bool,
    /// Of the light of sun and moon.
    pub(crate) discs_left: DiscsLeft,
    pub(crate) pages: wgpu::Buffer,
    pub(crate) seen: wgpu::TextureView,
}

impl DomeView {
    pub(crate) fn uniform(&self) -> Part {
        uniform(self.cells, self.under_clouds, self.discs_left)
    }
}

fn uniform(cells: u32, under_clouds: bool, left: DiscsLeft) -> Part {
    Part::new(&DomeUniform {
        cells,
        sun_left: narrow(left.sun),
        moon_left: narrow(left.moon),
        under_clouds: u32::from(under_clouds),
    })
}

/// The clouds before a picture: by direction, or those of a tile by pixel.
#[derive(Clone, Copy)]
pub(crate) enum CloudsSeen<'a> {
    Dome(&'a DomeView),
    Tile(&'a Table),
}

/// Blocks that a pass is to do.
pub(crate) struct Blocks<'a> {
    pub(crate) dome: &'a wgpu::Buffer,
    pub(crate) list: wgpu::Buffer,
    pub(crate) nodes: &'a wgpu::Buffer,
    pub(crate) seen: &'a wgpu::TextureView,
    count: u32,
}

impl Blocks<'_> {
    pub(crate) const fn threads(&self) -> [u32; 3] {
        [BLOCK_CORNERS, self.count, 1]
    }
}

/// A block that is kept.
struct Kept {
    slot: u32,
    /// What lit it.
    lit_by: Option<Fingerprint>,
    /// The frame that last looked there.
    seen_at: u64,
}

struct Dome {
    made_from: Fingerprint,
    cells: u32,
    slots: u32,
    nodes: wgpu::Buffer,
    seen: wgpu::TextureView,
    blocks: HashMap<UVec2, Kept>,
}

pub(crate) struct CloudDomes {
    shape: CloudDome,
    light: CloudDomeLight,
    kept: VecDeque<Dome>,
    frames: u64,
}

/// The place of a direction on the square, 0 to 1: `dome_place` of `lib/dome.wgsl`.
pub(crate) fn dome_place(direction: DVec3) -> DVec2 {
    let p = direction.truncate() / direction.abs().element_sum();
    let sign = DVec2::select(p.cmpge(DVec2::ZERO), DVec2::ONE, DVec2::NEG_ONE);
    let folded = if direction.z < 0.0 {
        (1.0 - DVec2::new(p.y, p.x).abs()) * sign
    } else {
        p
    };
    0.5 + 0.5 * folded
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "of cells or blocks, of which there are few"
)]
const fn whole(value: f64) -> u32 {
    value as u32
}

/// Cells to a side, so that they are about as large as four pixels, which span that angle each.
fn cells_for(pixel_angle: f64, size_px: UVec2) -> u32 {
    let finer = (SEEN_PX / f64::from(size_px.max_element())).clamp(1.0, 2.0);
    let cells = (finer / pixel_angle).clamp(f64::from(*CELLS.start()), f64::from(*CELLS.end()));
    whole(cells).next_multiple_of(2 * BLOCK_CELLS)
}

/// The blocks that a picture looks at.
fn blocks_before(lens: &Lens, size_px: UVec2, cells: u32) -> Vec<UVec2> {
    let side = cells / BLOCK_CELLS;
    let mut there = vec![false; (side * side) as usize];
    let places =
        |length: u32| (0..=length.div_ceil(ASK_PX)).map(move |i| f64::from((i * ASK_PX).min(length)));
    for y in places(size_px.y) {
        for x in places(size_px.x) {
            let Some(direction) = lens.sight(DVec2::new(x, y)) else {
                continue;
            };
            let at = dome_place(direction) * f64::from(cells);
            let bound = |v: f64| whole(v.clamp(0.0, f64::from(cells - 1)) / f64::from(BLOCK_CELLS));
            for row in bound(at.y - REACH_CELLS)..=bound(at.y + REACH_CELLS) {
                for column in bound(at.x - REACH_CELLS)..=bound(at.x + REACH_CELLS) {
                    there[(row * side + column) as usize] = true;
                }
            }
        }
    }
    let all = (0..side).flat_map(|row| (0..side).map(move |column| UVec2::new(column, row)));
    all.zip(there)
        .filter_map(|(block, there)| there.then_some(block))
        .collect()
}

impl Dome {
    fn new(gpu: &Gpu, made_from: Fingerprint, cells: u32, wanted: u32) -> Self {
        let slots = wanted.next_power_of_two().clamp(*BLOCKS.start(), *BLOCKS.end());
        let corners = u64::from(slots) * u64::from(BLOCK_CORNERS);
        let size = [BLOCKS_IN_ROW, slots.div_ceil(BLOCKS_IN_ROW)].map(|blocks| BLOCK_SIDE * blocks);
        Self {
            made_from,
            cells,
            slots,
            nodes: gpu.buffer(
                "cloud_dome",
                4 * NODE_FLOATS * corners,
                wgpu::BufferUsages::STORAGE,
            ),
            seen: gpu.written(
                "cloud_dome_light",
                [size[0], size[1], 1],
                Shape::Flat,
                Texel::Float,
            ),
            blocks: HashMap::new(),
        }
    }

    /// Makes room for blocks that are not there, and gives them.
    fn admit(&mut self, wanted: &[UVec2], frame: u64) -> Vec<UVec2> {
        for block in wanted {
            if let Some(kept) = self.blocks.get_mut(block) {
                kept.seen_at = frame;
            }
        }
        let fresh: Vec<_> = wanted
            .iter()
            .filter(|block| !self.blocks.contains_key(block))
            .copied()
            .collect();
        let mut free: Vec<u32> = {
            let taken: std::collections::HashSet<u32> = self.blocks.values().map(|kept| kept.slot).collect();
            (0..self.slots).filter(|slot| !taken.contains(slot)).collect()
        };
        if free.len() < fresh.len() {
            // Those go first that nobody has looked at for longest.
            let mut oldest: Vec<_> = self
                .blocks
                .iter()
                .map(|(block, kept)| (kept.seen_at, *block))
                .collect();
            oldest.sort_by_key(|(seen_at, block)| (*seen_at, block.x, block.y));
            for (_, block) in oldest.into_iter().take(fresh.len() - free.len()) {
                free.extend(self.blocks.remove(&block).map(|kept| kept.slot));
            }
        }
        for (block, slot) in fresh.iter().zip(free) {
            self.blocks.insert(
                *block,
                Kept {
                    slot,
                    lit_by: None,
                    seen_at: frame,
                },
            );
        }
        fresh
    }

    fn list(&self, gpu: &Gpu, blocks: &[UVec2]) -> wgpu::Buffer {
        let rows: Vec<[u32; 4]> = blocks
            .iter()
            .filter_map(|block| Some([block.x, block.y, self.blocks.get(block)?.slot, 0]))
            .collect();
        gpu.filled("blocks", bytemuck::cast_slice(&rows), wgpu::BufferUsages::STORAGE)
    }

    fn pages(&self, gpu: &Gpu) -> wgpu::Buffer {
        let side = self.cells / BLOCK_CELLS;
        let mut pages = vec![0_u32; (side * side) as usize];
        for (block, kept) in &self.blocks {
            pages[(block.y * side + block.x) as usize] = kept.slot;
        }
        gpu.filled("pages", bytemuck::cast_slice(&pages), wgpu::BufferUsages::STORAGE)
    }
}

impl CloudDomes {
    pub(crate) const fn new() -> Self {
        Self {
            shape: CloudDome::new(),
            light: CloudDomeLight::new(),
            kept: VecDeque::new(),
            frames: 0,
        }
    }

    /// Sees to it that all is there that a picture looks at.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Cloudscape,
        lens: &Lens,
        size_px: UVec2,
        pixel_angle: f64,
    ) -> DomeView {
        let gpu = recorder.gpu;
        self.frames += 1;
        let mut cells = cells_for(pixel_angle, size_px);
        let mut wanted = blocks_before(lens, size_px, cells);
        while wanted.len() > *BLOCKS.end() as usize {
            cells = (cells / 2).next_multiple_of(2 * BLOCK_CELLS);
            wanted = blocks_before(lens, size_px, cells);
        }
        let count = |blocks: &[UVec2]| u32::try_from(blocks.len()).unwrap_or(u32::MAX);
        let made_from = Fingerprint::of((scape.shape_fingerprint(), cells));
        let fits = |dome: &Dome| dome.made_from == made_from && dome.slots >= count(&wanted);
        let mut dome = self
            .kept
            .iter()
            .position(fits)
            .and_then(|at| self.kept.remove(at))
            .unwrap_or_else(|| Dome::new(gpu, made_from, cells, count(&wanted)));
        let fresh = dome.admit(&wanted, self.frames);
        let light = scape.fingerprint();
        let dark: Vec<_> = wanted
            .into_iter()
            .filter(|block| {
                dome.blocks
                    .get(block)
                    .is_some_and(|kept| kept.lit_by != Some(light))
            })
            .collect();
        let uniform = uniform(cells, scape.under_clouds, DiscsLeft::default());
        if !dark.is_empty() {
            let held = uniform.upload(gpu, "dome");
            let work = |blocks: &[UVec2]| Blocks {
                dome: &held,
                list: dome.list(gpu, blocks),
                nodes: &dome.nodes,
                seen: &dome.seen,
                count: count(blocks),
            };
            if !fresh.is_empty() {
                self.shape.run(recorder, scape, &work(&fresh));
            }
            self.light.run(recorder, scape, &work(&dark));
        }
        for block in dark {
            if let Some(kept) = dome.blocks.get_mut(&block) {
                kept.lit_by = Some(light);
            }
        }
        let view = DomeView {
            cells,
            under_clouds: scape.under_clouds,
            discs_left: DiscsLeft::default(),
            pages: dome.pages(gpu),
            seen: dome.seen.clone(),
        };
        self.kept.push_front(dome);
        self.kept.truncate(MOST_DOMES);
        view
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of one view at many sizes: what is shown enlarged is not blurred once more, and small pictures stay cheap.
    #[test]
    fn small_previews_have_finer_cells() {
        let cells = |width: u32| cells_for(1.0 / f64::from(width), UVec2::new(width, width / 2));
        assert_eq!(cells(550), cells(900));
        assert_eq!((cells(320), cells(1280)), (640, 1280));
        assert_eq!(cells(16), *CELLS.start());
    }
}
