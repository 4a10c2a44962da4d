//! Why something could not be done with jobs.

use welkin_scene::problem::SceneError;

/// Why something could not be done with jobs.
#[derive(Debug, thiserror::Error)]
pub enum JobError {
    /// The document was refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An asset that the job names could not be taken.
    #[error(transparent)]
    Assets(#[from] welkin_assets::Error),
    /// There is no such job.
    #[error("there is no job {0}")]
    Unknown(String),
    /// There is no such result, or not yet.
    #[error("job {job} has no result {name}")]
    NoResult {
        /// The job.
        job: String,
        /// What was asked for.
        name: String,
    },
    /// The key stands for another job.
    #[error("the idempotency key {key:?} was used for another document, that of job {job}")]
    KeyTaken {
        /// The key.
        key: String,
        /// The job that it stands for.
        job: String,
    },
    /// The job is still worked on.
    #[error(
        "job {job} is {state}: it can be removed once it has ended, or was stopped and its last frame has ended"
    )]
    Open {
        /// The job.
        job: String,
        /// How far it is.
        state: &'static str,
    },
    /// All jobs together would take more than they may.
    #[error(
        "the job may take {bytes} bytes, and jobs here have {taken} of {most}: remove old ones, or raise --store-bytes"
    )]
    Full {
        /// What it may take.
        bytes: u64,
        /// What the others take.
        taken: u64,
        /// What all may take.
        most: u64,
    },
    /// The address of a queue or a store makes no sense.
    #[error("{0}")]
    Address(String),
    /// The queue's database failed.
    #[error("the queue: {0}")]
    Queue(String),
    /// The store of results failed.
    #[error("the store of results: {0}")]
    Store(#[from] object_store::Error),
    /// A file of this machine failed.
    #[error("{what}: {source}")]
    File {
        /// What was done with which file.
        what: String,
        /// What the system said.
        source: std::io::Error,
    },
    /// What the queue or the store holds is not what was put there.
    #[error("{0}")]
    Damaged(String),
}

impl From<sqlx::Error> for JobError {
    fn from(error: sqlx::Error) -> Self {
        Self::Queue(error.to_string())
    }
}

impl JobError {
    /// For `map_err`: what was done when the system refused.
    pub(crate) fn file(what: impl Into<String>) -> impl FnOnce(std::io::Error) -> Self {
        move |source| Self::File {
            what: what.into(),
            source,
        }
    }
}
