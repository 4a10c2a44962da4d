//! What `/v1/assets` answers, for the OpenAPI document.

use serde_json::{Value, json};
use welkin_assets::{Kind, MAX_SIDE_PX, MAX_TRIANGLES};

/// One asset. What it holds differs from kind to kind.
pub(crate) fn asset_schema() -> Value {
    let side = |least: u32, what: &str| json!({"type": "integer", "minimum": least, "maximum": MAX_SIDE_PX, "description": what});
    let count = |most: usize, what: &str| json!({"type": "integer", "minimum": 0, "maximum": most, "description": what});
    let numbers = |length: usize, what: &str| json!({"type": "array", "items": {"type": "number"}, "minItems": length, "maxItems": length, "description": what});
    let told = |what: &str| {
        let mut pair = numbers(2, what);
        pair["type"] = json!(["array", "null"]);
        pair
    };
    let picture = json!({
        "width_px": side(1, "Width, pixels"),
        "height_px": side(1, "Height, pixels"),
        "bit_depth": {"enum": [1, 2, 4, 8, 16], "description": "Bits of a sample, or of an index into the palette"},
        "colour": {"enum": ["grey", "grey-alpha", "rgb", "rgba", "palette"]},
    });
    let heights = json!({
        "width_px": side(2, "Columns"),
        "height_px": side(2, "Rows"),
        "range_m": told("The lowest and the highest, metres; null where the file does not tell"),
        "extent_m": told("Width and height of the rectangle, metres; null where the file does not tell"),
    });
    let mesh = json!({
        "triangles": count(MAX_TRIANGLES, "Triangles"),
        "vertices": count(3 * MAX_TRIANGLES, "Vertices"),
        "materials": {"type": "integer", "minimum": 1, "description": "Materials"},
        "textures": {"type": "integer", "minimum": 0, "description": "Textures and normal maps"},
        "least": numbers(3, "The least of each coordinate, in the file's units"),
        "most": numbers(3, "The greatest of each coordinate, in the file's units"),
    });
    let kinds = [
        (Kind::WeatherMaps, picture),
        (Kind::Heightfields, heights),
        (Kind::Meshes, mesh),
    ];
    json!({"oneOf": kinds.map(|(kind, facts)| one_kind(kind, facts))})
}

fn one_kind(kind: Kind, facts: Value) -> Value {
    let mut properties = json!({
        "kind": {"const": kind.name()},
        "name": {"type": "string", "pattern": "^[a-z0-9][a-z0-9_-]{0,63}$", "description": "What scenes call it"},
        "format": {"enum": kind.forms(), "description": "How the file holds it"},
        "bytes": {"type": "integer", "minimum": 0, "description": "Size of the file, bytes"},
        "sha256": {"type": "string", "pattern": "^[0-9a-f]{64}$", "description": "Of the file; its tag, too"},
    });
    if let (Some(properties), Value::Object(facts)) = (properties.as_object_mut(), facts) {
        properties.extend(facts);
    }
    let names: Vec<_> = properties
        .as_object()
        .into_iter()
        .flatten()
        .map(|(name, _)| name.clone())
        .collect();
    json!({"type": "object", "properties": properties, "required": names})
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
