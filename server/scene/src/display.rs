//! From radiance to a picture.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How radiance becomes a picture. Linear formats do not use it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Display {
    /// How much light the picture takes.
    pub exposure: Exposure,
    /// How the light is rolled off towards white.
    pub tone_curve: ToneCurve,
    /// Colour temperature of the light that shall look white, kelvin. 6500 leaves colours as they are.
    #[schemars(range(min = 1667.0, max = 25_000.0))]
    pub white_balance_k: f64,
    /// Veil of light that the lens spreads about the sun: 0 none, 1 a clean lens.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub glare: f64,
    /// Hide the steps of 8-bit colour under noise of one step.
    pub dither: bool,
}

impl Default for Display {
    fn default() -> Self {
        Self {
            exposure: Exposure::Auto { compensation_ev: 0.0 },
            tone_curve: ToneCurve::Agx,
            white_balance_k: 6_500.0,
            glare: 1.0,
            dither: true,
        }
    }
}

/// How much light the picture takes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Exposure {
    /// A camera's fixed exposure value at ISO 100: 15 on a sunny day, 12 near sunset, 5 at dusk.
    Ev {
        /// EV at ISO 100.
        #[schemars(range(min = -30.0, max = 30.0))]
        ev: f64,
    },
    /// Metered from the scene.
    Auto {
        /// Added light: +1 doubles it.
        #[serde(default)]
        #[schemars(range(min = -10.0, max = 10.0))]
        compensation_ev: f64,
    },
    /// The eye of Iniesta and Pérez 2015: the pupil closes as one looks towards the sun,
    /// clamp(1 - cos γ / 4, 0, 1) × gain × radiance.
    Pupil {
        /// What one W/m²/sr counts before the tone curve.
        #[serde(default = "default_pupil_gain")]
        #[schemars(range(min = 0.0, max = 1e6))]
        gain: f64,
    },
}

/// The thesis lights its sky with a sun of 30; ours sends 1.77 (luminance-weighted): 30 / 1.77.
const fn default_pupil_gain() -> f64 {
    17.0
}

/// How the light is rolled off towards white.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ToneCurve {
    /// c / (1 + c)
    Reinhard,
    /// 1 - e^(-c)
    Exponential,
    /// The film-like curve of the Academy Color Encoding System.
    Aces,
    /// AgX: bright colours fade to white without turning their hue.
    #[default]
    Agx,
}
