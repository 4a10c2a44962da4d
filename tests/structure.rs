//! The tree is what ARCHITECTURE.md says it is.
#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};

/// What a checkout holds beside its own files: version control, builds, packages, output.
const NOT_OURS: [&str; 5] = [".git", "target", "node_modules", "out", "test-output"];
/// Longer files have taken on a second job.
const MOST_LINES: usize = 400;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn name(path: &Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let paths = entries.map(|entry| entry.unwrap().path());
    paths
        .filter(|path| !NOT_OURS.contains(&name(path).as_str()))
        .collect()
}

fn folders(folder: &Path) -> Vec<String> {
    let folders = entries(folder).into_iter().filter(|path| path.is_dir());
    folders
        .map(|path| name(&path))
        .filter(|name| !name.starts_with('.'))
        .collect()
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let (folders, mut found): (Vec<_>, Vec<_>) = entries(folder).into_iter().partition(|path| path.is_dir());
    found.extend(folders.iter().flat_map(|folder| files(folder)));
    found
}

/// Names of the files of one kind right inside a folder, without their extension.
fn stems(folder: &str, extension: &str) -> BTreeSet<String> {
    let files = entries(&root().join(folder))
        .into_iter()
        .filter(|path| path.extension() == Some(extension.as_ref()));
    files
        .map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
        .collect()
}

#[test]
fn a_pass_is_one_shader_one_module_and_one_entry_point_of_one_name() {
    let shaders = stems("shaders", "wgsl");
    let mut modules = stems("server/render/src/passes", "rs");
    modules.remove("mod");
    assert_eq!(
        shaders, modules,
        "shaders/*.wgsl and server/render/src/passes/*.rs"
    );
    assert!(!shaders.is_empty());
    for pass in shaders {
        let text = fs::read_to_string(root().join(format!("shaders/{pass}.wgsl"))).unwrap();
        let entries: Vec<_> = text.split("@compute").skip(1).collect();
        let named = |entry: &&str| {
            entry
                .split_once("fn ")
                .is_some_and(|(_, rest)| rest.starts_with(&format!("{pass}(")))
        };
        assert!(
            entries.len() == 1 && entries.iter().all(named),
            "shaders/{pass}.wgsl needs one entry point, {pass}"
        );
    }
}

#[test]
fn no_pass_rasterises() {
    for path in files(&root().join("shaders")) {
        let text = fs::read_to_string(&path).unwrap();
        assert!(
            !text.contains("@vertex") && !text.contains("@fragment"),
            "{}",
            path.display()
        );
    }
}

#[test]
fn the_architecture_names_every_folder_there_is_and_nothing_that_is_not() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let tree = page.split("```").nth(1).expect("the page opens with the tree");
    let named: BTreeSet<_> = tree
        .lines()
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    for folder in folders(root()).iter().chain(&folders(&root().join("server"))) {
        assert!(
            named.contains(format!("{folder}/").as_str()),
            "ARCHITECTURE.md does not name {folder}/"
        );
    }
    let places = ["", "server", "server/render", "server/render/src", "shaders"];
    for entry in named {
        let there = places.iter().any(|place| root().join(place).join(entry).exists());
        assert!(there, "ARCHITECTURE.md names {entry}, which is not there");
    }
}

#[test]
fn files_stay_short() {
    let long: Vec<_> = ["server", "shaders", "web"]
        .iter()
        .flat_map(|folder| files(&root().join(folder)))
        .filter(|path| {
            ["rs", "wgsl", "js", "mjs", "css", "html"]
                .iter()
                .any(|kind| path.extension() == Some(kind.as_ref()))
        })
        .filter(|path| fs::read_to_string(path).unwrap().lines().count() > MOST_LINES)
        .collect();
    assert!(long.is_empty(), "over {MOST_LINES} lines: {long:?}");
}

/// A build must work on any machine, from whichever mirror that machine is set up for.
#[test]
fn no_file_names_a_machine_or_a_registry() {
    let words = [
        ["/wo", "rk/"],
        ["/ro", "ot/"],
        ["/Use", "rs/"],
        ["deb.deb", "ian.org"],
        ["registry.np", "mjs.org"],
        ["pypi", ".org"],
        ["index.cra", "tes.io"],
        ["static.cra", "tes.io"],
    ]
    .map(|halves| halves.concat());
    for path in files(root()) {
        // Pictures and other files that are not text name nothing.
        let Ok(text) = fs::read_to_string(&path) else {
            continue;
        };
        for word in &words {
            assert!(!text.contains(word.as_str()), "{} names {word}", path.display());
        }
    }
}
