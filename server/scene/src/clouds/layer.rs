//! Layers of cloud.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One layer of cloud.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Layer {
    /// Clouds with a height.
    Volume(VolumeLayer),
    /// A thin high layer.
    Sheet(SheetLayer),
}

impl Layer {
    /// Share of the layer's area that is covered, where the layer itself says so.
    #[must_use]
    pub const fn coverage(&self) -> Option<f64> {
        match self {
            Self::Volume(volume) => volume.coverage,
            Self::Sheet(sheet) => sheet.coverage,
        }
    }
}

/// Clouds between two heights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct VolumeLayer {
    /// Height above the ground of the clouds' bases, metres.
    #[schemars(range(min = 0.0, max = 1e5))]
    pub base_m: f64,
    /// Height above the ground that the tallest clouds reach, metres; above `base_m`.
    #[schemars(range(min = 0.0, max = 1e5))]
    pub top_m: f64,
    /// From 0 stratus through 0.5 stratocumulus to 1 cumulus and cumulonimbus; null for what the weather map says.
    #[serde(rename = "type")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub cloud_type: Option<f64>,
    /// Share of the area that this layer covers; null for the clouds' coverage.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub coverage: Option<f64>,
    /// Multiplies the extinction of this layer.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub density: f64,
    /// How far the tops spread into an anvil, as those of a cumulonimbus do under the tropopause: 0 not, 1 fully.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub anvil: f64,
}

impl Default for VolumeLayer {
    fn default() -> Self {
        Self {
            base_m: 1_500.0,
            top_m: 4_000.0,
            cloud_type: None,
            coverage: None,
            density: 1.0,
            anvil: 0.0,
        }
    }
}

/// Clouds so thin that they are drawn on one sphere.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SheetLayer {
    /// Height above the ground, metres.
    #[schemars(range(min = 0.0, max = 1e5))]
    pub height_m: f64,
    /// What it looks like.
    pub genus: Genus,
    /// Share of the area that this layer covers; null for the clouds' coverage.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub coverage: Option<f64>,
    /// Vertical optical depth where it is densest; null for what is usual for the genus.
    #[schemars(range(min = 0.0, max = 20.0))]
    pub optical_depth: Option<f64>,
}

impl Default for SheetLayer {
    fn default() -> Self {
        Self {
            height_m: 8_000.0,
            genus: Genus::Cirrus,
            coverage: None,
            optical_depth: None,
        }
    }
}

impl SheetLayer {
    /// Vertical optical depth where the sheet is densest.
    #[must_use]
    pub fn densest_optical_depth(&self) -> f64 {
        self.optical_depth
            .unwrap_or_else(|| self.genus.usual_optical_depth())
    }
}

/// Genus of a thin layer (WMO International Cloud Atlas).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Genus {
    /// Fibres and hooks of ice.
    #[default]
    Cirrus,
    /// Fine ripples and grains of ice.
    Cirrocumulus,
    /// A smooth veil of ice.
    Cirrostratus,
    /// Rows and pavements of cloudlets.
    Altocumulus,
    /// A grey veil, through which the sun is seen as through ground glass, if at all.
    Altostratus,
}

impl Genus {
    /// Vertical optical depth where a layer of this genus is densest. Cloud statistics by satellite (ISCCP, Rossow and
    /// Schiffer 1999) put cirrus and cirrostratus below 3.6 and most of it near 1, altocumulus and altostratus between
    /// 3.6 and 23.
    #[must_use]
    pub const fn usual_optical_depth(self) -> f64 {
        match self {
            Self::Cirrocumulus => 0.5,
            Self::Cirrus => 0.8,
            Self::Cirrostratus => 1.0,
            Self::Altocumulus => 4.0,
            Self::Altostratus => 8.0,
        }
    }
}
