//! The OpenAPI document: the routes as they are annotated, the schemas as the scene crate derives them.

use crate::{
    assets::document as assets, error::Error, jobs::document as jobs, live::document as live,
    problem::component,
};
use axum::{
    Json,
    http::{HeaderValue, StatusCode},
};
use schemars::schema_for;
use serde_json::{Map, Value, json};
use std::{collections::BTreeMap, sync::Arc};
use utoipa::{
    IntoResponses, OpenApi,
    openapi::{Ref, RefOr, Response},
};
use welkin_scene::{ProbeAnswer, schema};

/// Swagger UI sets styles on its elements and draws its icons from data URLs; its scripts are files of ours.
pub(crate) const DOCS_POLICY: HeaderValue = HeaderValue::from_static(
    "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; object-src 'none'; \
     base-uri 'none'; frame-ancestors 'self'",
);

/// All statuses that a problem may have.
const PROBLEMS: [StatusCode; 14] = [
    StatusCode::BAD_REQUEST,
    StatusCode::NOT_FOUND,
    StatusCode::METHOD_NOT_ALLOWED,
    StatusCode::NOT_ACCEPTABLE,
    StatusCode::REQUEST_TIMEOUT,
    StatusCode::CONFLICT,
    StatusCode::PRECONDITION_FAILED,
    StatusCode::PAYLOAD_TOO_LARGE,
    StatusCode::UNSUPPORTED_MEDIA_TYPE,
    StatusCode::UNPROCESSABLE_ENTITY,
    StatusCode::UPGRADE_REQUIRED,
    StatusCode::INTERNAL_SERVER_ERROR,
    StatusCode::SERVICE_UNAVAILABLE,
    StatusCode::INSUFFICIENT_STORAGE,
];

#[derive(OpenApi)]
#[openapi(info(
    title = "Welkin",
    description = "Renders physically based skies: a scene document in, a picture or radiance out. \
        Every field has a default, so `{}` is a scene.",
    license(name = "MIT OR Apache-2.0", identifier = "MIT OR Apache-2.0")
))]
pub(crate) struct Description;

/// What may be said of a request that cannot be answered.
pub(crate) struct Refusals;
/// What may be said while the renderer cannot answer.
pub(crate) struct Busy;
/// What is said of a name that does not exist.
pub(crate) struct Missing;
/// What is said where a condition does not hold.
pub(crate) struct Conditional;
/// What is said while it is still worked on.
pub(crate) struct InWork;
/// What is said where nothing more can be stored.
pub(crate) struct NoRoom;
/// What is said where a WebSocket is expected.
pub(crate) struct NoSocket;

type Responses = BTreeMap<String, RefOr<Response>>;

impl IntoResponses for Refusals {
    fn responses() -> Responses {
        let refused = |status: &&StatusCode| {
            status.is_client_error() && !matches!(status.as_u16(), 404 | 405 | 409 | 412 | 426)
        };
        refer(PROBLEMS.iter().filter(refused))
    }
}

impl IntoResponses for Busy {
    fn responses() -> Responses {
        refer(&[StatusCode::SERVICE_UNAVAILABLE, StatusCode::INTERNAL_SERVER_ERROR])
    }
}

impl IntoResponses for Missing {
    fn responses() -> Responses {
        refer(&[StatusCode::NOT_FOUND])
    }
}

impl IntoResponses for Conditional {
    fn responses() -> Responses {
        refer(&[StatusCode::PRECONDITION_FAILED])
    }
}

impl IntoResponses for InWork {
    fn responses() -> Responses {
        refer(&[StatusCode::CONFLICT])
    }
}

impl IntoResponses for NoRoom {
    fn responses() -> Responses {
        refer(&[StatusCode::INSUFFICIENT_STORAGE])
    }
}

impl IntoResponses for NoSocket {
    fn responses() -> Responses {
        refer(&[StatusCode::UPGRADE_REQUIRED, StatusCode::SERVICE_UNAVAILABLE])
    }
}

fn refer<'a>(statuses: impl IntoIterator<Item = &'a StatusCode>) -> Responses {
    let entry = |status: &StatusCode| {
        (
            status.as_u16().to_string(),
            RefOr::Ref(Ref::from_response_name(component(*status).0)),
        )
    };
    statuses.into_iter().map(entry).collect()
}

/// This document.
#[utoipa::path(get, path = "/openapi.json", tag = "discovery", responses(
    (status = 200, description = "OpenAPI 3.1", content_type = "application/json", body = Object)))]
pub(crate) async fn openapi(document: axum::Extension<Arc<Value>>) -> Json<Value> {
    Json(document.0.as_ref().clone())
}

/// The document with what the annotations refer to.
pub(crate) fn complete(routes: &utoipa::openapi::OpenApi, build: &str) -> Result<Value, Error> {
    let mut document = serde_json::to_value(routes).map_err(|e| Error::Internal { cause: e.to_string() })?;
    document["openapi"] = "3.1.0".into();
    document["info"]["version"] = build.into();
    let roots = [
        ("Scene", schema::scene_schema()),
        ("FrameRequest", schema::frame_request_schema()),
        ("ProbeRequest", schema::probe_request_schema()),
        ("Timeline", schema::timeline_schema()),
        ("JobRequest", schema::job_request_schema()),
        ("Job", jobs::job_schema()),
        ("Jobs", jobs::page_schema()),
        ("MetarRequest", schema::metar_request_schema()),
        ("MetarAnswer", schema::metar_answer_schema()),
        ("ProbeAnswer", schema_for!(ProbeAnswer).to_value()),
        ("Problem", problem_schema()),
        ("Device", device_schema()),
        ("Preset", preset_schema()),
        (
            "Presets",
            json!({"type": "array", "items": {"$ref": "#/components/schemas/Preset"}}),
        ),
        ("Asset", assets::asset_schema()),
        ("Assets", assets::list_schema()),
        ("LiveMessage", live::message_schema()),
        ("LiveAnswer", live::answer_schema()),
    ];
    let mut schemas = Map::new();
    for (name, mut schema) in roots {
        if let Some(schema) = schema.as_object_mut() {
            schema.remove("$schema");
            if let Some(Value::Object(parts)) = schema.remove("$defs") {
                schemas.extend(parts);
            }
        }
        schemas.insert(name.into(), schema);
    }
    let mut components = json!({"schemas": schemas, "responses": problem_responses()});
    point_to_components(&mut components);
    document["components"] = components;
    Ok(document)
}

/// JSON Schema keeps its parts in `$defs`, OpenAPI in `components`.
fn point_to_components(value: &mut Value) {
    match value {
        Value::Object(members) => members.iter_mut().for_each(|(name, value)| match value {
            Value::String(target) if name == "$ref" => {
                *target = target.replace("#/$defs/", "#/components/schemas/")
            }
            other => point_to_components(other),
        }),
        Value::Array(items) => items.iter_mut().for_each(point_to_components),
        _ => {}
    }
}

fn problem_responses() -> Value {
    let content = json!({"application/problem+json": {"schema": {"$ref": "#/components/schemas/Problem"}}});
    let response = |status: &StatusCode| {
        let (name, title) = component(*status);
        let mut response = json!({"description": title, "content": content});
        if *status == StatusCode::SERVICE_UNAVAILABLE {
            response["headers"] =
                json!({"Retry-After": {"description": "Seconds", "schema": {"type": "integer"}}});
        }
        (name.to_owned(), response)
    };
    Value::Object(PROBLEMS.iter().map(response).collect())
}

fn problem_schema() -> Value {
    let fault = json!({
        "pointer": {"type": "string", "description": "The field in the body, a JSON pointer (RFC 6901)"},
        "parameter": {"type": "string", "description": "The parameter in the query, or in the path"},
        "value": {"description": "What it holds; null where it is missing"},
        "allowed": {"type": "string", "description": "What it may hold"},
    });
    let mut whole = json!({
        "type": {"type": "string", "format": "uri-reference"},
        "title": {"type": "string"},
        "status": {"type": "integer"},
        "detail": {"type": "string"},
        "instance": {"type": "string", "format": "uri-reference", "description": "Path and request id"},
    });
    whole["group"] = json!({
        "type": "object",
        "description": "The group of a weather report that is not understood",
        "properties": {
            "group": {"type": "string", "description": "In capital letters; empty where the report ends too early"},
            "number": {"type": "integer", "description": "The group's number in the report, from 1"},
            "start": {"type": "integer", "description": "Characters before it"},
            "end": {"type": "integer", "description": "Characters before its end"},
            "expected": {"type": "string", "description": "What may stand there"},
        },
        "required": ["group", "number", "start", "end", "expected"],
    });
    let mut one = fault.clone();
    one["message"] = json!({"type": "string", "description": "The whole in one sentence"});
    whole["errors"] = json!({"type": "array", "items": {
        "type": "object", "properties": one, "required": ["value", "allowed", "message"]}});
    if let (Some(whole), Some(fault)) = (whole.as_object_mut(), fault.as_object()) {
        whole.extend(fault.clone());
    }
    json!({
        "description": "RFC 9457, with the field at fault; `errors` lists all of them",
        "type": "object", "properties": whole, "required": ["type", "title", "status", "detail"],
    })
}

fn device_schema() -> Value {
    let text = |what: &str| json!({"type": "string", "description": what});
    let count = |what: &str| json!({"type": "integer", "minimum": 0, "description": what});
    let properties = json!({
        "adapter": text("The adapter's name"),
        "kind": text("cpu, discrete-gpu, integrated-gpu, virtual-gpu or other"),
        "backend": text("vulkan, metal or dx12"),
        "driver": text("Driver and its version"),
        "max_side_px": count("Longest side of a frame, pixels"),
        "recoveries": count("Times the device was lost and opened anew"),
        "build": text("The build that serves"),
        "max_frame_pixels": count("The largest frame, pixels"),
        "frame_memory_bytes": count("Memory for frames in work; a picture takes 3 bytes a pixel, radiance 12"),
    });
    let required: Vec<_> = properties
        .as_object()
        .into_iter()
        .flatten()
        .map(|(name, _)| name)
        .collect();
    json!({"type": "object", "properties": properties, "required": required})
}

fn preset_schema() -> Value {
    json!({
        "type": "object",
        "properties": {
            "name": {"type": "string"}, "title": {"type": "string"}, "description": {"type": "string"},
            "scene": {"$ref": "#/components/schemas/Scene"},
        },
        "required": ["name", "title", "description", "scene"],
    })
}
