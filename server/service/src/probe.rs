//! `/v1/probe`: the numbers behind the picture.

use crate::{
    body::JsonText,
    error::Error,
    openapi::{Busy, Refusals},
    state::Service,
};
use axum::{Json, extract::State};
use welkin_scene::{ProbeAnswer, ProbeRequest, renderer::ProbeOrder};

/// Radiance, transmittance and distance at exact directions, and the light that falls on the observer.
#[utoipa::path(
    post, path = "/v1/probe", tag = "frames",
    request_body(content = ref("#/components/schemas/ProbeRequest"), content_type = "application/json"),
    responses(
        (status = 200, description = "One entry a direction, in the order asked",
            content_type = "application/json", body = ref("#/components/schemas/ProbeAnswer")),
        Refusals, Busy,
    )
)]
pub(crate) async fn post_probe(
    State(service): State<Service>,
    JsonText(body): JsonText,
) -> Result<Json<ProbeAnswer>, Error> {
    let request = ProbeRequest::from_json(&body)?;
    let assets = service.assets_of(&request.scene).await;
    let assets = assets.map_err(|e| e.within("/scene"))?;
    let answer = service.renderer.probe(ProbeOrder { request, assets }).await;
    answer.map(Json).map_err(|e| {
        crate::metrics::refused(&e);
        Error::from_render(e, service.renderer.device().max_side_px)
    })
}
