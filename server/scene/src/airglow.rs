//! The faint light of the night sky itself.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Light that the upper air gives off by itself, evenly over an even shell, together with that of the stars too faint
/// to be seen one by one. Night is dark, not black.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Airglow {
    /// Radiance of the shell seen straight up from below without the air in front, in R, G and B, W/m²/sr (per nm).
    /// The shell grows brighter towards the horizon, where more of it is in sight.
    #[schemars(inner(range(min = 0.0, max = 1e3)))]
    pub zenith_radiance_w_m2_sr: [f64; 3],
    /// Height above the ground where the shell begins, metres.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub base_m: f64,
    /// Height above the ground where the shell ends, metres.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub top_m: f64,
}

/// A dark site's zenith has 22.0 mag/arcsec² in V. Magnitude 0 is 3.63e-11 W/m²/nm at 550 nm (Bessell 1979) and a
/// steradian has 4.2545e10 square arcseconds: 3.63e-11 · 10^(-0.4 · 22) · 4.2545e10 = 2.45e-9 W/m²/sr/nm. In blue the
/// sky's B-V of 0.9 gives 6.32e-11 / 3.63e-11 · 10^(-0.4 · 0.9) = 0.76 of that. In red, between the bands of OH, the
/// continuum is about 0.7 of what the band about the green oxygen line holds.
const DARK_SITE: [f64; 3] = [1.7e-9, 2.45e-9, 1.86e-9];

impl Default for Airglow {
    fn default() -> Self {
        Self {
            zenith_radiance_w_m2_sr: DARK_SITE,
            base_m: 85_000.0,
            top_m: 97_000.0,
        }
    }
}
