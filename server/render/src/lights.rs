//! Sun, moon and night sky as the passes read them.

use crate::{
    colour,
    night::Night,
    passes::{Table, sky::MoonInputs},
    sunlight::{Direct, DiscsLeft},
    uniforms::{Part, Standpoint, ViewUniform},
};
use std::sync::Arc;
use welkin_scene::{Scene, Sun};

/// What shines on a scene. The meter's copies show no discs: a camera is not exposed for them.
pub(crate) struct Lights {
    view: Part,
    metered_view: Part,
    airglow: Part,
    moon: Option<MoonParts>,
    pub(crate) glare: Glare,
}

struct MoonParts {
    moon: Part,
    metered: Part,
    view: Part,
    metered_view: Part,
    face: wgpu::TextureView,
    lights: bool,
    sky_view: Option<Arc<Table>>,
}

/// The disc about which the lens spreads a veil of light: the brighter one of sun and moon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Glare {
    /// At the observer, W/m²; zero where the disc is not shown.
    pub(crate) irradiance_w_m2: [f64; 3],
    pub(crate) diameter_deg: f64,
    /// The moon's, else the sun's.
    of_moon: bool,
}

impl Lights {
    /// `direct` is of a clear sky, `moon_sky_view` the light of the moon in the air, where it counts.
    pub(crate) fn new(
        scene: &Scene,
        stand: &Standpoint,
        night: Night,
        direct: &Direct,
        airglow: Part,
        face: impl FnOnce() -> wgpu::TextureView,
        moon_sky_view: Option<Arc<Table>>,
    ) -> Self {
        let sun = night.sun(&scene.sun);
        let hidden = Sun {
            disc: false,
            ..sun.clone()
        };
        let shown = |shown: bool, irradiance: [f64; 3]| if shown { irradiance } else { [0.0; 3] };
        let of_sun = Glare {
            irradiance_w_m2: shown(scene.sun.disc, direct.sun),
            diameter_deg: scene.sun.angular_diameter_deg,
            of_moon: false,
        };
        let of_moon = scene.moon.as_ref().zip(night.moon).map(|(moon, over)| Glare {
            irradiance_w_m2: shown(moon.disc, direct.moon),
            diameter_deg: over.seen.angular_diameter_deg,
            of_moon: true,
        });
        let of_moon = of_moon.filter(|moon| moon.illuminance() > of_sun.illuminance());
        let moon = night.moon.map(|over| MoonParts {
            moon: Part::new(&over.uniform(night.uncovered, false, of_moon.is_some())),
            metered: Part::new(&over.uniform(night.uncovered, true, false)),
            view: Part::new(&over.view(scene, stand, false)),
            metered_view: Part::new(&over.view(scene, stand, true)),
            face: face(),
            lights: over.counts > 0.0,
            sky_view: moon_sky_view,
        });
        Self {
            view: Part::new(&ViewUniform::new(&sun, stand)),
            metered_view: Part::new(&ViewUniform::new(&hidden, stand)),
            airglow,
            moon,
            glare: of_moon.unwrap_or(of_sun),
        }
    }

    pub(crate) const fn view(&self, metered: bool) -> &Part {
        if metered { &self.metered_view } else { &self.view }
    }

    /// The moon in the sun's place.
    pub(crate) fn moon_view(&self) -> Option<&Part> {
        self.moon.as_ref().map(|moon| &moon.view)
    }

    pub(crate) const fn airglow(&self) -> &Part {
        &self.airglow
    }

    pub(crate) fn moon(&self, metered: bool) -> Option<MoonInputs<'_>> {
        self.moon.as_ref().map(|parts| MoonInputs {
            moon: if metered { &parts.metered } else { &parts.moon },
            view: if metered { &parts.metered_view } else { &parts.view },
            face: &parts.face,
            lights: parts.lights,
            sky_view: parts.sky_view.as_deref(),
        })
    }
}

impl Glare {
    /// Behind clouds.
    pub(crate) fn behind(&self, left: DiscsLeft) -> Self {
        let left = if self.of_moon { left.moon } else { left.sun };
        Self {
            irradiance_w_m2: self.irradiance_w_m2.map(|e| left * e),
            ..*self
        }
    }

    /// Lux.
    fn illuminance(&self) -> f64 {
        const LUMA: [f64; 3] = [0.2126, 0.7152, 0.0722];
        (0..3)
            .map(|i| LUMA[i] * colour::LUMINANCE_PER_RADIANCE[i] * self.irradiance_w_m2[i])
            .sum()
    }
}
