//! Rays against meshes: the shader against every triangle in f64.

use super::{RADIUS_M, compare, random3, rows};
use crate::{
    cpu::mesh::cast,
    ground::Solid,
    shader,
    tests::{engine, evaluate},
    uniforms::{Part, ground::GroundUniform},
};
use glam::{DVec3, Vec3};
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};
use welkin_scene::{
    Terrain,
    assets::{Material, MeshModel},
};
use wgpu::BufferUsages;

/// Triangles of all sizes, strewn over a square kilometre.
fn model(count: u32, seed: u64) -> MeshModel {
    let mut source = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut positions = Vec::new();
    for k in 0..count {
        let place = (random3(&mut source) - DVec3::new(0.5, 0.5, 0.0)) * DVec3::new(1000.0, 1000.0, 100.0);
        let size = if k % 50 == 0 { 200.0 } else { 15.0 };
        for _ in 0..3 {
            let corner = place + (random3(&mut source) - 0.5) * size;
            positions.push(corner.as_vec3().to_array());
        }
    }
    MeshModel {
        normals: vec![[0.0, 0.0, 1.0]; positions.len()].into(),
        uvs: vec![[0.0; 2]; positions.len()].into(),
        positions: positions.into(),
        triangles: (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        material_of: vec![0; count as usize].into(),
        materials: vec![Material {
            albedo: [0.5; 3],
            ambient: [1.0; 3],
            diffuse: 1.0,
            specular: [0.0; 3],
            shininess: 1.0,
            texture: None,
            normal_map: None,
        }],
        ..MeshModel::default()
    }
}

#[test]
fn rays_meet_meshes_where_triangles_in_f64_are() {
    let engine = engine();
    let gpu = &engine.gpu;
    let placed = serde_json::json!({"kind": "mesh", "name": "any", "up_axis": "z"});
    let Terrain::Mesh(placed) = serde_json::from_value(placed).unwrap() else {
        panic!("no mesh")
    };
    let (mut met, mut loose, mut all) = (0, 0, 0);
    for count in [1, 2, 9, 300, 4000] {
        let solid = Solid::new(&model(count, u64::from(count)), &placed, RADIUS_M).unwrap();
        let triangles: Vec<[DVec3; 3]> = solid
            .triangles
            .chunks_exact(9)
            .map(|t| {
                let [v, e1, e2] = [0, 3, 6].map(|i| Vec3::from_slice(&t[i..i + 3]).as_dvec3());
                [v, v + e1, v + e2]
            })
            .collect();
        assert_eq!(triangles.len(), count as usize);
        let mut source = Xoshiro256PlusPlus::seed_from_u64(5);
        let rays: Vec<(DVec3, DVec3)> = (0..600)
            .map(|i| {
                let wide = if i % 3 == 0 { 1e6 } else { 1500.0 };
                let from = (random3(&mut source) - DVec3::new(0.5, 0.5, 0.0)) * wide;
                let aim = &triangles[i % triangles.len()];
                let share = random3(&mut source);
                // Now and then past it.
                let to =
                    (aim[0] * share.x + aim[1] * share.y + aim[2] * share.z) / share.element_sum() * 1.002;
                let from = from.as_vec3().as_dvec3();
                (from, (to - from).normalize().as_vec3().as_dvec3())
            })
            .collect();
        let size = solid.most_m - solid.least_m;
        let uniform = GroundUniform {
            radius_m: RADIUS_M as f32,
            highest_m: solid.most_m.z as f32,
            lowest_m: solid.least_m.z as f32,
            corner_m: solid.least_m.truncate().as_vec2(),
            cell_m: size.truncate().as_vec2(),
            cells: glam::UVec2::ONE,
            ..GroundUniform::default()
        };
        let ground = Part::new(&uniform).upload(gpu, "ground");
        let shape = gpu.filled(
            "triangles",
            bytemuck::cast_slice(&solid.triangles),
            BufferUsages::STORAGE,
        );
        let finder = gpu.filled("nodes", bytemuck::cast_slice(&solid.nodes), BufferUsages::STORAGE);
        let binds = [
            (0, ground.as_entire_binding()),
            (3, shape.as_entire_binding()),
            (4, finder.as_entire_binding()),
        ];
        let statements = "x.x = cast_mesh(a.xyz, b.xyz, 0.0, 1e12);";
        let found = evaluate(gpu, &shader::GROUND_SHADOW, statements, &rows(&rays), &binds);
        let found: Vec<_> = found
            .iter()
            .map(|x| Some(f64::from(x[0])).filter(|t| *t >= 0.0))
            .collect();
        let (hits, edges) = compare(&rays, &found, |p, d| cast(&triangles, p, d));
        met += hits;
        loose += edges;
        all += rays.len();
    }
    // The test would be empty if most rays missed or grazed. From a thousand kilometres an edge is wide.
    assert!(
        met > all / 2 && loose < all / 3,
        "{met} met, {loose} grazed of {all}"
    );
}
