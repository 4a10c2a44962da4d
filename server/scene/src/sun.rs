//! The sun.

use crate::direction::Direction;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The sun: where it stands and what it sends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Sun {
    /// A direction, or a time and a place.
    pub position: SunPosition,
    /// Irradiance above the atmosphere on a plane that faces the sun, in the R, G and B bands, W/m² (per nm).
    #[schemars(inner(range(min = 0.0, max = 1e6)))]
    pub irradiance_w_m2: [f64; 3],
    /// Diameter of the disc, degrees. The light in the air comes from the disc's centre.
    #[schemars(range(min = 0.0, max = 20.0))]
    pub angular_diameter_deg: f64,
    /// Darken the disc towards its edge (Neckel and Labs 1994). The disc sends the same irradiance either way.
    pub limb_darkening: bool,
    /// Show the disc, and its glitter on water. Off for environment maps whose renderer samples the sun apart.
    pub disc: bool,
}

impl Default for Sun {
    fn default() -> Self {
        Self {
            position: SunPosition::Direction(Direction::angles(180.0, 35.0)),
            irradiance_w_m2: [1.474, 1.8504, 1.91198],
            angular_diameter_deg: 0.5357,
            limb_darkening: true,
            disc: true,
        }
    }
}

/// Where the sun stands at the origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum SunPosition {
    /// Given outright.
    Direction(Direction),
    /// Computed from time and place.
    TimeAndPlace(TimeAndPlace),
}

/// A moment and a place on the Earth. The scene's `time_s` is added to the moment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeAndPlace {
    /// RFC 3339, for example `2026-06-21T05:00:00Z`; years 1900 to 2100.
    #[schemars(extend("format" = "date-time"))]
    pub time: String,
    /// North is positive, degrees.
    #[schemars(range(min = -90.0, max = 90.0))]
    pub latitude_deg: f64,
    /// East is positive, degrees.
    #[schemars(range(min = -180.0, max = 180.0))]
    pub longitude_deg: f64,
    /// Lift the sun near the horizon as a standard atmosphere (101 325 Pa, 12 °C) bends its light.
    #[serde(default)]
    pub refraction: bool,
}
