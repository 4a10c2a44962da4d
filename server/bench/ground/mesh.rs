//! What the bench's meshes have in common.

use sha2::{Digest, Sha256};
use welkin_scene::assets::{Material, MeshModel, Texture};

/// Positions, normals and places on the texture.
pub(super) type Vertices = (Vec<[f32; 3]>, Vec<[f32; 3]>, Vec<[f32; 2]>);

/// Of the texture and of the normal map, pixels.
const TEXTURE_PX: u32 = 256;

/// One material with a grained texture and a normal map, as those of the thesis have.
pub(super) fn model(vertices: Vertices, triangles: Vec<[u32; 3]>, albedo: [f32; 3]) -> MeshModel {
    let (positions, normals, uvs) = vertices;
    let mut digest = Sha256::new();
    for value in positions.as_flattened() {
        digest.update(value.to_le_bytes());
    }
    for index in triangles.as_flattened() {
        digest.update(index.to_le_bytes());
    }
    MeshModel {
        positions: positions.into(),
        normals: normals.into(),
        uvs: uvs.into(),
        material_of: vec![0; triangles.len()].into(),
        triangles: triangles.into(),
        materials: vec![Material {
            albedo,
            ambient: [1.0; 3],
            diffuse: 1.0,
            specular: [0.02; 3],
            shininess: 16.0,
            texture: Some(0),
            normal_map: Some(1),
        }],
        textures: vec![
            texture(|grain| [grain(0, 0) + 0.5; 3]),
            texture(|grain| {
                let slope = [grain(-1, 0) - grain(1, 0), grain(0, 1) - grain(0, -1), 1.0];
                let length = slope.iter().map(|part| part * part).sum::<f32>().sqrt();
                slope.map(|part| 0.5 + 0.5 * part / length)
            }),
        ],
        digest: digest.finalize().into(),
    }
}

/// `colour` gets the noise so many pixels to the right and down, -0.5 to 0.5.
#[allow(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "few pixels, and bytes by their own bounds"
)]
fn texture(colour: impl Fn(&dyn Fn(i32, i32) -> f32) -> [f32; 3]) -> Texture {
    let noise = Noise::new(71);
    let side = i64::from(TEXTURE_PX);
    let mut rgba = Vec::new();
    for y in 0..side {
        for x in 0..side {
            let grain = |right: i32, down: i32| {
                let wrapped = |at: i64| at.rem_euclid(side) as f32 / 8.0;
                0.5 * noise.at(wrapped(x + i64::from(right)), wrapped(y + i64::from(down)))
            };
            rgba.extend(colour(&grain).map(|part| (255.0 * part.clamp(0.0, 1.0)).round() as u8));
            rgba.push(255);
        }
    }
    Texture {
        width_px: TEXTURE_PX,
        height_px: TEXTURE_PX,
        rgba: rgba.into(),
    }
}

/// Value noise over the plane, -1 to 1, one wave long 2.
#[derive(Clone, Copy)]
pub(super) struct Noise {
    seed: u32,
}

impl Noise {
    pub(super) const fn new(seed: u32) -> Self {
        Self { seed }
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "cells are few; their numbers may wrap"
    )]
    pub(super) fn at(self, x: f32, y: f32) -> f32 {
        let ease = |t: f32| t * t * (3.0 - 2.0 * t);
        let (u, v) = (ease(x - x.floor()), ease(y - y.floor()));
        let corner = |dx: i32, dy: i32| {
            let [i, j] = [x.floor() as i32 + dx, y.floor() as i32 + dy].map(|i| i as u32);
            2.0 * share(hash(hash(i.wrapping_add(self.seed)).wrapping_add(j))) - 1.0
        };
        let row = |dy: i32| corner(0, dy) + u * (corner(1, dy) - corner(0, dy));
        row(0) + v * (row(1) - row(0))
    }
}

/// Wellons' mixing of 32 bits ("lowbias32").
pub(super) fn hash(x: u32) -> u32 {
    let h = (x ^ x >> 16).wrapping_mul(0x7feb_352d);
    let h = (h ^ h >> 15).wrapping_mul(0x846c_a68b);
    h ^ h >> 16
}

/// From 0 to 1.
#[allow(clippy::cast_precision_loss, reason = "24 bits")]
pub(super) fn share(hash: u32) -> f32 {
    (hash >> 8) as f32 / 16_777_216.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_within_its_bounds_and_without_leaps() {
        let noise = Noise::new(3);
        let mut seen = [f32::INFINITY, f32::NEG_INFINITY];
        for k in -400_i16..400 {
            let x = f32::from(k) * 0.05;
            let (here, next) = (noise.at(x, 2.3), noise.at(x + 1e-3, 2.3));
            // Its steepest is 3 over one cell.
            assert!((here - next).abs() < 4e-3, "{x}");
            seen = [seen[0].min(here), seen[1].max(here)];
        }
        assert!(seen[0] >= -1.0 && seen[1] <= 1.0, "{seen:?}");
        assert!(seen[1] - seen[0] > 1.0, "{seen:?}");
    }
}
