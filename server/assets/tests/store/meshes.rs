//! Meshes as OBJ: what is read, and what is refused.

use crate::files::{name, png, store};
use ::png::{BitDepth, ColorType};
use proptest::prelude::*;
use std::{
    fs,
    io::{Cursor, Write},
    sync::Arc,
};
use welkin_assets::{Error, Facts, Form, Kind, Store};
use welkin_scene::MeshModel;
use zip::{CompressionMethod, ZipWriter, write::SimpleFileOptions};

pub(crate) const MESHES: Kind = Kind::Meshes;

pub(crate) fn zipped(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
    for (path, bytes) in files {
        zip.start_file(*path, options).unwrap();
        zip.write_all(bytes).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

pub(crate) fn read(store: &Store, file: &[u8]) -> Result<Arc<MeshModel>, Error> {
    store.put(MESHES, &name("it"), file, |_| true)?;
    store.mesh_model(&name("it"))
}

pub(crate) fn refused(store: &Store, file: &[u8], told: &str) {
    let Err(error) = read(store, file) else {
        panic!("taken, though {told:?}: {}", String::from_utf8_lossy(file));
    };
    assert!(
        matches!(
            error,
            Error::Refused { .. } | Error::Damaged { .. } | Error::Form { .. }
        ),
        "{error}"
    );
    assert!(error.to_string().contains(told), "{error}");
}

fn obj(text: &str) -> Vec<u8> {
    zipped(&[("it.obj", text.as_bytes())])
}

pub(crate) fn pixel(rgb: [u8; 3]) -> Vec<u8> {
    png((1, 1), ColorType::Rgb, BitDepth::Eight, &rgb, |_| {})
}

/// A square of two triangles, of which one has a material.
const SQUARE: &str = "mtllib it.mtl\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
                      f 1/1 2/2 3/3\nusemtl roof\nf 1/1 3/3 4/4\n";
const ROOF: &str = "newmtl roof\nKa 0.5 0.5 0.5\nKd 0.6 0.4 0.2\nKs 0.9 0.9 0.1\nNs 50\n\
                    map_Kd -s 1 1 1 colours/my roof.png\nnorm colours/bumps.png\n";

#[test]
fn an_obj_comes_with_materials_textures_and_normals() {
    let (folder, store) = store();
    let file = zipped(&[
        ("town/it.obj", SQUARE.as_bytes()),
        ("town/it.mtl", ROOF.as_bytes()),
        ("town/colours/my roof.png", &pixel([200, 100, 50])),
        ("town/colours/bumps.png", &pixel([128, 128, 255])),
        ("town/read me.txt", b"not looked at"),
    ]);
    let mesh = read(&store, &file).unwrap();
    assert_eq!(mesh.triangles.len(), 2);
    assert_eq!(mesh.normals[..], [[0.0, 0.0, 1.0]; 6]);
    // The texture's first row is its top.
    assert_eq!(mesh.positions[2], [2.0, 2.0, 0.0]);
    assert_eq!(mesh.uvs[2], [1.0, 0.0]);
    let [bare, roof] = [0, 1].map(|i| &mesh.materials[mesh.material_of[i] as usize]);
    assert_eq!((bare.albedo, bare.texture), ([0.8; 3], None));
    assert_eq!(
        (roof.albedo, roof.ambient, roof.shininess),
        ([0.6, 0.4, 0.2], [0.5; 3], 50.0)
    );
    // No more is mirrored than the albedo leaves; 1 - 0.6 is rounded.
    for (specular, expected) in roof.specular.iter().zip([0.4, 0.6, 0.1_f32]) {
        assert!((specular - expected).abs() < 1e-6, "{roof:?}");
    }
    assert_eq!(mesh.textures[roof.texture.unwrap()].rgba[..], [200, 100, 50, 255]);
    assert_eq!(
        mesh.textures[roof.normal_map.unwrap()].rgba[..],
        [128, 128, 255, 255]
    );
    assert!(folder.path().join("meshes/it.zip").is_file());
    let asset = store.asset(MESHES, &name("it")).unwrap().unwrap();
    assert_eq!(
        (asset.form, asset.form.media_type()),
        (Form::Zip, "application/zip")
    );
    let Facts::Mesh(facts) = asset.facts else {
        panic!("{asset:?}");
    };
    assert_eq!((facts.triangles, facts.materials, facts.textures), (2, 2, 2));
    assert_eq!((facts.least, facts.most), ([0.0; 3], [2.0, 2.0, 0.0]));
}

/// A folder of the same files is the same mesh; it may be read, replaced and removed like a file.
#[test]
fn a_folder_may_stand_for_a_file() {
    let (folder, store) = store();
    let inside = folder.path().join("meshes/town");
    fs::create_dir_all(inside.join("colours")).unwrap();
    fs::write(inside.join("it.obj"), SQUARE).unwrap();
    fs::write(inside.join("it.mtl"), ROOF).unwrap();
    fs::write(inside.join("colours/my roof.png"), pixel([1, 2, 3])).unwrap();
    fs::write(inside.join("colours/bumps.png"), pixel([128, 128, 255])).unwrap();
    fs::write(inside.join(".hidden.obj"), "no mesh").unwrap();
    let name = name("town");
    let first = store.mesh_model(&name).unwrap();
    assert_eq!((first.triangles.len(), first.textures[0].rgba[0]), (2, 1));
    let (asset, packed) = store.file(MESHES, &name).unwrap();
    assert_eq!((asset.form, asset.digest), (Form::Zip, first.digest));
    assert_eq!(
        read(&store, &packed).unwrap().triangles.len(),
        2,
        "it can be sent elsewhere"
    );
    fs::write(inside.join("colours/my roof.png"), pixel([9, 2, 3])).unwrap();
    assert_eq!(store.mesh_model(&name).unwrap().textures[0].rgba[0], 9);
    let listed: Vec<_> = store.list(MESHES).unwrap().into_iter().map(|a| a.name).collect();
    assert_eq!(listed, [crate::files::name("it"), name.clone()]);
    store
        .put(
            MESHES,
            &name,
            &obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
            |_| true,
        )
        .unwrap();
    assert!(!inside.exists() && folder.path().join("meshes/town.zip").is_file());
    assert_eq!(store.mesh_model(&name).unwrap().triangles.len(), 1);
    fs::create_dir(&inside).unwrap();
    store.delete(MESHES, &name, |_| true).unwrap();
    assert!(!inside.exists() && store.asset(MESHES, &name).unwrap().is_none());
}

#[cfg(unix)]
#[test]
fn links_in_a_folder_lead_nowhere() {
    let (folder, store) = store();
    let outside = tempfile::tempdir().unwrap();
    fs::write(outside.path().join("secret.mtl"), "newmtl roof\nKd 1 1 1\n").unwrap();
    let inside = folder.path().join("meshes/town");
    fs::create_dir_all(&inside).unwrap();
    fs::write(
        inside.join("it.obj"),
        "mtllib it.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    )
    .unwrap();
    std::os::unix::fs::symlink(outside.path().join("secret.mtl"), inside.join("it.mtl")).unwrap();
    let error = store.mesh_model(&name("town")).unwrap_err().to_string();
    assert!(error.contains("it.mtl") && error.contains("missing"), "{error}");
    std::os::unix::fs::symlink(outside.path(), folder.path().join("meshes/whole")).unwrap();
    assert!(store.asset(MESHES, &name("whole")).unwrap().is_none());
    assert!(outside.path().join("secret.mtl").exists());
}

/// Normals of the triangles about a vertex, by their angles there: on a cube, along the diagonal.
#[test]
fn normals_are_made_where_there_are_none() {
    let (_folder, store) = store();
    let corner = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\nf 1 4 2\n";
    let mesh = read(&store, &obj(corner)).unwrap();
    let expected = 1.0 / 3.0_f32.sqrt();
    // Three right angles count alike; rounded to 24 bits.
    assert!(
        mesh.normals[0].iter().all(|c| (c - expected).abs() < 1e-6),
        "{:?}",
        mesh.normals[0]
    );
    // Cutting one of the sides in two changes nothing where its angle is cut.
    let cut = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0.5 0.5 0\nf 1 2 5\nf 1 5 3\nf 1 3 4\nf 1 4 2\n";
    let mesh = read(&store, &obj(cut)).unwrap();
    assert!(
        mesh.normals[0].iter().all(|c| (c - expected).abs() < 1e-6),
        "{:?}",
        mesh.normals[0]
    );
    let told = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 3 4\nf 1//1 2//1 3//1\n";
    assert_eq!(read(&store, &obj(told)).unwrap().normals[0], [0.0, 0.6, 0.8]);
    let flat = "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n";
    assert_eq!(read(&store, &obj(flat)).unwrap().normals[0], [0.0, 0.0, 1.0]);
}

#[test]
fn polygons_negative_indices_and_lines_are_understood() {
    let (_folder, store) = store();
    let text =
        "# a pentagon\no one\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0.5 2 0\nv 0 1 0\nf -5 -4 -3 -2 -1\nl 1 2\np 1\n";
    let mesh = read(&store, &obj(text)).unwrap();
    assert_eq!(mesh.triangles.len(), 3);
    assert_eq!(mesh.positions.len(), 5);
}

#[test]
fn broken_geometry_is_refused() {
    let (_folder, store) = store();
    let square = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (rest, told) in [
        ("", "no triangles"),
        ("f 1 2\n", "no triangles"),
        ("f 1 2 9\n", "it.obj"),
        ("f 1 2 0\n", ""),
        ("f 1 2 -9\n", ""),
        ("f 1/7 2/7 3/7\n", "line 4 of the OBJ names texture coordinates"),
        ("f 1//7 2//7 3//7\n", "line 4 of the OBJ names normals"),
        ("vt 0 0\nf 1/7 2/7 3/7\n", "it.obj"),
        ("vn 0 0 1\nf 1//7 2//7 3//7\n", "it.obj"),
        ("f 1 2 99999999999999999999\n", ""),
        ("f 1/9223372036854775807 2 3\n", ""),
        ("vt 0 0\nf 1/-9 2/-9 3/-9\n", ""),
        ("f 1 2 x\n", ""),
        ("vt 0 0\nf 1/1 2 3\n", "texture coordinates"),
        ("vn 0 0 1\nf 1//1 2 3\n", "normals"),
        ("v nan 0 0\nf 1 2 4\n", "NaN"),
        ("v 0 inf 0\nf 1 2 4\n", "inf"),
        ("v 1e30 0 0\nf 1 2 4\n", "1e30"),
        ("vt nan 0\nf 1/1 2/1 3/1\n", "texture coordinate"),
        ("v 1 2\nf 1 2 3\n", ""),
    ] {
        refused(&store, &obj(&format!("{square}{rest}")), told);
    }
    // A normal that is none is made anew.
    let odd = format!("{square}vn nan 0 0\nf 1//1 2//1 3//1\n");
    assert_eq!(read(&store, &obj(&odd)).unwrap().normals[0], [0.0, 0.0, 1.0]);
}

#[test]
fn nothing_outside_of_the_file_is_looked_for() {
    let (_folder, store) = store();
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for path in [
        "../it.mtl",
        "/etc/passwd",
        "a/../../it.mtl",
        "C:\\it.mtl",
        "..\\it.mtl",
        "\\\\host\\it.mtl",
        "http://host/it.mtl",
        "a//it.mtl",
        "./../it.mtl",
    ] {
        let text = format!("mtllib {path}\n{triangle}");
        refused(&store, &obj(&text), "must lie within");
        let library = format!("newmtl a\nmap_Kd {path}\n");
        let text = format!("mtllib it.mtl\n{triangle}");
        let file = zipped(&[("it.obj", text.as_bytes()), ("it.mtl", library.as_bytes())]);
        refused(&store, &file, "must lie within");
    }
    for path in ["../it.obj", "/it.obj", "a/../it.obj", "..\\it.obj", "C:/it.obj"] {
        refused(&store, &zipped(&[(path, triangle.as_bytes())]), "must lie within");
    }
    refused(&store, &obj(&format!("mtllib gone.mtl\n{triangle}")), "gone.mtl");
    let library = "newmtl a\nmap_Kd gone.png\n";
    let text = format!("mtllib it.mtl\n{triangle}");
    let file = zipped(&[("it.obj", text.as_bytes()), ("it.mtl", library.as_bytes())]);
    refused(&store, &file, "gone.png");
}

#[test]
fn odd_textures_and_materials_are_refused_or_mended() {
    let (_folder, store) = store();
    let text = "mtllib it.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
    let of = |library: &str, texture: &[u8]| {
        let files: [(&str, &[u8]); 3] = [
            ("it.obj", text.as_bytes()),
            ("it.mtl", library.as_bytes()),
            ("t.png", texture),
        ];
        zipped(&files)
    };
    let textured = "newmtl a\nmap_Kd t.png\n";
    refused(&store, &of(textured, b"GIF89a"), "neither PNG nor JPEG");
    let cut = pixel([1, 2, 3])[..60].to_vec();
    refused(&store, &of(textured, &cut), "t.png");
    refused(&store, &of(textured, b"\xff\xd8\xff\xe0"), "t.png");
    let wide = crate::files::headed(4097, 1, 8, 2, &[]);
    refused(&store, &of(textured, &wide), "4097 x 1");
    refused(
        &store,
        &of("newmtl a\nbump t.png\n", &pixel([7; 3])),
        "heights are no normals",
    );
    refused(&store, &of("newmtl a\nKd nan 1 1\n", &[]), "no number");
    refused(&store, &of("newmtl a\nKd\n", &[]), "");
    refused(&store, &of("newmtl\n", &[]), "");
    // One grey for all three colours, no mirror by the model of illumination, shares cut to what light there is.
    let mesh = read(
        &store,
        &of(
            "newmtl a\nKd 0.5\nKa spectral x.rfl\nKs 1 1 1\nillum 1\nNs 0\n",
            &[],
        ),
    )
    .unwrap();
    let material = &mesh.materials[mesh.material_of[0] as usize];
    assert_eq!((material.albedo, material.ambient), ([0.5; 3], [1.0; 3]));
    assert_eq!((material.specular, material.shininess), ([0.0; 3], 1.0));
    let mesh = read(&store, &of("newmtl a\nKd 7 -1 0.25\n", &[])).unwrap();
    assert_eq!(mesh.materials[0].albedo, [1.0, 0.0, 0.25]);
}

/// Each would take far more memory than the file has bytes.
#[test]
fn bombs_do_not_go_off() {
    let (_folder, store) = store();
    let many = |line: &str, times: usize| obj(&format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{}", line.repeat(times)));
    refused(&store, &many("f 1 2 3\n", 1_000_001), "1000001 triangles");
    let fan = format!("f{}\n", " 1 2".repeat(500_002));
    refused(&store, &many(&fan, 1), "1000002 triangles");
    refused(&store, &many("v 0 0 0\n", 3_000_000), "vertices");
    refused(
        &store,
        &many(&format!("usemtl {}\nf 1 2 3\n", "x".repeat(300)), 1),
        "names have 256",
    );
    let zeros = vec![b' '; 600 << 20];
    refused(&store, &zipped(&[("it.obj", &zeros)]), "unpacks to more");
    let names: Vec<_> = (0..1001).map(|i| format!("{i}.txt")).collect();
    let files: Vec<_> = names.iter().map(|name| (name.as_str(), b"".as_slice())).collect();
    refused(&store, &zipped(&files), "1001 files");
    refused(
        &store,
        &zipped(&[("a.obj", b""), ("b.OBJ", b"")]),
        "2 files that end in .obj",
    );
    refused(&store, &zipped(&[("a.txt", b"")]), "0 files that end in .obj");
    refused(&store, b"PK\x03\x04", "damaged");
}

#[test]
fn a_million_triangles_are_taken() {
    let (_folder, store) = store();
    // 1000 x 500 cells of two triangles.
    let mut text = String::new();
    for y in 0..501 {
        for x in 0..1001 {
            text += &format!("v {x} {y} 0\n");
        }
    }
    for y in 0..500 {
        for x in 0..1000 {
            let a = y * 1001 + x + 1;
            text += &format!("f {a} {} {} {}\n", a + 1, a + 1002, a + 1001);
        }
    }
    let mesh = read(&store, &obj(&text)).unwrap();
    assert_eq!(
        (mesh.triangles.len(), mesh.positions.len()),
        (1_000_000, 501 * 1001)
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Whatever is written in them, OBJ and MTL are answered, and what is taken is whole.
    #[test]
    fn no_lines_break_the_reader(
        lines in proptest::collection::vec("(v|vt|vn|f|o|g|usemtl|mtllib|l|p|s|#)( -?[0-9]{1,20}(/-?[0-9]{0,3}){0,2}| nan| a| it.mtl){0,5}", 0..20),
        materials in proptest::collection::vec("(newmtl|Ka|Kd|Ks|Ns|illum|map_Kd|bump|norm|d)( -?[0-9.]{1,4}| a| nan){0,4}", 0..8),
    ) {
        let (_folder, store) = store();
        let text = format!("mtllib it.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n{}\n", lines.join("\n"));
        let file = zipped(&[("it.obj", text.as_bytes()), ("it.mtl", materials.join("\n").as_bytes())]);
        if let Ok(mesh) = read(&store, &file) {
            let count = mesh.positions.len();
            prop_assert!(mesh.normals.len() == count && mesh.uvs.len() == count);
            prop_assert!(mesh.triangles.iter().flatten().all(|&corner| (corner as usize) < count));
            prop_assert!(mesh.material_of.len() == mesh.triangles.len());
            prop_assert!(mesh.material_of.iter().all(|&of| (of as usize) < mesh.materials.len()));
            for normal in mesh.normals.iter() {
                let length = normal.iter().map(|c| c * c).sum::<f32>().sqrt();
                prop_assert!((length - 1.0).abs() < 1e-6, "{normal:?}");
            }
        }
    }
}
