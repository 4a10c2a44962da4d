//! What is told of an asset in a list.

use crate::png_file::PngFacts;
use serde::Serialize;
use welkin_scene::{HeightGrid, MeshModel};

/// What a file holds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Facts {
    /// Of a weather map: what its header says.
    Picture(PngFacts),
    /// Of a heightfield.
    Heights(HeightFacts),
    /// Of a mesh.
    Mesh(MeshFacts),
}

/// What a heightfield holds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct HeightFacts {
    /// Columns.
    pub width_px: u32,
    /// Rows.
    pub height_px: u32,
    /// The lowest and the highest, metres; none where the file does not tell.
    pub range_m: Option<[f64; 2]>,
    /// Width and height of the rectangle, metres; none where the file does not tell.
    pub extent_m: Option<[f64; 2]>,
}

impl From<&HeightGrid> for HeightFacts {
    fn from(grid: &HeightGrid) -> Self {
        Self {
            width_px: grid.width,
            height_px: grid.height,
            range_m: grid.range_m,
            extent_m: grid.extent_m,
        }
    }
}

/// What a mesh holds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MeshFacts {
    /// Triangles.
    pub triangles: usize,
    /// Vertices, those that differ in normal or texture coordinate counted apart.
    pub vertices: usize,
    /// Materials.
    pub materials: usize,
    /// Textures and normal maps.
    pub textures: usize,
    /// The least of each coordinate, in the file's units.
    pub least: [f32; 3],
    /// The greatest of each coordinate, in the file's units.
    pub most: [f32; 3],
}

impl From<&MeshModel> for MeshFacts {
    fn from(mesh: &MeshModel) -> Self {
        let ends = |end: fn(f32, f32) -> f32, start: f32| {
            mesh.positions.iter().fold([start; 3], |found, at| {
                [0, 1, 2].map(|axis| end(found[axis], at[axis]))
            })
        };
        Self {
            triangles: mesh.triangles.len(),
            vertices: mesh.positions.len(),
            materials: mesh.materials.len(),
            textures: mesh.textures.len(),
            least: ends(f32::min, f32::INFINITY),
            most: ends(f32::max, f32::NEG_INFINITY),
        }
    }
}
