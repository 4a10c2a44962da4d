//! Names of jobs, of their tasks and of what they leave in the store.

use crate::JobError;
use object_store::path::Path;
use serde::Serialize;
use std::{fmt, str::FromStr};
use ulid::Ulid;
use welkin_assets::{Kind, Name};

/// The name of a job: a ULID, so that names sort by when jobs were sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct JobId(Ulid);

impl JobId {
    pub(crate) fn new() -> Self {
        Self(Ulid::generate())
    }

    /// Where a frame's file lies in the store. Frames are numbered from 0, in the document's order.
    pub(crate) fn frame(self, number: u32, extension: &str) -> Path {
        self.within(&format!("frames/{number:06}.{extension}"))
    }

    /// Where a file that is made of all frames lies.
    pub(crate) fn whole(self, name: &str) -> Path {
        self.within(name)
    }

    /// Where an asset lies as it was when the job was sent.
    pub(crate) fn asset(self, kind: Kind, name: &Name) -> Path {
        self.within(&format!("assets/{kind}/{name}"))
    }

    /// The folder of assets.
    pub(crate) fn assets(self) -> Path {
        self.within("assets")
    }

    /// The folder of all that is in the store of it.
    pub(crate) fn folder(self) -> Path {
        Path::from(format!("jobs/{self}"))
    }

    fn within(self, name: &str) -> Path {
        Path::from(format!("jobs/{self}/{name}"))
    }

    /// The key that a task has in the queue: each is there once.
    pub(crate) fn key(self, part: Part) -> String {
        match part {
            Part::Frame(number) => format!("{self}/{number:06}"),
            Part::Gather => format!("{self}/gather"),
        }
    }
}

impl fmt::Display for JobId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl Serialize for JobId {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl FromStr for JobId {
    type Err = JobError;

    /// Only as it is written: other spellings of the same ULID would be other names in the store.
    fn from_str(text: &str) -> Result<Self, JobError> {
        let id = Ulid::from_string(text).map(Self).ok();
        id.filter(|id| id.to_string() == text)
            .ok_or_else(|| JobError::Unknown(text.chars().take(40).collect()))
    }
}

/// A task of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Part {
    /// One frame.
    Frame(u32),
    /// What is made of all frames.
    Gather,
}

impl Part {
    /// From the key of a task.
    pub(crate) fn of_key(key: &str) -> Option<Self> {
        match key.split_once('/')?.1 {
            "gather" => Some(Self::Gather),
            number => number.parse().ok().map(Self::Frame),
        }
    }
}

/// What the queue holds of a task.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
pub struct Task {
    /// The job's name.
    pub job: String,
    /// Which part of it.
    pub part: Part,
    /// When it was put into the queue, milliseconds since 1970.
    pub queued_ms: i64,
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;

    #[test]
    fn a_job_has_one_spelling() {
        let id = JobId::new();
        assert_eq!(id.to_string().parse::<JobId>().unwrap(), id);
        for other in [
            id.to_string().to_lowercase(),
            String::new(),
            "../x".into(),
            "x".repeat(1000),
        ] {
            assert!(other.parse::<JobId>().is_err(), "{other}");
        }
    }

    #[test]
    fn keys_tell_their_part() {
        let id = JobId::new();
        for part in [Part::Frame(0), Part::Frame(99_999), Part::Gather] {
            assert_eq!(Part::of_key(&id.key(part)), Some(part));
        }
    }
}
