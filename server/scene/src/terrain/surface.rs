//! What covers a heightfield, and how it takes the light.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What covers a heightfield, and how it takes the light.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Surface {
    /// Share of the light that is sent back.
    pub albedo: GroundAlbedo,
    /// How the light is sent back.
    pub phong: Phong,
}

/// Share of the light that a heightfield sends back.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum GroundAlbedo {
    /// Grass, rock and snow by height and slope.
    Bands(SurfaceBands),
    /// The same everywhere.
    Plain(PlainAlbedo),
}

impl Default for GroundAlbedo {
    fn default() -> Self {
        Self::Bands(SurfaceBands::default())
    }
}

/// The same albedo everywhere.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PlainAlbedo {
    /// In R, G and B.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub rgb: [f64; 3],
}

impl Default for PlainAlbedo {
    fn default() -> Self {
        Self { rgb: [0.18; 3] }
    }
}

/// Grass low and where it is not steep, rock above and on steep slopes, snow higher still. Albedos by ASTER and USGS
/// spectra of such ground, in three bands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SurfaceBands {
    /// Albedo of grass and low woods in R, G and B.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub grass: [f64; 3],
    /// Albedo of rock and scree in R, G and B.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub rock: [f64; 3],
    /// Albedo of snow in R, G and B.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub snow: [f64; 3],
    /// Height over the sphere above which grass gives way to rock, metres.
    #[schemars(range(min = -2e4, max = 5e4))]
    pub grass_line_m: f64,
    /// Height over the sphere above which snow lies, metres.
    #[schemars(range(min = -2e4, max = 5e4))]
    pub snow_line_m: f64,
    /// How far both lines wander up and down with the shape of the ground, metres.
    #[schemars(range(min = 0.0, max = 5e3))]
    pub line_width_m: f64,
    /// Slope beyond which grass gives way to rock, degrees.
    #[schemars(range(min = 0.0, max = 90.0))]
    pub rock_slope_deg: f64,
    /// Slope beyond which snow does not stay, degrees.
    #[schemars(range(min = 0.0, max = 90.0))]
    pub snow_slope_deg: f64,
}

impl Default for SurfaceBands {
    fn default() -> Self {
        Self {
            grass: [0.055, 0.075, 0.028],
            rock: [0.17, 0.155, 0.14],
            snow: [0.82, 0.85, 0.88],
            grass_line_m: 1_300.0,
            snow_line_m: 1_800.0,
            line_width_m: 400.0,
            rock_slope_deg: 32.0,
            snow_slope_deg: 50.0,
        }
    }
}

/// Phong's terms (1975), with Iniesta and Pérez's ambient term, which takes the surface's own colour.
///
/// The ambient term sends back albedo × ambient of the sky's light, the diffuse term albedo × diffuse of the sun's, and
/// the specular term the share specular of it about the mirror's direction, as the cosine to the power of shininess.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Phong {
    /// Factor of the sky's light: 1 is what the albedo says.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub ambient: f64,
    /// Factor of the sun's light: 1 is what the albedo says.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub diffuse: f64,
    /// Share of the sun's light that is mirrored.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub specular: f64,
    /// How sharp the mirror's image is: 1 dull, 1000 polished.
    #[schemars(range(min = 1.0, max = 1000.0))]
    pub shininess: f64,
}

impl Default for Phong {
    fn default() -> Self {
        Self {
            ambient: 1.0,
            diffuse: 1.0,
            specular: 0.0,
            shininess: 16.0,
        }
    }
}
