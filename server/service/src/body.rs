//! JSON bodies, checked before they are read.

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

/// How long a body may take; set by the router for the message of [`Error::Slow`].
#[derive(Clone, Copy)]
pub(crate) struct BodyTimeout(pub(crate) Duration);

impl<S: Send + Sync> FromRequest<S> for JsonText {
    type Rejection = Error;

    async fn from_request(request: Request, state: &S) -> Result<Self, Error> {
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
        if essence != "application/json"
            && !(essence.starts_with("application/") && essence.ends_with("+json"))
        {
            return Err(Error::MediaType { found });
        }
        let seconds = request
            .extensions()
            .get::<BodyTimeout>()
            .map_or(0, |timeout| timeout.0.as_secs());
        let bytes = Bytes::from_request(request, state)
            .await
            .map_err(|rejection| refusal(&rejection, seconds))?;
        String::from_utf8(bytes.into())
            .map(Self)
            .map_err(|e| Error::Body(format!("it is not UTF-8: {e}")))
    }
}

fn refusal(rejection: &BytesRejection, seconds: u64) -> Error {
    if rejection.status() == StatusCode::PAYLOAD_TOO_LARGE {
        return Error::BodyTooLarge {
            limit_bytes: MAX_BODY_BYTES,
        };
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
