//! Patches on scenes: JSON Merge Patch (RFC 7396), in which null has two meanings. Where a scene's member may be null,
//! it switches that part off; elsewhere it removes the member, so that its default counts.

use crate::{
    schema::scene_schema,
    shape::{TAG, branches, resolve},
};
use serde_json::{Map, Value};
use std::sync::LazyLock;

static SCENE: LazyLock<Value> = LazyLock::new(scene_schema);

pub(super) fn merged(document: &Value, patch: &Map<String, Value>) -> Value {
    let mut merged = document.clone();
    merge_members(&mut merged, patch, &[LazyLock::force(&SCENE)]);
    merged
}

/// `schemas` are those that the document may follow.
fn merge_members(target: &mut Value, patch: &Map<String, Value>, schemas: &[&'static Value]) {
    let kind = |members: &Map<String, Value>| members.get(TAG).cloned();
    let is_other = |held: &Map<String, Value>| kind(patch).is_some_and(|new| kind(held) != Some(new));
    if target.as_object().is_none_or(is_other) {
        *target = Value::Object(Map::new());
    }
    let Some(held) = target.as_object_mut() else {
        return;
    };
    for (name, value) in patch {
        let member: Vec<&'static Value> = schemas
            .iter()
            .flat_map(|schema| shapes(schema))
            .filter_map(|shape| shape["properties"].get(name))
            .collect();
        match value {
            Value::Null if !member.iter().any(|schema| may_be_null(schema)) => {
                held.remove(name);
            }
            Value::Object(patch) => {
                let target = held.entry(name).or_insert(Value::Null);
                merge_members(target, patch, &member);
            }
            other => {
                held.insert(name.clone(), other.clone());
            }
        }
    }
}

/// The schema itself, or those of its branches.
fn shapes(schema: &'static Value) -> Vec<&'static Value> {
    let schema = resolve(&SCENE, schema);
    match branches(schema) {
        [] => vec![schema],
        branches => branches.iter().flat_map(shapes).collect(),
    }
}

fn may_be_null(schema: &'static Value) -> bool {
    shapes(schema).iter().any(|shape| match &shape["type"] {
        Value::Array(types) => types.iter().any(|t| t == "null"),
        other => other == "null",
    })
}
