//! The air and the ground in SI units, and the optical depth of any stretch of it.

use crate::{
    gauss::Rule,
    line::{Line, Span},
};
use glam::DVec3;

/// Scale heights above the ground at which an exponential layer counts as ended: e^-18 is 1.5e-8.
const EXPONENTIAL_ENDS: f64 = 18.0;

/// A constituent whose density falls as e^(-h / scale height).
#[derive(Clone, Copy, Debug)]
pub struct Exponential {
    /// Metres.
    pub scale_height_m: f64,
    /// At the ground, per band, 1/m.
    pub scattering_per_m: DVec3,
    /// Scattering and absorption at the ground, 1/m.
    pub extinction_per_m: DVec3,
}

/// An absorber whose density rises and falls linearly about a height.
#[derive(Clone, Copy, Debug)]
pub struct Tent {
    /// At the centre, 1/m.
    pub absorption_per_m: DVec3,
    /// Metres above the ground.
    pub centre_m: f64,
    /// From the centre to either end, metres.
    pub half_width_m: f64,
}

/// A homogeneous layer on the ground, with the aerosols' phase function.
#[derive(Clone, Copy, Debug)]
pub struct Layer {
    /// Metres above the ground.
    pub top_m: f64,
    /// 1/m.
    pub scattering_per_m: DVec3,
    /// 1/m.
    pub extinction_per_m: DVec3,
}

/// The planet's air. The ground's albedo is not part of it: one estimate serves several albedos.
#[derive(Clone, Debug)]
pub struct Medium {
    /// Metres.
    pub ground_radius_m: f64,
    /// No air lies outside this radius, metres.
    pub top_radius_m: f64,
    /// Molecules.
    pub rayleigh: Exponential,
    /// Aerosols.
    pub mie: Exponential,
    /// The aerosols' asymmetry.
    pub asymmetry: f64,
    /// Ozone.
    pub ozone: Option<Tent>,
    /// Haze.
    pub haze: Option<Layer>,
    rule: Rule<12>,
}

impl Medium {
    /// Air on a sphere.
    pub fn new(
        (ground_radius_m, top_m): (f64, f64),
        rayleigh: Exponential,
        (mie, asymmetry): (Exponential, f64),
        ozone: Option<Tent>,
        haze: Option<Layer>,
    ) -> Self {
        Self {
            ground_radius_m,
            top_radius_m: ground_radius_m + top_m,
            rayleigh,
            mie,
            asymmetry,
            ozone,
            haze: haze.filter(|haze| haze.extinction_per_m.max_element() > 0.0),
            rule: Rule::new(),
        }
    }

    /// Scattering coefficients of molecules and of aerosols with the haze, per band, 1/m.
    pub fn scattering_per_m(&self, altitude_m: f64) -> (DVec3, DVec3) {
        let density = |layer: &Exponential| (-altitude_m / layer.scale_height_m).exp();
        let haze = self.haze.filter(|haze| altitude_m < haze.top_m);
        (
            self.rayleigh.scattering_per_m * density(&self.rayleigh),
            self.mie.scattering_per_m * density(&self.mie)
                + haze.map_or(DVec3::ZERO, |haze| haze.scattering_per_m),
        )
    }

    /// Extinction coefficient per band, 1/m.
    pub fn extinction_per_m(&self, altitude_m: f64) -> DVec3 {
        let density = |layer: &Exponential| (-altitude_m / layer.scale_height_m).exp();
        let haze = self.haze.filter(|haze| altitude_m < haze.top_m);
        let ozone = self.ozone.map_or(DVec3::ZERO, |tent| {
            let away = (altitude_m - tent.centre_m).abs() / tent.half_width_m;
            tent.absorption_per_m * (1.0 - away).max(0.0)
        });
        self.rayleigh.extinction_per_m * density(&self.rayleigh)
            + self.mie.extinction_per_m * density(&self.mie)
            + haze.map_or(DVec3::ZERO, |haze| haze.extinction_per_m)
            + ozone
    }

    /// Heights at which a coefficient or its slope jumps, metres.
    pub fn corners_m(&self) -> Vec<f64> {
        let tent = self
            .ozone
            .iter()
            .flat_map(|tent| [-1.0, 0.0, 1.0].map(|side| tent.centre_m + side * tent.half_width_m));
        let top = self.top_radius_m - self.ground_radius_m;
        let corners = tent.chain(self.haze.iter().map(|haze| haze.top_m));
        corners
            .filter(|height| (0.0..top).contains(height))
            .chain([0.0, top])
            .collect()
    }

    /// What a ray sees of the air.
    pub(crate) fn span(&self, point: DVec3, direction: DVec3) -> Option<Span> {
        Span::of_ray(point, direction, self.ground_radius_m, self.top_radius_m)
    }

    /// e^-τ per band between two places on a line, both in the air.
    pub(crate) fn transmittance(&self, line: &Line, from: f64, to: f64) -> DVec3 {
        // The radius falls up to s = 0 and rises after, alike on both sides.
        let depth = if from < 0.0 && to > 0.0 {
            self.rising_depth(line, 0.0, -from) + self.rising_depth(line, 0.0, to)
        } else {
            let (a, b) = (from.abs(), to.abs());
            self.rising_depth(line, a.min(b), a.max(b))
        };
        (-depth).exp()
    }

    /// e^-τ per band from a point to space; none where the ground lies between.
    pub(crate) fn transmittance_to_space(&self, point: DVec3, direction: DVec3) -> Option<DVec3> {
        match self.span(point, direction) {
            None => Some(DVec3::ONE),
            Some(span) if span.ground => None,
            Some(span) => Some(self.transmittance(&span.line, span.start, span.end)),
        }
    }

    /// τ per band where the radius rises with s, 0 ≤ a ≤ b.
    fn rising_depth(&self, line: &Line, a: f64, b: f64) -> DVec3 {
        let mut depth = DVec3::ZERO;
        for layer in [&self.rayleigh, &self.mie] {
            depth += layer.extinction_per_m * self.exponential_column(line, (a, b), layer.scale_height_m);
        }
        if let Some(tent) = &self.ozone {
            depth += tent.absorption_per_m * self.tent_column(line, (a, b), tent);
        }
        if let Some(haze) = &self.haze {
            depth +=
                haze.extinction_per_m * (line.reach(self.ground_radius_m + haze.top_m).min(b) - a).max(0.0);
        }
        depth
    }

    /// ∫ e^(-h/H) ds. The exponent is at most quadratic in s and spans 18 at most, so that 12 nodes leave 1e-6.
    fn exponential_column(&self, line: &Line, (a, b): (f64, f64), scale_height_m: f64) -> f64 {
        let end = line.reach(self.ground_radius_m + EXPONENTIAL_ENDS * scale_height_m);
        let b = b.min(end);
        if a >= b {
            return 0.0;
        }
        let per_m = 1.0 / scale_height_m;
        self.rule
            .integrate(a, b, |s| ((self.ground_radius_m - line.radius(s)) * per_m).exp())
    }

    /// ∫ (1 - |h - c|/w) ds with ∫ r ds = (s r + p² ln(s + r))/2.
    fn tent_column(&self, line: &Line, (a, b): (f64, f64), tent: &Tent) -> f64 {
        let centre = self.ground_radius_m + tent.centre_m;
        let reach = |radius: f64| line.reach(radius).clamp(a, b);
        let middle = reach(centre);
        let side = |s0: f64, s1: f64, foot: f64| {
            if s0 >= s1 {
                return 0.0;
            }
            let (r0, r1) = (line.radius(s0), line.radius(s1));
            let integral = 0.5 * (s1 * r1 - s0 * r0 + line.p2 * ((s1 + r1) / (s0 + r0)).ln());
            (integral - foot * (s1 - s0)) / tent.half_width_m
        };
        let (low, high) = (centre - tent.half_width_m, centre + tent.half_width_m);
        side(reach(low), middle, low) - side(middle, reach(high), high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEPS: u32 = 100_000;

    /// Columns by brute force: midpoints.
    fn brute(medium: &Medium, line: &Line, a: f64, b: f64) -> DVec3 {
        let step = (b - a) / f64::from(STEPS);
        let depth: DVec3 = (0..STEPS)
            .map(|i| {
                let s = a + step * (f64::from(i) + 0.5);
                medium.extinction_per_m(line.radius(s) - medium.ground_radius_m) * step
            })
            .sum();
        (-depth).exp()
    }

    #[test]
    fn transmittance_agrees_with_brute_force_on_every_kind_of_line() {
        let layer = |height: f64, per_m: f64| Exponential {
            scale_height_m: height,
            scattering_per_m: DVec3::splat(per_m),
            extinction_per_m: DVec3::new(0.5, 1.0, 2.0) * per_m,
        };
        let tent = Tent {
            absorption_per_m: DVec3::splat(2e-6),
            centre_m: 25e3,
            half_width_m: 15e3,
        };
        let haze = Layer {
            top_m: 1e3,
            scattering_per_m: DVec3::splat(1e-5),
            extinction_per_m: DVec3::splat(2e-5),
        };
        let medium = Medium::new(
            (6.36e6, 1e5),
            layer(8e3, 1e-5),
            (layer(1.2e3, 1e-5), 0.8),
            Some(tent),
            Some(haze),
        );
        for altitude in [0.0, 5.0, 900.0, 1e4, 3e4, 4e5] {
            for cosine in [-1.0_f64, -0.5, -0.13, -0.05, -0.01, 0.0, 0.01, 0.1, 0.5, 1.0] {
                let direction = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
                let Some(span) = medium.span(DVec3::Z * (6.36e6 + altitude), direction) else {
                    continue;
                };
                let found = medium.transmittance(&span.line, span.start, span.end);
                let exact = brute(&medium, &span.line, span.start, span.end);
                // The midpoints miss the haze's edge by half a step, twice at most; 1e-6 is the quadrature's own.
                let step = (span.end - span.start) / f64::from(STEPS);
                assert!(
                    (found - exact).abs().max_element() < step * haze.extinction_per_m.x + 1e-6,
                    "{altitude} m, {cosine}: {found} for {exact}"
                );
            }
        }
    }
}
