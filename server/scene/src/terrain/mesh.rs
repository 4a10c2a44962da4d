//! Triangles from a file.

use super::{Phong, Shadow};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A mesh from the asset store, with its own materials and textures.
///
/// It stands on the sphere as on a plane: each of its points is as high over the sphere as it is over the mesh's own
/// horizontal plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mesh {
    /// The file's name in the store of meshes: up to 64 of the characters a-z, 0-9, `_` and `-`, the first a letter or
    /// a digit.
    #[schemars(regex(pattern = "^[a-z0-9][a-z0-9_-]{0,63}$"))]
    pub name: String,
    /// Metres to one unit of the file.
    #[serde(default = "one")]
    #[schemars(range(min = 1e-6, max = 1e6))]
    pub scale: f64,
    /// Where the mesh's origin stands: east and north of the scene's origin, and up from the sphere, metres.
    #[serde(default)]
    #[schemars(inner(range(min = -1e6, max = 1e6)))]
    pub position_m: [f64; 3],
    /// Turns the mesh about the vertical, clockwise as seen from above, degrees.
    #[serde(default)]
    #[schemars(range(min = -360.0, max = 360.0))]
    pub azimuth_deg: f64,
    /// Which of the file's axes points up.
    #[serde(default)]
    pub up_axis: UpAxis,
    /// How all of it takes the light, in place of what the file's materials say; null for those. Albedos, textures and
    /// normal maps stay the file's.
    #[serde(default)]
    pub phong: Option<Phong>,
    /// How it casts shadows; null for none.
    #[serde(default = "shadow")]
    pub shadow: Option<Shadow>,
}

const fn one() -> f64 {
    1.0
}

#[allow(clippy::unnecessary_wraps, reason = "the default of an optional field")]
fn shadow() -> Option<Shadow> {
    Some(Shadow::default())
}

impl Mesh {
    /// Rows of the matrix that turns and scales the file's axes to east, north and up, metres.
    #[must_use]
    pub fn axes(&self) -> [[f64; 3]; 3] {
        let (sin, cos) = self.azimuth_deg.to_radians().sin_cos();
        // Clockwise: what looked north looks (sin, cos).
        let turned = |east: f64, north: f64, up: f64| {
            [
                self.scale * (cos * east + sin * north),
                self.scale * (cos * north - sin * east),
                self.scale * up,
            ]
        };
        let columns = match self.up_axis {
            UpAxis::Z => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            // Blender's and glTF's: x east, y up, and z towards the viewer, who looks north.
            UpAxis::Y => [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]],
        }
        .map(|[east, north, up]| turned(east, north, up));
        [0, 1, 2].map(|row| [0, 1, 2].map(|column| columns[column][row]))
    }
}

/// Which of a file's axes points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum UpAxis {
    /// x east, y up, z south: what glTF says, and most OBJ files hold.
    #[default]
    Y,
    /// x east, y north, z up.
    Z,
}
