//! The stars.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The stars that the naked eye sees, from a catalogue of 5,044.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Stars {
    /// Multiplies their light.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub intensity: f64,
    /// Faintest star that is shown, V magnitude. The catalogue ends at 6.
    #[schemars(range(min = -2.0, max = 7.0))]
    pub limiting_magnitude: f64,
    /// How the sphere of stars stands; null for how it does at the sun's time and place, or, where the sun is given as
    /// a direction, as on a winter evening in Europe.
    pub orientation: Option<Orientation>,
}

impl Default for Stars {
    fn default() -> Self {
        Self {
            intensity: 1.0,
            limiting_magnitude: 7.0,
            orientation: None,
        }
    }
}

/// How the sphere of stars stands over the horizon.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Orientation {
    /// Height of the celestial north pole, degrees; negative in the south.
    #[schemars(range(min = -90.0, max = 90.0))]
    pub latitude_deg: f64,
    /// Right ascension of the south point's meridian (J2000), degrees: 15 times the local sidereal time in hours.
    #[schemars(range(min = -360.0, max = 360.0))]
    pub sidereal_time_deg: f64,
}

impl Default for Orientation {
    /// Orion in the south: a February evening at 45° north.
    fn default() -> Self {
        Self {
            latitude_deg: 45.0,
            sidereal_time_deg: 90.0,
        }
    }
}
