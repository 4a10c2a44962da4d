//! Why a command did not do what it was asked.

use serde_json::{Value, json};
use std::{io, process::ExitCode};
use welkin_encode::EncodeError;
use welkin_jobs::JobError;
use welkin_scene::{problem::SceneError, renderer::RenderError};
use welkin_service::StartError;

/// Why a command did not do what it was asked.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// The arguments make no sense.
    #[error("{0}")]
    Usage(String),
    /// The settings make no sense.
    #[error("settings: {0}")]
    Settings(#[from] Box<figment::Error>),
    /// The document was refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// There is nothing to render on.
    #[error("{0}")]
    Device(String),
    /// The renderer gave no frame.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The frame could not be made a file, or the format not be told.
    #[error(transparent)]
    Encode(#[from] EncodeError),
    /// A file could not be read or written.
    #[error("{what}: {source}")]
    File {
        /// The file and what was done with it.
        what: String,
        /// What the system said.
        source: io::Error,
    },
    /// The folder of assets could not be opened or read.
    #[error(transparent)]
    Assets(welkin_assets::Error),
    /// The service could not be started.
    #[error(transparent)]
    Start(#[from] StartError),
    /// The queue of jobs or the store of their results failed.
    #[error(transparent)]
    Jobs(#[from] JobError),
    /// The server refused, or could not be reached.
    #[error("{0}")]
    Server(String),
    /// A job ended, and not well.
    #[error("{0}")]
    Job(String),
    /// A benchmark could not measure, or found a promise broken.
    #[error("{0}")]
    Bench(String),
    /// Ended from the keyboard.
    #[error("interrupted")]
    Interrupted,
}

impl Failure {
    /// The exit code where there is no device.
    pub(crate) const NO_DEVICE: u8 = 3;

    /// For `map_err`: what was done when the system refused.
    pub(crate) fn file(what: impl Into<String>) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::File {
            what: what.into(),
            source,
        }
    }

    /// What scripts are told.
    pub(crate) fn exit_code(&self) -> ExitCode {
        match self {
            Self::Usage(_) | Self::Settings(_) | Self::Scene(_) => 2,
            Self::Render(RenderError::Size { .. }) | Self::Encode(EncodeError::Extension { .. }) => 2,
            Self::Device(_) => Self::NO_DEVICE,
            Self::Render(_)
            | Self::Encode(_)
            | Self::File { .. }
            | Self::Assets(_)
            | Self::Start(_)
            | Self::Jobs(_)
            | Self::Server(_)
            | Self::Job(_)
            | Self::Bench(_) => 1,
            // What shells give for an interrupt.
            Self::Interrupted => 130,
        }
        .into()
    }

    /// Tells it on standard error.
    pub(crate) fn tell(&self, json: bool) {
        if json {
            eprintln!("{}", self.problem());
            return;
        }
        for line in self.to_string().lines() {
            eprintln!("error: {line}");
        }
    }

    /// RFC 9457, as the service tells it.
    fn problem(&self) -> Value {
        let title = match self {
            Self::Usage(_) | Self::Settings(_) => "Wrong usage",
            Self::Scene(_) => "Not valid",
            Self::Device(_) => "No device",
            Self::Render(_) => "Not rendered",
            Self::Encode(_) => "Not encoded",
            Self::File { .. } | Self::Assets(_) => "Not read or written",
            Self::Start(_) => "Not started",
            Self::Jobs(_) | Self::Job(_) => "Job not done",
            Self::Server(_) => "No answer as hoped",
            Self::Bench(_) => "Not measured, or not as promised",
            Self::Interrupted => "Interrupted",
        };
        let mut problem = json!({"type": "about:blank", "title": title, "detail": self.to_string()});
        match self {
            Self::Scene(SceneError::Invalid(problems)) => {
                if let Some(first) = problems.first() {
                    problem["detail"] = first.message.as_str().into();
                    problem["pointer"] = first.pointer.as_str().into();
                    problem["value"] = first.value.clone();
                    problem["allowed"] = first.allowed.as_str().into();
                }
                problem["errors"] = json!(problems);
            }
            Self::Scene(SceneError::Report(fault)) => {
                problem["pointer"] = "/metar".into();
                problem["value"] = fault.group.as_str().into();
                problem["allowed"] = fault.expected.as_str().into();
                problem["group"] = json!(fault);
            }
            Self::Scene(SceneError::Malformed { pointer, .. }) => {
                problem["pointer"] = pointer.as_str().into()
            }
            _ => {}
        }
        problem
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use welkin_scene::Scene;

    #[test]
    fn a_refused_scene_names_its_field_in_both_forms() {
        let failure = Failure::from(Scene::from_json(r#"{"planet": {"radius_m": 1}}"#).unwrap_err());
        assert!(failure.to_string().starts_with("/planet/radius_m: "), "{failure}");
        let problem = failure.problem();
        assert_eq!(problem["pointer"], "/planet/radius_m");
        assert_eq!(problem["errors"][0]["message"], problem["detail"]);
        assert_eq!(failure.exit_code(), ExitCode::from(2));
    }
}
