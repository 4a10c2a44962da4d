//! Scenes from what others know of the weather.

use crate::{body::JsonText, error::Error, openapi::Refusals};
use axum::Json;
use std::time::SystemTime;
use welkin_scene::{MetarAnswer, MetarRequest};

/// The scene that a weather report (METAR or SPECI) tells.
///
/// Visibility, weather, temperature and pressure make the air, time and station the sun. A group that is not understood
/// is named with its place; what the scene does not show is listed in `not_rendered`.
#[utoipa::path(
    post, path = "/v1/scenes/from-metar", tag = "scenes",
    request_body(content = ref("#/components/schemas/MetarRequest"), content_type = "application/json"),
    responses(
        (status = 200, description = "The scene, what was read, and what was assumed",
            content_type = "application/json", body = ref("#/components/schemas/MetarAnswer")),
        Refusals,
    )
)]
pub(crate) async fn from_metar(JsonText(body): JsonText) -> Result<Json<MetarAnswer>, Error> {
    let request = MetarRequest::from_json(&body)?;
    Ok(Json(request.scene(SystemTime::now())?))
}
