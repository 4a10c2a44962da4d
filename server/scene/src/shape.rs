//! Reading our own schemas: references, the branches of a union, types, and what a field may hold, in words.

use crate::{
    problem::{field_name, number},
    schema::split_unit,
};
use serde_json::Value;

/// The member that tells the shapes of a tagged type apart.
pub(crate) const TAG: &str = "kind";

/// The schema itself, behind its reference.
pub(crate) fn resolve<'a>(root: &'a Value, schema: &'a Value) -> &'a Value {
    let target = schema["$ref"]
        .as_str()
        .and_then(|r| r.strip_prefix('#'))
        .and_then(|p| root.pointer(p));
    target.unwrap_or(schema)
}

/// The alternatives of a union, none for other schemas.
pub(crate) fn branches(schema: &Value) -> &[Value] {
    let union = schema["anyOf"].as_array().or_else(|| schema["oneOf"].as_array());
    union.map(Vec::as_slice).unwrap_or_default()
}

/// The names of an object's members.
pub(crate) fn members(schema: &Value) -> Vec<&str> {
    schema["properties"]
        .as_object()
        .into_iter()
        .flatten()
        .map(|(name, _)| name.as_str())
        .collect()
}

/// The words that a choice is made from, through nested unions; none for what is no choice of words.
pub(crate) fn words<'a>(root: &'a Value, schema: &'a Value) -> Vec<&'a str> {
    let schema = resolve(root, schema);
    let own = schema["const"].as_str();
    own.into_iter()
        .chain(branches(schema).iter().flat_map(|b| words(root, b)))
        .collect()
}

/// The values of the tag of a tagged union; none for what is no tagged union.
pub(crate) fn tags<'a>(root: &'a Value, schema: &'a Value) -> Vec<&'a str> {
    branches(schema)
        .iter()
        .filter_map(|b| resolve(root, b)["properties"][TAG]["const"].as_str())
        .collect()
}

/// Whether the value is of the schema's JSON type. A whole number may be written `3.0`.
pub(crate) fn is_of_type(schema: &Value, held: &Value) -> bool {
    let is = |name: &str| match name {
        "null" => held.is_null(),
        "boolean" => held.is_boolean(),
        "string" => held.is_string(),
        "array" => held.is_array(),
        "object" => held.is_object(),
        "integer" => held.as_f64().is_some_and(|n| n.fract() == 0.0),
        _ => held.is_number(),
    };
    match &schema["type"] {
        Value::String(name) => is(name),
        Value::Array(names) => names.iter().filter_map(Value::as_str).any(is),
        _ => true,
    }
}

/// What the field at `pointer` may hold, as it follows "must be".
pub(crate) fn describe(root: &Value, schema: &Value, pointer: &str) -> String {
    let schema = resolve(root, schema);
    let words = words(root, schema);
    let nullable = branches(schema).iter().any(|b| b["type"] == "null");
    if !words.is_empty() {
        return one_of(&words) + if nullable { ", or null" } else { "" };
    }
    let tags = tags(root, schema);
    if !tags.is_empty() {
        return format!("an object whose `{TAG}` is {}", one_of(&tags));
    }
    if !branches(schema).is_empty() {
        let each: Vec<String> = branches(schema)
            .iter()
            .map(|b| describe(root, b, pointer))
            .collect();
        return each.join(", or ");
    }
    let names = schema["type"].as_array().map(Vec::as_slice).unwrap_or_default();
    let nullable = names.iter().any(|name| name == "null");
    let first = names
        .iter()
        .filter_map(Value::as_str)
        .find(|name| *name != "null");
    let holds = match first.or_else(|| schema["type"].as_str()).unwrap_or_default() {
        "null" => "null".into(),
        "boolean" => "true or false".into(),
        "string" if schema["format"] == "date-time" => "a date and time as in RFC 3339".into(),
        "string" => match schema["pattern"].as_str() {
            Some(pattern) => format!("a text that matches `{pattern}`"),
            None => "a text".into(),
        },
        "integer" => format!("a whole number{}", range(schema, pointer)),
        "number" => format!("a number{}", range(schema, pointer)),
        "array" => array(root, schema, pointer),
        _ => format!("an object with {}", fields(&members(schema))),
    };
    holds + if nullable { ", or null" } else { "" }
}

/// "the fields `a`, `b`"
pub(crate) fn fields(names: &[&str]) -> String {
    match names {
        [one] => format!("the field `{one}`"),
        _ => format!("the fields {}", quoted(names)),
    }
}

/// "one of `a`, `b`"
pub(crate) fn one_of(names: &[&str]) -> String {
    match names {
        [one] => format!("`{one}`"),
        _ => format!("one of {}", quoted(names)),
    }
}

fn quoted(names: &[&str]) -> String {
    names
        .iter()
        .map(|n| format!("`{n}`"))
        .collect::<Vec<_>>()
        .join(", ")
}

fn array(root: &Value, schema: &Value, pointer: &str) -> String {
    let items = describe(root, &schema["items"], pointer);
    match (schema["minItems"].as_u64(), schema["maxItems"].as_u64()) {
        (Some(least), Some(most)) if least == most => format!("an array of {most}, each {items}"),
        (_, Some(most)) => format!("an array of at most {most}, each {items}"),
        _ => format!("an array, each {items}"),
    }
}

fn range(schema: &Value, pointer: &str) -> String {
    let unit = split_unit(field_name(pointer))
        .1
        .map(|unit| format!(" {}", unit.word))
        .unwrap_or_default();
    match (schema["minimum"].as_f64(), schema["maximum"].as_f64()) {
        (Some(least), Some(most)) => format!(" from {} to {}{unit}", number(least), number(most)),
        (Some(least), None) => format!(" of {}{unit} or more", number(least)),
        (None, Some(most)) => format!(" of {}{unit} or less", number(most)),
        (None, None) => unit,
    }
}
