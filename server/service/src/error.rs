//! Why a request was not answered as asked, and how HTTP says it.

use axum::http::StatusCode;
use serde::Serialize;
use serde_json::Value;
use welkin_assets::Error as AssetError;
use welkin_encode::EncodeError;
use welkin_scene::{
    ReportFault,
    problem::{Problem, SceneError},
    renderer::RenderError,
};

/// Why a request was not answered as asked. The message is for the client; causes are for the log.
#[derive(Clone, Debug, thiserror::Error)]
pub(crate) enum Error {
    /// The body is not JSON.
    #[error("{reason} (line {line}, column {column})")]
    Malformed {
        pointer: String,
        line: usize,
        column: usize,
        reason: String,
    },
    /// The body cannot be read as text.
    #[error("the body cannot be read: {0}")]
    Body(String),
    /// JSON, or a query, but not what was asked for.
    #[error("{}", first_message(.0))]
    Invalid(Vec<Fault>),
    /// A weather report has a group that is not understood.
    #[error("{0}")]
    Report(ReportFault),
    /// No such path, or nothing of that name.
    #[error("there is nothing at {0}")]
    NotFound(String),
    /// The path exists, the method does not.
    #[error("{method} is not offered here; see /docs for what is")]
    Method { method: String },
    /// `Accept` names nothing that is offered.
    #[error("{0}")]
    NotAcceptable(String),
    /// The body came too slowly.
    #[error("the body did not arrive in {seconds} s")]
    Slow { seconds: u64 },
    /// The body is longer than allowed.
    #[error("a body may have {limit_bytes} bytes at most")]
    BodyTooLarge { limit_bytes: u64 },
    /// The frame is larger than this server renders.
    #[error("{}", first_message(.0))]
    FrameTooLarge(Vec<Fault>),
    /// The body is not announced as JSON.
    #[error("send the body as application/json, not as {found}")]
    MediaType { found: String },
    /// This server has no place for assets.
    #[error("this server keeps no assets; started with --assets, it keeps them in the folder named there")]
    NoAssets,
    /// This server has no jobs.
    #[error("this server takes no jobs; started with --queue and --store, it keeps them there")]
    NoJobs,
    /// An idempotency key that stands for another document.
    #[error("{0}")]
    KeyTaken(String),
    /// What is to be removed is still worked on.
    #[error("{0}")]
    StillOpen(String),
    /// The queue of jobs, or the store of their results, does not answer.
    #[error("the queue of jobs or the store of their results does not answer; try again in 5 s")]
    Unreachable { cause: String },
    /// Not a file of the kind that it is sent as.
    #[error("{0}")]
    WrongFile(String),
    /// A file of the right kind that cannot be used.
    #[error("{0}")]
    BadFile(String),
    /// `If-Match` or `If-None-Match` does not hold.
    #[error("the asset is not, or no more, what `If-Match` or `If-None-Match` take it for")]
    Precondition,
    /// The store of assets is full.
    #[error("{0}")]
    NoRoom(String),
    /// `/v1/live` was not called as a WebSocket.
    #[error("connect here with a WebSocket: {0}")]
    Upgrade(String),
    /// No place is free.
    #[error("{what}; try again in {retry_after_s} s")]
    Busy { what: String, retry_after_s: u32 },
    /// The device failed and is being opened anew.
    #[error("the device failed and is opened anew; try again in 1 s")]
    Device { cause: String },
    /// The service is shutting down.
    #[error("the service is shutting down")]
    Stopped,
    /// A fault of ours.
    #[error("a fault in the service; it has been logged")]
    Internal { cause: String },
}

/// One thing that is wrong with what was sent.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Fault {
    /// The field in the body, as a JSON pointer (RFC 6901).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) pointer: Option<String>,
    /// The parameter in the query, or in the path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) parameter: Option<String>,
    /// What it holds.
    pub(crate) value: Value,
    /// What it may hold.
    pub(crate) allowed: String,
    /// The whole in one sentence.
    pub(crate) message: String,
}

impl Fault {
    /// A fault of a field in the body.
    pub(crate) fn field(pointer: impl Into<String>, value: Value, allowed: String, message: String) -> Self {
        Self {
            pointer: Some(pointer.into()),
            parameter: None,
            value,
            allowed,
            message,
        }
    }

    /// A fault of a parameter in the query, or in the path.
    pub(crate) fn query(parameter: &str, value: impl Into<Value>, allowed: String, message: String) -> Self {
        Self {
            pointer: None,
            parameter: Some(parameter.into()),
            value: value.into(),
            allowed,
            message,
        }
    }
}

impl From<Problem> for Fault {
    fn from(
        Problem {
            pointer,
            value,
            allowed,
            message,
        }: Problem,
    ) -> Self {
        Self::field(pointer, value, allowed, message)
    }
}

impl From<SceneError> for Error {
    fn from(error: SceneError) -> Self {
        match error {
            SceneError::Malformed {
                pointer,
                line,
                column,
                reason,
            } => Self::Malformed {
                pointer,
                line,
                column,
                reason,
            },
            SceneError::Invalid(problems) => Self::Invalid(problems.into_iter().map(Fault::from).collect()),
            SceneError::Report(fault) => Self::Report(fault),
        }
    }
}

impl From<AssetError> for Error {
    fn from(error: AssetError) -> Self {
        match error {
            AssetError::Unknown { kind, name } => Self::NotFound(format!("/v1/assets/{kind}/{name}")),
            AssetError::Form { .. } => Self::WrongFile(error.to_string()),
            AssetError::Name
            | AssetError::Side { .. }
            | AssetError::Damaged { .. }
            | AssetError::Refused { .. } => Self::BadFile(error.to_string()),
            AssetError::TooLarge { limit_bytes } => Self::BodyTooLarge { limit_bytes },
            AssetError::Full { .. } => Self::NoRoom(error.to_string()),
            AssetError::Busy => Self::Busy {
                what: error.to_string(),
                retry_after_s: 5,
            },
            AssetError::Condition => Self::Precondition,
            AssetError::Scene(error) => error.into(),
            AssetError::Folder { .. } => Self::Internal {
                cause: error.to_string(),
            },
        }
    }
}

impl From<EncodeError> for Error {
    fn from(error: EncodeError) -> Self {
        match error {
            EncodeError::NotAcceptable { .. } => Self::NotAcceptable(error.to_string()),
            _ => Self::Internal {
                cause: error.to_string(),
            },
        }
    }
}

impl Error {
    /// What the renderer said. `max_side_px` tells a size that is too large from one that is not possible.
    pub(crate) fn from_render(error: RenderError, max_side_px: u32) -> Self {
        match error {
            RenderError::Busy { retry_after_s } => Self::Busy {
                what: "all places in the render queue are taken".into(),
                retry_after_s,
            },
            RenderError::Size {
                width_px,
                height_px,
                ref reason,
            } => {
                let sides = [("/width_px", width_px), ("/height_px", height_px)];
                let fault = |(pointer, side): (&str, u32)| {
                    Fault::field(pointer, side.into(), reason.clone(), error.to_string())
                };
                let faults = sides.map(fault).into();
                let too_large = width_px.max(height_px) > max_side_px;
                if too_large {
                    Self::FrameTooLarge(faults)
                } else {
                    Self::Invalid(faults)
                }
            }
            RenderError::Device(cause) => Self::Device { cause },
            RenderError::Stopped => Self::Stopped,
        }
    }

    /// The status that says it.
    pub(crate) const fn status(&self) -> StatusCode {
        match self {
            Self::Malformed { .. } | Self::Body(_) => StatusCode::BAD_REQUEST,
            Self::Invalid(_) | Self::Report(_) | Self::BadFile(_) | Self::KeyTaken(_) => {
                StatusCode::UNPROCESSABLE_ENTITY
            }
            Self::NotFound(_) | Self::NoAssets | Self::NoJobs => StatusCode::NOT_FOUND,
            Self::Method { .. } => StatusCode::METHOD_NOT_ALLOWED,
            Self::NotAcceptable(_) => StatusCode::NOT_ACCEPTABLE,
            Self::Slow { .. } => StatusCode::REQUEST_TIMEOUT,
            Self::BodyTooLarge { .. } | Self::FrameTooLarge(_) => StatusCode::PAYLOAD_TOO_LARGE,
            Self::MediaType { .. } | Self::WrongFile(_) => StatusCode::UNSUPPORTED_MEDIA_TYPE,
            Self::StillOpen(_) => StatusCode::CONFLICT,
            Self::Precondition => StatusCode::PRECONDITION_FAILED,
            Self::NoRoom(_) => StatusCode::INSUFFICIENT_STORAGE,
            Self::Upgrade(_) => StatusCode::UPGRADE_REQUIRED,
            Self::Busy { .. } | Self::Device { .. } | Self::Unreachable { .. } | Self::Stopped => {
                StatusCode::SERVICE_UNAVAILABLE
            }
            Self::Internal { .. } => StatusCode::INTERNAL_SERVER_ERROR,
        }
    }

    /// Seconds after which the same request may succeed.
    pub(crate) const fn retry_after_s(&self) -> Option<u32> {
        match self {
            Self::Busy { retry_after_s, .. } => Some(*retry_after_s),
            Self::Device { .. } => Some(1),
            Self::Unreachable { .. } => Some(5),
            _ => None,
        }
    }

    /// What the log is told and the client is not.
    pub(crate) fn cause(&self) -> Option<&str> {
        match self {
            Self::Device { cause } | Self::Unreachable { cause } | Self::Internal { cause } => Some(cause),
            _ => None,
        }
    }

    /// Puts `pointer` in place of every pointer: faults of what is only derived from that part.
    pub(crate) fn pointing_to(mut self, pointer: &str) -> Self {
        if let Self::Invalid(faults) = &mut self {
            for fault in faults {
                fault.pointer = Some(pointer.into());
            }
        }
        self
    }

    /// Puts `prefix` before every pointer: faults of a part, told in the terms of the whole.
    pub(crate) fn within(mut self, prefix: &str) -> Self {
        if let Self::Invalid(faults) = &mut self {
            for pointer in faults.iter_mut().filter_map(|fault| fault.pointer.as_mut()) {
                pointer.insert_str(0, prefix);
            }
        }
        self
    }
}

fn first_message(faults: &[Fault]) -> &str {
    faults
        .first()
        .map_or("the request is not valid", |fault| &fault.message)
}
