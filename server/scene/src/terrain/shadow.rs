//! How terrain hides the sun.

use crate::frame::whole;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How terrain hides the sun from itself, from the ground and from the air.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Shadow {
    /// By a picture of the terrain as the sun sees it, made again only when sun or terrain change.
    Map(ShadowMap),
    /// By a ray to the sun from every place: exact, and slower.
    Rays {},
}

impl Default for Shadow {
    fn default() -> Self {
        Self::Map(ShadowMap::default())
    }
}

/// A picture of the terrain as the sun sees it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ShadowMap {
    /// Side of the picture, pixels: a power of two.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 512, max = 8192))]
    pub size_px: u32,
    /// How the picture is looked up.
    pub filter: ShadowFilter,
}

impl Default for ShadowMap {
    fn default() -> Self {
        Self {
            size_px: 2048,
            filter: ShadowFilter::Gaussian,
        }
    }
}

/// How a shadow map is looked up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ShadowFilter {
    /// The nearest pixel: edges in steps.
    Nearest,
    /// What four pixels say, each as near as it is.
    Bilinear,
    /// What those around say, weighted by a bell curve: soft edges.
    #[default]
    Gaussian,
}
