//! What `/v1/live` speaks, for the OpenAPI document, which has no place for WebSockets of its own.

use super::message::{MAX_SIDE_PX, MIN_SIDE_PX};
use serde_json::{Value, json};

/// Text in.
pub(crate) fn message_schema() -> Value {
    let side = |what: &str| json!({"type": "integer", "minimum": MIN_SIDE_PX, "maximum": MAX_SIDE_PX, "description": what});
    json!({
        "type": "object",
        "description": "What a viewer sends to /v1/live. Members may come together; the scene is set before it is patched.",
        "properties": {
            "seq": {"type": "integer", "minimum": 0, "maximum": u32::MAX, "description": "Comes back with the answers"},
            "scene": {"$ref": "#/components/schemas/Scene"},
            "patch": {"type": "object", "description": "JSON Merge Patch (RFC 7396) on the document last sent"},
            "output": {
                "type": "object",
                "properties": {
                    "width_px": side("Width, pixels"), "height_px": side("Height, pixels"),
                    "format": {"enum": ["jpeg", "png", "raw"]}, "quality": {"enum": ["preview", "final"]},
                },
                "additionalProperties": false,
            },
        },
        "required": ["seq"],
        "anyOf": [{"required": ["scene"]}, {"required": ["patch"]}, {"required": ["output"]}],
        "additionalProperties": false,
    })
}

/// Text out.
pub(crate) fn answer_schema() -> Value {
    json!({
        "type": "object",
        "description": "What /v1/live answers in text: an error, or the facts of the picture sent just before.",
        "properties": {
            "seq": {"type": ["integer", "null"], "description": "Of the message it answers; null where that was not readable"},
            "error": {"$ref": "#/components/schemas/Problem"},
            "stats": {
                "type": "object",
                "properties": {
                    "passes": {"type": "array", "items": {"type": "object", "properties": {
                        "pass": {"type": "string"}, "ms": {"type": "number"}}}},
                    "render_ms": {"type": "number"}, "encode_ms": {"type": "number"},
                    "width_px": {"type": "integer"}, "height_px": {"type": "integer"},
                    "quality": {"enum": ["preview", "final"]}, "ev100": {"type": ["number", "null"]},
                    "sun": {"$ref": "#/components/schemas/SunPlace"},
                    "moon": {"anyOf": [{"$ref": "#/components/schemas/MoonPlace"}, {"type": "null"}]},
                    "adapter": {"type": "string"}, "bytes": {"type": "integer"},
                },
            },
        },
        "required": ["seq"],
    })
}
