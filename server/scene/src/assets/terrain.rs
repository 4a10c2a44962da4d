//! Terrain as a renderer gets it.

use std::{fmt, sync::Arc};

/// Heights over a rectangle as a renderer gets them. Two of the same digest are the same.
#[derive(Clone)]
pub struct HeightGrid {
    /// Columns, 2 or more.
    pub width: u32,
    /// Rows, 2 or more.
    pub height: u32,
    /// From 0 to 1, rows from the north, each from the west. Every sample is a point: the first and the last of a row
    /// lie on the rectangle's edges.
    pub heights: Arc<[f32]>,
    /// What 0 and 1 are, metres; none where the file does not tell.
    pub range_m: Option<[f64; 2]>,
    /// From the first to the last column and from the first to the last row, metres; none where the file does not tell.
    pub extent_m: Option<[f64; 2]>,
    /// SHA-256 of the file that the heights were read from.
    pub digest: [u8; 32],
}

impl fmt::Debug for HeightGrid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { width, height, .. } = self;
        write!(f, "HeightGrid({width} x {height}, {})", self.digest_hex())
    }
}

/// Triangles as a renderer gets them, in the file's own axes and units. Two of the same digest are the same.
#[derive(Clone, Default)]
pub struct MeshModel {
    /// Of each vertex.
    pub positions: Arc<[[f32; 3]]>,
    /// Of each vertex, of length 1. Where the file has none: of the triangles about the vertex, by their angles
    /// there.
    pub normals: Arc<[[f32; 3]]>,
    /// Of each vertex; (0, 0) is the texture's upper left corner, (1, 1) its lower right one, and it repeats beyond.
    /// Zeros where the file has none.
    pub uvs: Arc<[[f32; 2]]>,
    /// Three vertices a triangle, anticlockwise as seen from outside.
    pub triangles: Arc<[[u32; 3]]>,
    /// Of each triangle, its place in `materials`.
    pub material_of: Arc<[u32]>,
    /// At least one.
    pub materials: Vec<Material>,
    /// What materials refer to.
    pub textures: Vec<Texture>,
    /// SHA-256 of the file that it was read from.
    pub digest: [u8; 32],
}

impl fmt::Debug for MeshModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "MeshModel({} triangles, {})",
            self.triangles.len(),
            self.digest_hex()
        )
    }
}

/// How the surface of a mesh takes the light, linear.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Share of the light that is sent back, 0 to 1; multiplies the texture.
    pub albedo: [f32; 3],
    /// Factor of the sky's light, 0 to 1.
    pub ambient: [f32; 3],
    /// Factor of the sun's light, 0 to 1.
    pub diffuse: f32,
    /// Share of the sun's light that is mirrored, 0 to 1.
    pub specular: [f32; 3],
    /// Phong's exponent, 1 to 1000.
    pub shininess: f32,
    /// The albedo's texture: its place in the mesh's textures.
    pub texture: Option<usize>,
    /// The normal map (x right, y up over the texture, z outwards; 0.5 is 0): its place in the mesh's textures.
    pub normal_map: Option<usize>,
}

/// A picture on a mesh.
#[derive(Clone)]
pub struct Texture {
    /// Width, pixels.
    pub width_px: u32,
    /// Height, pixels.
    pub height_px: u32,
    /// R, G, B, A of each pixel, rows from the top: sRGB for an albedo, linear for a normal map.
    pub rgba: Arc<[u8]>,
}
