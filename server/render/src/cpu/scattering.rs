//! Twin of `lib/scattering.wgsl` and of what `probe.wgsl` makes of it, by brute force.

use super::{
    air::{air, coefficients, transmittance_to_space},
    geometry::{Ray, in_shadow},
    phase::{cornette_shanks, rayleigh},
};
use glam::DVec3;
use std::f64::consts::PI;
use welkin_scene::{Atmosphere, Scene};

/// What is seen in one direction, light scattered once and the ground lit by the sun alone, for a sun of unit
/// irradiance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub(crate) radiance: [f64; 3],
    pub(crate) transmittance: [f64; 3],
}

/// Steps in each even piece of the ray, and the Gauss-Legendre nodes and weights in each step.
const STEPS: u32 = 30;
const GAUSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_3, 5.0 / 18.0),
    (0.5, 8.0 / 18.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];

/// Lengths between which density, light and shadow run evenly: the ray's stretch of air, cut at its lowest point, at
/// the edges of the planet's shadow, at the ozone layer's edges and centre and where the haze ends.
fn cuts(ray: &Ray, scene: &Scene, air: &Atmosphere, sun: DVec3) -> Vec<f64> {
    let planet = &scene.planet;
    let Some((enters, leaves)) = ray.crossing(planet.radius_m + air.top_m) else {
        return Vec::new();
    };
    let from = enters.max(0.0);
    let to = ray.ground(planet.radius_m).unwrap_or(leaves);
    if to <= from {
        return Vec::new();
    }
    let mut cuts = vec![from, ray.closest(), to];
    if let Some(ozone) = &air.ozone {
        for altitude_m in [-ozone.half_width_m, 0.0, ozone.half_width_m].map(|d| ozone.centre_m + d) {
            let crossing = ray.crossing(planet.radius_m + altitude_m.max(0.0));
            cuts.extend(crossing.iter().flat_map(|(a, b)| [*a, *b]));
        }
    }
    if let Some(haze) = &scene.haze {
        let crossing = ray.crossing(planet.radius_m + haze.top_m);
        cuts.extend(crossing.iter().flat_map(|(a, b)| [*a, *b]));
    }
    // The shadow's edges by bisection between samples that differ.
    let dark = |t: f64| in_shadow(planet.radius_m, ray.at(t), sun);
    const SAMPLES: u32 = 4000;
    let at = |k: u32| from + (to - from) * f64::from(k) / f64::from(SAMPLES);
    for k in 0..SAMPLES {
        let (mut a, mut b) = (at(k), at(k + 1));
        if dark(a) != dark(b) {
            for _ in 0..60 {
                let m = 0.5 * (a + b);
                if dark(m) == dark(a) { a = m } else { b = m }
            }
            cuts.push(a);
        }
    }
    cuts.retain(|t| (from..=to).contains(t));
    cuts.sort_by(f64::total_cmp);
    cuts
}

/// The light scattered once along a ray from an altitude over the pole z.
pub(crate) fn seen(scene: &Scene, altitude_m: f64, view: DVec3, sun: DVec3) -> Seen {
    let planet = &scene.planet;
    let air = &air(scene);
    let ray = Ray::new(planet.radius_m, altitude_m, view);
    let cos = view.dot(sun);
    let asymmetry = air.mie.clone().unwrap_or_default().asymmetry;
    let phases = (rayleigh(cos), cornette_shanks(cos, asymmetry));
    let sunlight = |point: DVec3, h: f64| {
        transmittance_to_space(scene, h, (point.dot(sun) / point.length()).clamp(-1.0, 1.0))
    };
    let mut depth = [0.0; 3];
    let mut radiance = [0.0; 3];
    let cuts = cuts(&ray, scene, air, sun);
    for piece in cuts.windows(2) {
        let (from, to) = (piece[0], piece[1]);
        let middle = ray.at(0.5 * (from + to));
        let dark = in_shadow(planet.radius_m, middle, sun);
        // Squares from the end nearer to the lowest point.
        let rising = 0.5 * (from + to) > ray.closest();
        let bent = |x: f64| if rising { x * x } else { 1.0 - (1.0 - x).powi(2) };
        let altitude_m = |t: f64| (ray.at(t).length() - planet.radius_m).max(0.0);
        let depth_between = |a: f64, b: f64| {
            GAUSS.iter().fold([0.0; 3], |sum: [f64; 3], (x, w)| {
                let extinction = coefficients(scene, air, altitude_m(a + x * (b - a))).extinction_per_m;
                [0, 1, 2].map(|i| sum[i] + w * (b - a) * extinction[i])
            })
        };
        for k in 0..STEPS {
            let at = |k: u32| from + (to - from) * bent(f64::from(k) / f64::from(STEPS));
            let (start, end) = (at(k), at(k + 1));
            for (x, w) in GAUSS {
                let t = start + x * (end - start);
                let before = depth_between(start, t);
                let h = altitude_m(t);
                let c = coefficients(scene, air, h);
                let source = [0, 1, 2].map(|i| phases.0 * c.rayleigh_per_m[i] + phases.1 * c.mie_per_m[i]);
                let sun_there = if dark { [0.0; 3] } else { sunlight(ray.at(t), h) };
                for i in 0..3 {
                    let left = (-depth[i] - before[i]).exp();
                    radiance[i] += left * source[i] * sun_there[i] * w * (end - start);
                }
            }
            let whole = depth_between(start, end);
            depth = [0, 1, 2].map(|i| depth[i] + whole[i]);
        }
    }
    let transmittance = depth.map(|d: f64| (-d).exp());
    if let Some(distance_m) = ray.ground(planet.radius_m) {
        let up = ray.at(distance_m).normalize();
        let lit = sunlight(up, 0.0);
        for i in 0..3 {
            let sent = planet.ground_albedo[i] / PI * up.dot(sun).max(0.0) * lit[i];
            radiance[i] += transmittance[i] * sent;
        }
    }
    Seen {
        radiance,
        transmittance,
    }
}
