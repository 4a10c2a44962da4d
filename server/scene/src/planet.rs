//! The planet's sphere.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A sphere of ground or of water.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Planet {
    /// Radius of the ground, metres.
    #[schemars(range(min = 1e5, max = 1e8))]
    pub radius_m: f64,
    /// Share of the light that the ground sends back (Lambert), in R, G and B. With water, what comes out of the
    /// water: some 0.02 of the sea's blue.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub ground_albedo: [f64; 3],
    /// What the sphere is made of.
    pub surface: SphereSurface,
}

impl Default for Planet {
    fn default() -> Self {
        Self {
            radius_m: 6_360_000.0,
            ground_albedo: [0.1; 3],
            surface: SphereSurface::default(),
        }
    }
}

/// What a planet's sphere is made of.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum SphereSurface {
    /// Matt ground.
    Ground {},
    /// Water, in which sun and sky are mirrored.
    Water(Water),
}

impl Default for SphereSurface {
    fn default() -> Self {
        Self::Ground {}
    }
}

/// Water with waves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Water {
    /// Speed of the wind over it, metres per second. The waves' slopes grow with it (Cox and Munk 1954): still water
    /// is a mirror, 15 m/s spread the sun's glitter widely.
    #[schemars(range(min = 0.0, max = 30.0))]
    pub wind_m_s: f64,
}

impl Default for Water {
    fn default() -> Self {
        Self { wind_m_s: 5.0 }
    }
}
