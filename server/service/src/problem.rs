//! Errors as `application/problem+json` (RFC 9457).

use crate::error::{Error, Fault};
use axum::{
    body::Body,
    extract::Request,
    http::{HeaderValue, StatusCode, header},
    middleware::Next,
    response::{IntoResponse, Response},
};
use serde::Serialize;
use serde_json::Value;
use std::any::Any;
use tower_http::request_id::RequestId;
use welkin_scene::ReportFault;

/// The document sent to the client. `pointer`, `value` and `allowed` are those of the first fault.
#[derive(Serialize)]
pub(crate) struct Problem {
    #[serde(rename = "type")]
    kind: String,
    title: &'static str,
    status: u16,
    detail: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    instance: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pointer: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    parameter: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    value: Option<Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    allowed: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    group: Option<ReportFault>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<Fault>,
}

/// Name of the OpenAPI component that describes a status, and the title of its problems.
pub(crate) const fn component(status: StatusCode) -> (&'static str, &'static str) {
    match status {
        StatusCode::BAD_REQUEST => ("Malformed", "Malformed request"),
        StatusCode::NOT_FOUND => ("NotFound", "Not found"),
        StatusCode::METHOD_NOT_ALLOWED => ("MethodNotAllowed", "Method not allowed"),
        StatusCode::NOT_ACCEPTABLE => ("NotAcceptable", "Not acceptable"),
        StatusCode::REQUEST_TIMEOUT => ("Timeout", "Too slow"),
        StatusCode::CONFLICT => ("Conflict", "Not in this state"),
        StatusCode::PRECONDITION_FAILED => ("PreconditionFailed", "Precondition failed"),
        StatusCode::INSUFFICIENT_STORAGE => ("InsufficientStorage", "Store full"),
        StatusCode::PAYLOAD_TOO_LARGE => ("TooLarge", "Too large"),
        StatusCode::UNSUPPORTED_MEDIA_TYPE => ("UnsupportedMediaType", "Unsupported media type"),
        StatusCode::UNPROCESSABLE_ENTITY => ("Invalid", "Not valid"),
        StatusCode::UPGRADE_REQUIRED => ("UpgradeRequired", "WebSocket required"),
        StatusCode::SERVICE_UNAVAILABLE => ("Unavailable", "Not available now"),
        _ => ("Internal", "Internal error"),
    }
}

impl Problem {
    pub(crate) fn new(error: &Error, instance: Option<String>) -> Self {
        let status = error.status();
        let (component, title) = component(status);
        let (first, errors) = match error {
            Error::Invalid(faults) | Error::FrameTooLarge(faults) => {
                (faults.first().cloned(), faults.clone())
            }
            Error::Malformed { pointer, .. } => (
                Some(Fault::field(
                    pointer,
                    Value::Null,
                    "JSON".into(),
                    error.to_string(),
                )),
                vec![],
            ),
            Error::Report(fault) => {
                let allowed = fault.expected.clone();
                let fault = Fault::field("/metar", fault.group.clone().into(), allowed, error.to_string());
                (Some(fault.clone()), vec![fault])
            }
            _ => (None, vec![]),
        };
        let group = match error {
            Error::Report(fault) => Some(fault.clone()),
            _ => None,
        };
        let (mut pointer, mut parameter, mut value, mut allowed) = (None, None, None, None);
        if let Some(fault) = first {
            (pointer, parameter, allowed) = (fault.pointer, fault.parameter, Some(fault.allowed));
            value = Some(fault.value);
        }
        Self {
            kind: format!("/openapi.json#/components/responses/{component}"),
            title,
            status: status.as_u16(),
            detail: error.to_string(),
            instance,
            pointer,
            parameter,
            value,
            allowed,
            group,
            errors,
        }
    }
}

/// The error waits in the response's extensions until [`answer`] knows the request it belongs to.
impl IntoResponse for Error {
    fn into_response(self) -> Response {
        let mut response = self.status().into_response();
        if let Some(seconds) = self.retry_after_s() {
            response.headers_mut().insert(header::RETRY_AFTER, seconds.into());
        }
        response.extensions_mut().insert(self);
        response
    }
}

/// What becomes of a panic in a handler.
pub(crate) fn from_panic(panic: Box<dyn Any + Send>) -> Response {
    let text = panic.downcast_ref::<String>().cloned();
    let text = text.or_else(|| panic.downcast_ref::<&str>().map(|&s| s.to_owned()));
    Error::Internal {
        cause: format!("panic: {}", text.unwrap_or_default()),
    }
    .into_response()
}

/// Writes the problem document of a failed request, and its cause to the log.
pub(crate) async fn answer(request: Request, next: Next) -> Response {
    let (path, method) = (request.uri().path().to_owned(), request.method().to_string());
    let id = request
        .extensions()
        .get::<RequestId>()
        .and_then(|id| id.header_value().to_str().ok().map(str::to_owned));
    let mut response = next.run(request).await;
    let named = response.extensions_mut().remove::<Error>();
    let Some(error) = named.or_else(|| unnamed(response.status(), &path, method)) else {
        return response;
    };
    if let Some(cause) = error.cause() {
        tracing::error!(cause, "{error}");
    }
    let instance = id.map_or_else(|| path.clone(), |id| format!("{path}#{id}"));
    let body = serde_json::to_vec(&Problem::new(&error, Some(instance))).unwrap_or_default();
    *response.status_mut() = error.status();
    let headers = response.headers_mut();
    headers.remove(header::CONTENT_LENGTH);
    headers.insert(
        header::CONTENT_TYPE,
        HeaderValue::from_static("application/problem+json"),
    );
    headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
    *response.body_mut() = Body::from(body);
    response
}

/// What the framework answered by itself.
fn unnamed(status: StatusCode, path: &str, method: String) -> Option<Error> {
    match status {
        StatusCode::NOT_FOUND => Some(Error::NotFound(path.to_owned())),
        StatusCode::METHOD_NOT_ALLOWED => Some(Error::Method { method }),
        _ if status.is_client_error() => Some(Error::Body(status.to_string())),
        _ if status.is_server_error() => Some(Error::Internal {
            cause: status.to_string(),
        }),
        _ => None,
    }
}
