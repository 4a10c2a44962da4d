//! A mesh as the shaders read it: triangles in the order of a tree's leaves, the tree, and what covers them.

use super::Frame;
use crate::{error::Error, uniforms::narrow};
use glam::{DMat3, DVec3, Vec3};
use obvhs::{
    BvhBuildParams,
    bvh2::{Bvh2, builder::build_bvh2_from_tris, node::Bvh2Node},
    triangle::Triangle,
};
use std::time::Duration;
use welkin_scene::{
    assets::MeshModel,
    terrain::{Mesh, Phong},
};

/// Words of the shaders' buffers, as `lib/mesh.wgsl` and `lib/mesh_skin.wgsl` name them.
pub(crate) struct Solid {
    pub(crate) triangles: Vec<f32>,
    pub(crate) nodes: Vec<u32>,
    pub(crate) attributes: Vec<u32>,
    pub(crate) materials: Vec<u32>,
    pub(crate) pictures: Vec<u32>,
    pub(crate) least_m: DVec3,
    pub(crate) most_m: DVec3,
}

/// `MOST_DEEP` of `lib/mesh.wgsl`.
const MOST_DEEP: usize = 64;
/// Four bits hold the number.
const MOST_IN_LEAF: u32 = 8;
const LEAF: u32 = 0x8000_0000;
const COUNT_SHIFT: u32 = 27;

impl Solid {
    /// In the frame of the place where it stands.
    pub(crate) fn new(model: &MeshModel, placed: &Mesh, radius_m: f64) -> Result<Self, Error> {
        let rows = placed.axes().map(DVec3::from_array);
        let turn = DMat3::from_cols(rows[0], rows[1], rows[2]).transpose();
        let lift = DVec3::Z * placed.position_m[2];
        let vertices: Vec<Vec3> = model
            .positions
            .iter()
            .map(|p| {
                let flat = turn * DVec3::from_array(p.map(f64::from)) + lift;
                let squared = flat.truncate().length_squared();
                let fall = squared / (radius_m + (radius_m * radius_m - squared).max(0.0).sqrt());
                (flat - DVec3::Z * fall).as_vec3()
            })
            .collect();
        let upright = turn / placed.scale;
        let normals: Vec<u32> = model
            .normals
            .iter()
            .map(|n| pack_direction((upright * DVec3::from_array(n.map(f64::from))).as_vec3()))
            .collect();
        let corners = |triangle: &[u32; 3]| triangle.map(|i| vertices[i as usize]);
        let all: Vec<Triangle> = model
            .triangles
            .iter()
            .map(|triangle| {
                let [v0, v1, v2] = corners(triangle).map(Into::into);
                Triangle { v0, v1, v2 }
            })
            .collect();
        let params = BvhBuildParams {
            max_prims_per_leaf: MOST_IN_LEAF,
            ..BvhBuildParams::fast_build()
        };
        let tree = build_bvh2_from_tris(&all, params, &mut Duration::default());
        let nodes = flattened(&tree)?;
        let (mut triangles, mut attributes) = (Vec::new(), Vec::new());
        for &index in &tree.primitive_indices {
            let i = index as usize;
            let triangle = &model.triangles[i];
            let [a, b, c] = corners(triangle);
            for v in [a, b - a, c - a] {
                triangles.extend(v.to_array());
            }
            attributes.extend(triangle.map(|v| normals[v as usize]));
            for v in triangle {
                attributes.extend(model.uvs[*v as usize].map(f32::to_bits));
            }
            attributes.push(model.material_of[i]);
        }
        let (pictures, begins) = pictures(model);
        let (mut least_m, mut most_m) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for vertex in &vertices {
            (least_m, most_m) = (least_m.min(*vertex), most_m.max(*vertex));
        }
        Ok(Self {
            triangles,
            nodes,
            attributes,
            materials: materials(model, placed.phong, &begins),
            pictures,
            least_m: least_m.as_dvec3(),
            most_m: most_m.as_dvec3(),
        })
    }

    pub(crate) fn frame(placed: &Mesh, radius_m: f64) -> Frame {
        let [east, north, _] = placed.position_m;
        Frame::new(radius_m, [east, north], 0.0)
    }
}

/// Sixteen words a node: the boxes of its halves, and what these are. The first is the root.
fn flattened(tree: &Bvh2) -> Result<Vec<u32>, Error> {
    let word = |node: &Bvh2Node, at: u32| {
        if node.is_leaf() {
            LEAF | node.prim_count << COUNT_SHIFT | node.first_index
        } else {
            at
        }
    };
    let boxed = |node: &Bvh2Node| {
        let (least, most) = (node.aabb.min, node.aabb.max);
        [least.x, least.y, least.z, most.x, most.y, most.z].map(f32::to_bits)
    };
    let root = &tree.nodes[0];
    if root.is_leaf() {
        // A leaf alone stands as one half; the other is a leaf of nothing.
        let mut nodes = [boxed(root), boxed(root)].concat();
        nodes.extend([word(root, 0), LEAF, 0, 0]);
        return Ok(nodes);
    }
    let mut nodes = Vec::new();
    // Nodes whose halves are to be written, each with how deep it lies.
    let mut queue = std::collections::VecDeque::from([(root, 0)]);
    let mut known = 1_u32;
    while let Some((node, deep)) = queue.pop_front() {
        if deep >= MOST_DEEP {
            return Err(Error::Mesh(format!("its tree is deeper than {MOST_DEEP} boxes")));
        }
        let first = node.first_index as usize;
        let halves = [&tree.nodes[first], &tree.nodes[first + 1]];
        let words = halves.map(|half| {
            let at = known;
            if !half.is_leaf() {
                known += 1;
                queue.push_back((half, deep + 1));
            }
            word(half, at)
        });
        for half in halves {
            nodes.extend(boxed(half));
        }
        nodes.extend([words[0], words[1], 0, 0]);
    }
    Ok(nodes)
}

/// `Material` of `lib/mesh_skin.wgsl`, twelve words each.
fn materials(model: &MeshModel, phong: Option<Phong>, begins: &[u32]) -> Vec<u32> {
    let mut words = Vec::new();
    for material in &model.materials {
        let specular = material.specular.iter().sum::<f32>() / 3.0;
        let own = (material.diffuse, material.ambient, specular, material.shininess);
        let (diffuse, ambient, specular, shininess) = phong.map_or(own, |p| {
            (
                narrow(p.diffuse),
                [narrow(p.ambient); 3],
                narrow(p.specular),
                narrow(p.shininess),
            )
        });
        words.extend(material.albedo.map(f32::to_bits));
        words.push(diffuse.to_bits());
        words.extend(ambient.map(f32::to_bits));
        words.extend([specular.to_bits(), shininess.to_bits()]);
        words.extend([material.texture, material.normal_map].map(|t| t.map_or(0, |t| begins[t] + 1)));
        words.push(0);
    }
    words
}

/// Every texture with ever smaller ones of itself, and where each begins.
fn pictures(model: &MeshModel) -> (Vec<u32>, Vec<u32>) {
    // An empty buffer cannot be bound.
    let (mut words, mut begins) = (vec![0], Vec::new());
    for (index, texture) in model.textures.iter().enumerate() {
        begins.push(u32::try_from(words.len()).unwrap_or(u32::MAX));
        let is_colour = model.materials.iter().any(|m| m.texture == Some(index));
        words.extend([texture.width_px, texture.height_px]);
        let (mut width, mut height) = (texture.width_px as usize, texture.height_px as usize);
        let mut texels: Vec<[f32; 4]> = texture
            .rgba
            .chunks_exact(4)
            .map(|t| {
                let value = |v: u8| f32::from(v) / 255.0;
                let linear = |v: u8| if is_colour { from_srgb(value(v)) } else { value(v) };
                [linear(t[0]), linear(t[1]), linear(t[2]), value(t[3])]
            })
            .collect();
        loop {
            words.extend(texels.iter().map(|t| packed(*t, is_colour)));
            if width == 1 && height == 1 {
                break;
            }
            (texels, width, height) = halved(&texels, width, height);
        }
    }
    (words, begins)
}

fn from_srgb(v: f32) -> f32 {
    if v <= 0.040_45 {
        v / 12.92
    } else {
        ((v + 0.055) / 1.055).powf(2.4)
    }
}

/// Colours as square roots, which eight bits hold well.
fn packed(texel: [f32; 4], is_colour: bool) -> u32 {
    let byte = |v: f32| {
        let v = if is_colour { v.sqrt() } else { v };
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to a byte"
        )]
        let byte = (v * 255.0).round().clamp(0.0, 255.0) as u8;
        byte
    };
    u32::from_le_bytes(texel.map(byte))
}

/// Half as wide and high, the means of four; an odd row or column counts twice at the edge.
fn halved(texels: &[[f32; 4]], width: usize, height: usize) -> (Vec<[f32; 4]>, usize, usize) {
    let (w, h) = ((width / 2).max(1), (height / 2).max(1));
    let at = |x: usize, y: usize| texels[y.min(height - 1) * width + x.min(width - 1)];
    let mean = |i: usize| {
        let (x, y) = (2 * (i % w), 2 * (i / w));
        let four = [at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)];
        [0, 1, 2, 3].map(|c| four.iter().map(|t| t[c]).sum::<f32>() / 4.0)
    };
    ((0..w * h).map(mean).collect(), w, h)
}

/// `pack_direction` of `lib/seen_ground.wgsl`.
fn pack_direction(n: Vec3) -> u32 {
    let p = n.truncate() / n.abs().element_sum().max(1e-12);
    let sign = glam::Vec2::select(p.cmpge(glam::Vec2::ZERO), glam::Vec2::ONE, glam::Vec2::NEG_ONE);
    let folded = if n.z < 0.0 {
        (1.0 - glam::Vec2::new(p.y, p.x).abs()) * sign
    } else {
        p
    };
    let part = |v: f32| {
        #[allow(clippy::cast_possible_truncation, reason = "clamped to a short integer")]
        let short = (v.clamp(-1.0, 1.0) * 32767.0).round() as i16;
        u32::from(u16::from_le_bytes(short.to_le_bytes()))
    };
    part(folded.x) | part(folded.y) << 16
}
