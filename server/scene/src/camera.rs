//! The observer.

use crate::direction::Direction;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where the observer stands, where they look, and how the picture is projected.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Camera {
    /// East, north, up from the origin on the ground, metres. On the ground or above it.
    #[schemars(inner(range(min = -1e8, max = 1e8)))]
    pub position_m: [f64; 3],
    /// Centre of the picture. The environment projections are aligned with the world and do not use it.
    pub direction: Direction,
    /// Rotation of the picture about its centre, clockwise, degrees.
    #[schemars(range(min = -360.0, max = 360.0))]
    pub roll_deg: f64,
    /// How directions fall on the picture.
    pub projection: Projection,
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            position_m: [0.0, 0.0, 2.0],
            direction: Direction::angles(180.0, 10.0),
            roll_deg: 0.0,
            projection: Projection::Perspective {
                vertical_fov_deg: 60.0,
            },
        }
    }
}

/// How directions fall on the picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Projection {
    /// A pinhole camera.
    Perspective {
        /// Angle between the lower and the upper edge, degrees.
        #[serde(default = "default_vertical_fov_deg")]
        #[schemars(range(min = 0.01, max = 170.0))]
        vertical_fov_deg: f64,
    },
    /// A round picture, its diameter the shorter side of the frame; black outside.
    Fisheye {
        /// Angle across the circle, degrees. Stereographic reaches 300 degrees at most.
        #[serde(default = "default_fisheye_fov_deg")]
        #[schemars(range(min = 1.0, max = 360.0))]
        fov_deg: f64,
        /// Distance from the centre as a function of the angle from the axis.
        #[serde(default)]
        mapping: FisheyeMapping,
    },
    /// The whole sphere: the left edge looks west, the centre east (+x), the right half south; zenith at the top.
    /// Blender (x east, y north) and three.js (x east, z south) show it with the sun in its place.
    Equirectangular {},
    /// Six square faces in one strip, left to right +x, -x, +y, -y, +z, -z of three.js (x east, y up, z south);
    /// the frame is six times as wide as high.
    Cubemap {},
}

/// Radius r of a fisheye picture as a function of the angle θ from its axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FisheyeMapping {
    /// r ∝ θ
    #[default]
    Equidistant,
    /// r ∝ sin(θ/2): equal solid angles cover equal areas.
    Equisolid,
    /// r ∝ tan(θ/2): shapes are kept.
    Stereographic,
}

const fn default_vertical_fov_deg() -> f64 {
    60.0
}

const fn default_fisheye_fov_deg() -> f64 {
    180.0
}
