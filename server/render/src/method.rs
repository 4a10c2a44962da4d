//! How the scene's method is carried out: which variants of the shaders, and how many steps.

use crate::{
    camera::projection_code,
    uniforms::{AirUniform, Standpoint},
};
use welkin_scene::{Method, Projection, Quality, Scene};

/// Steps of an integral to the sun where the scene does not say: within 0.01 % for the Earth from a table's entry.
const TABLE_SUN_STEPS: u32 = 64;
/// The same inside every step of view.
const NESTED_SUN_STEPS: u32 = 32;
/// Steps of view where each pixel has its own ray.
const PIXEL_STEPS: u32 = 48;
/// Steps of the probe's rays.
const PROBE_STEPS: u32 = 384;

/// Steps along each ray of view, and along each ray to the sun.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Steps {
    pub(crate) view: u32,
    pub(crate) sun: u32,
}

/// What a scene asks of the passes that follow light through the air.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Plan {
    pub(crate) method: Method,
    /// True where orders beyond the first count.
    pub(crate) multiple: bool,
    pub(crate) haze: bool,
    /// True where the upper air's own light can be seen.
    pub(crate) airglow: bool,
    /// As `sight_at` numbers it.
    pub(crate) projection: u32,
    view_steps: Option<u32>,
    sun_steps: Option<u32>,
}

impl Plan {
    pub(crate) fn new(scene: &Scene, air: &AirUniform) -> Self {
        let chosen = scene.atmosphere.as_ref();
        Self {
            method: match chosen.map_or(Method::Lut, |air| air.method) {
                Method::Lut if is_above_haze(scene) => Method::Table,
                method => method,
            },
            multiple: air.multiple > 0.0,
            haze: air.haze_extinction_per_m > 0.0,
            airglow: chosen.is_some_and(|air| air.airglow.is_some()) && !is_day(scene),
            projection: projection_code(&scene.camera.projection),
            view_steps: chosen.and_then(|air| air.view_steps),
            sun_steps: chosen.and_then(|air| air.sun_steps),
        }
    }

    /// For the entries of the table of optical depth.
    pub(crate) fn table_steps(&self) -> u32 {
        match self.method {
            // Nothing but ground and later orders reads the table then.
            Method::Nested => TABLE_SUN_STEPS,
            Method::Table | Method::Lut => self.sun_steps.unwrap_or(TABLE_SUN_STEPS),
        }
    }

    /// For the entries of the table of the sky.
    pub(crate) fn sky_view_steps(&self, quality: Quality) -> Steps {
        let usual = match quality {
            Quality::Preview => 24,
            Quality::Final => 48,
        };
        Steps {
            view: self.view_steps.unwrap_or(usual),
            sun: 0,
        }
    }

    /// For a pixel's own ray.
    pub(crate) fn pixel_steps(&self) -> Steps {
        Steps {
            view: self.view_steps.unwrap_or(PIXEL_STEPS),
            sun: self.sun_steps.unwrap_or(NESTED_SUN_STEPS),
        }
    }

    /// For the probe's rays.
    pub(crate) fn probe_steps(&self) -> Steps {
        Steps {
            view: self.view_steps.unwrap_or(PROBE_STEPS),
            sun: self.sun_steps.unwrap_or(TABLE_SUN_STEPS),
        }
    }

    /// About how many times the work of a pixel that reads tables a pixel takes.
    pub(crate) fn work_per_pixel(&self) -> u32 {
        let Steps { view, sun } = self.pixel_steps();
        match self.method {
            Method::Lut => 1,
            Method::Table => view.div_ceil(4),
            Method::Nested => (view * sun).div_ceil(16),
        }
    }

    /// The same with every ray followed.
    pub(crate) fn along_rays(self) -> Self {
        let method = match self.method {
            Method::Lut => Method::Table,
            method => method,
        };
        Self { method, ..self }
    }

    /// True where few places tell of the pixels between them: not where each pixel has a ray of its own, nor across the
    /// faces of a cubemap.
    pub(crate) fn runs_evenly(&self) -> bool {
        self.method == Method::Lut && self.projection != projection_code(&Projection::Cubemap {})
    }

    /// The constants of the shaders that follow light through the air.
    pub(crate) fn march_constants(&self) -> [(&'static str, f64); 2] {
        let flag = |on: bool| f64::from(u8::from(on));
        [("MULTIPLE", flag(self.multiple)), ("HAZE", flag(self.haze))]
    }

    /// As the shaders number it.
    pub(crate) fn method_code(&self) -> f64 {
        match self.method {
            Method::Lut => 0.0,
            Method::Table => 1.0,
            Method::Nested => 2.0,
        }
    }
}

/// True for an observer above a haze: seen from there it has an edge that lies between two rows of the sky's table, so
/// each pixel follows its own ray.
fn is_above_haze(scene: &Scene) -> bool {
    let altitude_m = Standpoint::new(scene).altitude_m;
    let haze = scene.haze.as_ref().filter(|haze| haze.extinction() > 0.0);
    haze.is_some_and(|haze| altitude_m > haze.top_m)
}

/// Sine of the sun's elevation from which on the sky is a million times brighter than airglow: 3°.
const DAY_SINE: f64 = 0.052;

/// True in the light of day: not in space, where the night side may be in view.
fn is_day(scene: &Scene) -> bool {
    let stand = Standpoint::new(scene);
    let inside = scene
        .atmosphere
        .as_ref()
        .is_some_and(|air| stand.altitude_m < 0.5 * air.top_m);
    inside && stand.up.dot(stand.sun) > DAY_SINE
}
