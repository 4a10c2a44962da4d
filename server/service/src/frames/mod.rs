//! `/v1/frames`: a scene in, a file out.

mod headers;

pub(crate) use headers::has_copy;
pub(crate) mod picture;
pub(crate) mod query;

use crate::{
    body::JsonText,
    error::Error,
    metrics::{self, Source},
    openapi::{Busy, Refusals},
    state::Service,
};
use axum::{
    extract::{RawQuery, State},
    http::{HeaderMap, StatusCode, header},
    response::{IntoResponse, Response},
};
use picture::Asked;
use welkin_encode::format_from_accept;
use welkin_scene::frame::{self, Format, FrameRequest};

/// One frame of a scene, or of a timeline at a time.
///
/// The kind of file is that of `format`, else the one that `Accept` likes best, else PNG. The same request gives
/// the same bytes from the same build on the same device, which is what `ETag` stands for.
#[utoipa::path(
    post, path = "/v1/frames", tag = "frames",
    request_body(content = ref("#/components/schemas/FrameRequest"), content_type = "application/json"),
    params(("If-None-Match" = Option<String>, Header, description = "Tags of the copies one has")),
    responses(
        (status = 200, description = "The file", content(
            (String = "image/png"), (String = "image/jpeg"), (String = "image/x-exr"),
            (String = "image/vnd.radiance"), (String = "application/x-npy"), (String = "application/octet-stream")),
            headers(
                ("ETag" = String, description = "Stands for request, build and device"),
                ("Server-Timing" = String, description = "Milliseconds of each pass, the queue and the encoder"),
                ("Welkin-Build" = String, description = "The build that made it"),
                ("Welkin-Sun" = String, description = "Where the sun stands, degrees"),
                ("Welkin-Ev100" = f64, description = "Exposure value of the picture at ISO 100"))),
        (status = 304, description = "The copy one has is the one"),
        Refusals, Busy,
    )
)]
pub(crate) async fn post_frame(
    State(service): State<Service>,
    headers: HeaderMap,
    JsonText(body): JsonText,
) -> Result<Response, Error> {
    let request = FrameRequest::from_json(&body)?;
    answer(&service, request, &headers).await
}

/// One frame of a preset, all in the query.
#[utoipa::path(
    get, path = "/v1/frames", tag = "frames", params(query::FrameQuery),
    responses(
        (status = 200, description = "The file, as `POST /v1/frames` answers it", content_type = "image/png", body = String),
        (status = 304, description = "The copy one has is the one"),
        Refusals, Busy,
    )
)]
pub(crate) async fn get_frame(
    State(service): State<Service>,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Error> {
    let request = query::read(query.as_deref().unwrap_or_default())?;
    answer(&service, request, &headers)
        .await
        .map_err(query::in_query_terms)
}

async fn answer(service: &Service, request: FrameRequest, headers: &HeaderMap) -> Result<Response, Error> {
    let format = match request.format {
        Some(format) => format,
        None => accepted(headers)?,
    };
    let assets = service.assets_of(&request.scene).await;
    let assets = assets.map_err(|e| match request.source {
        frame::Source::Scene => e.within("/scene"),
        // The name may stand in any of its keyframes.
        frame::Source::Timeline => e.pointing_to("/timeline"),
    })?;
    let asked = Asked::new(service, request, assets, format)?;
    let quality = asked.request.quality;
    if headers::has_copy(headers, &asked.etag()) {
        metrics::frame_answered(format, quality, Source::Client);
        let known = headers::identity(&asked, &service.settings.build);
        return Ok((StatusCode::NOT_MODIFIED, known).into_response());
    }
    let (picture, source) = service.picture(&asked).await?;
    metrics::frame_answered(format, quality, source);
    let described = headers::describe(&asked, &picture, source, &service.renderer.device().adapter);
    let identity = headers::identity(&asked, &service.settings.build);
    Ok((identity, described, picture.bytes.clone()).into_response())
}

fn accepted(headers: &HeaderMap) -> Result<Format, Error> {
    let values: Vec<_> = headers
        .get_all(header::ACCEPT)
        .iter()
        .filter_map(|value| value.to_str().ok())
        .collect();
    Ok(format_from_accept(&values.join(", "))?)
}
