//! Meshes as binary glTF.

use crate::{
    files::store,
    meshes::{pixel, read, refused},
};
use proptest::prelude::*;
use serde_json::{Value, json};

/// The container: a header, the document, and its bytes.
fn glb(document: &Value, blob: &[u8]) -> Vec<u8> {
    let padded = |mut bytes: Vec<u8>, with: u8| {
        bytes.resize(bytes.len().next_multiple_of(4), with);
        bytes
    };
    let (document, blob) = (
        padded(document.to_string().into_bytes(), b' '),
        padded(blob.to_vec(), 0),
    );
    let length = |bytes: usize| (bytes as u32).to_le_bytes();
    [
        b"glTF".as_slice(),
        &2_u32.to_le_bytes(),
        &length(28 + document.len() + blob.len()),
        &length(document.len()),
        b"JSON",
        &document,
        &length(blob.len()),
        b"BIN\0",
        &blob,
    ]
    .concat()
}

fn floats(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// A triangle with normals, texture coordinates, indices and one texture, and where its bytes lie.
fn textured() -> (Value, Vec<u8>) {
    let texture = pixel([10, 20, 30]);
    let mut blob = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    blob.extend(floats(&[0.0, 0.0, 2.0].repeat(3)));
    blob.extend(floats(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]));
    blob.extend([0_u16, 1, 2].iter().flat_map(|i| i.to_le_bytes()));
    blob.extend([0; 2]);
    blob.extend(&texture);
    let view =
        |offset: usize, length: usize| json!({"buffer": 0, "byteOffset": offset, "byteLength": length});
    let accessor = |view: u32, kind: u32, shape: &str| json!({"bufferView": view, "componentType": kind, "count": 3, "type": shape});
    let mut positions = accessor(0, 5126, "VEC3");
    positions["min"] = json!([0, 0, 0]);
    positions["max"] = json!([1, 1, 0]);
    let document = json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{
            "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {
            "baseColorFactor": [0.5, 0.25, 1.0, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.5,
            "baseColorTexture": {"index": 0}}, "normalTexture": {"index": 0}}],
        "textures": [{"source": 0}],
        "images": [{"bufferView": 4, "mimeType": "image/png"}],
        "buffers": [{"byteLength": blob.len()}],
        "bufferViews": [view(0, 36), view(36, 36), view(72, 24), view(96, 6), view(104, texture.len())],
        "accessors": [positions, accessor(1, 5126, "VEC3"), accessor(2, 5126, "VEC2"), accessor(3, 5123, "SCALAR")],
    });
    (document, blob)
}

#[test]
fn a_glb_comes_with_its_materials() {
    let (folder, store) = store();
    let (document, blob) = textured();
    let mesh = read(&store, &glb(&document, &blob)).unwrap();
    assert_eq!(mesh.positions[1], [1.0, 0.0, 0.0]);
    assert_eq!(mesh.normals[..], [[0.0, 0.0, 1.0]; 3]);
    assert_eq!(mesh.uvs[..], [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    assert_eq!(mesh.triangles[..], [[0, 1, 2]]);
    let material = &mesh.materials[mesh.material_of[0] as usize];
    assert_eq!((material.albedo, material.diffuse), ([0.5, 0.25, 1.0], 1.0));
    // 4 % of the light is mirrored, where the albedo leaves it.
    assert_eq!(material.specular, [0.04, 0.04, 0.0]);
    // A roughness of 0.5 is an α of 0.25: 2 / 0.0625 - 2.
    assert_eq!(material.shininess, 30.0);
    assert_eq!((material.texture, material.normal_map), (Some(0), Some(0)));
    assert_eq!(mesh.textures[0].rgba[..], [10, 20, 30, 255]);
    assert!(folder.path().join("meshes/it.glb").is_file());
}

#[test]
fn nodes_place_their_meshes() {
    let (_folder, store) = store();
    let (mut document, blob) = textured();
    // Twice as large, a quarter turned about z, one up; and a mirror image of that.
    document["nodes"] = json!([
        {"children": [1, 2], "scale": [2, 2, 2]},
        {"mesh": 0, "translation": [0, 0, 1], "rotation": [0, 0, 0.5_f64.sqrt(), 0.5_f64.sqrt()]},
        {"mesh": 0, "scale": [1, 1, -1]},
    ]);
    let mesh = read(&store, &glb(&document, &blob)).unwrap();
    assert_eq!(mesh.triangles.len(), 2);
    let near = |a: [f32; 3], b: [f32; 3]| {
        // The rotation is rounded to 24 bits.
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6), "{a:?} {b:?}");
    };
    near(mesh.positions[1], [0.0, 2.0, 2.0]);
    near(mesh.positions[2], [-2.0, 0.0, 2.0]);
    near(mesh.normals[0], [0.0, 0.0, 1.0]);
    near(mesh.positions[4], [2.0, 0.0, 0.0]);
    near(mesh.normals[3], [0.0, 0.0, -1.0]);
    assert_eq!(mesh.triangles[1], [3, 5, 4], "seen from the other side");
}

#[test]
fn what_lies_outside_or_is_broken_is_refused() {
    let (_folder, store) = store();
    let (document, blob) = textured();
    let check = |pointer: &str, value: Value, told: &str| {
        let mut changed = document.clone();
        match changed.pointer_mut(pointer) {
            Some(place) => *place = value,
            None => {
                let (parent, key) = pointer.rsplit_once('/').unwrap();
                changed.pointer_mut(parent).unwrap()[key] = value;
            }
        }
        refused(&store, &glb(&changed, &blob), told);
    };
    check("/buffers/0/uri", json!("../secret.bin"), "../secret.bin");
    check(
        "/buffers/0/uri",
        json!("data:application/octet-stream;base64,AA=="),
        "data:",
    );
    check("/images/0", json!({"uri": "/etc/passwd"}), "/etc/passwd");
    check(
        "/images/0",
        json!({"uri": "http://host/a.png"}),
        "http://host/a.png",
    );
    check("/extensionsRequired", json!(["KHR_draco_mesh_compression"]), "");
    check("/meshes/0/primitives/0/mode", json!(5), "strips or fans");
    check("/meshes/0/primitives/0/mode", json!(0), "no triangles");
    check("/meshes/0/primitives/0/attributes/POSITION", json!(9), "");
    check(
        "/meshes/0/primitives/0/attributes/NORMAL",
        json!(2),
        "not three floats",
    );
    check("/accessors/0/count", json!(4_000_000), "4000000 vertices");
    check("/accessors/0/count", json!(4), "");
    check("/accessors/3/count", json!(4_000_000_000_u32), "triangles");
    check("/accessors/3/count", json!(2), "three corners");
    check("/accessors/0/byteOffset", json!(40), "");
    check(
        "/accessors/0",
        json!({"componentType": 5126, "count": 3_000_000_000_u32, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0],
            "sparse": {"count": 1, "indices": {"bufferView": 3, "componentType": 5123}, "values": {"bufferView": 0}}}),
        "3000000000 vertices",
    );
    check("/bufferViews/0/byteLength", json!(1_000_000), "");
    check("/bufferViews/0/byteOffset", json!(u64::MAX), "");
    check("/bufferViews/0/byteStride", json!(0), "");
    check(
        "/bufferViews/4/byteOffset",
        json!(1_000_000),
        "image 0 lies beyond the end",
    );
    check("/bufferViews/4/byteOffset", json!(0), "neither PNG nor JPEG");
    check("/nodes", json!([{"children": [0]}]), "deep");
    check("/scenes", json!([]), "");
    check(
        "/materials/0/pbrMetallicRoughness/baseColorFactor",
        json!([1e39, 0, 0, 1]),
        "",
    );
    let mut broken = blob.clone();
    broken[96] = 7;
    refused(&store, &glb(&document, &broken), "names vertex 7");
    broken[..4].copy_from_slice(&f32::NAN.to_le_bytes());
    broken[96] = 0;
    refused(&store, &glb(&document, &broken), "NaN");
    let whole = glb(&document, &blob);
    for length in 0..whole.len() {
        assert!(read(&store, &whole[..length]).is_err(), "{length}");
    }
}

/// Each node holds the next one ten times over: ten to the power of twenty nodes.
#[test]
fn a_tree_that_grows_without_end_is_cut() {
    let (_folder, store) = store();
    let (mut document, blob) = textured();
    let nodes: Vec<_> = (1..21)
        .map(|i| json!({"children": vec![i; 10]}))
        .chain([json!({"mesh": 0})])
        .collect();
    document["nodes"] = nodes.into();
    refused(&store, &glb(&document, &blob), "more than 100000");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn changed_files_are_refused_or_whole(
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let (_folder, store) = store();
        let (document, blob) = textured();
        let mut file = glb(&document, &blob);
        for (at, byte) in changes {
            let at = at.index(file.len());
            file[at] = byte;
        }
        if let Ok(mesh) = read(&store, &file) {
            let count = mesh.positions.len();
            prop_assert!(mesh.triangles.iter().flatten().all(|&corner| (corner as usize) < count));
            prop_assert!(mesh.positions.iter().flatten().all(|c| c.is_finite()));
        }
    }
}
