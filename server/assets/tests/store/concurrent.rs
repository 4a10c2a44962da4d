//! Many at once, in one process and over several stores of one folder.

use crate::files::{MAPS, name, put, small, store};
use std::{collections::BTreeSet, sync::Barrier, thread};
use welkin_assets::{Error, Limits, Store};

#[test]
fn readers_see_whole_files_while_writers_replace_and_remove_them() {
    let (folder, first) = store();
    let second = Store::open(folder.path(), Limits::default()).unwrap();
    let digests: BTreeSet<_> = (0..4)
        .map(|seed| put(&first, "x", &small(seed)).unwrap().0.digest)
        .collect();
    thread::scope(|scope| {
        for (seed, store) in [(0, &first), (1, &second), (2, &first), (3, &second)] {
            scope.spawn(move || {
                for _ in 0..25 {
                    put(store, "map", &small(seed)).unwrap();
                    if let Err(error) = store.delete(MAPS, &name("map"), |_| true) {
                        assert!(matches!(error, Error::Unknown { .. }), "{error}");
                    }
                }
            });
        }
        for store in [&first, &second] {
            let digests = &digests;
            scope.spawn(move || {
                for _ in 0..200 {
                    match store.file(MAPS, &name("map")) {
                        Ok((asset, file)) => {
                            assert!(digests.contains(&asset.digest));
                            assert_eq!(file.len() as u64, asset.bytes);
                        }
                        Err(error) => assert!(matches!(error, Error::Unknown { .. }), "{error}"),
                    }
                    match store.weather_picture(&name("map")) {
                        Ok(picture) => assert!(digests.contains(&picture.digest)),
                        Err(error) => assert!(matches!(error, Error::Unknown { .. }), "{error}"),
                    }
                }
            });
        }
    });
}

/// Of many who all believe that they are the first, one is.
#[test]
fn a_condition_holds_for_one_only() {
    let (folder, first) = store();
    let second = Store::open(folder.path(), Limits::default()).unwrap();
    let start = Barrier::new(8);
    let created: usize = thread::scope(|scope| {
        let tries: Vec<_> = (0..8_u8)
            .map(|seed| {
                let (start, store) = (&start, if seed % 2 == 0 { &first } else { &second });
                scope.spawn(move || {
                    start.wait();
                    store.put(MAPS, &name("map"), &small(seed), |there| there.is_none())
                })
            })
            .collect();
        let done = tries.into_iter().map(|t| t.join().unwrap());
        done.filter(|done| match done {
            Ok(_) => true,
            Err(error) => {
                assert!(matches!(error, Error::Condition), "{error}");
                false
            }
        })
        .count()
    });
    assert_eq!(created, 1);
}

#[test]
fn the_last_place_is_given_once() {
    let (_folder, store) = crate::files::store_of(Limits {
        max_assets: 1,
        ..Limits::default()
    });
    let stored = thread::scope(|scope| {
        let tries: Vec<_> = (0..8_u8)
            .map(|seed| {
                let store = &store;
                scope.spawn(move || put(store, &format!("map-{seed}"), &small(seed)).is_ok())
            })
            .collect();
        tries
            .into_iter()
            .map(|t| t.join().unwrap())
            .filter(|&ok| ok)
            .count()
    });
    assert_eq!(stored, 1);
    assert_eq!(store.usage().unwrap().count, 1);
}
