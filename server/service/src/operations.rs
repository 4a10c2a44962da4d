//! For operators: is it alive, is it ready, how is it doing.

use crate::{error::Error, metrics, openapi::Busy, state::Service};
use axum::{extract::State, http::header, response::IntoResponse};

/// The process answers.
#[utoipa::path(get, path = "/healthz", tag = "operations", responses(
    (status = 200, description = "It does", content_type = "text/plain", body = String)))]
pub(crate) async fn health() -> &'static str {
    "ok\n"
}

/// It takes requests.
#[utoipa::path(get, path = "/readyz", tag = "operations", responses(
    (status = 200, description = "It does", content_type = "text/plain", body = String),
    Busy))]
pub(crate) async fn ready(State(service): State<Service>) -> Result<&'static str, Error> {
    if *service.stopping().borrow() {
        Err(Error::Stopped)
    } else {
        Ok("ready\n")
    }
}

/// Numbers in Prometheus' text format.
#[utoipa::path(get, path = "/metrics", tag = "operations", responses(
    (status = 200, description = "The numbers", content_type = "text/plain", body = String)))]
pub(crate) async fn numbers() -> Result<impl IntoResponse, Error> {
    let text = metrics::recorder()?.render();
    Ok((
        [(header::CONTENT_TYPE, "text/plain; version=0.0.4; charset=utf-8")],
        text,
    ))
}
