//! Haze and fog: a layer of even density on the ground.

use crate::bands::{Bands, share};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An even layer of aerosols from the ground up, which scatters with their phase function. `null` is no haze.
///
/// Its density is given by `visibility_m` or by `extinction_per_m`, not both; without either, by a visibility of
/// [`DEFAULT_VISIBILITY_M`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Haze {
    /// Distance at which the haze alone leaves 2 % of a dark object's contrast, metres: 3.912 / extinction
    /// (Koschmieder 1924). Below 1000 m one speaks of fog.
    #[schemars(range(min = 50.0, max = 1e6))]
    pub visibility_m: Option<f64>,
    /// Extinction coefficient, scattering and absorption together, 1/m.
    #[schemars(range(min = 0.0, max = 0.1))]
    pub extinction_per_m: Option<f64>,
    /// Height above the ground where the layer ends, metres.
    #[schemars(range(min = 1.0, max = 1e5))]
    pub top_m: f64,
    /// Share of the extinction that is scattering, one number or R, G and B: 1 water, 0.95 country haze, 0.8 smoke.
    #[schemars(schema_with = "share")]
    pub albedo: Bands,
}

/// What `visibility_m` is where nothing is said, metres.
pub const DEFAULT_VISIBILITY_M: f64 = 20_000.0;

/// -ln(0.02): optical depth at which 2 % of the contrast is left.
pub(crate) const KOSCHMIEDER: f64 = 3.912;

impl Default for Haze {
    fn default() -> Self {
        Self {
            visibility_m: None,
            extinction_per_m: None,
            top_m: 1_000.0,
            albedo: Bands::Grey(0.95),
        }
    }
}

impl Haze {
    /// Extinction coefficient however it is given, 1/m.
    #[must_use]
    pub fn extinction(&self) -> f64 {
        let visible = || KOSCHMIEDER / self.visibility_m.unwrap_or(DEFAULT_VISIBILITY_M);
        self.extinction_per_m.unwrap_or_else(visible)
    }
}
