//! Binary glTF 2.0. All must be within the file: nothing that it names elsewhere is looked for.

use super::{Part, Parts, check_size, plain_material, textures::Textures};
use crate::{Error, bundle::shown};
use gltf::{
    Accessor, Document, Gltf, Primitive,
    accessor::{DataType, Dimensions},
    buffer, image,
    mesh::Mode,
    scene::Node,
};
use welkin_scene::Material;

/// Nodes within nodes: a circle of them would never end.
const MOST_DEPTH: usize = 64;
/// Nodes visited in all: each may name the same children.
const MOST_NODES: usize = 100_000;
/// Light that glass and the like mirror at right angles (glTF 2.0, appendix B).
const DIELECTRIC: f32 = 0.04;

type Matrix = [[f64; 4]; 4];
const IDENTITY: Matrix = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 1.0],
];

pub(super) fn read(file: &[u8]) -> Result<Parts, Error> {
    let Gltf { document, blob } = Gltf::from_slice(file).map_err(Error::damaged)?;
    let blob = blob.unwrap_or_default();
    check_within(&document)?;
    let mut reader = Reader {
        blob: &blob,
        parts: Parts::default(),
        nodes: 0,
    };
    reader.read_materials(&document)?;
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let roots: Vec<Node<'_>> = match &scene {
        Some(scene) => scene.nodes().collect(),
        None => return Err(Error::refused("it has no scene")),
    };
    for node in roots {
        reader.read_node(&node, IDENTITY, 0)?;
    }
    Ok(reader.parts)
}

fn check_within(document: &Document) -> Result<(), Error> {
    let outside = |uri: &str| {
        Error::refused(format!(
            "it names {}: a .glb must hold all that it needs",
            shown(uri)
        ))
    };
    if let Some(extension) = document.extensions_required().next() {
        return Err(Error::refused(format!(
            "it requires the extension {}, and none is known here",
            shown(extension)
        )));
    }
    for buffer in document.buffers() {
        if let buffer::Source::Uri(uri) = buffer.source() {
            return Err(outside(uri));
        }
    }
    for image in document.images() {
        if let image::Source::Uri { uri, .. } = image.source() {
            return Err(outside(uri));
        }
    }
    Ok(())
}

struct Reader<'a> {
    blob: &'a [u8],
    parts: Parts,
    nodes: usize,
}

impl<'a> Reader<'a> {
    fn read_materials(&mut self, document: &Document) -> Result<(), Error> {
        let mut textures = Textures::default();
        let blob = self.blob;
        let mut picture = |image: gltf::Image<'_>| {
            let image::Source::View { view, .. } = image.source() else {
                return Err(Error::refused("a texture lies outside of the file"));
            };
            let bytes = view
                .offset()
                .checked_add(view.length())
                .and_then(|end| blob.get(view.offset()..end));
            let name = format!("image {}", image.index());
            let missing = || Error::damaged(format!("{name} lies beyond the end"));
            textures.place(&name, || bytes.map(<[u8]>::to_vec).ok_or_else(missing))
        };
        for material in document.materials() {
            let surface = material.pbr_metallic_roughness();
            let texture = surface
                .base_color_texture()
                .map(|info| picture(info.texture().source()));
            let normal_map = material
                .normal_texture()
                .map(|info| picture(info.texture().source()));
            let [r, g, b, _] = surface.base_color_factor();
            let metallic = surface.metallic_factor().clamp(0.0, 1.0);
            // Phong's lobe is about as wide as that of a microfacet surface: n = 2 / α² - 2, α = roughness².
            let alpha = surface.roughness_factor().powi(2).max(0.02);
            self.parts.materials.push(Material {
                albedo: [r, g, b],
                ambient: [1.0; 3],
                diffuse: 1.0 - metallic,
                specular: [r, g, b].map(|colour| DIELECTRIC + (colour - DIELECTRIC) * metallic),
                shininess: 2.0 / (alpha * alpha) - 2.0,
                texture: texture.transpose()?,
                normal_map: normal_map.transpose()?,
            });
        }
        // What primitives without a material get.
        self.parts.materials.push(plain_material());
        self.parts.textures = textures.all;
        Ok(())
    }

    fn read_node(&mut self, node: &Node<'_>, above: Matrix, depth: usize) -> Result<(), Error> {
        self.nodes += 1;
        if depth > MOST_DEPTH || self.nodes > MOST_NODES {
            return Err(Error::refused(format!(
                "its nodes are more than {MOST_NODES}, or more than {MOST_DEPTH} deep"
            )));
        }
        let place = product(
            above,
            node.transform().matrix().map(|column| column.map(f64::from)),
        );
        for primitive in node.mesh().iter().flat_map(|mesh| mesh.primitives()) {
            self.read_primitive(&primitive, place)?;
        }
        for child in node.children() {
            self.read_node(&child, place, depth + 1)?;
        }
        Ok(())
    }

    fn read_primitive(&mut self, primitive: &Primitive<'_>, place: Matrix) -> Result<(), Error> {
        match primitive.mode() {
            Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => return Ok(()),
            Mode::Triangles => {}
            Mode::TriangleStrip | Mode::TriangleFan => {
                return Err(Error::refused("it holds strips or fans: send plain triangles"));
            }
        }
        let lacking =
            |what: &str| Error::damaged(format!("the {what} of a part lie beyond the end, or are lacking"));
        let positions = primitive
            .get(&gltf::Semantic::Positions)
            .ok_or_else(|| lacking("positions"))?;
        let normals = primitive.get(&gltf::Semantic::Normals);
        // Textures take the first set of coordinates unless they say otherwise.
        let material = primitive.material();
        let textured = material.pbr_metallic_roughness().base_color_texture();
        let set = textured.map(|info| info.tex_coord()).unwrap_or_default();
        let uvs = primitive.get(&gltf::Semantic::TexCoords(set));
        check_vectors(Some(&positions), "positions")?;
        check_vectors(normals.as_ref(), "normals")?;
        let corners = primitive
            .indices()
            .map_or(positions.count(), |indices| indices.count());
        let most = [Some(&positions), normals.as_ref(), uvs.as_ref()]
            .into_iter()
            .flatten()
            .map(Accessor::count)
            .max();
        // Before anything is made: a sparse accessor claims what it likes.
        check_size(
            self.parts.triangles.len() + corners / 3,
            self.parts.positions.len() + most.unwrap_or_default(),
        )?;
        let blob = self.blob;
        let source = primitive.reader(|_| Some(blob));
        let read = source.read_positions().ok_or_else(|| lacking("positions"))?;
        let mut part = Part {
            positions: read.map(|at| point(place, at)).collect(),
            normals: Vec::new(),
            uvs: Vec::new(),
            corners: &[],
            material: u32::try_from(material.index().unwrap_or(self.parts.materials.len() - 1))
                .map_err(Error::damaged)?,
        };
        if normals.is_some() {
            let read = source.read_normals().ok_or_else(|| lacking("normals"))?;
            let turn = cofactors(place);
            part.normals = read.map(|normal| turned(turn, normal)).collect();
        }
        if uvs.is_some() {
            let read = source
                .read_tex_coords(set)
                .ok_or_else(|| lacking("texture coordinates"))?;
            part.uvs = read.into_f32().collect();
        }
        let mut corners: Vec<u32> = match primitive.indices() {
            Some(_) => source
                .read_indices()
                .ok_or_else(|| lacking("indices"))?
                .into_u32()
                .collect(),
            None => (0..u32::try_from(part.positions.len()).map_err(Error::damaged)?).collect(),
        };
        if determinant(place) < 0.0 {
            // A mirrored part is seen from its other side.
            corners
                .as_chunks_mut::<3>()
                .0
                .iter_mut()
                .for_each(|corner| corner.swap(1, 2));
        }
        self.parts.add(Part {
            corners: &corners,
            ..part
        })
    }
}

fn check_vectors(accessor: Option<&Accessor<'_>>, what: &str) -> Result<(), Error> {
    let is_plain = |accessor: &Accessor<'_>| {
        accessor.dimensions() == Dimensions::Vec3 && accessor.data_type() == DataType::F32
    };
    if accessor.is_none_or(is_plain) {
        Ok(())
    } else {
        Err(Error::refused(format!("its {what} are not three floats each")))
    }
}

/// Columns of a matrix that does `b` first.
fn product(a: Matrix, b: Matrix) -> Matrix {
    b.map(|column| [0, 1, 2, 3].map(|row| (0..4).map(|k| a[k][row] * column[k]).sum()))
}

#[allow(clippy::cast_possible_truncation, reason = "as the file's own numbers are")]
fn point(place: Matrix, at: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = at.map(f64::from);
    [0, 1, 2].map(|row| (place[0][row] * x + place[1][row] * y + place[2][row] * z + place[3][row]) as f32)
}

/// What turns normals: the inverse's transpose but for its length. Columns; a mirror image's normals point outwards too.
fn cofactors(place: Matrix) -> [[f64; 3]; 3] {
    let columns = [0, 1, 2].map(|i| [place[i][0], place[i][1], place[i][2]]);
    let sign = determinant(place).signum();
    let crossed = |a: usize, b: usize| super::cross(columns[a], columns[b]).map(|c| c * sign);
    [crossed(1, 2), crossed(2, 0), crossed(0, 1)]
}

fn determinant(place: Matrix) -> f64 {
    let columns = [0, 1, 2].map(|i| [place[i][0], place[i][1], place[i][2]]);
    let crossed = super::cross(columns[1], columns[2]);
    (0..3).map(|i| columns[0][i] * crossed[i]).sum()
}

/// Zero where it has no direction.
fn turned(turn: [[f64; 3]; 3], normal: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = normal.map(f64::from);
    let sum = [0, 1, 2].map(|row| turn[0][row] * x + turn[1][row] * y + turn[2][row] * z);
    super::unit(sum).unwrap_or_default()
}
