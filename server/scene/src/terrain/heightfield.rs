//! Heights over a rectangle of the ground.

use super::{Shadow, Surface};
use crate::{assets::HeightGrid, frame::whole};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Side of a heightfield where neither scene nor file says so, metres.
pub const DEFAULT_EXTENT_M: f64 = 40_000.0;
/// Height of a heightfield where neither scene nor file says so, metres.
pub const DEFAULT_HEIGHT_M: f64 = 2_500.0;

/// Heights over a rectangle: those of `name` in the asset store, or mountains made from noise. Outside of the
/// rectangle is the planet's sphere.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Heightfield {
    /// The file's name in the store of heightfields: up to 64 of the characters a-z, 0-9, `_` and `-`, the first a
    /// letter or a digit. Null for mountains made from noise.
    #[schemars(regex(pattern = "^[a-z0-9][a-z0-9_-]{0,63}$"))]
    pub name: Option<String>,
    /// The mountains that are made where there is no `name`; null for the usual ones.
    pub mountains: Option<Mountains>,
    /// The longer side of the rectangle, metres. Null for what the file says, or 40000 where it says nothing.
    #[schemars(range(min = 100.0, max = 1e6))]
    pub extent_m: Option<f64>,
    /// From the lowest to the highest that the heights can be, metres. Null for what the file says, or 2500 where it
    /// says nothing.
    #[schemars(range(min = 0.0, max = 2e4))]
    pub height_m: Option<f64>,
    /// Height over the sphere of the lowest that the heights can be, metres. Where the terrain would lie below the
    /// sphere, the sphere is the ground.
    #[schemars(range(min = -2e4, max = 2e4))]
    pub base_m: f64,
    /// East and north of the rectangle's middle from the scene's origin, metres.
    #[schemars(inner(range(min = -1e6, max = 1e6)))]
    pub centre_m: [f64; 2],
    /// Where the upper edge of the file looks, clockwise from north, degrees.
    #[schemars(range(min = -360.0, max = 360.0))]
    pub azimuth_deg: f64,
    /// Share of half a side over which the heights go down to the sphere towards the edges: 0 leaves them as they are,
    /// with cliffs.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub edge_fade: f64,
    /// What covers it.
    pub surface: Surface,
    /// How it casts shadows; null for none.
    pub shadow: Option<Shadow>,
}

impl Default for Heightfield {
    fn default() -> Self {
        Self {
            name: None,
            mountains: None,
            extent_m: None,
            height_m: None,
            base_m: 0.0,
            centre_m: [0.0; 2],
            azimuth_deg: 0.0,
            edge_fade: 0.2,
            surface: Surface::default(),
            shadow: Some(Shadow::default()),
        }
    }
}

impl Heightfield {
    /// The mountains that are to be made; none where the heights are an asset's.
    #[must_use]
    pub fn made(&self) -> Option<Mountains> {
        self.name
            .is_none()
            .then(|| self.mountains.clone().unwrap_or_default())
    }

    /// How large the heightfield is, with the asset that `name` stands for or without one.
    #[must_use]
    pub fn relief(&self, grid: Option<&HeightGrid>) -> Relief {
        let own_m = grid.and_then(|grid| grid.extent_m);
        let [width, height] = own_m.unwrap_or_else(|| {
            // Square samples, as many a side as there are steps between them.
            let steps = |count: u32| f64::from(count.max(2) - 1);
            grid.map_or([1.0; 2], |grid| [steps(grid.width), steps(grid.height)])
        });
        let longer = width.max(height);
        let extent_m = self
            .extent_m
            .or(own_m.map(|_| longer))
            .unwrap_or(DEFAULT_EXTENT_M);
        let range_m = grid.and_then(|grid| grid.range_m);
        let height_m = self
            .height_m
            .or(range_m.map(|[least, most]| most - least))
            .unwrap_or(DEFAULT_HEIGHT_M);
        Relief {
            extent_m: [width, height].map(|side| extent_m * side / longer),
            height_m,
        }
    }
}

/// How large a heightfield is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relief {
    /// From the first to the last column, and from the first to the last row, metres.
    pub extent_m: [f64; 2],
    /// What a height of 1 in the grid is above one of 0, metres.
    pub height_m: f64,
}

/// Mountains from ridged noise, made once for a seed. They do not repeat.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Mountains {
    /// Chooses the mountains. The same seed gives the same ones.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 0, max = 4_294_967_295_u32))]
    pub seed: u32,
    /// From one great ridge to the next, metres.
    #[schemars(range(min = 500.0, max = 1e5))]
    pub ridge_scale_m: f64,
    /// How much of the height the finer shapes have: 0 rolling hills, 1 crags.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub roughness: f64,
    /// How much water has worked: 0 not, 1 deep valleys with smooth floors between sharp crests.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub erosion: f64,
    /// How far ridges bend and branch, as a share of `ridge_scale_m`.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub warp: f64,
    /// About the scene's origin the ground is level up to this distance and rises beyond, metres; 0 for none.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub valley_radius_m: f64,
}

impl Default for Mountains {
    fn default() -> Self {
        Self {
            seed: 1,
            ridge_scale_m: 9_000.0,
            roughness: 0.5,
            erosion: 0.5,
            warp: 0.4,
            valley_radius_m: 2_500.0,
        }
    }
}
