//! Twin of `lib/air.wgsl` and of the transmittance table.

use welkin_scene::{Atmosphere, Haze, Scene};

/// The scene's air; vacuum is air of no density.
pub(crate) fn air(scene: &Scene) -> Atmosphere {
    scene.atmosphere.clone().unwrap_or(Atmosphere {
        density_factor: 0.0,
        ..Atmosphere::default()
    })
}

/// Coefficients in R, G and B at an altitude, 1/m.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Coefficients {
    pub(crate) rayleigh_per_m: [f64; 3],
    /// Scattering by aerosols and haze.
    pub(crate) mie_per_m: [f64; 3],
    pub(crate) extinction_per_m: [f64; 3],
}

/// Scattering and extinction at an altitude in metres.
pub(crate) fn coefficients(scene: &Scene, air: &Atmosphere, altitude_m: f64) -> Coefficients {
    let h = altitude_m.max(0.0);
    let mut c = Coefficients::default();
    let add = |to: &mut [f64; 3], per_m: [f64; 3], density: f64| {
        for i in 0..3 {
            to[i] += per_m[i] * density;
        }
    };
    if let Some(rayleigh) = &air.rayleigh {
        let density = air.density_factor * (-h / rayleigh.scale_height_m).exp();
        add(&mut c.rayleigh_per_m, rayleigh.scattering_per_m, density);
        add(&mut c.extinction_per_m, rayleigh.scattering_per_m, density);
        add(&mut c.extinction_per_m, rayleigh.absorption_per_m, density);
    }
    if let Some(mie) = &air.mie {
        let density = air.density_factor * (-h / mie.scale_height_m).exp();
        add(&mut c.mie_per_m, mie.scattering_per_m.rgb(), density);
        add(&mut c.extinction_per_m, mie.scattering_per_m.rgb(), density);
        add(&mut c.extinction_per_m, mie.absorption_per_m.rgb(), density);
    }
    if let Some(ozone) = &air.ozone {
        let density = (1.0 - (h - ozone.centre_m).abs() / ozone.half_width_m).max(0.0);
        add(
            &mut c.extinction_per_m,
            ozone.absorption_per_m,
            air.density_factor * density,
        );
    }
    if let Some(haze) = scene.haze.as_ref().filter(|haze| h < haze.top_m) {
        add(&mut c.mie_per_m, haze.albedo.rgb(), haze.extinction());
        add(&mut c.extinction_per_m, [1.0; 3], haze.extinction());
    }
    c
}

/// Transmittance from an altitude to space along a direction with cosine `mu` to the zenith; zero through the ground.
pub(crate) fn transmittance_to_space(scene: &Scene, altitude_m: f64, mu: f64) -> [f64; 3] {
    optical_depth_to_space(scene, altitude_m, mu).map_or([0.0; 3], |depth| depth.map(|d| (-d).exp()))
}

/// Its optical depth; none through the ground.
pub(crate) fn optical_depth_to_space(scene: &Scene, altitude_m: f64, mu: f64) -> Option<[f64; 3]> {
    let radius_m = scene.planet.radius_m;
    let air = air(scene);
    let r = radius_m + altitude_m;
    let closest = r * (1.0 - mu * mu).max(0.0).sqrt();
    if mu < 0.0 && closest < radius_m {
        return None;
    }
    let r_top = radius_m + air.top_m;
    if closest >= r_top || (altitude_m > air.top_m && mu >= 0.0) {
        return Some([0.0; 3]);
    }
    // Along the ray from its closest point s = 0: from the observer or the top, to the top; cut where the haze ends.
    let reach = (r_top * r_top - closest * closest).sqrt();
    let from = (r * mu).max(-reach);
    let haze_top_m = scene.haze.as_ref().map_or(0.0, |haze: &Haze| haze.top_m);
    let r_haze = radius_m + haze_top_m;
    let in_haze = (r_haze * r_haze - closest * closest).max(0.0).sqrt();
    let mut tau = [0.0; 3];
    let mut add = |from: f64, to: f64| {
        // Midpoints of steps that grow with the square from the lower end.
        const STEPS: u32 = 256;
        let at = |j: f64| from + (j / f64::from(STEPS)).powi(2) * (to - from);
        for k in 0..STEPS {
            let s = at(f64::from(k) + 0.5);
            let h = (closest * closest + s * s).sqrt() - radius_m;
            let e = coefficients(scene, &air, h).extinction_per_m;
            let length = at(f64::from(k) + 1.0) - at(f64::from(k));
            for i in 0..3 {
                tau[i] += e[i] * length;
            }
        }
    };
    for (from, to) in [(from.max(0.0), reach), (0.0, (-from).max(0.0))] {
        let cut = in_haze.min(to).max(from);
        add(from, cut);
        add(cut, to);
    }
    Some(tau)
}
