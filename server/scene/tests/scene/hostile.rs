//! Text that is not JSON, and documents made to hurt.

use crate::faults::problems;
use serde_json::{Value, json};
use welkin_scene::{ProbeRequest, Scene, SceneError};

#[test]
fn not_json() {
    for (text, at, word) in [
        (r#"{"camera": {"roll_deg": NaN}}"#, "/camera/roll_deg", "NaN"),
        (
            r#"{"camera": {"position_m": [0, Infinity, 0]}}"#,
            "/camera/position_m/1",
            "Infinity",
        ),
        (
            r#"{"camera": {"position_m": [0, 0, -Infinity]}}"#,
            "/camera/position_m/2",
            "Infinity",
        ),
        (
            r#"{"atmosphere": {"top_m": 1e999}}"#,
            "/atmosphere/top_m",
            "too large",
        ),
        (
            r#"{"atmosphere": {"top_m": -1e999}}"#,
            "/atmosphere/top_m",
            "too large",
        ),
        (
            r#"{"a/b": {"~": [0, {"x": }]}}"#,
            "/a~1b/~0/1/x",
            "expected value",
        ),
        (r#"{"sun": "#, "/sun", "EOF"),
        ("", "", "EOF"),
        ("{} {}", "", "trailing"),
    ] {
        match Scene::from_json(text) {
            Err(SceneError::Malformed { pointer, reason, .. }) => {
                assert_eq!(pointer, at, "{text}");
                assert!(reason.contains(word), "{text}: {reason}");
            }
            other => panic!("{text}: {other:?}"),
        }
    }
    let Err(SceneError::Malformed { line, column, .. }) =
        Scene::from_json("{\n  \"time_s\": 1,\n  \"sun\": NaN\n}")
    else {
        panic!("NaN was read");
    };
    assert_eq!((line, column), (3, 10));
    let error = Scene::from_json(r#"{"time_s": NaN}"#).unwrap_err();
    assert_eq!(
        error.to_string(),
        "not JSON at line 1, column 12, in /time_s: NaN is not a number in JSON; write a finite number"
    );
}

#[test]
fn several_problems_are_told_at_once_and_not_too_many() {
    let two = json!({"camera": {"roll_deg": 1e4}, "planet": {"radius": 1}});
    let text = Scene::from_value(&two).unwrap_err().to_string();
    assert_eq!(text.lines().count(), 2, "{text}");
    let many: serde_json::Map<String, Value> = (0..1000).map(|i| (format!("field{i}"), json!(i))).collect();
    assert_eq!(problems(Scene::from_value(&many.into())).len(), 16);
    let directions = vec![json!([0, 0, 0]); 1000];
    assert_eq!(
        problems(ProbeRequest::from_value(&json!({"directions": directions}))).len(),
        16
    );
}

#[test]
fn huge_documents_give_short_answers() {
    let long = "x".repeat(1 << 20);
    let documents = [
        json!({"display": {"tone_curve": long}}),
        json!({"sun": {"position": {"time": long, "latitude_deg": 0, "longitude_deg": 0}}}),
        json!({"time_s": 1e9, "sun": {"position": {
            "time": format!("2090-01-01T00:00:00.{}Z", "0".repeat(1 << 20)), "latitude_deg": 0, "longitude_deg": 0
        }}}),
        json!({ long.as_str(): { long.as_str(): 1 } }),
        json!({"camera": {"direction": vec![json!("y"); 1 << 18]}}),
        json!({"camera": {"position_m": vec![json!({"é": "ü".repeat(50)}); 1 << 10]}}),
    ];
    for document in documents {
        let all = problems(Scene::from_value(&document));
        let answer = serde_json::to_string(&all).unwrap();
        assert!(answer.len() < 2000, "{answer}");
    }
    let pointer = format!(r#"{{"{long}": {{"a": NaN}}}}"#);
    assert!(
        matches!(Scene::from_json(&pointer), Err(SceneError::Malformed { pointer, .. }) if pointer.is_empty())
    );
    let nested = format!("{}NaN", "{\"a name of some length\":".repeat(100));
    let Err(SceneError::Malformed { pointer, .. }) = Scene::from_json(&nested) else {
        panic!("NaN was read")
    };
    assert!(
        pointer.ends_with("/a name of some length") && pointer.len() <= 256,
        "{pointer}"
    );
    let deep = "[".repeat(1 << 20);
    assert!(
        matches!(Scene::from_json(&deep), Err(SceneError::Malformed { pointer, .. }) if pointer.len() <= 256)
    );
    let directions = vec![json!([0, 0, 1]); 65_537];
    let longest = problems(ProbeRequest::from_value(&json!({"directions": directions})));
    assert_eq!(longest[0].pointer, "/directions");
}

#[test]
fn of_two_members_the_last_counts() {
    let scene = Scene::from_json(r#"{"time_s": 1, "time_s": 2}"#).unwrap();
    assert_eq!(scene.time_s.to_bits(), 2.0_f64.to_bits());
}
