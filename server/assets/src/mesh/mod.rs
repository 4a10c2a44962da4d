//! Meshes: OBJ with its materials, or binary glTF.

mod glb;
mod obj;
mod textures;

use crate::{Error, Form};
use textures::MOST_TEXTURE_BYTES;
use welkin_scene::{Material, MeshModel, Texture};

/// Most triangles of a mesh.
pub const MAX_TRIANGLES: usize = 1_000_000;
/// As many as there can be where no two triangles share one.
const MAX_VERTICES: usize = 3 * MAX_TRIANGLES;
/// Beyond, numbers of 32 bits are too coarse to build with.
const MOST_COORDINATE: f32 = 1e9;
/// The largest mesh in memory, bytes: 32 a vertex and 16 a triangle.
pub(crate) const MOST_BYTES: u64 = (MAX_VERTICES * 32 + MAX_TRIANGLES * 16) as u64 + MOST_TEXTURE_BYTES;

/// Reads a file to its end.
pub(crate) fn read(form: Form, file: &[u8], digest: [u8; 32]) -> Result<MeshModel, Error> {
    let parts = match form {
        Form::Glb => glb::read(file)?,
        _ => obj::read(file)?,
    };
    parts.finish(digest)
}

/// A mesh as it grows.
#[derive(Default)]
struct Parts {
    positions: Vec<[f32; 3]>,
    /// Zeros where the file has none.
    normals: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    triangles: Vec<[u32; 3]>,
    material_of: Vec<u32>,
    materials: Vec<Material>,
    textures: Vec<Texture>,
}

/// What a file leaves open.
fn plain_material() -> Material {
    Material {
        albedo: [0.8; 3],
        ambient: [1.0; 3],
        diffuse: 1.0,
        specular: [0.0; 3],
        shininess: 16.0,
        texture: None,
        normal_map: None,
    }
}

/// Before anything of that size is made.
fn check_size(triangles: usize, vertices: usize) -> Result<(), Error> {
    if triangles > MAX_TRIANGLES || vertices > MAX_VERTICES {
        return Err(Error::refused(format!(
            "it has {triangles} triangles and {vertices} vertices: a mesh may have {MAX_TRIANGLES} and {MAX_VERTICES}"
        )));
    }
    Ok(())
}

impl Parts {
    /// Adds a part whose vertices are its own. Normals and texture coordinates may be lacking, all of them together.
    fn add(&mut self, part: Part<'_>) -> Result<(), Error> {
        let Part {
            positions,
            normals,
            uvs,
            corners,
            material,
        } = part;
        let count = positions.len();
        check_size(
            self.triangles.len() + corners.len() / 3,
            self.positions.len() + count,
        )?;
        for (name, length) in [("normals", normals.len()), ("texture coordinates", uvs.len())] {
            if length != 0 && length != count {
                return Err(Error::refused(format!(
                    "of the {count} vertices of a part {length} have {name}: all must have them, or none"
                )));
            }
        }
        let begin = u32::try_from(self.positions.len()).map_err(Error::damaged)?;
        let (triangles, rest) = corners.as_chunks::<3>();
        if !rest.is_empty() {
            return Err(Error::refused("a triangle has not three corners"));
        }
        for triangle in triangles {
            if let Some(corner) = triangle.iter().find(|&&corner| corner as usize >= count) {
                return Err(Error::refused(format!(
                    "a triangle names vertex {corner} of a part that has {count}"
                )));
            }
            self.triangles.push(triangle.map(|corner| begin + corner));
        }
        self.material_of.resize(self.triangles.len(), material);
        self.positions.extend(positions);
        self.normals.extend(normals);
        self.normals.resize(self.positions.len(), [0.0; 3]);
        self.uvs.extend(uvs);
        self.uvs.resize(self.positions.len(), [0.0; 2]);
        Ok(())
    }

    /// Checks numbers, fills in normals, and sees to it that no surface sends back more light than it gets.
    fn finish(mut self, digest: [u8; 32]) -> Result<MeshModel, Error> {
        if self.triangles.is_empty() {
            return Err(Error::refused("it has no triangles"));
        }
        let is_near = |&coordinate: &f32| coordinate.abs() <= MOST_COORDINATE;
        if let Some(at) = self.positions.iter().find(|at| !at.iter().all(is_near)) {
            return Err(Error::refused(format!(
                "a vertex lies at {at:?}: coordinates are numbers up to {MOST_COORDINATE:e}"
            )));
        }
        if let Some(uv) = self.uvs.iter().find(|uv| !uv.iter().all(is_near)) {
            return Err(Error::refused(format!(
                "a texture coordinate is {uv:?}: they are numbers up to {MOST_COORDINATE:e}"
            )));
        }
        self.fill_normals();
        for material in &mut self.materials {
            keep_energy(material)?;
        }
        Ok(MeshModel {
            positions: self.positions.into(),
            normals: self.normals.into(),
            uvs: self.uvs.into(),
            triangles: self.triangles.into(),
            material_of: self.material_of.into(),
            materials: self.materials,
            textures: self.textures,
            digest,
        })
    }

    /// Triangles count by their angles at the vertex, so that it does not matter how a face is cut into triangles
    /// (Thürmer and Wüthrich 1998).
    fn fill_normals(&mut self) {
        let mut sums = vec![[0.0_f64; 3]; self.positions.len()];
        for triangle in &self.triangles {
            let corners = triangle.map(|corner| self.positions[corner as usize].map(f64::from));
            for i in 0..3 {
                let at = corners[i];
                let [ahead, behind] = [1, 2].map(|k| difference(corners[(i + k) % 3], at));
                let normal = cross(ahead, behind);
                let area = length(normal);
                if area > 0.0 {
                    let along: f64 = (0..3).map(|k| ahead[k] * behind[k]).sum();
                    let weight = area.atan2(along) / area;
                    let sum = &mut sums[triangle[i] as usize];
                    *sum = [0, 1, 2].map(|k| sum[k] + weight * normal[k]);
                }
            }
        }
        for (normal, sum) in self.normals.iter_mut().zip(sums) {
            *normal = unit(normal.map(f64::from))
                .or_else(|| unit(sum))
                .unwrap_or([0.0, 0.0, 1.0]);
        }
    }
}

/// Vertices, and triangles over them.
struct Part<'a> {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    /// Three a triangle.
    corners: &'a [u32],
    material: u32,
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// None for what has no direction.
#[allow(
    clippy::cast_possible_truncation,
    reason = "a unit vector needs no more digits"
)]
fn unit(v: [f64; 3]) -> Option<[f32; 3]> {
    let length = length(v);
    (length > 0.0 && length.is_finite()).then(|| v.map(|c| (c / length) as f32))
}

/// Factors from 0 to 1, and no more mirrored than the albedo leaves.
fn keep_energy(material: &mut Material) -> Result<(), Error> {
    let Material {
        albedo,
        ambient,
        diffuse,
        specular,
        shininess,
        ..
    } = material;
    let colours = [&albedo[..], &ambient[..], &specular[..], &[*diffuse, *shininess]];
    if !colours.concat().iter().all(|number| number.is_finite()) {
        return Err(Error::refused("a material holds what is no number"));
    }
    *diffuse = diffuse.clamp(0.0, 1.0);
    *shininess = shininess.clamp(1.0, 1000.0);
    *albedo = albedo.map(|share| share.clamp(0.0, 1.0));
    *ambient = ambient.map(|share| share.clamp(0.0, 1.0));
    *specular = [0, 1, 2].map(|i| specular[i].clamp(0.0, 1.0 - albedo[i] * *diffuse));
    Ok(())
}
