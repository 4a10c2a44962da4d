//! What can be computed without chance: light scattered once, and sunlight off the ground.

use crate::{
    gauss::Rule,
    line::{Line, Span},
    medium::Medium,
    phase,
};
use glam::DVec3;
use std::f64::consts::PI;

/// Relative error of the adaptive quadrature.
const TOLERANCE: f64 = 1e-8;
/// Halvings of a piece at most: what lies in 2^-24 of it is below rounding.
const DEEPEST: u32 = 24;
/// Heights that cut every ray, metres, so that a piece spans a few scale heights at most.
const CUTS_M: [f64; 9] = [300.0, 1e3, 2.5e3, 5e3, 1e4, 2e4, 4e4, 6e4, 8e4];

/// Radiance per unit of the sun's irradiance that reaches a span's start after one scattering in the air, 1/sr.
pub(crate) fn single_scattering(medium: &Medium, span: &Span, sun: DVec3) -> DVec3 {
    let rule = Rule::<12>::new();
    let cosine = span.line.direction.dot(sun);
    let phases = (
        phase::rayleigh(cosine),
        phase::cornette_shanks(cosine, medium.asymmetry),
    );
    let source = |s: f64| {
        let point = span.line.point(s);
        let Some(sunlight) = medium.transmittance_to_space(point, sun) else {
            return DVec3::ZERO;
        };
        let (molecules, aerosols) = medium.scattering_per_m(point.length() - medium.ground_radius_m);
        (molecules * phases.0 + aerosols * phases.1)
            * sunlight
            * medium.transmittance(&span.line, span.start, s)
    };
    let cuts = cuts(medium, span, sun);
    let pieces = || cuts.windows(2).map(|piece| (piece[0], piece[1]));
    let rough: Vec<DVec3> = pieces().map(|(a, b)| piece(&rule, a, b, &source)).collect();
    let allowed = rough.iter().sum::<DVec3>() * TOLERANCE;
    pieces()
        .zip(&rough)
        .map(|((a, b), rough)| refined(&rule, (a, b), *rough, &source, allowed, DEEPEST))
        .sum()
}

/// Radiance that leaves a ground of albedo 1 under the sun alone, per unit of the sun's irradiance, 1/sr.
pub(crate) fn sunlit_ground(medium: &Medium, point: DVec3, sun: DVec3) -> DVec3 {
    let cosine = point.normalize().dot(sun);
    if cosine <= 0.0 {
        return DVec3::ZERO;
    }
    let sunlight = medium.transmittance_to_space(point, sun);
    sunlight.unwrap_or(DVec3::ZERO) * (cosine / PI)
}

/// Where a ray is cut: at its lowest point, at the heights where the air changes its slope, and where the sun's ray
/// to it grazes such a height, the ground's shadow first of all.
fn cuts(medium: &Medium, span: &Span, sun: DVec3) -> Vec<f64> {
    let line = &span.line;
    let mut cuts = vec![span.start, 0.0, span.end];
    for height in medium.corners_m().iter().chain(&CUTS_M) {
        let radius = medium.ground_radius_m + height;
        let reach = line.reach(radius);
        cuts.extend([-reach, reach]);
        cuts.extend(cylinder(line, sun, radius));
    }
    cuts.retain(|s| (span.start..=span.end).contains(s));
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    cuts
}

/// The places on a line whose distance from the axis through the planet's centre along `axis` is `radius`:
/// |x|² - (x·a)² = ρ² with x = n + s d, n·d = 0.
fn cylinder(line: &Line, axis: DVec3, radius: f64) -> Vec<f64> {
    let (along, nearest) = (line.direction.dot(axis), line.nearest.dot(axis));
    let (a, half_b) = (1.0 - along * along, -nearest * along);
    let c = line.p2 - nearest * nearest - radius * radius;
    let discriminant = half_b * half_b - a * c;
    if discriminant <= 0.0 || a < 1e-12 {
        return Vec::new();
    }
    let root = discriminant.sqrt();
    vec![(-half_b - root) / a, (-half_b + root) / a]
}

/// One piece. Where the sun's ray grazes a layer its way through the layer begins like a square root; the
/// substitution s = a + (b - a) u²(3 - 2u) makes that smooth at both ends.
fn piece(rule: &Rule<12>, a: f64, b: f64, f: &impl Fn(f64) -> DVec3) -> DVec3 {
    rule.integrate(0.0, 1.0, |u: f64| {
        f(a + (b - a) * u * u * (3.0 - 2.0 * u)) * (6.0 * u * (1.0 - u) * (b - a))
    })
}

/// Halves a piece until the halves' sum agrees with the whole.
fn refined(
    rule: &Rule<12>,
    (a, b): (f64, f64),
    whole: DVec3,
    f: &impl Fn(f64) -> DVec3,
    allowed: DVec3,
    depth: u32,
) -> DVec3 {
    let middle = 0.5 * (a + b);
    let (left, right) = (piece(rule, a, middle, f), piece(rule, middle, b, f));
    let change = (left + right - whole).abs();
    if depth == 0 || change.cmple(allowed).all() {
        return left + right;
    }
    refined(rule, (a, middle), left, f, allowed, depth - 1)
        + refined(rule, (middle, b), right, f, allowed, depth - 1)
}
