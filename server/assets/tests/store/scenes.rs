//! What scenes name.

use crate::files::{put, small, store};
use serde_json::{Value, json};
use welkin_assets::{Error, resolve};
use welkin_scene::{Scene, problem::SceneError};

fn scene(map: Value) -> Scene {
    Scene::from_value(&json!({"clouds": {"weather_map": map}})).unwrap()
}

fn asset(name: &str) -> Value {
    json!({"kind": "asset", "name": name})
}

#[test]
fn every_name_becomes_its_picture() {
    let (_folder, store) = store();
    put(&store, "a", &small(1)).unwrap();
    put(&store, "b", &small(2)).unwrap();
    let found = resolve(
        Some(&store),
        &scene(json!({"kind": "blend", "from": asset("a"), "to": asset("b")})),
    );
    let maps = &found.unwrap().weather_maps;
    assert_eq!((maps["a"].rgba[0], maps["b"].rgba[0], maps.len()), (1, 2, 2));
    let before = resolve(Some(&store), &scene(asset("a"))).unwrap();
    put(&store, "a", &small(3)).unwrap();
    let after = resolve(Some(&store), &scene(asset("a"))).unwrap();
    assert_ne!(before, after, "the content is another");
    put(&store, "a", &small(1)).unwrap();
    assert_eq!(resolve(Some(&store), &scene(asset("a"))).unwrap(), before);
}

#[test]
fn a_scene_without_names_needs_no_store() {
    for scene in [Scene::default(), scene(json!({"kind": "procedural"}))] {
        assert!(resolve(None, &scene).unwrap().weather_maps.is_empty());
    }
}

#[test]
fn a_name_that_stands_for_nothing_is_named_with_its_field() {
    let (_folder, store) = store();
    let problems = |store, map| match resolve(store, &scene(map)) {
        Err(Error::Scene(SceneError::Invalid(problems))) => problems,
        other => panic!("{other:?}"),
    };
    let none = problems(Some(&store), asset("front"));
    assert_eq!(
        (&*none[0].pointer, &none[0].value),
        ("/clouds/weather_map/name", &json!("front"))
    );
    assert!(none[0].message.contains("has none"), "{none:?}");
    for number in 0..10 {
        put(&store, &format!("map-{number}"), &small(number)).unwrap();
    }
    let blend = json!({"kind": "blend", "from": asset("fornt"), "to": asset("map-3")});
    let one = problems(Some(&store), blend);
    assert_eq!(
        (one.len(), &*one[0].pointer),
        (1, "/clouds/weather_map/from/name")
    );
    assert!(
        one[0].allowed.contains("map-0, map-1") && one[0].allowed.ends_with("map-7 and 2 more"),
        "{one:?}"
    );
    let blend = json!({"kind": "blend", "from": asset("x"), "to": asset("y")});
    assert_eq!(problems(Some(&store), blend).len(), 2);
    let off = problems(None, asset("front"));
    assert!(off[0].message.contains("--assets"), "{off:?}");
}
