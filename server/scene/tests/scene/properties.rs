//! Random documents: none panics, valid ones round trip, and the schema and the reader are of one mind.

use crate::strategies::valid_scene;
use jsonschema::Validator;
use proptest::{collection::vec, option, prelude::*, sample::select};
use serde_json::{Value, json};
use std::sync::LazyLock;
use welkin_scene::{FrameRequest, ProbeRequest, Scene, SceneError, presets, scene_schema};

static SCHEMA: LazyLock<Validator> =
    LazyLock::new(|| jsonschema::draft202012::new(&scene_schema()).expect("a derived schema is valid"));

/// Where the reader refuses what the schema lets pass.
const BEYOND_THE_SCHEMA: [&str; 16] = [
    "/camera/direction",
    "/camera/position_m",
    "/camera/projection/fov_deg",
    "/clouds/layers/0/top_m",
    "/clouds/layers/1/top_m",
    "/clouds/shape/gradients/cumulus",
    "/clouds/shape/gradients/stratocumulus",
    "/clouds/shape/gradients/stratus",
    "/clouds/shape/low_freq_min",
    "/haze/extinction_per_m",
    "/haze/top_m",
    "/sun/position",
    "/sun/position/time",
    "/terrain/mountains",
    "/terrain/shadow/size_px",
    "/time_s",
];

fn words() -> impl Strategy<Value = String> {
    const KNOWN: &[&str] = &[
        "camera",
        "direction",
        "azimuth_deg",
        "elevation_deg",
        "kind",
        "fisheye",
        "stereographic",
        "single",
        "agx",
        "time",
        "latitude_deg",
        "2026-06-21T05:00:00Z",
        "ozone",
        "fov_deg",
        "/",
        "~1",
        "",
    ];
    prop_oneof![select(KNOWN).prop_map(String::from), any::<String>()]
}

fn json_value() -> impl Strategy<Value = Value> {
    let leaf = prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::from),
        select(vec![
            0.0, -0.0, 1.0, -1.0, 0.5, 90.0, 301.0, 1e4, 6.36e6, 1e9, 1e300, 5e-324
        ])
        .prop_map(Value::from),
        any::<f64>().prop_map(Value::from),
        any::<i64>().prop_map(Value::from),
        any::<u64>().prop_map(Value::from),
        words().prop_map(Value::from),
    ];
    leaf.prop_recursive(4, 32, 4, |inner| {
        prop_oneof![
            vec(inner.clone(), 0..5).prop_map(Value::from),
            vec((words(), inner), 0..5).prop_map(|members| members.into_iter().collect()),
        ]
    })
}

/// A preset with some of its fields replaced, renamed or removed.
fn damaged_scene() -> impl Strategy<Value = Value> {
    let edit = (
        any::<prop::sample::Index>(),
        option::weighted(0.8, json_value()),
        option::weighted(0.2, words()),
    );
    (select(presets()), vec(edit, 1..4)).prop_map(|(preset, edits)| {
        let mut scene = serde_json::to_value(&preset.scene).expect("a scene is JSON");
        for (at, value, name) in edits {
            let mut parents = Vec::new();
            pointers(&scene, "", &mut parents);
            if parents.is_empty() {
                continue;
            }
            let pointer = at.get(&parents).clone();
            let (parent, key) = pointer.rsplit_once('/').expect("a member");
            match scene.pointer_mut(parent).expect("it was found there") {
                Value::Array(items) => match value {
                    Some(value) => items[key.parse::<usize>().expect("an index")] = value,
                    None => drop(items.pop()),
                },
                Value::Object(members) => {
                    let key = key.replace("~1", "/").replace("~0", "~");
                    let old = members.remove(&key);
                    let value = if name.is_some() { old } else { value };
                    members.extend(value.map(|value| (name.unwrap_or(key), value)));
                }
                _ => unreachable!("only arrays and objects have members"),
            }
        }
        scene
    })
}

fn pointers(value: &Value, at: &str, found: &mut Vec<String>) {
    let members: Vec<(String, &Value)> = match value {
        Value::Array(items) => items
            .iter()
            .enumerate()
            .map(|(i, v)| (i.to_string(), v))
            .collect(),
        Value::Object(members) => members
            .iter()
            .map(|(k, v)| (k.replace('~', "~0").replace('/', "~1"), v))
            .collect(),
        _ => Vec::new(),
    };
    for (key, value) in members {
        let pointer = format!("{at}/{key}");
        pointers(value, &pointer, found);
        found.push(pointer);
    }
}

/// Some problems, each of which points to something or to where it should be.
fn is_told_well(document: &Value, error: &SceneError) -> bool {
    let SceneError::Invalid(problems) = error else {
        return false;
    };
    let exists = |pointer: &str| document.pointer(pointer).is_some();
    !problems.is_empty()
        && problems.len() <= 16
        && problems.iter().all(|p| {
            let parent = p.pointer.rsplit_once('/').map_or("", |(parent, _)| parent);
            !p.allowed.is_empty() && !p.message.is_empty() && (exists(&p.pointer) || exists(parent))
        })
}

proptest! {
    #[test]
    fn valid_scenes_round_trip(scene in valid_scene()) {
        let text = serde_json::to_string(&scene).unwrap();
        prop_assert_eq!(Scene::from_json(&text).unwrap(), scene.clone());
        let request = FrameRequest { scene, width_px: 600, height_px: 100, ..FrameRequest::default() };
        prop_assert_eq!(FrameRequest::from_value(&serde_json::to_value(&request).unwrap()).unwrap(), request);
    }

    #[test]
    fn the_sun_and_the_observer_of_a_valid_scene_are_somewhere(scene in valid_scene()) {
        let observer = scene.observer();
        prop_assert!(observer.altitude_m >= 0.0);
        for unit in [scene.sun_direction(), observer.up] {
            // A few roundings of a 53-bit fraction.
            prop_assert!((unit.iter().map(|c| c * c).sum::<f64>() - 1.0).abs() < 1e-14);
        }
        prop_assert!(scene.sun_place().elevation_deg.abs() <= 90.0);
    }

    #[test]
    fn schema_and_reader_are_of_one_mind(document in damaged_scene()) {
        match Scene::from_value(&document) {
            Ok(scene) => {
                prop_assert!(SCHEMA.is_valid(&document));
                let written = serde_json::to_value(&scene).unwrap();
                prop_assert_eq!(Scene::from_value(&written).unwrap(), scene);
            }
            Err(error) => {
                prop_assert!(is_told_well(&document, &error), "{error:?}");
                if SCHEMA.is_valid(&document) {
                    let SceneError::Invalid(problems) = error else { unreachable!("told well") };
                    for problem in problems {
                        prop_assert!(BEYOND_THE_SCHEMA.contains(&problem.pointer.as_str()), "{problem:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn any_json_is_answered(document in json_value()) {
        for read in [
            Scene::from_value(&document).map(drop),
            FrameRequest::from_value(&document).map(drop),
            ProbeRequest::from_value(&document).map(drop),
            ProbeRequest::from_value(&json!({"directions": [document]})).map(drop),
            Scene::from_value(&json!({"sun": document})).map(drop),
            Scene::from_json(&document.to_string()).map(drop),
        ] {
            if let Err(error) = read {
                prop_assert!(matches!(&error, SceneError::Invalid(p) if (1..=16).contains(&p.len())));
                prop_assert!(!error.to_string().is_empty());
            }
        }
    }

    #[test]
    fn any_text_is_answered(text in ".{0,200}", cut in any::<prop::sample::Index>()) {
        drop(Scene::from_json(&text));
        let scene = serde_json::to_string_pretty(&Scene::default()).unwrap();
        let mut broken = scene.clone();
        broken.insert_str(cut.index(scene.len()), &text);
        drop(Scene::from_json(&broken));
        prop_assert!(Scene::from_json(&scene[..cut.index(scene.len())]).is_err());
    }
}
