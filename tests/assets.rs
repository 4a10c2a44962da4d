//! `--assets` on the command line. No device is needed: a scene that names what there is not is refused before.
#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use serde_json::Value;
use std::{
    fs,
    path::Path,
    process::{Command, Output},
};
use tempfile::TempDir;

const SCENE: &str = r#"{"clouds": {"weather_map": {"kind": "asset", "name": "front"}}}"#;

fn welkin(args: &[&str], home: &Path) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_welkin"));
    command
        .args(args)
        .env("XDG_DATA_HOME", home)
        .env_remove("WELKIN_ASSETS");
    command.output().unwrap()
}

fn problem(output: &Output, code: i32) -> Value {
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{said}");
    // The log may have told before of files that are of no use.
    let begin = said.lines().position(|line| line.starts_with('{')).unwrap();
    let told: Vec<_> = said.lines().skip(begin).collect();
    serde_json::from_str(&told.join("\n")).unwrap()
}

/// A folder with a scene that names the weather map `front`, and the path of that scene.
fn scene() -> (TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    fs::write(&path, SCENE).unwrap();
    (folder, path.to_string_lossy().into_owned())
}

#[test]
fn an_unknown_name_is_refused_before_a_device_is_opened() {
    let (folder, scene) = scene();
    let picture = folder.path().join("sky.png").to_string_lossy().into_owned();
    let maps = folder.path().join("weather-maps");
    fs::create_dir(&maps).unwrap();
    let mut file = Vec::new();
    png::Encoder::new(&mut file, 1, 1)
        .write_header()
        .unwrap()
        .write_image_data(&[0])
        .unwrap();
    fs::write(maps.join("rear.png"), file).unwrap();
    let assets = folder.path().to_string_lossy().into_owned();
    for args in [
        vec!["render", &scene, "-o", &picture],
        vec!["probe", &scene, "[[0, 0, 1]]"],
    ] {
        let common = ["--json", "--assets", &assets];
        let problem = problem(&welkin(&[&args[..], &common].concat(), folder.path()), 2);
        assert_eq!(
            (&problem["pointer"], &problem["value"]),
            (&"/clouds/weather_map/name".into(), &"front".into())
        );
        assert!(
            problem["allowed"].as_str().unwrap().ends_with(": rear"),
            "{problem}"
        );
    }
    assert!(!Path::new(&picture).exists());
}

#[test]
fn where_there_is_no_folder_that_is_told() {
    let (folder, scene) = scene();
    let none = problem(&welkin(&["probe", &scene, "[]", "--json"], folder.path()), 2);
    assert!(none["detail"].as_str().unwrap().contains("--assets"), "{none}");
    assert!(!folder.path().join("welkin").exists(), "reading makes no folder");
    let args = ["probe", &scene, "[]", "--json", "--assets", "no such folder"];
    let missing = problem(&welkin(&args, folder.path()), 1);
    assert!(
        missing["detail"].as_str().unwrap().contains("no such folder"),
        "{missing}"
    );
}

/// Files of every kind are looked for in the folder, and what is wrong with one is told under the field that names it.
#[test]
fn terrain_that_cannot_be_used_is_refused_with_its_reason() {
    let folder = tempfile::tempdir().unwrap();
    let hut = folder.path().join("meshes/hut");
    fs::create_dir_all(&hut).unwrap();
    fs::write(hut.join("hut.obj"), "mtllib ../secret.mtl\nv 0 0 0\n").unwrap();
    fs::create_dir(folder.path().join("heightfields")).unwrap();
    fs::write(folder.path().join("heightfields/alps.tif"), "no TIFF").unwrap();
    let assets = folder.path().to_string_lossy().into_owned();
    let path = folder.path().join("scene.json");
    for (terrain, told) in [
        (r#"{"kind": "mesh", "name": "hut"}"#, "../secret.mtl"),
        (
            r#"{"kind": "mesh", "name": "town"}"#,
            "there is no asset town among the meshes",
        ),
        (
            r#"{"kind": "heightfield", "name": "alps"}"#,
            "send a grey PNG of 16 bits, a GeoTIFF or an NPY",
        ),
    ] {
        fs::write(&path, format!(r#"{{"terrain": {terrain}}}"#)).unwrap();
        let scene = path.to_string_lossy().into_owned();
        let args = ["probe", &scene, "[[0, 0, 1]]", "--json", "--assets", &assets];
        let problem = problem(&welkin(&args, folder.path()), 2);
        assert_eq!(problem["pointer"], "/terrain/name");
        assert!(problem["detail"].as_str().unwrap().contains(told), "{problem}");
    }
}
