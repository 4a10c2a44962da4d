//! Nothing outside the folder is read, written or removed.

use crate::files::{MAPS, name, plant, put, small, store};
use std::fs;
use welkin_assets::{Error, Limits, Name, Store};

#[test]
fn only_plain_names_are_names() {
    for text in [
        "",
        ".",
        "..",
        "../a",
        "a/b",
        "a\\b",
        "/etc/passwd",
        "a.png",
        "A",
        "-a",
        "_a",
        "a b",
        "a\0",
        "é",
        "a:b",
        "~",
    ] {
        assert!(matches!(Name::new(text), Err(Error::Name)), "{text:?}");
    }
}

#[test]
fn a_folder_that_is_not_there_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("missing");
    let error = Store::open(&missing, Limits::default())
        .err()
        .unwrap()
        .to_string();
    assert!(error.contains("missing"), "{error}");
}

#[test]
fn nothing_is_left_behind_but_the_files() {
    let (folder, store) = store();
    put(&store, "a", &small(0)).unwrap();
    put(&store, "a", &small(1)).unwrap();
    put(&store, "b", b"no picture").unwrap_err();
    let names: Vec<_> = fs::read_dir(folder.path().join("weather-maps"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    assert_eq!(names, ["a.png"]);
}

#[cfg(unix)]
mod links {
    use super::*;
    use std::os::unix::fs::symlink;

    #[test]
    fn a_link_is_neither_read_nor_written_through() {
        let (folder, store) = store();
        let outside = tempfile::tempdir().unwrap();
        let target = outside.path().join("target.png");
        fs::write(&target, small(7)).unwrap();
        plant(&folder, "inside.png", &small(8));
        let maps = folder.path().join("weather-maps");
        for (link, to) in [
            ("out", target.clone()),
            ("in", "inside.png".into()),
            ("nowhere", "void".into()),
        ] {
            symlink(to, maps.join(format!("{link}.png"))).unwrap();
            assert!(store.asset(MAPS, &name(link)).unwrap().is_none(), "{link}");
            assert!(matches!(
                store.weather_picture(&name(link)),
                Err(Error::Unknown { .. })
            ));
            assert!(matches!(
                store.delete(MAPS, &name(link), |_| true),
                Err(Error::Unknown { .. })
            ));
            assert!(matches!(
                store.file(MAPS, &name(link)),
                Err(Error::Unknown { .. })
            ));
        }
        let names: Vec<_> = store.list(MAPS).unwrap().into_iter().map(|a| a.name).collect();
        assert_eq!(names, [name("inside")]);
        // A file takes the link's place, and what it led to stays.
        put(&store, "out", &small(9)).unwrap();
        assert_eq!(fs::read(&target).unwrap(), small(7));
        assert!(maps.join("out.png").symlink_metadata().unwrap().is_file());
    }

    #[test]
    fn a_kind_whose_folder_is_a_link_is_refused() {
        let (folder, store) = store();
        let outside = tempfile::tempdir().unwrap();
        fs::write(outside.path().join("map.png"), small(1)).unwrap();
        symlink(outside.path(), folder.path().join("weather-maps")).unwrap();
        for error in [
            store.asset(MAPS, &name("map")).map(drop),
            store.list(MAPS).map(drop),
            store.file(MAPS, &name("map")).map(drop),
            put(&store, "map", &small(2)).map(drop),
            store.delete(MAPS, &name("map"), |_| true),
        ] {
            assert!(matches!(error, Err(Error::Folder { .. })), "{error:?}");
        }
        assert_eq!(fs::read(outside.path().join("map.png")).unwrap(), small(1));
    }

    #[test]
    fn the_lock_may_not_be_a_link_either() {
        let (folder, store) = store();
        let outside = tempfile::tempdir().unwrap();
        let target = outside.path().join("made");
        symlink(&target, folder.path().join(".lock")).unwrap();
        assert!(matches!(put(&store, "map", &small(0)), Err(Error::Folder { .. })));
        assert!(!target.exists());
    }
}

#[test]
fn a_folder_in_a_files_place_is_nothing_and_stays() {
    let (folder, store) = store();
    let inside = folder.path().join("weather-maps/map.png");
    fs::create_dir_all(&inside).unwrap();
    assert!(store.asset(MAPS, &name("map")).unwrap().is_none());
    assert!(matches!(put(&store, "map", &small(0)), Err(Error::Folder { .. })));
    assert!(matches!(
        store.delete(MAPS, &name("map"), |_| true),
        Err(Error::Unknown { .. })
    ));
    assert!(inside.is_dir());
}
