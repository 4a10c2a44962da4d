//! Where droplets send the light.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The phase function of the droplets. It integrates to 1 over all directions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Phase {
    /// Two lobes of Henyey and Greenstein (1941).
    DualHenyeyGreenstein(DualHenyeyGreenstein),
    /// Spheres of water, by a fit to Mie's theory (Jendersie and d'Eon 2023).
    Droplets(Droplets),
}

impl Default for Phase {
    fn default() -> Self {
        Self::DualHenyeyGreenstein(DualHenyeyGreenstein::default())
    }
}

/// One lobe along the light, one against it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DualHenyeyGreenstein {
    /// Asymmetry of the lobe along the light: the mean cosine of its deflection.
    #[schemars(range(min = 0.0, max = 0.99))]
    pub forward: f64,
    /// Asymmetry of the lobe against the light.
    #[schemars(range(min = -0.99, max = 0.0))]
    pub backward: f64,
    /// Share of the light in the lobe against the light; the other lobe has the rest.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub blend: f64,
}

impl Default for DualHenyeyGreenstein {
    fn default() -> Self {
        Self {
            forward: 0.8,
            backward: -0.25,
            blend: 0.3,
        }
    }
}

/// Spheres of water, all of one size.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Droplets {
    /// Diameter, metres.
    #[schemars(range(min = 5e-6, max = 5e-5))]
    pub diameter_m: f64,
}

impl Default for Droplets {
    fn default() -> Self {
        Self { diameter_m: 2e-5 }
    }
}
