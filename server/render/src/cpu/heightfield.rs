//! Twin of `lib/heightfield.wgsl`: patch after patch along the ray, with the sphere as it is.

use crate::ground::Field;
use glam::{DVec2, DVec3, USizeVec2};

/// Roundings of f64 at the planet's radius are a nanometre.
const CLOSE_M: f64 = 1e-7;

pub(crate) struct Caster<'a> {
    pub(crate) field: &'a Field,
    pub(crate) radius_m: f64,
}

impl Caster<'_> {
    fn vertex(&self, at: USizeVec2) -> f64 {
        f64::from(self.field.heights_m[at.y * (self.field.cells.x + 1) + at.x])
    }

    /// Height of the ray over the sphere less that of the patch.
    fn over(&self, cell: USizeVec2, p: DVec3) -> f64 {
        let share = (p.truncate() + self.field.extent_m / 2.0) / self.field.cell_m() - cell.as_dvec2();
        let [sw, se, nw, ne] =
            [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| self.vertex(cell + USizeVec2::new(x, y)));
        let south = sw + share.x * (se - sw);
        let north = nw + share.x * (ne - nw);
        let squared = p.truncate().length_squared();
        let fall = squared / (self.radius_m + (self.radius_m.powi(2) - squared).sqrt());
        p.z + fall - (south + share.y * (north - south))
    }

    /// Where within a patch, between two ways, the ray falls through the surface.
    fn within(&self, cell: USizeVec2, p: DVec3, d: DVec3, from: f64, to: f64) -> Option<f64> {
        // A quadratic has one minimum or maximum; of the pieces about it each holds one root at most.
        let f = |t: f64| self.over(cell, p + t * d);
        let (a, m, b) = (f(from), f(0.5 * (from + to)), f(to));
        let (bend, slope) = (2.0 * (a - 2.0 * m + b), 4.0 * m - 3.0 * a - b);
        let turn = if bend == 0.0 { 0.5 } else { -slope / (2.0 * bend) };
        let turn = from + turn.clamp(0.0, 1.0) * (to - from);
        [(from, turn), (turn, to)]
            .into_iter()
            .find_map(|(mut low, mut high)| {
                if f(low) < -CLOSE_M || f(high) > 0.0 {
                    return None;
                }
                for _ in 0..80 {
                    let middle = 0.5 * (low + high);
                    if f(middle) > 0.0 {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                Some(high)
            })
    }

    /// The way to the first place where the ray falls through the field.
    pub(crate) fn cast(&self, p: DVec3, d: DVec3) -> Option<f64> {
        let half = self.field.extent_m / 2.0;
        let cell_m = self.field.cell_m();
        // All ways at which a row or a column of patches is entered.
        let mut crossings = Vec::new();
        for axis in 0..2 {
            if d[axis] != 0.0 {
                for k in 0..=self.field.cells[axis] {
                    #[allow(clippy::cast_precision_loss, reason = "patches are few")]
                    crossings.push((k as f64 * cell_m[axis] - half[axis] - p[axis]) / d[axis]);
                }
            }
        }
        crossings.retain(|t| *t > 0.0);
        crossings.push(0.0);
        crossings.sort_by(f64::total_cmp);
        crossings.push(crossings.last().copied().unwrap_or(0.0) + 1e6);
        crossings.windows(2).find_map(|pair| {
            let middle = p + 0.5 * (pair[0] + pair[1]) * d;
            let place: DVec2 = (middle.truncate() + half) / cell_m;
            if place.cmplt(DVec2::ZERO).any() || place.cmpge(self.field.cells.as_dvec2()).any() {
                return None;
            }
            self.within(place.as_usizevec2(), p, d, pair[0], pair[1])
        })
    }
}
