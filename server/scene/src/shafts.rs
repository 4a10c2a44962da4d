//! Shafts of light and of shadow in the air.

use crate::frame::whole;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How terrain and clouds draw shafts into the air.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Shafts {
    /// The air scatters the sun's light once only where the sun reaches it. Light that is scattered more often comes
    /// from everywhere, and stays.
    Exact(ExactShafts),
    /// The glow about the sun, smeared away from it over the picture: cheap, and only near the sun.
    Radial(RadialShafts),
}

impl Default for Shafts {
    fn default() -> Self {
        Self::Exact(ExactShafts::default())
    }
}

/// Light only where the sun reaches.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ExactShafts {
    /// Places along a ray of view at which it is asked whether the sun is seen.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 8, max = 256))]
    pub steps: u32,
}

impl Default for ExactShafts {
    fn default() -> Self {
        Self { steps: 64 }
    }
}

/// A glow smeared over the picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RadialShafts {
    /// Places between a pixel and the sun's image that are looked at.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 8, max = 256))]
    pub steps: u32,
    /// How much of the way to the sun's image is looked at: shafts are as long.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub length: f64,
    /// What is left of a place's light at the far end of the way.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub decay: f64,
    /// Multiplies the light of the shafts.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub strength: f64,
}

impl Default for RadialShafts {
    fn default() -> Self {
        Self {
            steps: 48,
            length: 0.8,
            decay: 0.3,
            strength: 1.0,
        }
    }
}
