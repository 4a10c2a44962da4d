//! Plates of ice in the air, which mirror lamps, sun and moon into pillars.

use crate::{
    frame::whole,
    problem::{Problem, Problems, number},
};
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::json;

/// Most layers.
pub const MAX_CRYSTAL_LAYERS: usize = 4;

/// Plates of ice: one layer, or a list of up to four.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum IceCrystals {
    /// A layer.
    One(CrystalLayer),
    /// Layers.
    Several(#[schemars(length(max = 4))] Vec<CrystalLayer>),
}

impl<'de> Deserialize<'de> for IceCrystals {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        /// The list first: serde would read an empty one as a layer without a word.
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Written {
            Several(Vec<CrystalLayer>),
            One(CrystalLayer),
        }
        Ok(match Written::deserialize(deserializer)? {
            Written::Several(layers) => Self::Several(layers),
            Written::One(layer) => Self::One(layer),
        })
    }
}

impl IceCrystals {
    /// The layers, however they are written.
    #[must_use]
    pub fn layers(&self) -> &[CrystalLayer] {
        match self {
            Self::One(layer) => std::slice::from_ref(layer),
            Self::Several(layers) => layers,
        }
    }
}

/// A layer of plates that fall nearly level, and mirror light with their faces.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CrystalLayer {
    /// Height above the ground where it begins, metres.
    #[schemars(range(min = 0.0, max = 3e4))]
    pub base_m: f64,
    /// Height above the ground where it ends, metres.
    #[schemars(range(min = 0.0, max = 3e4))]
    pub top_m: f64,
    /// Plates in a cubic metre.
    #[schemars(range(min = 0.0, max = 1e9))]
    pub number_density_per_m3: f64,
    /// Area of one face of a plate, m².
    #[schemars(range(min = 0.0, max = 1e-4))]
    pub plate_area_m2: f64,
    /// How far the plates tilt.
    pub tilt: Tilt,
    /// What part of the light they mirror.
    pub reflectance: Reflectance,
    /// What the plates take from the light of lamps and sun on its way through them, 1/m.
    #[schemars(range(min = 0.0, max = 0.1))]
    pub extinction_per_m: f64,
    /// How uneven the layer is; null for an even one.
    pub variation: Option<CrystalVariation>,
}

impl Default for CrystalLayer {
    fn default() -> Self {
        Self {
            base_m: 0.0,
            top_m: 400.0,
            number_density_per_m3: 20_000.0,
            plate_area_m2: 5e-9,
            tilt: Tilt::default(),
            reflectance: Reflectance::default(),
            extinction_per_m: 2e-4,
            variation: None,
        }
    }
}

/// How the axes of the plates are spread about the vertical: their density for each steradian at an angle δ from it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Tilt {
    /// exp(-δ²/2σ²), up to a maximum.
    Gaussian(GaussianTilt),
    /// The same for all up to a maximum.
    Uniform(UniformTilt),
    /// Slopes of a normal distribution, as of waves on water: exp(-tan²δ/2s²)/cos³δ.
    Slope(GaussianTilt),
}

impl Default for Tilt {
    fn default() -> Self {
        Self::Gaussian(GaussianTilt::default())
    }
}

impl Tilt {
    /// The largest angle from the vertical, degrees.
    #[must_use]
    pub const fn max_deg(&self) -> f64 {
        match self {
            Self::Gaussian(tilt) | Self::Slope(tilt) => tilt.max_deg,
            Self::Uniform(tilt) => tilt.max_deg,
        }
    }
}

/// Plates of usual size in calm air have a spread of 1° to 2° (Noel and Sassen 2005).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct GaussianTilt {
    /// Its spread in each of two directions, degrees; as a slope, its tangent is the slopes' spread.
    #[schemars(range(min = 0.05, max = 15.0))]
    pub sigma_deg: f64,
    /// No plate tilts more, degrees.
    #[schemars(range(min = 0.1, max = 45.0))]
    pub max_deg: f64,
}

impl Default for GaussianTilt {
    fn default() -> Self {
        Self {
            sigma_deg: 1.5,
            max_deg: 6.0,
        }
    }
}

/// No angle up to a largest one is rarer than another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct UniformTilt {
    /// No plate tilts more, degrees.
    #[schemars(range(min = 0.1, max = 45.0))]
    pub max_deg: f64,
}

impl Default for UniformTilt {
    fn default() -> Self {
        Self { max_deg: 3.0 }
    }
}

/// What part of the light a plate mirrors, by Fresnel's equations for ice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Reflectance {
    /// At both of its faces, back and forth inside as well.
    #[default]
    Slab,
    /// At its outer face alone.
    Outer,
}

/// Clumps and gaps that drift with the wind: the density is multiplied by 1 + `amount` times a noise from -1 to 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CrystalVariation {
    /// Share of the density that varies.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub amount: f64,
    /// Size of a clump, metres.
    #[schemars(range(min = 5.0, max = 1e5))]
    pub scale_m: f64,
    /// Chooses the clumps.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 0, max = 4_294_967_295_u32))]
    pub seed: u32,
    /// How fast the wind moves them, metres per second.
    #[schemars(range(min = 0.0, max = 150.0))]
    pub speed_m_s: f64,
    /// Where the wind comes from, clockwise from north, degrees.
    #[schemars(range(min = -360.0, max = 360.0))]
    pub azimuth_deg: f64,
}

impl Default for CrystalVariation {
    fn default() -> Self {
        Self {
            amount: 0.6,
            scale_m: 150.0,
            seed: 1,
            speed_m_s: 2.0,
            azimuth_deg: 270.0,
        }
    }
}

/// Adds what is wrong with the layers, which stand at the pointer `at`.
pub(crate) fn check(crystals: &IceCrystals, at: &str, problems: &mut Problems) {
    for (i, layer) in crystals.layers().iter().enumerate() {
        let at = match crystals {
            IceCrystals::One(_) => at.to_owned(),
            IceCrystals::Several(_) => format!("{at}/{i}"),
        };
        if layer.top_m <= layer.base_m {
            problems.push(Problem::new(
                format!("{at}/top_m"),
                &json!(layer.top_m),
                format!("a number of metres above `base_m`, {}", number(layer.base_m)),
            ));
        }
    }
}
