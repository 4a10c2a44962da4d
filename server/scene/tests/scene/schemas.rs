//! The schemas that are served.

use serde_json::{Value, json};
use welkin_scene::{
    FrameRequest, ProbeRequest, Scene, Timeline, frame_request_schema, presets, probe_request_schema,
    scene_schema, timeline_schema,
};

/// Every field of every object in a schema, as (name, schema).
fn fields(schema: &Value) -> Vec<(&str, &Value)> {
    let own = schema["properties"]
        .as_object()
        .into_iter()
        .flatten()
        .map(|(name, field)| (name.as_str(), field));
    let inner = match schema {
        Value::Object(members) => members.values().collect::<Vec<_>>(),
        Value::Array(items) => items.iter().collect(),
        _ => Vec::new(),
    };
    own.chain(inner.into_iter().flat_map(fields)).collect()
}

#[test]
fn they_are_schemas_of_draft_2020_12() {
    for (schema, title) in [
        (scene_schema(), "Scene"),
        (frame_request_schema(), "FrameRequest"),
        (probe_request_schema(), "ProbeRequest"),
        (timeline_schema(), "Timeline"),
    ] {
        assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
        assert_eq!(schema["title"], title);
        assert!(jsonschema::draft202012::meta::is_valid(&schema));
    }
}

#[test]
fn every_field_has_title_and_description() {
    for schema in [scene_schema(), frame_request_schema(), probe_request_schema()] {
        for (name, field) in fields(&schema) {
            assert!(field["title"].is_string(), "{name}");
            // The tag of a union is told by the descriptions of its branches.
            assert!(
                field["description"].is_string() || field["const"].is_string(),
                "{name}"
            );
        }
    }
}

#[test]
fn every_number_has_both_ends_of_its_range() {
    let schema = frame_request_schema();
    let mut numbers = 0;
    for (name, field) in fields(&schema) {
        let number = if field["type"] == "array" {
            &field["items"]
        } else {
            field
        };
        if number["type"] == "number" || number["type"] == "integer" {
            numbers += 1;
            assert!(
                number["minimum"].is_number() && number["maximum"].is_number(),
                "{name}: {field}"
            );
        }
    }
    assert!(numbers > 20, "{numbers}");
}

#[test]
fn units_follow_the_names() {
    let schema = frame_request_schema();
    let unit =
        |pointer: &str| schema.pointer(pointer).unwrap_or_else(|| panic!("{pointer}"))["x-unit"].clone();
    for (pointer, expected) in [
        ("/properties/width_px", json!("px")),
        ("/properties/quality", Value::Null),
        ("/$defs/Camera/properties/position_m", json!("m")),
        ("/$defs/Camera/properties/roll_deg", json!("°")),
        ("/$defs/Mie/properties/scattering_per_m", json!("1/m")),
        ("/$defs/Mie/properties/asymmetry", Value::Null),
        ("/$defs/Sun/properties/irradiance_w_m2", json!("W/m²")),
        ("/$defs/Display/properties/white_balance_k", json!("K")),
        ("/$defs/Scene/properties/time_s", json!("s")),
        ("/$defs/Exposure/oneOf/0/properties/ev", json!("EV")),
        ("/$defs/Exposure/oneOf/1/properties/compensation_ev", json!("EV")),
    ] {
        assert_eq!(unit(pointer), expected, "{pointer}");
    }
    assert_eq!(
        schema.pointer("/$defs/Camera/properties/roll_deg/title"),
        Some(&json!("Roll"))
    );
    assert_eq!(
        schema.pointer("/$defs/Exposure/oneOf/0/properties/ev/title"),
        Some(&json!("EV"))
    );
}

#[test]
fn defaults_are_those_of_the_types() {
    let defaults = |schema: Value| -> Value {
        let fields = schema["properties"].as_object().unwrap();
        fields
            .iter()
            .map(|(name, field)| (name.clone(), field["default"].clone()))
            .collect()
    };
    assert_eq!(
        defaults(scene_schema()),
        serde_json::to_value(Scene::default()).unwrap()
    );
    let mut frame = serde_json::to_value(FrameRequest::default()).unwrap();
    frame["timeline"] = Value::Null;
    frame["at_s"] = Value::Null;
    assert_eq!(defaults(frame_request_schema()), frame);
    assert_eq!(
        defaults(timeline_schema()),
        serde_json::to_value(Timeline::default()).unwrap()
    );
    assert_eq!(
        defaults(probe_request_schema()),
        serde_json::to_value(ProbeRequest::default()).unwrap()
    );
}

#[test]
fn presets_fit() {
    let schema = jsonschema::draft202012::new(&scene_schema()).unwrap();
    for preset in presets() {
        assert!(
            schema.is_valid(&serde_json::to_value(&preset.scene).unwrap()),
            "{}",
            preset.name
        );
    }
}
