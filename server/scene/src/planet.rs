//! The planet's sphere.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A sphere with a matt surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Planet {
    /// Radius of the ground, metres.
    #[schemars(range(min = 1e5, max = 1e8))]
    pub radius_m: f64,
    /// Share of the light that the ground sends back (Lambert), in R, G and B.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub ground_albedo: [f64; 3],
}

impl Default for Planet {
    fn default() -> Self {
        Self {
            radius_m: 6_360_000.0,
            ground_albedo: [0.1; 3],
        }
    }
}
