//! What `/v1/jobs` answers, for the OpenAPI document.

use serde_json::{Value, json};

fn object(properties: Value) -> Value {
    let names: Vec<_> = properties
        .as_object()
        .into_iter()
        .flatten()
        .map(|(name, _)| name.clone())
        .collect();
    json!({"type": "object", "properties": properties, "required": names})
}

/// One job.
pub(crate) fn job_schema() -> Value {
    let count = |what: &str| json!({"type": "integer", "minimum": 0, "description": what});
    let text = |what: &str| json!({"type": "string", "description": what});
    object(json!({
        "id": text("Its name: a ULID"),
        "name": {"type": ["string", "null"], "description": "What people call it"},
        "kind": {"enum": ["list", "grid", "random", "timeline", "panorama"]},
        "format": {"type": ["string", "null"], "description": "The kind of file of its frames; null for the usual one"},
        "state": {"enum": ["queueing", "running", "gathering", "done", "failed", "cancelled"]},
        "created_at": {"type": "string", "format": "date-time"},
        "ended_at": {"type": ["string", "null"], "format": "date-time"},
        "frames": count("Frames in all"),
        "counts": object(json!({
            "waiting": count("Not begun, or to be begun again"),
            "running": count("Being rendered"),
            "done": count("Their files are there"),
            "failed": count("Given up"),
            "cancelled": count("Stopped"),
            "retries": count("Times that one was begun again"),
        })),
        "rate_per_s": {"type": "number", "minimum": 0, "description": "Frames a second over the last minute"},
        "eta_s": {"type": ["number", "null"], "description": "Seconds until all frames are done at this rate"},
        "latest": {"type": "array", "maxItems": 4, "description": "The frames that were done last",
            "items": count("A frame's number")},
        "failures": {"type": "array", "items": object(json!({
            "frame": {"type": ["integer", "null"], "description": "Its number; null for what is made of all frames"},
            "attempts": count("How often it was begun"),
            "reason": text("Why the last attempt failed"),
        }))},
        "notes": {"type": "array", "items": {"type": "string"}, "description": "What else is to be said"},
        "files": {"type": "array", "description": "Files made of all frames", "items": object(json!({
            "name": text("As `results` names it"),
            "bytes": count("Its length"),
        }))},
    }))
}

/// Some of them.
pub(crate) fn page_schema() -> Value {
    object(json!({
        "jobs": {"type": "array", "items": {"$ref": "#/components/schemas/Job"}},
        "next": {"type": ["string", "null"], "description": "`before` of the next page; null where there is none"},
    }))
}
