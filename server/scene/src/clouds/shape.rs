//! How noise carves the clouds out of the weather.

use crate::frame::{whole, whole_or_null};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How noise carves the clouds (Schneider 2015): a coarse one makes their bodies, a fine one their edges.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Shape {
    /// Length after which the coarse noise repeats, metres.
    #[schemars(range(min = 100.0, max = 1e5))]
    pub base_scale_m: f64,
    /// Length after which the fine noise repeats, metres.
    #[schemars(range(min = 10.0, max = 1e5))]
    pub detail_scale_m: f64,
    /// Value of the coarse noise's octaves that counts as 0; below `low_freq_max`.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub low_freq_min: f64,
    /// Value of the coarse noise's octaves that counts as 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub low_freq_max: f64,
    /// How deep the fine noise eats into the edges: 0 not at all.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub high_freq_modifier: f64,
    /// How far turbulence carries the fine noise, metres.
    #[schemars(range(min = 0.0, max = 1e4))]
    pub curl_distortion_m: f64,
    /// Chooses the noises; null for the clouds' seed.
    #[serde(deserialize_with = "whole_or_null")]
    #[schemars(range(min = 0, max = 4_294_967_295_u32))]
    pub seed: Option<u32>,
    /// Cells of Perlin noise along `base_scale_m`.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 1, max = 32))]
    pub perlin_frequency: u32,
    /// Cells of Worley noise along `base_scale_m`.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 1, max = 32))]
    pub worley_frequency: u32,
    /// Cells of Worley noise along `detail_scale_m`.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 1, max = 32))]
    pub detail_frequency: u32,
    /// How dense each type of cloud is from its base to its top.
    pub gradients: Gradients,
}

impl Default for Shape {
    fn default() -> Self {
        Self {
            base_scale_m: 8_000.0,
            detail_scale_m: 900.0,
            low_freq_min: 0.0,
            low_freq_max: 1.0,
            high_freq_modifier: 0.35,
            curl_distortion_m: 120.0,
            seed: None,
            perlin_frequency: 4,
            worley_frequency: 4,
            detail_frequency: 2,
            gradients: Gradients::default(),
        }
    }
}

/// Density by height for each type of cloud. Heights are shares of the layer, 0 its base and 1 its top, and rise:
/// where the cloud begins, is full, is no longer full, and ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Gradients {
    /// Of type 0.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub stratus: [f64; 4],
    /// Of type 0.5.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub stratocumulus: [f64; 4],
    /// Of type 1.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub cumulus: [f64; 4],
}

/// Schneider 2015.
impl Default for Gradients {
    fn default() -> Self {
        Self {
            stratus: [0.02, 0.05, 0.09, 0.11],
            stratocumulus: [0.02, 0.2, 0.48, 0.625],
            cumulus: [0.01, 0.0625, 0.78, 1.0],
        }
    }
}

impl Gradients {
    /// Each type fills its layer, so that the layer's heights are those of the clouds.
    #[must_use]
    pub const fn filling() -> Self {
        Self {
            stratus: [0.0, 0.1, 0.85, 1.0],
            stratocumulus: [0.0, 0.15, 0.6, 1.0],
            cumulus: [0.0, 0.0625, 0.78, 1.0],
        }
    }
}
