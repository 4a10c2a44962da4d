//! One row a job: its document, and how far it is.

use super::{Queue, now_ms, on};
use crate::{JobError, id::JobId};
use serde::Serialize;
use sqlx::Row;

/// How far a job is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum State {
    /// Its tasks are being put into the queue.
    Queueing,
    /// Its frames wait or are rendered.
    Running,
    /// Its frames are done, and what is made of all of them is being made.
    Gathering,
    /// All is done.
    Done,
    /// All has ended, and something failed.
    Failed,
    /// It was stopped.
    Cancelled,
}

impl State {
    const ALL: [Self; 6] = [
        Self::Queueing,
        Self::Running,
        Self::Gathering,
        Self::Done,
        Self::Failed,
        Self::Cancelled,
    ];

    /// As the document and the database write it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Queueing => "queueing",
            Self::Running => "running",
            Self::Gathering => "gathering",
            Self::Done => "done",
            Self::Failed => "failed",
            Self::Cancelled => "cancelled",
        }
    }

    /// True where nothing more will happen.
    #[must_use]
    pub const fn has_ended(self) -> bool {
        matches!(self, Self::Done | Self::Failed | Self::Cancelled)
    }
}

/// A job as its row holds it.
#[derive(Clone, Debug)]
pub(crate) struct Record {
    pub(crate) id: JobId,
    pub(crate) document: String,
    pub(crate) frames: u32,
    pub(crate) state: State,
    pub(crate) created_ms: i64,
    pub(crate) ended_ms: Option<i64>,
    /// What is to be said of it, such as a film that could not be made.
    pub(crate) notes: Vec<String>,
}

const COLUMNS: &str = "id, document, frames, state, created_ms, ended_ms, notes";

impl Queue {
    /// Adds a job, unless one of this key is there; then gives that one's name.
    pub(crate) async fn add(
        &self,
        id: JobId,
        key: Option<&str>,
        document: &str,
        frames: u32,
    ) -> Result<Option<JobId>, JobError> {
        let text = "INSERT INTO welkin_jobs (id, idempotency_key, document, frames, state, created_ms) \
                    VALUES ($1, $2, $3, $4, 'queueing', $5) ON CONFLICT (idempotency_key) DO NOTHING";
        let added = on!(self, |pool, tasks| {
            let added = sqlx::query(text)
                .bind(id.to_string())
                .bind(key)
                .bind(document)
                .bind(i64::from(frames))
                .bind(now_ms());
            added.execute(pool).await?.rows_affected()
        });
        if added == 1 {
            return Ok(None);
        }
        let text = "SELECT id FROM welkin_jobs WHERE idempotency_key = $1";
        let known: String = on!(self, |pool, tasks| sqlx::query_scalar(text)
            .bind(key)
            .fetch_one(pool)
            .await?);
        Ok(Some(known.parse()?))
    }

    /// A job's row.
    pub(crate) async fn record(&self, id: JobId) -> Result<Record, JobError> {
        let found = self.records("WHERE id = $1", &id.to_string()).await?;
        found
            .into_iter()
            .next()
            .ok_or_else(|| JobError::Unknown(id.to_string()))
    }

    /// Jobs before one in the order they were sent, the last first.
    pub(crate) async fn records_before(&self, id: Option<JobId>, most: u32) -> Result<Vec<Record>, JobError> {
        // No ULID begins with a later letter.
        let before = id.map_or_else(|| "~".into(), |id| id.to_string());
        let clause = format!("WHERE id < $1 ORDER BY id DESC LIMIT {most}");
        self.records(&clause, &before).await
    }

    /// Jobs that have not ended, the first first.
    pub(crate) async fn open_records(&self) -> Result<Vec<Record>, JobError> {
        self.records("WHERE ended_ms IS NULL AND id > $1 ORDER BY id", "")
            .await
    }

    async fn records(&self, clause: &str, value: &str) -> Result<Vec<Record>, JobError> {
        let text = format!("SELECT {COLUMNS} FROM welkin_jobs {clause}");
        macro_rules! record {
            ($row:expr) => {{
                let row = $row;
                let (id, state): (String, String) = (row.try_get(0)?, row.try_get(3)?);
                let notes: String = row.try_get(6)?;
                let damaged = || JobError::Damaged(format!("the queue's row of job {id} is damaged"));
                Ok(Record {
                    document: row.try_get(1)?,
                    frames: u32::try_from(row.try_get::<i64, _>(2)?).map_err(|_| damaged())?,
                    state: State::ALL
                        .into_iter()
                        .find(|s| s.name() == state)
                        .ok_or_else(damaged)?,
                    created_ms: row.try_get(4)?,
                    ended_ms: row.try_get(5)?,
                    notes: serde_json::from_str(&notes).map_err(|_| damaged())?,
                    id: id.parse()?,
                })
            }};
        }
        on!(self, |pool, tasks| {
            let rows = sqlx::query(sqlx::AssertSqlSafe(text))
                .bind(value)
                .fetch_all(pool)
                .await?;
            rows.iter().map(|row| record!(row)).collect()
        })
    }

    /// Moves a job from one state to another, if it is in that one: of several who try, one does.
    pub(crate) async fn advance(&self, id: JobId, from: State, to: State) -> Result<bool, JobError> {
        let text = "UPDATE welkin_jobs SET state = $3, ended_ms = $4 WHERE id = $1 AND state = $2";
        let ended = to.has_ended().then(now_ms);
        let moved = on!(self, |pool, tasks| {
            let moved = sqlx::query(text)
                .bind(id.to_string())
                .bind(from.name())
                .bind(to.name())
                .bind(ended);
            moved.execute(pool).await?.rows_affected()
        });
        Ok(moved == 1)
    }

    /// Marks a job as cancelled, unless it has ended.
    pub(crate) async fn cancel(&self, id: JobId) -> Result<bool, JobError> {
        let text =
            "UPDATE welkin_jobs SET state = 'cancelled', ended_ms = $2 WHERE id = $1 AND ended_ms IS NULL";
        let moved = on!(self, |pool, tasks| {
            let moved = sqlx::query(text).bind(id.to_string()).bind(now_ms());
            moved.execute(pool).await?.rows_affected()
        });
        Ok(moved == 1)
    }

    /// True where a job was stopped.
    pub(crate) async fn is_cancelled(&self, id: JobId) -> Result<bool, JobError> {
        let text = "SELECT count(*) FROM welkin_jobs WHERE id = $1 AND state = 'cancelled'";
        let count: i64 = on!(self, |pool, tasks| {
            sqlx::query_scalar(text)
                .bind(id.to_string())
                .fetch_one(pool)
                .await?
        });
        Ok(count > 0)
    }

    /// Says something of a job.
    pub(crate) async fn note(&self, id: JobId, notes: &[String]) -> Result<(), JobError> {
        let text = "UPDATE welkin_jobs SET notes = $2 WHERE id = $1";
        let notes = serde_json::json!(notes).to_string();
        on!(self, |pool, tasks| {
            sqlx::query(text)
                .bind(id.to_string())
                .bind(notes)
                .execute(pool)
                .await?;
        });
        Ok(())
    }
}
