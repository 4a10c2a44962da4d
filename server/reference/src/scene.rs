//! From the scene document to the air of this crate. All units are converted here.

use crate::medium::{Exponential, Layer, Medium, Tent};
use glam::DVec3;
use welkin_scene::{Mie, Rayleigh, Scene};

impl Medium {
    /// A scene's air and haze; none in vacuum.
    pub fn from_scene(scene: &Scene) -> Option<Self> {
        let air = scene.atmosphere.as_ref()?;
        let factor = air.density_factor;
        let absent = |scale_height_m: f64| Exponential {
            scale_height_m,
            scattering_per_m: DVec3::ZERO,
            extinction_per_m: DVec3::ZERO,
        };
        let layer = |scattering: [f64; 3], absorption: [f64; 3], scale_height_m: f64| Exponential {
            scale_height_m,
            scattering_per_m: DVec3::from(scattering) * factor,
            extinction_per_m: (DVec3::from(scattering) + DVec3::from(absorption)) * factor,
        };
        let rayleigh = air.rayleigh.as_ref().map_or_else(
            || absent(Rayleigh::default().scale_height_m),
            |r| layer(r.scattering_per_m, r.absorption_per_m, r.scale_height_m),
        );
        let mie = air.mie.as_ref().map_or_else(
            || absent(Mie::default().scale_height_m),
            |m| {
                layer(
                    m.scattering_per_m.rgb(),
                    m.absorption_per_m.rgb(),
                    m.scale_height_m,
                )
            },
        );
        // Haze scatters as the aerosols do, and as the standard ones where there are none.
        let asymmetry = air.mie.as_ref().map_or(Mie::default().asymmetry, |m| m.asymmetry);
        let ozone = air.ozone.as_ref().map(|ozone| Tent {
            absorption_per_m: DVec3::from(ozone.absorption_per_m) * factor,
            centre_m: ozone.centre_m,
            half_width_m: ozone.half_width_m,
        });
        let haze = scene.haze.as_ref().map(|haze| Layer {
            top_m: haze.top_m,
            scattering_per_m: DVec3::from(haze.albedo.rgb()) * haze.extinction(),
            extinction_per_m: DVec3::splat(haze.extinction()),
        });
        Some(Self::new(
            (scene.planet.radius_m, air.top_m),
            rayleigh,
            (mie, asymmetry),
            ozone,
            haze,
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Straight up from the ground, τ is known: σ H (1 - e^(-top/H)) of what thins with height, σ times the height of
    /// haze, σ times the half width of ozone.
    #[test]
    fn every_coefficient_of_the_scene_is_in_the_optical_depth() {
        let scene = serde_json::json!({
            "atmosphere": {
                "top_m": 60e3,
                "density_factor": 1.5,
                "rayleigh": {"scattering_per_m": [1e-6, 2e-6, 3e-6], "absorption_per_m": [3e-6, 0.0, 1e-6],
                             "scale_height_m": 9e3},
                "mie": {"scattering_per_m": [4e-6, 5e-6, 6e-6], "absorption_per_m": 1e-6, "scale_height_m": 1.5e3},
                "ozone": {"absorption_per_m": [1e-6, 2e-6, 4e-6], "centre_m": 20e3, "half_width_m": 8e3}
            },
            "haze": {"visibility_m": 39_120.0, "top_m": 500.0, "albedo": 0.5}
        });
        let medium = Medium::from_scene(&serde_json::from_value(scene).unwrap()).unwrap();
        let column = |scale_height_m: f64| scale_height_m * (1.0 - (-60e3 / scale_height_m).exp());
        let thinning =
            DVec3::new(4.0, 2.0, 4.0) * 1e-6 * column(9e3) + DVec3::new(5.0, 6.0, 7.0) * 1e-6 * column(1.5e3);
        let ozone = DVec3::new(1.0, 2.0, 4.0) * 1e-6 * 8e3;
        let haze = DVec3::splat(1e-4 * 500.0);
        let expected = (thinning + ozone) * 1.5 + haze;
        let ground = DVec3::Z * medium.ground_radius_m;
        let found = medium.transmittance_to_space(ground, DVec3::Z).unwrap();
        // The quadrature's own error.
        let off = (-found.ln() / expected - 1.0).abs().max_element();
        assert!(off < 1e-6, "{off}");
        let (molecules, aerosols) = medium.scattering_per_m(0.0);
        assert!((molecules - DVec3::new(1.5, 3.0, 4.5) * 1e-6).abs().max_element() < 1e-12);
        let expected = DVec3::new(6.0, 7.5, 9.0) * 1e-6 + DVec3::splat(0.5e-4);
        assert!((aerosols - expected).abs().max_element() < 1e-12);
    }
}
