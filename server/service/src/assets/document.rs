//! What `/v1/assets` answers, for the OpenAPI document.

use serde_json::{Value, json};
use welkin_assets::{Kind, MAX_SIDE_PX};

/// One asset.
pub(crate) fn asset_schema() -> Value {
    let kinds = Kind::ALL.map(Kind::name);
    let side =
        |what: &str| json!({"type": "integer", "minimum": 1, "maximum": MAX_SIDE_PX, "description": what});
    json!({
        "type": "object",
        "properties": {
            "kind": {"enum": kinds},
            "name": {"type": "string", "pattern": "^[a-z0-9][a-z0-9_-]{0,63}$", "description": "What scenes call it"},
            "bytes": {"type": "integer", "minimum": 0, "description": "Size of the file, bytes"},
            "sha256": {"type": "string", "pattern": "^[0-9a-f]{64}$", "description": "Of the file; its tag, too"},
            "width_px": side("Width, pixels"),
            "height_px": side("Height, pixels"),
            "bit_depth": {"enum": [1, 2, 4, 8, 16], "description": "Bits of a sample, or of an index into the palette"},
            "colour": {"enum": ["grey", "grey-alpha", "rgb", "rgba", "palette"]},
        },
        "required": ["kind", "name", "bytes", "sha256", "width_px", "height_px", "bit_depth", "colour"],
    })
}

/// The list of them.
pub(crate) fn list_schema() -> Value {
    let count = |what: &str| json!({"type": "integer", "minimum": 0, "description": what});
    let part = |what: &str, properties: Value| {
        let names: Vec<_> = properties
            .as_object()
            .into_iter()
            .flatten()
            .map(|(name, _)| name.clone())
            .collect();
        json!({"type": "object", "description": what, "properties": properties, "required": names})
    };
    json!({
        "type": "object",
        "properties": {
            "assets": {"type": "array", "items": {"$ref": "#/components/schemas/Asset"}},
            "used": part("How full the store is, whatever the list is of",
                json!({"count": count("Files"), "bytes": count("Their bytes")})),
            "limits": part("How much the store takes", json!({
                "max_asset_bytes": count("The largest asset, bytes"),
                "max_assets": count("Most assets, of all kinds together"),
                "assets_bytes": count("All assets together, bytes"),
            })),
        },
        "required": ["assets", "used", "limits"],
    })
}
