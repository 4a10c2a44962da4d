//! The mountains and the town of tests/tools/ground_assets.mjs, against what trimesh finds of them.

use crate::files::{name, store};
use serde_json::Value;
use std::{fs, path::Path, process::Command};
use welkin_scene::MeshModel;

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn vector(value: &Value) -> [f64; 3] {
    serde_json::from_value(value.clone()).unwrap()
}

/// Sizes are read as 32-bit floats, whose ends are a tenth of a millimetre apart at ten kilometres: 2e-8 of them.
fn near(found: [f64; 3], expected: &Value, tolerance: f64) {
    let expected = vector(expected);
    let is_near = (0..3).all(|i| (found[i] - expected[i]).abs() <= tolerance);
    assert!(is_near, "{found:?} is not {expected:?}");
}

fn corners(mesh: &MeshModel, triangle: [u32; 3]) -> [[f64; 3]; 3] {
    triangle.map(|corner| mesh.positions[corner as usize].map(f64::from))
}

fn area(mesh: &MeshModel, triangle: [u32; 3]) -> f64 {
    let [a, b, c] = corners(mesh, triangle);
    let [u, v] = [b, c].map(|p| [0, 1, 2].map(|i| p[i] - a[i]));
    let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
    0.5 * (dot(u, u) * dot(v, v) - dot(u, v).powi(2)).max(0.0).sqrt()
}

#[test]
fn the_meshes_of_the_thesis_are_as_trimesh_sees_them() {
    let (folder, store) = store();
    let made = Command::new("node")
        .arg(root().join("tests/tools/ground_assets.mjs"))
        .arg(folder.path().join("meshes"))
        .status();
    assert!(made.unwrap().success());
    let oracle = fs::read_to_string(root().join("tests/oracles/ground_meshes.json")).unwrap();
    let oracle: Value = serde_json::from_str(&oracle).unwrap();
    let [mountains, town] = ["mountains", "town"].map(|which| store.mesh_model(&name(which)).unwrap());
    for (which, mesh, materials) in [
        ("mountains", &mountains, &["slope"][..]),
        ("town", &town, &["street", "wall", "roof"]),
    ] {
        let expected = &oracle[which];
        assert_eq!(
            mesh.triangles.len() as u64,
            expected["triangles"].as_u64().unwrap()
        );
        let ends = |end: fn(f32, f32) -> f32| {
            let all = mesh.positions.iter().copied();
            let found = all.reduce(|a, b| [0, 1, 2].map(|i| end(a[i], b[i])));
            found.unwrap().map(f64::from)
        };
        near(ends(f32::min), &expected["least"], 1e-3);
        near(ends(f32::max), &expected["most"], 1e-3);
        for (i, material) in materials.iter().enumerate() {
            let expected = &expected["materials"][material];
            let is_it = |of: &u32| *of as usize == i;
            let all = mesh.triangles.iter().zip(mesh.material_of.iter());
            let own: Vec<_> = all
                .filter(|(_, of)| is_it(of))
                .map(|(triangle, _)| *triangle)
                .collect();
            assert_eq!(
                own.len() as u64,
                expected["triangles"].as_u64().unwrap(),
                "{material}"
            );
            let whole: f64 = own.iter().map(|&triangle| area(mesh, triangle)).sum();
            let told = expected["area"].as_f64().unwrap();
            // Sides of metres are rounded by 2e-5 m at a kilometre, at random.
            assert!((whole / told - 1.0).abs() < 1e-5, "{material}: {whole} {told}");
            assert!(mesh.materials[i].texture.is_some(), "{material}");
        }
    }
    assert_eq!(
        mountains.positions.len() as u64,
        oracle["mountains"]["vertices"].as_u64().unwrap()
    );
    let [slope] = &mountains.materials[..] else {
        panic!("{:?}", mountains.materials);
    };
    assert!(slope.normal_map.is_some());
    for expected in oracle["mountains"]["vertex_normals"].as_array().unwrap() {
        let at = vector(&expected["at"]);
        let there = |p: &[f32; 3]| (0..3).all(|i| (f64::from(p[i]) - at[i]).abs() < 1e-3);
        let i = mountains.positions.iter().position(there).unwrap();
        // Both sum the same six triangles; positions differ by their rounding, 1e-3 m over sides of 90 m.
        near(mountains.normals[i].map(f64::from), &expected["normal"], 3e-5);
    }
    let groups = ["street", "wall", "roof"];
    for (i, group) in groups.iter().enumerate() {
        let own: Vec<_> = (0..town.triangles.len())
            .filter(|&triangle| town.material_of[triangle] as usize == i)
            .collect();
        for expected in oracle["town"]["face_normals"][group].as_array().unwrap() {
            let place = usize::try_from(expected["triangle"].as_u64().unwrap()).unwrap();
            let triangle = town.triangles[own[place]];
            let all = corners(&town, triangle);
            let middle = [0, 1, 2].map(|k| all.iter().map(|corner| corner[k]).sum::<f64>() / 3.0);
            near(middle, &expected["at"], 1e-3);
            for corner in triangle {
                // The file's normals have four digits behind the point.
                near(
                    town.normals[corner as usize].map(f64::from),
                    &expected["normal"],
                    2e-4,
                );
            }
        }
    }
}
