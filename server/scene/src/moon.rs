//! The moon.

use crate::direction::Direction;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The moon: where it stands, how much of it is lit, and what it sends. It shines by the scene's sun, whose irradiance
/// and direction it follows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Moon {
    /// Where it stands; null for where it is at the sun's time and place. Where the sun is given as a direction, there
    /// is no moon unless its position is given too.
    pub position: Option<Direction>,
    /// Angle between sun and observer as seen from the moon, degrees: 0 full, 90 half, 180 new; null for what the
    /// places of sun and moon give. The lit limb points to the sun either way.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub phase_angle_deg: Option<f64>,
    /// Multiplies the moon's light.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub irradiance_scale: f64,
    /// Diameter of the disc, degrees; null for what its distance gives, or the mean, 0.518.
    #[schemars(range(min = 0.0, max = 20.0))]
    pub angular_diameter_deg: Option<f64>,
    /// Multiplies the light that the Earth throws on the moon's dark side; 0 for none.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub earthshine: f64,
    /// Show the disc. Off for environment maps whose renderer samples the moon apart.
    pub disc: bool,
}

impl Default for Moon {
    fn default() -> Self {
        Self {
            position: None,
            phase_angle_deg: None,
            irradiance_scale: 1.0,
            angular_diameter_deg: None,
            earthshine: 1.0,
            disc: true,
        }
    }
}

/// Where the moon stands at the scene's origin, and how much of it is lit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MoonPlace {
    /// Clockwise from north, degrees.
    pub azimuth_deg: f64,
    /// Up from the horizon, degrees.
    pub elevation_deg: f64,
    /// Angle between sun and observer as seen from the moon, degrees: 0 full, 90 half, 180 new.
    pub phase_angle_deg: f64,
    /// Share of the disc that is lit, 0 to 1.
    pub illuminated_fraction: f64,
    /// Diameter of the disc, degrees.
    pub angular_diameter_deg: f64,
    /// Distance, metres; the mean, where the moon is given as a direction.
    pub distance_m: f64,
}
