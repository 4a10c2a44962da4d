//! Bodies, checked before they are read.

use crate::error::Error;
use axum::{
    body::Bytes,
    extract::{FromRequest, Request, rejection::BytesRejection},
    http::{StatusCode, header},
};
use std::{error::Error as _, time::Duration};
use tower_http::timeout::TimeoutError;

/// The longest body and the longest live message, bytes.
pub(crate) const MAX_BODY_BYTES: usize = 1 << 20;

/// Text announced as JSON.
pub(crate) struct JsonText(pub(crate) String);

/// The document of a job, announced as JSON: it may list thousands of scenes.
pub(crate) struct JobText(pub(crate) String);

/// The longest document of a job, bytes.
pub(crate) const MAX_JOB_BYTES: usize = 64 << 20;

impl<S: Send + Sync> FromRequest<S> for JobText {
    type Rejection = Error;

    async fn from_request(request: Request, state: &S) -> Result<Self, Error> {
        json(request, state, MAX_JOB_BYTES as u64).await.map(Self)
    }
}

/// How long a body may take; set by the router for the message of [`Error::Slow`].
#[derive(Clone, Copy)]
pub(crate) struct BodyTimeout(pub(crate) Duration);

impl<S: Send + Sync> FromRequest<S> for JsonText {
    type Rejection = Error;

    async fn from_request(request: Request, state: &S) -> Result<Self, Error> {
        json(request, state, MAX_BODY_BYTES as u64).await.map(Self)
    }
}

/// A body that is announced as JSON, as text.
async fn json<S: Send + Sync>(request: Request, state: &S, limit_bytes: u64) -> Result<String, Error> {
    let kind = request.headers().get(header::CONTENT_TYPE);
    let found = kind
        .map_or("nothing", |value| value.to_str().unwrap_or("unreadable text"))
        .to_owned();
    let essence = found
        .split(';')
        .next()
        .unwrap_or_default()
        .trim()
        .to_ascii_lowercase();
    if essence != "application/json" && !(essence.starts_with("application/") && essence.ends_with("+json")) {
        return Err(Error::MediaType { found });
    }
    let bytes = bounded(request, state, limit_bytes).await?;
    String::from_utf8(bytes.into()).map_err(|e| Error::Body(format!("it is not UTF-8: {e}")))
}

/// A body of bytes. One whose announced length is too large is not read at all.
pub(crate) async fn read(request: Request, limit_bytes: u64) -> Result<Bytes, Error> {
    let announced = request.headers().get(header::CONTENT_LENGTH);
    let announced = announced.and_then(|length| length.to_str().ok()?.parse::<u64>().ok());
    if announced.is_some_and(|length| length > limit_bytes) {
        return Err(Error::BodyTooLarge { limit_bytes });
    }
    bounded(request, &(), limit_bytes).await
}

/// The router has set the limit; here it is for the message of the error.
async fn bounded<S: Send + Sync>(request: Request, state: &S, limit_bytes: u64) -> Result<Bytes, Error> {
    let seconds = request
        .extensions()
        .get::<BodyTimeout>()
        .map_or(0, |timeout| timeout.0.as_secs());
    Bytes::from_request(request, state)
        .await
        .map_err(|rejection| refusal(&rejection, limit_bytes, seconds))
}

fn refusal(rejection: &BytesRejection, limit_bytes: u64, seconds: u64) -> Error {
    if rejection.status() == StatusCode::PAYLOAD_TOO_LARGE {
        return Error::BodyTooLarge { limit_bytes };
    }
    let mut cause = rejection.source();
    while let Some(error) = cause {
        if error.is::<TimeoutError>() {
            return Error::Slow { seconds };
        }
        cause = error.source();
    }
    Error::Body("the connection ended before the body did".into())
}
