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
