//! What there is: presets, schemas, the device.

use crate::{error::Error, openapi::Missing, state::Service};
use axum::{
    Json,
    extract::{Path, State, rejection::PathRejection},
};
use serde::Serialize;
use serde_json::Value;
use welkin_scene::{
    preset::{Preset, preset, presets},
    renderer::DeviceInfo,
    schema,
};

/// The device and the build that use it.
#[derive(Serialize)]
pub(crate) struct Device {
    #[serde(flatten)]
    device: DeviceInfo,
    build: String,
    max_frame_pixels: u64,
    frame_memory_bytes: u64,
}

/// All presets, each with its complete scene.
#[utoipa::path(get, path = "/v1/presets", tag = "discovery", responses(
    (status = 200, description = "In the order to show them", content_type = "application/json",
        body = ref("#/components/schemas/Presets"))))]
pub(crate) async fn list_presets() -> Json<&'static [Preset]> {
    Json(presets())
}

/// One preset.
#[utoipa::path(get, path = "/v1/presets/{name}", tag = "discovery",
    params(("name" = String, Path, description = "As the list names it")),
    responses(
        (status = 200, description = "The preset", content_type = "application/json",
            body = ref("#/components/schemas/Preset")),
        Missing))]
pub(crate) async fn get_preset(
    name: Result<Path<String>, PathRejection>,
) -> Result<Json<&'static Preset>, Error> {
    let Path(name) = name.map_err(|e| Error::NotFound(e.body_text()))?;
    let found = preset(&name).map(Json);
    found.ok_or_else(|| Error::NotFound(format!("/v1/presets/{name}; /v1/presets names them all")))
}

/// JSON Schema (draft 2020-12) of the scene document.
#[utoipa::path(get, path = "/v1/schema/scene", tag = "discovery", responses(
    (status = 200, description = "The schema", content_type = "application/schema+json", body = Object)))]
pub(crate) async fn scene_schema() -> Json<Value> {
    Json(schema::scene_schema())
}

/// JSON Schema (draft 2020-12) of a frame request.
#[utoipa::path(get, path = "/v1/schema/frame", tag = "discovery", responses(
    (status = 200, description = "The schema", content_type = "application/schema+json", body = Object)))]
pub(crate) async fn frame_schema() -> Json<Value> {
    Json(schema::frame_request_schema())
}

/// JSON Schema (draft 2020-12) of a timeline.
#[utoipa::path(get, path = "/v1/schema/timeline", tag = "discovery", responses(
    (status = 200, description = "The schema", content_type = "application/schema+json", body = Object)))]
pub(crate) async fn timeline_schema() -> Json<Value> {
    Json(schema::timeline_schema())
}

/// JSON Schema (draft 2020-12) of a job.
#[utoipa::path(get, path = "/v1/schema/job", tag = "discovery", responses(
    (status = 200, description = "The schema", content_type = "application/schema+json", body = Object)))]
pub(crate) async fn job_schema() -> Json<Value> {
    Json(schema::job_request_schema())
}

/// JSON Schema (draft 2020-12) of a probe request.
#[utoipa::path(get, path = "/v1/schema/probe", tag = "discovery", responses(
    (status = 200, description = "The schema", content_type = "application/schema+json", body = Object)))]
pub(crate) async fn probe_schema() -> Json<Value> {
    Json(schema::probe_request_schema())
}

/// The device that renders, the build, and how large a frame may be.
#[utoipa::path(get, path = "/v1/device", tag = "discovery", responses(
    (status = 200, description = "The device", content_type = "application/json",
        body = ref("#/components/schemas/Device"))))]
pub(crate) async fn device(State(service): State<Service>) -> Json<Device> {
    Json(Device {
        device: service.renderer.device(),
        build: service.settings.build.clone(),
        max_frame_pixels: service.settings.max_frame_pixels,
        frame_memory_bytes: service.settings.frame_memory_bytes,
    })
}
