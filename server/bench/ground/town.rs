//! A town of streets, gabled houses and blocks with flat roofs.

use super::mesh::{Vertices, hash, model, share};
use welkin_scene::assets::MeshModel;

/// West to east, metres.
pub(super) const SIDE_M: f32 = 1_600.0;
/// Cells of street each way, of two triangles.
const STREETS: u16 = 10;
/// Lots each way; along the middle column runs the main street.
const LOTS: u16 = 33;
/// Of 14 triangles each.
const HOUSES: u32 = 400;
/// Of 10 triangles each.
const BLOCKS: u32 = 602;

/// 200 + 400 × 14 + 602 × 10 = 11,820 triangles; x points east, y up, z south.
pub(super) fn town() -> MeshModel {
    let mut faces = Faces::default();
    let cell = SIDE_M / f32::from(STREETS);
    for j in 0..STREETS {
        for i in 0..STREETS {
            let [x, z] = [i, j].map(|k| f32::from(k) * cell - 0.5 * SIDE_M);
            faces.add(&[
                [x, 0.0, z],
                [x, 0.0, z + cell],
                [x + cell, 0.0, z + cell],
                [x + cell, 0.0, z],
            ]);
        }
    }
    let lot = SIDE_M / f32::from(LOTS + 1);
    let middle = LOTS / 2;
    let places = (0..LOTS).flat_map(|j| (0..LOTS).map(move |i| [i, j]));
    let places = places.filter(|[i, _]| *i != middle);
    for (n, place) in (0..HOUSES + BLOCKS).zip(places) {
        let draw = |k: u32| share(hash(8 * n + k));
        let [x, z] = place.map(|k| (f32::from(k) - f32::from(middle)) * lot);
        let half = [lot * (0.25 + 0.1 * draw(0)), lot * (0.25 + 0.1 * draw(1))];
        // Evenly among the blocks.
        let before = |n: u32| n * HOUSES / (HOUSES + BLOCKS);
        if before(n + 1) > before(n) {
            faces.house([x, z], half, 5.0 + 4.0 * draw(2));
        } else {
            // Taller towards the middle.
            let tall = (-(x * x + z * z) / (0.18 * SIDE_M).powi(2)).exp();
            faces.block([x, z], half, 9.0 + 10.0 * draw(2) + 60.0 * tall * draw(3));
        }
    }
    model(faces.vertices, faces.triangles, [0.35, 0.3, 0.26])
}

#[derive(Default)]
struct Faces {
    vertices: Vertices,
    triangles: Vec<[u32; 3]>,
}

impl Faces {
    /// A flat face, its corners anticlockwise as seen from outside.
    fn add(&mut self, corners: &[[f32; 3]]) {
        let [a, b, c] = [corners[0], corners[1], corners[2]];
        let [u, v] = [b, c].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
        let normal = unit([
            u[1] * v[2] - u[2] * v[1],
            u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0],
        ]);
        let along = unit(u);
        let (positions, normals, uvs) = &mut self.vertices;
        let first = u32::try_from(positions.len()).unwrap_or(u32::MAX);
        for corner in corners {
            let way = [corner[0] - a[0], corner[1] - a[1], corner[2] - a[2]];
            let far = way.iter().zip(along).map(|(a, b)| a * b).sum::<f32>();
            let up = (way.iter().map(|a| a * a).sum::<f32>() - far * far)
                .max(0.0)
                .sqrt();
            positions.push(*corner);
            normals.push(normal);
            uvs.push([far / 8.0, up / 8.0]);
        }
        let count = u32::try_from(corners.len()).unwrap_or(3);
        let fan = (2..count).map(|k| [first, first + k - 1, first + k]);
        self.triangles.extend(fan);
    }

    fn walls(&mut self, ring: [[f32; 2]; 4], height_m: f32) {
        for k in 0..4 {
            let ([ax, az], [bx, bz]) = (ring[k], ring[(k + 1) % 4]);
            self.add(&[
                [ax, 0.0, az],
                [bx, 0.0, bz],
                [bx, height_m, bz],
                [ax, height_m, az],
            ]);
        }
    }

    fn block(&mut self, at: [f32; 2], half: [f32; 2], height_m: f32) {
        let ring = ring(at, half);
        self.walls(ring, height_m);
        self.add(&ring.map(|[x, z]| [x, height_m, z]));
    }

    fn house(&mut self, [x, z]: [f32; 2], [w, d]: [f32; 2], eaves_m: f32) {
        self.walls(ring([x, z], [w, d]), eaves_m);
        let top_m = eaves_m + 0.8 * d;
        let at = |east: f32, south: f32| [x + east, eaves_m, z + south];
        let (left, right) = ([x - w, top_m, z], [x + w, top_m, z]);
        self.add(&[at(w, d), at(w, -d), right]);
        self.add(&[at(-w, -d), at(-w, d), left]);
        self.add(&[at(-w, d), at(w, d), right, left]);
        self.add(&[at(w, -d), at(-w, -d), left, right]);
    }
}

/// Corners on the ground, anticlockwise as seen from above.
fn ring([x, z]: [f32; 2], [w, d]: [f32; 2]) -> [[f32; 2]; 4] {
    [[x - w, z + d], [x + w, z + d], [x + w, z - d], [x - w, z - d]]
}

fn unit(v: [f32; 3]) -> [f32; 3] {
    let length = v.iter().map(|part| part * part).sum::<f32>().sqrt();
    v.map(|part| part / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_town_has_the_thesis_triangles_which_look_outwards() {
        let town = town();
        assert_eq!(town.triangles.len(), 11_820);
        assert_eq!(town.positions.len(), town.normals.len());
        let mut down = 0;
        for (triangle, normal) in town.triangles.iter().map(|t| (t, town.normals[t[0] as usize])) {
            // Of length 1 but for single precision.
            let length = normal.iter().map(|part| part * part).sum::<f32>();
            assert!((length - 1.0).abs() < 1e-5, "{triangle:?} {normal:?}");
            down += u32::from(normal[1] < -0.1);
        }
        assert_eq!(down, 0);
        let highest = town.positions.iter().map(|p| p[1]).fold(0.0, f32::max);
        assert!((30.0..90.0).contains(&highest), "{highest}");
    }
}
