//! Mountains as a mesh of any fineness: the shape is the same, so that only the number of triangles differs.

use super::mesh::{Noise, model};
use welkin_scene::assets::MeshModel;

/// West to east, metres.
pub(super) const SIDE_M: f32 = 20_000.0;
const HEIGHT_M: f32 = 2_200.0;
/// From one great ridge to the next.
const RIDGES_M: f32 = 2_500.0;
/// Over which heights go down to the plain towards the edges.
const FADE_M: f32 = 3_500.0;
/// What the texture spans before it repeats.
const TEXTURE_M: f32 = 800.0;

/// Square cells of two triangles each; x points east, y up, z south.
#[allow(clippy::cast_precision_loss, reason = "numbers of cells are small")]
pub(super) fn mountains(columns: u32, rows: u32) -> MeshModel {
    let cell_m = SIDE_M / columns as f32;
    let extent_m = [SIDE_M, cell_m * rows as f32];
    let range = Range {
        ridges: (0..6).map(|k| Noise::new(11 + k)).collect(),
        bend: Noise::new(31),
        extent_m,
    };
    let place = |i: u32, j: u32| {
        [
            i as f32 * cell_m - 0.5 * extent_m[0],
            j as f32 * cell_m - 0.5 * extent_m[1],
        ]
    };
    let (mut positions, mut normals, mut uvs) = (Vec::new(), Vec::new(), Vec::new());
    for j in 0..=rows {
        for i in 0..=columns {
            let at @ [x, z] = place(i, j);
            positions.push([x, range.height_m(at), z]);
            let rise = |dx: f32, dz: f32| range.height_m([x + dx, z + dz]) - range.height_m([x - dx, z - dz]);
            let slope = [-rise(cell_m, 0.0), 2.0 * cell_m, -rise(0.0, cell_m)];
            let length = slope.iter().map(|part| part * part).sum::<f32>().sqrt();
            normals.push(slope.map(|part| part / length));
            uvs.push([x / TEXTURE_M, z / TEXTURE_M]);
        }
    }
    let vertex = |i: u32, j: u32| j * (columns + 1) + i;
    let mut triangles = Vec::new();
    for j in 0..rows {
        for i in 0..columns {
            let [a, b, c, d] = [
                vertex(i, j),
                vertex(i, j + 1),
                vertex(i + 1, j + 1),
                vertex(i + 1, j),
            ];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    model((positions, normals, uvs), triangles, [0.16, 0.15, 0.11])
}

struct Range {
    ridges: Vec<Noise>,
    bend: Noise,
    extent_m: [f32; 2],
}

impl Range {
    fn height_m(&self, at: [f32; 2]) -> f32 {
        let inwards = [0, 1].map(|axis| 0.5 * self.extent_m[axis] - at[axis].abs());
        let fade = (inwards[0].min(inwards[1]) / FADE_M).clamp(0.0, 1.0);
        let [x, y] = at.map(|m| m / RIDGES_M);
        let warp = 0.6 * self.bend.at(x, y);
        let (mut sum, mut scale) = (0.0, 1.0);
        for ridges in &self.ridges {
            let crest = (1.0 - ridges.at(scale * (x + warp), scale * (y - warp)).abs()).powi(2);
            sum += crest / scale;
            scale *= 2.0;
        }
        HEIGHT_M * fade * fade * (3.0 - 2.0 * fade) * (0.5 * sum).powf(1.6)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_mountains_have_as_many_triangles_as_asked_for() {
        let (coarse, fine) = (mountains(25, 20), mountains(50, 40));
        assert_eq!(coarse.triangles.len(), 1_000);
        assert_eq!(fine.triangles.len(), 4_000);
        for (k, position) in coarse.positions.iter().enumerate() {
            let (i, j) = (k % 26, k / 26);
            let same = fine.positions[2 * j * 51 + 2 * i];
            // Single precision at heights of kilometres.
            assert!((position[1] - same[1]).abs() < 0.1, "{position:?} {same:?}");
        }
        let highest = fine.positions.iter().map(|p| p[1]).fold(0.0, f32::max);
        assert!((1_000.0..4_000.0).contains(&highest), "{highest}");
        assert!(coarse.digest != fine.digest);
    }

    #[test]
    fn triangles_and_normals_look_up() {
        let model = mountains(25, 20);
        for triangle in model.triangles.iter() {
            let [a, b, c] = triangle.map(|v| model.positions[v as usize]);
            let (u, v) = ([b[0] - a[0], b[2] - a[2]], [c[0] - a[0], c[2] - a[2]]);
            // The y of u × v.
            assert!(u[1] * v[0] - u[0] * v[1] > 0.0, "{triangle:?}");
        }
        assert!(model.normals.iter().all(|normal| normal[1] > 0.0));
    }
}
