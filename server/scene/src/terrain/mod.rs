//! Terrain on the planet's sphere: mountains, or a mesh such as a town, and how they are lit.

mod check;
mod heightfield;
mod mesh;
mod shadow;
mod surface;

pub(crate) use check::check;
pub use heightfield::{DEFAULT_EXTENT_M, DEFAULT_HEIGHT_M, Heightfield, Mountains, Relief};
pub use mesh::{Mesh, UpAxis};
pub use shadow::{Shadow, ShadowFilter, ShadowMap};
pub use surface::{GroundAlbedo, Phong, PlainAlbedo, Surface, SurfaceBands};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What stands on the sphere.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Terrain {
    /// Heights over a rectangle: mountains from noise, or an elevation model from the asset store.
    Heightfield(Heightfield),
    /// Triangles from the asset store.
    Mesh(Mesh),
}

impl Terrain {
    /// How it casts shadows; none where it casts none.
    #[must_use]
    pub const fn shadow(&self) -> Option<Shadow> {
        match self {
            Self::Heightfield(field) => field.shadow,
            Self::Mesh(mesh) => mesh.shadow,
        }
    }
}
