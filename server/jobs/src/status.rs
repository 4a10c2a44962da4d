//! How a job is doing.

use crate::{
    JobError, JobId, Jobs,
    queue::{Counts, Dead, Record, State, now_ms},
};
use chrono::{DateTime, SecondsFormat};
use serde::Serialize;
use std::sync::Arc;
use welkin_scene::Format;

/// Failures that a status tells.
const MOST_FAILURES: u32 = 100;
/// Frames that a status names.
const LATEST: u32 = 4;
/// The rate is that of about this long, seconds.
const RATE_S: i64 = 60;

/// How a job is doing.
#[derive(Clone, Debug, Serialize)]
pub struct JobStatus {
    /// Its name.
    pub id: JobId,
    /// What people call it.
    pub name: Option<String>,
    /// `list`, `grid`, `random`, `timeline` or `panorama`.
    pub kind: String,
    /// The kind of file of its frames.
    pub format: Option<Format>,
    /// How far it is.
    pub state: State,
    /// When it was sent, RFC 3339.
    pub created_at: String,
    /// When it ended, RFC 3339; null while it has not.
    pub ended_at: Option<String>,
    /// How many frames there are in all.
    pub frames: u32,
    /// How many are how far.
    pub counts: Counts,
    /// Frames a second, over the last minute or since it was sent; over all its time once it has ended.
    pub rate_per_s: f64,
    /// Seconds until all frames are done at this rate; null where none was done lately, or it has ended.
    pub eta_s: Option<f64>,
    /// Numbers of the frames that were done last, in order; four at most.
    pub latest: Vec<u32>,
    /// What was given up, and why; the first hundred.
    pub failures: Vec<Dead>,
    /// What else is to be said, such as a film that could not be made.
    pub notes: Vec<String>,
    /// Files that were made of all frames.
    pub files: Vec<FileInfo>,
}

/// A file among a job's results.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct FileInfo {
    /// Its name.
    pub name: String,
    /// Its length, bytes.
    pub bytes: u64,
}

impl Jobs {
    /// A job's status: as it was found a moment ago, or for good, or else anew, from its row where that is known.
    pub(crate) async fn known_status(
        &self,
        id: JobId,
        record: Option<Record>,
    ) -> Result<JobStatus, JobError> {
        if let Some(status) = self.ended.get(&id).await {
            return Ok(status);
        }
        let found = async {
            let record = match record {
                Some(record) => record,
                None => self.queue.record(id).await?,
            };
            self.status_of(record).await
        };
        let found = self.lately.try_get_with(id, found).await;
        // All who asked at the same time share one error.
        let status = found.map_err(|error: Arc<JobError>| match &*error {
            JobError::Unknown(id) => JobError::Unknown(id.clone()),
            JobError::Damaged(reason) => JobError::Damaged(reason.clone()),
            other => JobError::Queue(other.to_string()),
        })?;
        if status.state.has_ended() && status.counts.running == 0 {
            self.ended.insert(id, status.clone()).await;
        }
        Ok(status)
    }

    async fn status_of(&self, record: Record) -> Result<JobStatus, JobError> {
        let Record {
            id,
            frames,
            state,
            created_ms,
            ended_ms,
            notes,
            summary,
        } = record;
        let counts = self.queue.counts(id).await?;
        let failures = match counts.failed {
            0 if state != State::Failed => Vec::new(),
            _ => self.queue.dead(id, MOST_FAILURES).await?,
        };
        let rate_per_s = self.rate(id, created_ms, ended_ms, counts).await?;
        let left = f64::from(frames.saturating_sub(counts.done + counts.failed));
        let files = match state {
            State::Queueing | State::Running => Vec::new(),
            _ => self.files(id).await?,
        };
        Ok(JobStatus {
            id,
            name: summary.name,
            kind: summary.kind,
            format: summary.format,
            state,
            created_at: rfc3339(created_ms),
            ended_at: ended_ms.map(rfc3339),
            frames,
            counts: Counts {
                // Those that are not in the queue yet, or of a job that was stopped before they were.
                waiting: match state {
                    State::Queueing => frames.saturating_sub(counts.done + counts.failed + counts.running),
                    _ => counts.waiting,
                },
                ..counts
            },
            rate_per_s,
            eta_s: (rate_per_s > 0.0 && !state.has_ended()).then(|| left / rate_per_s),
            latest: self.queue.latest(id, LATEST).await?,
            failures,
            notes,
            files,
        })
    }

    #[allow(clippy::cast_precision_loss, reason = "milliseconds of a job")]
    async fn rate(
        &self,
        id: JobId,
        created_ms: i64,
        ended_ms: Option<i64>,
        counts: Counts,
    ) -> Result<f64, JobError> {
        let lasted_s = |end_ms: i64| ((end_ms - created_ms) as f64 / 1e3).max(1.0);
        if let Some(ended_ms) = ended_ms {
            return Ok(f64::from(counts.done) / lasted_s(ended_ms));
        }
        let now = now_ms();
        let window_s = lasted_s(now).min(RATE_S as f64);
        let lately = self.queue.done_since(id, now / 1000 - RATE_S).await?;
        Ok(f64::from(lately) / window_s)
    }
}

fn rfc3339(ms: i64) -> String {
    let time = DateTime::from_timestamp_millis(ms).unwrap_or_default();
    time.to_rfc3339_opts(SecondsFormat::Millis, true)
}
