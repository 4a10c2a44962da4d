//! Which lamps' pillars a cell of 16×16 pixels may show.
//!
//! Seen from the observer a pillar is the wedge of directions v with |q_z| < sin δmax, where q is the normal of the plane of
//! v and the lamp, for as far as a layer's plates may turn the light. A cell is a cone of directions: a test of the cone is a
//! test of |q_z| widened by the cone's angle over that from the lamp, whatever the projection.

use crate::{
    lens::Lens,
    uniforms::{
        narrow, narrow3,
        pillars::{CrystalsUniform, LampUniform},
    },
};
use glam::{DMat3, DVec2, DVec3, UVec2};
use std::f64::consts::PI;

/// Pixels to a side of a cell, as `pillars.wgsl` has it.
pub(crate) const CELL_PX: u32 = 16;
/// Cells to a side of a block, whose cone is tested first.
const BLOCK: u32 = 8;
/// As `pillars.wgsl` numbers them.
pub(crate) const IN_PILLAR: u32 = 0x8000_0000;
pub(crate) const NEAR_LAMP: u32 = 0x4000_0000;
/// As far as a lamp's veil is drawn, radians.
const VEIL: f64 = 1.5 * PI / 180.0;

/// Lamps of each cell, row after row.
#[derive(Debug, Default)]
pub(crate) struct Cells {
    pub(crate) across: u32,
    /// Where each cell's list begins, and where the last one ends.
    pub(crate) begins: Vec<u32>,
    pub(crate) lamps: Vec<u32>,
    /// The cell of each entry.
    pub(crate) owners: Vec<u32>,
    /// About what each cell sees: a direction in the observer's own frame, and an angle.
    pub(crate) cones: Vec<[f32; 4]>,
}

/// A cone of directions.
#[derive(Clone, Copy, Debug)]
struct Cone {
    middle: DVec3,
    angle: f64,
    sin: f64,
    cos: f64,
}

impl Cone {
    /// About what a rectangle of pixels shows; none where it shows nothing.
    fn about(lens: &Lens, to_own: &DMat3, from: DVec2, size: DVec2) -> Option<Self> {
        let places = (0..25_u32).map(|i| DVec2::new(f64::from(i % 5), f64::from(i / 5)) / 4.0);
        // A cubemap's faces end at whole pixels; a hair inside is the same face.
        let sights: Vec<DVec3> = places
            .filter_map(|p| lens.sight(from + (p * 0.9998 + 0.0001) * size))
            .map(|d| *to_own * d)
            .collect();
        let middle = sights.iter().sum::<DVec3>().try_normalize()?;
        let cos = sights.iter().map(|s| s.dot(middle)).fold(1.0, f64::min);
        // What lies between the places seen bulges out by less than that.
        let angle = (cos.clamp(-1.0, 1.0).acos() * 1.1 + 1e-6).min(PI);
        let (sin, cos) = angle.sin_cos();
        Some(Self {
            middle,
            angle,
            sin,
            cos,
        })
    }
}

/// What of a lamp the test needs.
struct Wedge<'a> {
    layers: &'a [CrystalsUniform],
    d: f64,
    towards: DVec3,
    /// The image's spread to each side, metres.
    blur_m: f64,
    disc: f64,
}

impl Wedge<'_> {
    fn shown(&self, cone: &Cone) -> u32 {
        let along = self.towards.dot(cone.middle);
        let across = self.towards.cross(cone.middle);
        let sin_beta = across.length();
        // The blur widens what is near the lamp most: sin(β ± ρ) ≥ sin β cos ρ - sin ρ.
        let b = (self.d * (sin_beta * cone.cos - cone.sin)).max(self.blur_m);
        // sin(x + y) ≤ sin x + sin y, and q turns by the cone's angle over sin β.
        let may_mirror = |layer: &CrystalsUniform| {
            let sin_max = f64::from(layer.sin_max);
            let spread = if layer.law == 1 {
                0.5 * sin_max
            } else {
                f64::from(layer.sigma)
            };
            let widened = sin_max * (1.0 + (self.blur_m / (b * spread)).powi(2)).sqrt();
            across.z.abs() < widened * (sin_beta + cone.sin) + cone.sin || cone.angle > 0.5
        };
        let inside = self.layers.iter().any(may_mirror);
        let reach = cone.angle + self.disc;
        // cos x ≥ 1 - x²/2, so that no angle need be found.
        if !inside && along < 1.0 - 0.5 * reach * reach {
            return 0;
        }
        let beta = sin_beta.atan2(along);
        let near = if beta < reach { NEAR_LAMP } else { 0 };
        let pillar = inside
            && self
                .layers
                .iter()
                .any(|layer| may_mirror(layer) && (beta < cone.angle || self.reached(layer, cone, beta)));
        near | if pillar { IN_PILLAR } else { 0 }
    }

    /// Whether plates of the layer on the cone's rays may lie level enough.
    fn reached(&self, layer: &CrystalsUniform, cone: &Cone, beta: f64) -> bool {
        let rho = cone.angle;
        let (base_m, top_m) = (f64::from(layer.base_m), f64::from(layer.top_m));
        let elevation = cone.middle.z.clamp(-1.0, 1.0).asin();
        let (low, high) = ((elevation - rho).sin(), (elevation + rho).sin());
        // The farthest and the nearest place in the layer; beyond all places where a ray may be level.
        let far = if low <= 0.0 && high >= 0.0 {
            1e12
        } else if low > 0.0 {
            top_m / low
        } else {
            base_m / high
        };
        let near_m = if elevation > 0.0 {
            base_m / high.max(1e-9)
        } else {
            top_m / low.min(-1e-9)
        };
        if far <= 0.0 {
            return false;
        }
        let psi = |t: f64| 0.5 * ((t * beta.sin()).atan2(self.d - t * beta.cos()) - beta);
        let slack = 2.0 * rho + 0.01;
        let (from, to) = (psi(near_m.max(0.0)) - slack, psi(far) + slack);
        let Some(q) = self.towards.cross(cone.middle).try_normalize() else {
            return true;
        };
        let e2 = q.cross(self.towards);
        let psi0 = self.towards.z.atan2(e2.z);
        let reach = f64::from(layer.sin_max).asin();
        // Where the plane itself turns much within the cone, ψ0 does.
        let turn = (cone.sin / beta.sin().max(1e-6)).min(1.0).asin();
        let reach = reach * 1.1 + turn * self.towards.z.abs() + 0.002;
        [-PI, 0.0, PI]
            .iter()
            .any(|k| psi0 + k + reach > from && psi0 + k - reach < to)
    }
}

/// The lamps of every cell. `to_own` turns the world's directions into the observer's own frame, in which lamps and layers
/// are given.
pub(crate) fn cells(
    lens: &Lens,
    to_own: &DMat3,
    size_px: UVec2,
    lamps: &[LampUniform],
    layers: &[CrystalsUniform],
    pixel_angle: f64,
    veiled: bool,
) -> Cells {
    let count = (size_px + CELL_PX - 1) / CELL_PX;
    let blocks = (count + BLOCK - 1) / BLOCK;
    let cone = |from: UVec2, size: UVec2| {
        let end = (from + size).min(size_px);
        Cone::about(lens, to_own, from.as_dvec2(), (end - from).as_dvec2())
    };
    let cell_cones: Vec<Option<Cone>> = (0..count.x * count.y)
        .map(|i| {
            cone(
                UVec2::new(i % count.x, i / count.x) * CELL_PX,
                UVec2::splat(CELL_PX),
            )
        })
        .collect();
    let block_cones: Vec<Option<Cone>> = (0..blocks.x * blocks.y)
        .map(|i| {
            let side = BLOCK * CELL_PX;
            cone(UVec2::new(i % blocks.x, i / blocks.x) * side, UVec2::splat(side))
        })
        .collect();
    // Pairs of cell and entry, in the order of the lamps.
    let mut pairs: Vec<(u32, u32)> = Vec::new();
    for (which, lamp) in (0_u32..).zip(lamps) {
        let w = DVec3::from_array(lamp.place_m.map(f64::from));
        let d = w.length().max(1e-3);
        let radius_m = f64::from(lamp.radius_m);
        let veil = if veiled { VEIL } else { 0.0 };
        let wedge = Wedge {
            layers,
            d,
            towards: w / d,
            blur_m: (0.5 * radius_m).hypot(0.3 * pixel_angle * d),
            disc: (radius_m / d + 2.0 * pixel_angle).max(veil),
        };
        for (block, shape) in (0_u32..).zip(&block_cones) {
            if shape.as_ref().is_none_or(|cone| wedge.shown(cone) == 0) {
                continue;
            }
            let first = UVec2::new(block % blocks.x, block / blocks.x) * BLOCK;
            let end = (first + BLOCK).min(count);
            for cell in (first.y..end.y).flat_map(|y| (first.x..end.x).map(move |x| y * count.x + x)) {
                let shown = cell_cones[cell as usize].as_ref().map_or(0, |c| wedge.shown(c));
                if shown != 0 {
                    pairs.push((cell, which | shown));
                }
            }
        }
    }
    let mut begins = vec![0_u32; cell_cones.len() + 1];
    for (cell, _) in &pairs {
        begins[*cell as usize + 1] += 1;
    }
    for i in 1..begins.len() {
        begins[i] += begins[i - 1];
    }
    let mut next = begins.clone();
    let mut listed = vec![0_u32; pairs.len()];
    let mut owners = listed.clone();
    for (cell, entry) in pairs {
        let at = &mut next[cell as usize];
        listed[*at as usize] = entry;
        owners[*at as usize] = cell;
        *at += 1;
    }
    let cones = cell_cones
        .iter()
        .map(|cone| {
            cone.as_ref().map_or([0.0; 4], |cone| {
                narrow3(cone.middle.to_array())
                    .extend(narrow(cone.angle))
                    .to_array()
            })
        })
        .collect();
    Cells {
        across: count.x,
        begins,
        lamps: listed,
        owners,
        cones,
    }
}
