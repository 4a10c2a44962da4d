//! Twin of `lib/airglow.wgsl`, and what the night sky sends to the ground.

use super::air::optical_depth_to_space;
use crate::{catalogue::stars, quadrature::gauss_legendre};
use glam::DVec3;
use std::f64::consts::PI;
use welkin_scene::{Airglow, Scene};

/// Length of a ray from the ground in the shell; `mu` is its cosine to the zenith.
pub(crate) fn length_from_the_ground(radius_m: f64, glow: &Airglow, mu: f64) -> f64 {
    let to = |altitude_m: f64| {
        let b = radius_m * mu;
        (b * b + altitude_m * (2.0 * radius_m + altitude_m)).sqrt() - b
    };
    to(glow.top_m) - to(glow.base_m)
}

/// Radiance per metre of ray that gives the shell the zenith radiance it is said to have.
pub(crate) fn emission_per_m(glow: &Airglow) -> DVec3 {
    DVec3::from_array(glow.zenith_radiance_w_m2_sr) / (glow.top_m - glow.base_m)
}

/// Light of a moonless night.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NightLight {
    /// On level ground, W/m².
    pub(crate) ground_irradiance_w_m2: DVec3,
    /// Mean radiance about a place on the ground, W/m²/sr: what thick air there shines with.
    pub(crate) mean_radiance_w_m2_sr: DVec3,
}

/// From airglow and stars. What the air takes out of a ray it scatters, half of it down: the ground has E = ∫ L (T + (1 -
/// T)/2) mu dω, and the mean radiance is that of a bright upper half and a ground that reflects.
pub(crate) fn night_light(scene: &Scene) -> NightLight {
    let radius_m = scene.planet.radius_m;
    let glow = scene.atmosphere.as_ref().and_then(|air| air.airglow.as_ref());
    let starlight = scene.stars.as_ref().map_or(DVec3::ZERO, |of| {
        let shown = stars()
            .iter()
            .take_while(|s| s.magnitude <= of.limiting_magnitude);
        shown.map(|s| DVec3::from_array(s.irradiance_w_m2)).sum::<DVec3>() * of.intensity / (4.0 * PI)
    });
    let mut ground = DVec3::ZERO;
    for (x, weight) in gauss_legendre(8) {
        // mu = x² crowds the nodes towards the horizon; dω = 2π dmu.
        let mu = x * x;
        let shell = glow.map_or(DVec3::ZERO, |g| {
            emission_per_m(g) * length_from_the_ground(radius_m, g, mu)
        });
        let depth = optical_depth_to_space(scene, 0.0, mu).unwrap_or_default();
        let left = DVec3::from_array(depth.map(|d| 0.5 + 0.5 * (-d).exp()));
        ground += (shell + starlight) * left * (2.0 * PI * mu * weight * 2.0 * x);
    }
    let albedo = DVec3::from_array(scene.planet.ground_albedo);
    NightLight {
        ground_irradiance_w_m2: ground,
        mean_radiance_w_m2_sr: ground * (1.0 + albedo) / (2.0 * PI),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn scene(changes: &serde_json::Value) -> Scene {
        Scene::from_value(changes).unwrap()
    }

    #[test]
    fn the_zenith_of_a_dark_site_has_22_magnitudes() {
        let glow = Airglow::default();
        let zenith = emission_per_m(&glow) * length_from_the_ground(6.36e6, &glow, 1.0);
        const SQUARE_ARCSECONDS: f64 = 4.254_517e10;
        let magnitude = -2.5 * (zenith.y / SQUARE_ARCSECONDS / 3.63e-11).log10();
        assert!((magnitude - 22.0).abs() < 0.01, "{magnitude}");
        // Van Rhijn's factor 1 / √(1 - (R / (R + h))² sin² z) for a thin shell at 91 km: 5.97 at the horizon.
        let ratio = length_from_the_ground(6.36e6, &glow, 0.0) / length_from_the_ground(6.36e6, &glow, 1.0);
        let shell: f64 = 6.36e6 / (6.36e6 + 91_000.0);
        assert!(
            (ratio * (1.0 - shell * shell).sqrt() - 1.0).abs() < 0.01,
            "{ratio}"
        );
    }

    #[test]
    fn a_starlit_ground_has_the_light_that_is_measured() {
        let night = night_light(&scene(&json!({})));
        let lux = night.ground_irradiance_w_m2.dot(DVec3::new(
            0.2126 * 90231.0,
            0.7152 * 71876.0,
            0.0722 * 69561.0,
        ));
        // 0.6 to 0.9 mlx under a moonless sky (Hänel et al. 2018, for 22 to 21.5 mag/arcsec²).
        assert!((5e-4..1.2e-3).contains(&lux), "{lux}");
        let dark = night_light(&scene(&json!({"stars": null, "atmosphere": {"airglow": null}})));
        assert_eq!(dark.ground_irradiance_w_m2, DVec3::ZERO);
        let starlit = night_light(&scene(&json!({"atmosphere": {"airglow": null}})));
        assert!(starlit.ground_irradiance_w_m2.min_element() > 0.0);
    }
}
