//! Twin of `lib/air.wgsl` and of the transmittance table.

use welkin_scene::{Atmosphere, Planet};

/// Extinction in R, G and B at an altitude in metres, 1/m.
pub(crate) fn extinction_per_m(air: &Atmosphere, altitude_m: f64) -> [f64; 3] {
    let h = altitude_m.max(0.0);
    let mut sum = [0.0; 3];
    let mut add = |per_m: [f64; 3], density: f64| {
        for i in 0..3 {
            sum[i] += per_m[i] * density * air.density_factor;
        }
    };
    if let Some(rayleigh) = &air.rayleigh {
        add(rayleigh.scattering_per_m, (-h / rayleigh.scale_height_m).exp());
    }
    if let Some(mie) = &air.mie {
        add(
            [mie.scattering_per_m + mie.absorption_per_m; 3],
            (-h / mie.scale_height_m).exp(),
        );
    }
    if let Some(ozone) = &air.ozone {
        add(
            ozone.absorption_per_m,
            (1.0 - (h - ozone.centre_m).abs() / ozone.half_width_m).max(0.0),
        );
    }
    sum
}

/// Transmittance from an altitude to space along a direction with cosine `mu` to the zenith; zero through the ground.
pub(crate) fn transmittance_to_space(
    planet: &Planet,
    air: &Atmosphere,
    altitude_m: f64,
    mu: f64,
) -> [f64; 3] {
    optical_depth_to_space(planet, air, altitude_m, mu).map_or([0.0; 3], |depth| depth.map(|d| (-d).exp()))
}

/// Its optical depth; none through the ground.
pub(crate) fn optical_depth_to_space(
    planet: &Planet,
    air: &Atmosphere,
    altitude_m: f64,
    mu: f64,
) -> Option<[f64; 3]> {
    let r = planet.radius_m + altitude_m;
    let closest = r * (1.0 - mu * mu).max(0.0).sqrt();
    if mu < 0.0 && closest < planet.radius_m {
        return None;
    }
    let r_top = planet.radius_m + air.top_m;
    if closest >= r_top || (altitude_m > air.top_m && mu >= 0.0) {
        return Some([0.0; 3]);
    }
    // Along the ray from its closest point s = 0: from the observer or the top, to the top.
    let reach = (r_top * r_top - closest * closest).sqrt();
    let from = (r * mu).max(-reach);
    let mut tau = [0.0; 3];
    let mut add = |from: f64, to: f64| {
        // Midpoints of steps that grow with the square from the lower end.
        const STEPS: u32 = 256;
        let at = |j: f64| from + (j / f64::from(STEPS)).powi(2) * (to - from);
        for k in 0..STEPS {
            let s = at(f64::from(k) + 0.5);
            let h = (closest * closest + s * s).sqrt() - planet.radius_m;
            let e = extinction_per_m(air, h);
            let length = at(f64::from(k) + 1.0) - at(f64::from(k));
            for i in 0..3 {
                tau[i] += e[i] * length;
            }
        }
    };
    add(from.max(0.0), reach);
    add(0.0, (-from).max(0.0));
    Some(tau)
}
