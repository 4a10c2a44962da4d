//! How much the store takes.

use crate::files::{MAPS, name, plant, put, small, store, store_of};
use welkin_assets::{Error, Limits, Put, Usage};

#[test]
fn more_bytes_than_an_asset_may_have_are_refused_before_they_are_read() {
    let bytes = small(0).len() as u64;
    let limits = |max_asset_bytes| Limits {
        max_asset_bytes,
        ..Limits::default()
    };
    let (_folder, store) = store_of(limits(bytes));
    put(&store, "map", &small(0)).unwrap();
    let (_folder, store) = store_of(limits(bytes - 1));
    assert!(matches!(
        put(&store, "map", &small(0)),
        Err(Error::TooLarge { limit_bytes }) if limit_bytes == bytes - 1
    ));
}

#[test]
fn a_full_store_takes_no_more_but_lets_replace_and_delete() {
    let (_folder, store) = store_of(Limits {
        max_assets: 2,
        ..Limits::default()
    });
    put(&store, "a", &small(0)).unwrap();
    put(&store, "b", &small(1)).unwrap();
    let error = put(&store, "c", &small(2)).unwrap_err();
    assert!(matches!(error, Error::Full { .. }), "{error}");
    assert!(error.to_string().contains("2 assets"), "{error}");
    assert_eq!(put(&store, "b", &small(3)).unwrap().1, Put::Replaced);
    store.delete(MAPS, &name("a"), |_| true).unwrap();
    put(&store, "c", &small(2)).unwrap();
    let names: Vec<_> = store.list(MAPS).unwrap().into_iter().map(|a| a.name).collect();
    assert_eq!(names, [name("b"), name("c")]);
}

#[test]
fn the_bytes_of_all_are_bounded_too() {
    let (one, two) = (small(0), small(1));
    let bytes = (one.len() + two.len()) as u64;
    let (_folder, store) = store_of(Limits {
        assets_bytes: bytes,
        ..Limits::default()
    });
    put(&store, "a", &one).unwrap();
    put(&store, "b", &two).unwrap();
    assert_eq!(store.usage().unwrap(), Usage { count: 2, bytes });
    assert!(matches!(put(&store, "c", &one), Err(Error::Full { .. })));
    let mut longer = one.clone();
    longer.push(0);
    assert!(matches!(put(&store, "a", &longer), Err(Error::Full { .. })));
    // The same bytes again need no room.
    assert_eq!(put(&store, "a", &one).unwrap().1, Put::Replaced);
}

/// What others put into the folder counts, and is left out of the list where it is of no use.
#[test]
fn foreign_files_count_and_are_passed_over() {
    let (folder, store) = store();
    put(&store, "good", &small(0)).unwrap();
    plant(&folder, "broken.png", b"no picture");
    plant(&folder, "Other.png", &small(1));
    plant(&folder, "notes.txt", b"text");
    plant(&folder, ".hidden.png", &small(2));
    let names: Vec<_> = store.list(MAPS).unwrap().into_iter().map(|a| a.name).collect();
    assert_eq!(names, [name("good")]);
    assert_eq!(store.usage().unwrap().count, 2, "good and broken");
    assert!(matches!(
        store.weather_picture(&name("broken")),
        Err(Error::Form { .. })
    ));
    assert_eq!(put(&store, "broken", &small(3)).unwrap().1, Put::Replaced);
    assert_eq!(store.weather_picture(&name("broken")).unwrap().rgba[0], 3);
}
