//! The numbers behind the picture.

use crate::{direction::Direction, document::Scene, moon::MoonPlace};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Most directions in one probe.
pub const MAX_DIRECTIONS: usize = 65_536;

/// Asks for radiance at exact directions, at final quality.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ProbeRequest {
    /// What is seen; its camera says from where.
    pub scene: Scene,
    /// Where to look.
    #[schemars(length(max = 65_536))]
    pub directions: Vec<Direction>,
}

/// The answer to a probe; one entry a direction, in the order asked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ProbeAnswer {
    /// Radiance in R, G and B, the discs of sun and moon included where they are shown; stars are points and are not, W/m²/sr.
    pub radiance_w_m2_sr: Vec<[f64; 3]>,
    /// Transmittance from the observer to the ground or to space.
    pub transmittance: Vec<[f64; 3]>,
    /// Distance to the ground, metres; null where the sky is seen.
    pub distance_m: Vec<Option<f64>>,
    /// Light that falls on the observer.
    pub irradiance: Irradiance,
    /// Where the sun stands.
    pub sun: SunPlace,
    /// Where the moon stands; null where there is none.
    pub moon: Option<MoonPlace>,
}

/// Light that falls on the observer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Irradiance {
    /// From the sun on a horizontal plane that faces up, W/m².
    pub direct_w_m2: [f64; 3],
    /// From the sun on a plane that faces it, W/m².
    pub direct_normal_w_m2: [f64; 3],
    /// From the moon on a plane that faces it, W/m².
    pub moon_direct_normal_w_m2: [f64; 3],
    /// From the sky on a horizontal plane that faces up, without the discs of sun and moon, W/m².
    pub diffuse_w_m2: [f64; 3],
    /// Radiance of sky and ground, without the discs, in real orthonormal spherical harmonics of the world axes,
    /// in the order Y00, Y1-1 (y), Y10 (z), Y11 (x), Y2-2 (xy), Y2-1 (yz), Y20 (3z²-1), Y21 (xz), Y22 (x²-y²).
    pub sh9: [[f64; 3]; 9],
}

/// Where the sun stands at the scene's origin.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SunPlace {
    /// Clockwise from north, degrees.
    pub azimuth_deg: f64,
    /// Up from the horizon, degrees.
    pub elevation_deg: f64,
}
