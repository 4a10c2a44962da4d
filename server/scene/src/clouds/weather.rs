//! The weather map: where there are clouds, of which type, and where it rains. It repeats beyond its extent.

use crate::frame::whole_or_null;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The weather over the land.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum WeatherMap {
    /// Made from noise.
    Procedural(ProceduralMap),
    /// A picture from the asset store.
    Asset(AssetMap),
    /// The same everywhere.
    Uniform(UniformMap),
    /// From one map to another.
    Blend(BlendMap),
}

impl WeatherMap {
    /// The two maps between which the weather stands, and the second one's share; a map that is no blend is both.
    #[must_use]
    pub fn blended(&self) -> (PlainMap, PlainMap, f64) {
        let map = match self {
            Self::Blend(blend) => return (blend.from.clone(), blend.to.clone(), blend.share),
            Self::Procedural(map) => PlainMap::Procedural(map.clone()),
            Self::Asset(map) => PlainMap::Asset(map.clone()),
            Self::Uniform(map) => PlainMap::Uniform(map.clone()),
        };
        (map.clone(), map, 0.0)
    }
}

impl Default for WeatherMap {
    fn default() -> Self {
        Self::Procedural(ProceduralMap::default())
    }
}

/// A weather map that is not itself a blend of two.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum PlainMap {
    /// Made from noise.
    Procedural(ProceduralMap),
    /// A picture from the asset store.
    Asset(AssetMap),
    /// The same everywhere.
    Uniform(UniformMap),
}

impl Default for PlainMap {
    fn default() -> Self {
        Self::Procedural(ProceduralMap::default())
    }
}

impl From<PlainMap> for WeatherMap {
    fn from(map: PlainMap) -> Self {
        match map {
            PlainMap::Procedural(map) => Self::Procedural(map),
            PlainMap::Asset(map) => Self::Asset(map),
            PlainMap::Uniform(map) => Self::Uniform(map),
        }
    }
}

/// Weather made from noise. Coverage, type and rain are each spread evenly over 0 to 1, so that a coverage of 0.3
/// covers 0.3 of the area.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ProceduralMap {
    /// Side of the square after which the weather repeats, metres.
    #[schemars(range(min = 1e3, max = 1e7))]
    pub extent_m: f64,
    /// Chooses the weather; null for the clouds' seed.
    #[serde(deserialize_with = "whole_or_null")]
    #[schemars(range(min = 0, max = 4_294_967_295_u32))]
    pub seed: Option<u32>,
}

impl Default for ProceduralMap {
    fn default() -> Self {
        Self {
            extent_m: DEFAULT_EXTENT_M,
            seed: None,
        }
    }
}

/// What `extent_m` is where nothing is said, metres.
const DEFAULT_EXTENT_M: f64 = 60_000.0;

const fn default_extent_m() -> f64 {
    DEFAULT_EXTENT_M
}

/// Weather from a picture, with north at the top and the scene's origin in its middle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AssetMap {
    /// The picture's name in the store of weather maps: up to 64 of the characters a-z, 0-9, `_` and `-`, the first a
    /// letter or a digit.
    #[schemars(regex(pattern = "^[a-z0-9][a-z0-9_-]{0,63}$"))]
    pub name: String,
    /// What the picture's channels mean.
    #[serde(default)]
    pub convention: Convention,
    /// Side of the square that the picture covers, after which it repeats, metres.
    #[serde(default = "default_extent_m")]
    #[schemars(range(min = 1e3, max = 1e7))]
    pub extent_m: f64,
}

/// What the channels of a weather picture mean, each from 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Convention {
    /// R coverage, G type, B rain.
    #[default]
    CoverageTypeRain,
    /// R coverage low in the layer, G coverage high in the layer, B the clouds' greatest height as a share of the
    /// layer, A density.
    LowHighHeightDensity,
}

/// The same weather everywhere.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct UniformMap {
    /// Where the map stands among those of other places, 0 the last to be covered to 1 the first: there are clouds
    /// where it is over 1 minus the coverage of the clouds.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub coverage: f64,
    /// From 0 stratus through 0.5 stratocumulus to 1 cumulus and cumulonimbus.
    #[serde(rename = "type")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub cloud_type: f64,
    /// How much it rains, 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub rain: f64,
}

impl Default for UniformMap {
    fn default() -> Self {
        Self {
            coverage: 1.0,
            cloud_type: 0.5,
            rain: 0.0,
        }
    }
}

/// A cross-fade of two maps.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BlendMap {
    /// The map at share 0.
    pub from: PlainMap,
    /// The map at share 1.
    pub to: PlainMap,
    /// How much of `to` there is, 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub share: f64,
}
