//! What `/v1/live` speaks, for the OpenAPI document, which has no place for WebSockets of its own.

use super::message::{MAX_SIDE_PX, MIN_SIDE_PX, MOST_S};
use serde_json::{Value, json};

/// Text in.
pub(crate) fn message_schema() -> Value {
    let side = |what: &str| json!({"type": "integer", "minimum": MIN_SIDE_PX, "maximum": MAX_SIDE_PX, "description": what});
    json!({
        "type": "object",
        "description": "What a viewer sends to /v1/live. Members may come together, and the scene is set before it is patched; but a timeline or its moment comes without scene and patch.",
        "properties": {
            "seq": {"type": "integer", "minimum": 0, "maximum": u32::MAX, "description": "Comes back with the answers"},
            "scene": {"$ref": "#/components/schemas/Scene"},
            "patch": {"type": "object", "description": "JSON Merge Patch (RFC 7396) on the document last sent, or on the moment of the timeline last shown"},
            "timeline": {"$ref": "#/components/schemas/Timeline"},
            "at_s": {"type": "number", "minimum": -MOST_S, "maximum": MOST_S,
                "description": "Shows this moment of the timeline last sent, seconds; 0 where only the timeline is sent"},
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
        "anyOf": [{"required": ["scene"]}, {"required": ["patch"]}, {"required": ["timeline"]}, {"required": ["at_s"]}, {"required": ["output"]}],
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
                    "at_s": {"type": "number", "description": "Which moment of the timeline it is, where it is one"},
                    "scene": {"$ref": "#/components/schemas/Scene", "description": "The scene at that moment"},
                },
            },
        },
        "required": ["seq"],
    })
}
