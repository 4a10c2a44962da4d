//! The second and higher orders of scattering, and the sky's light on the ground.

use super::Table;
use crate::{
    gpu::Gpu,
    kernel::{Bind, Recorder, Variants},
    memo::{Fingerprint, Memo},
    phase::convolved,
    quadrature::gauss_legendre,
    shader,
    uniforms::{OrderUniform, Part, narrow},
};
use std::sync::Arc;
use welkin_scene::{Quality, Scene};

/// Azimuths of view, as in `lib/source.wgsl`.
const VIEW_AZIMUTHS: u32 = 12;

/// Heights in the haze, as in `lib/tables.wgsl`.
const HAZE_ROWS: u32 = 16;

/// Angles of the convolved phase function.
const ANGLES: usize = 256;

/// The source function by sun, height and direction of view (`lib/source.wgsl`), and the irradiance of the ground by
/// sun, for a sun of unit irradiance.
pub(crate) struct MultiScattering {
    pub(crate) source: Table,
    pub(crate) irradiance: Table,
}

/// What a scene asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Wanted {
    quality: Quality,
    /// False: the first order alone, or no air.
    multiple: bool,
    haze: bool,
    /// Orders that are followed; the rest is a geometric series.
    orders: u32,
}

impl Wanted {
    pub(crate) fn new(scene: &Scene, quality: Quality, multiple: bool) -> Self {
        let haze_depth = scene
            .haze
            .as_ref()
            .map_or(0.0, |haze| haze.extinction() * haze.top_m);
        // Light goes through a depth τ of haze in about τ² scatterings, most of which change it little.
        let orders = [(0.5, 6), (2.0, 10), (8.0, 18)]
            .into_iter()
            .find(|(depth, _)| haze_depth < *depth)
            .map_or(32, |(_, orders)| orders);
        Self {
            quality,
            multiple,
            haze: haze_depth > 0.0,
            orders,
        }
    }
}

/// How finely one quality computes.
#[derive(Clone, Copy)]
struct Detail {
    suns: u32,
    heights: u32,
    view_angles: u32,
    /// Nodes on either side of the horizon and azimuths on one side of the sun, and steps along each ray: for the first
    /// order, and for the later ones, which are smoother.
    first: [u32; 2],
    first_steps: u32,
    later: [u32; 2],
    later_steps: u32,
}

const PREVIEW: Detail = Detail {
    suns: 24,
    heights: 12,
    view_angles: 8,
    first: [6, 6],
    first_steps: 10,
    later: [6, 4],
    later_steps: 6,
};
const FINAL: Detail = Detail {
    suns: 48,
    heights: 24,
    view_angles: 12,
    first: [8, 8],
    first_steps: 24,
    later: [6, 6],
    later_steps: 12,
};

pub(crate) struct MultiScatteringPass {
    kernels: Variants,
    memo: Memo<MultiScattering>,
}

impl MultiScatteringPass {
    pub(crate) fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::MULTI_SCATTERING),
            memo: Memo::new(8),
        }
    }

    /// `asymmetry` is that of the aerosols' phase function.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        air: &Part,
        asymmetry: f64,
        transmittance: &Table,
        wanted: Wanted,
    ) -> Arc<MultiScattering> {
        let made_from = Fingerprint::of(("multi_scattering", air, transmittance.made_from, wanted));
        let kernels = &mut self.kernels;
        self.memo.get_or(made_from, || {
            let made = |view| Table { view, made_from };
            let gpu = recorder.gpu;
            if !wanted.multiple {
                return MultiScattering {
                    source: made(gpu.table("no source", 2, 2, 2 * VIEW_AZIMUTHS)),
                    irradiance: made(gpu.table("no irradiance", 2, 1, 1)),
                };
            }
            let (source, irradiance) = follow(recorder, kernels, air, asymmetry, transmittance, wanted);
            MultiScattering {
                source: made(source),
                irradiance: made(irradiance),
            }
        })
    }
}

/// The nodes of the polar angle with their weights, and the convolved phase function.
pub(crate) fn lists(gpu: &Gpu, polar: u32, asymmetry: f64) -> [wgpu::Buffer; 2] {
    let list = |label: &str, values: &[f32]| {
        gpu.filled(label, bytemuck::cast_slice(values), wgpu::BufferUsages::STORAGE)
    };
    let nodes: Vec<f32> = gauss_legendre(polar as usize)
        .into_iter()
        .flat_map(|(x, weight)| [narrow(x), narrow(weight)])
        .collect();
    [
        list("nodes", &nodes),
        list("twice scattered", &convolved(asymmetry, ANGLES)),
    ]
}

/// One dispatch an order.
fn follow(
    recorder: &mut Recorder<'_>,
    kernels: &mut Variants,
    air: &Part,
    asymmetry: f64,
    transmittance: &Table,
    wanted: Wanted,
) -> (wgpu::TextureView, wgpu::TextureView) {
    let gpu = recorder.gpu;
    let detail = match wanted.quality {
        Quality::Preview => PREVIEW,
        Quality::Final => FINAL,
    };
    let rows = detail.heights + if wanted.haze { HAZE_ROWS } else { 0 };
    let views = detail.view_angles * VIEW_AZIMUTHS;
    let [first_nodes, twice_scattered] = lists(gpu, detail.first[0], asymmetry);
    let [later_nodes, _] = lists(gpu, detail.later[0], asymmetry);
    let air = air.upload(gpu, "air");
    let cells = 2 * u64::from((views + 1) * detail.suns * rows);
    let sums = gpu.buffer("sums of the orders", 16 * cells, wgpu::BufferUsages::STORAGE);
    let new_pair = || {
        (
            gpu.table("multi_scattering", detail.suns, rows, views),
            gpu.table("irradiance", detail.suns, 1, 1),
        )
    };
    let mut before = new_pair();
    let mut after = new_pair();
    // A ray through haze is cut into pieces, which share its steps.
    let steps_share = if wanted.haze { 2 } else { 1 };
    for index in 1..=wanted.orders {
        let order = OrderUniform {
            last: u32::from(index == wanted.orders),
            steps: steps_share
                * if index == 1 {
                    detail.first_steps
                } else {
                    detail.later_steps
                },
        };
        let order = Part::new(&order).upload(gpu, "order");
        let first = index == 1;
        let (nodes, [polar, azimuths]) = if first {
            (&first_nodes, detail.first)
        } else {
            (&later_nodes, detail.later)
        };
        let constants = [
            ("FIRST", f64::from(u8::from(first))),
            ("HAZE", f64::from(u8::from(wanted.haze))),
            ("POLAR", f64::from(polar)),
            ("AZIMUTHS", f64::from(azimuths)),
        ];
        let kernel = kernels.get(gpu, &constants);
        let binds = [
            Bind::Buffer(&air),
            Bind::Buffer(&order),
            Bind::Table(&transmittance.view),
            Bind::LinearClamp,
            Bind::Table(&before.0),
            Bind::Table(&before.1),
            Bind::Table(&after.0),
            Bind::Table(&after.1),
            Bind::Buffer(&sums),
            Bind::Buffer(nodes),
            Bind::Buffer(&twice_scattered),
        ];
        recorder.dispatch_groups(kernel, &binds, [detail.suns, rows, 1]);
        std::mem::swap(&mut before, &mut after);
    }
    before
}
