//! Where the next scattering may happen: a probability density along a ray that is close to what the light does and
//! is known exactly. Nothing in it needs to be right, since each sample is weighed by the true over the proposed
//! density; it only needs to be positive wherever the air scatters.

use crate::{line::Span, medium::Medium, random::Random};
use glam::DVec3;

/// Stands for zero where something is divided by it.
const LEAST: f64 = 1e-290;

/// Spherical shells of nearly constant density.
#[derive(Clone, Debug)]
pub(crate) struct Shells {
    /// Their lower bounds' radii and the last one's upper bound, metres.
    radii_m: Vec<f64>,
    scattering_per_m: Vec<DVec3>,
    extinction_per_m: Vec<DVec3>,
}

/// A ray cut by the shells, with the probability, band by band, that light scatters in each piece.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cells {
    start: f64,
    cells: Vec<Cell>,
    /// Sum of all probabilities, that of reaching the ground included.
    total: DVec3,
    ground: DVec3,
}

#[derive(Clone, Copy, Debug)]
struct Cell {
    /// Where it ends; it begins where the one before it ends.
    end: f64,
    extinction_per_m: DVec3,
    depth: DVec3,
    mass: DVec3,
}

/// A place for the next event and its probability density per band.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Next {
    /// Scattering in the air at s; density per metre.
    Air(f64, DVec3),
    /// The ground; probability.
    Ground(DVec3),
}

impl Shells {
    /// `per_scale_height` shells for each factor e of density.
    pub(crate) fn new(medium: &Medium, per_scale_height: f64) -> Self {
        let top_m = medium.top_radius_m - medium.ground_radius_m;
        let mut heights_m = medium.corners_m();
        let (mie, rayleigh) = (medium.mie.scale_height_m, medium.rayleigh.scale_height_m);
        let mut height = 0.0;
        while height < top_m {
            heights_m.push(height);
            // Above eight of its scale heights a constituent no longer matters.
            let fine = [mie, rayleigh]
                .into_iter()
                .filter(|scale| height < 8.0 * scale)
                .fold(f64::MAX, f64::min);
            let scale = if fine < f64::MAX { fine } else { mie.max(rayleigh) };
            height += scale / per_scale_height;
        }
        heights_m.sort_by(f64::total_cmp);
        heights_m.dedup_by(|a, b| *a - *b < 1.0);
        let middles = || heights_m.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let scattering = |height: f64| {
            let (molecules, aerosols) = medium.scattering_per_m(height);
            molecules + aerosols
        };
        Self {
            scattering_per_m: middles().map(scattering).collect(),
            extinction_per_m: middles().map(|height| medium.extinction_per_m(height)).collect(),
            radii_m: heights_m
                .iter()
                .map(|height| medium.ground_radius_m + height)
                .collect(),
        }
    }
}

impl Cells {
    /// Cuts a span. `ground` is how much arriving at the ground counts, against scattering with an albedo of 1.
    pub(crate) fn cut(&mut self, shells: &Shells, span: &Span, ground: f64) {
        self.cells.clear();
        self.start = span.start;
        let line = &span.line;
        let last = shells.scattering_per_m.len() - 1;
        let above = |radius: f64| shells.radii_m.partition_point(|bound| *bound <= radius);
        let mut shell = above(line.radius(span.start)).clamp(1, last + 1) - 1;
        let mut state = (span.start, DVec3::ONE, DVec3::ZERO);
        // Inwards to the shell of the nearest point.
        while state.0 < 0.0 && line.p2 < shells.radii_m[shell] * shells.radii_m[shell] && shell > 0 {
            let end = -line.reach(shells.radii_m[shell]);
            self.push(shells, shell, end.min(span.end), &mut state);
            shell -= 1;
        }
        // Through it, and outwards.
        while state.0 < span.end && shell <= last {
            let end = line.reach(shells.radii_m[shell + 1]);
            let end = if shell == last || end > span.end {
                span.end
            } else {
                end
            };
            self.push(shells, shell, end, &mut state);
            shell += 1;
        }
        self.ground = if span.ground {
            state.1 * ground
        } else {
            DVec3::ZERO
        };
        self.total = state.2 + self.ground;
    }

    fn push(&mut self, shells: &Shells, shell: usize, end: f64, state: &mut (f64, DVec3, DVec3)) {
        let (start, transmittance, sum) = *state;
        if end <= start {
            return;
        }
        let extinction_per_m = shells.extinction_per_m[shell];
        let depth = extinction_per_m * (end - start);
        let (mut through, mut mean) = (DVec3::ZERO, DVec3::ZERO);
        for band in 0..3 {
            let depth = depth[band];
            // (1 - e^-τ)/τ; a series is nearly right for small τ, which is all that is needed here.
            mean[band] = if depth < 0.2 {
                1.0 - depth * (1.0 / 2.0 - depth * (1.0 / 6.0))
            } else {
                -(-depth).exp_m1() / depth
            };
            // Positive even where e^-τ is not.
            through[band] = (1.0 - depth * mean[band]).max(LEAST);
        }
        let mass = shells.scattering_per_m[shell] * (end - start) * mean * transmittance;
        self.cells.push(Cell {
            end,
            extinction_per_m,
            depth,
            mass,
        });
        *state = (
            end,
            (transmittance * through).max(DVec3::splat(LEAST)),
            sum + mass,
        );
    }

    /// Draws a place with one band's density, from `u` in [0, 1). None if that band meets nothing.
    pub(crate) fn sample(&self, band: usize, u: f64, random: &mut Random) -> Option<Next> {
        let total = self.total[band];
        if total <= 0.0 || total.is_nan() {
            return None;
        }
        let mut left = u * total;
        let mut start = self.start;
        for cell in &self.cells {
            if left < cell.mass[band] {
                let depth = cell.depth[band];
                let share = random.unit();
                // Truncated exponential: x = -ln(1 - u (1 - e^-τ))/σ, uniform where τ is small.
                let x = if depth < 1e-3 {
                    share * (cell.end - start)
                } else {
                    -(share * (-depth).exp_m1()).ln_1p() / cell.extinction_per_m[band]
                };
                let s = (start + x).min(cell.end);
                return Some(Next::Air(
                    s,
                    cell.mass / self.total.max(DVec3::splat(LEAST))
                        * cell.density(s - start, cell.end - start),
                ));
            }
            left -= cell.mass[band];
            start = cell.end;
        }
        // Rounding may leave a remainder where there is no ground.
        (self.ground[band] > 0.0).then(|| Next::Ground(self.ground / self.total.max(DVec3::splat(LEAST))))
    }
}

impl Cell {
    /// Density per metre at a way x into the cell, given that the cell is hit.
    fn density(&self, x: f64, length: f64) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|band| {
            let (depth, per_m) = (self.depth[band], self.extinction_per_m[band]);
            if depth < 1e-3 {
                1.0 / length
            } else {
                per_m * (-per_m * x).exp() / -(-depth).exp_m1()
            }
        }))
    }
}
