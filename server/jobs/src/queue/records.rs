//! One row a job: its document, and how far it is.

use super::{Queue, now_ms, on};
use crate::{JobError, id::JobId};
use serde::{Deserialize, Serialize};
use sqlx::Row;
use welkin_scene::Format;

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

/// What is told of a job's document wherever the job is, beside the document, which may be long.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Summary {
    pub(crate) name: Option<String>,
    pub(crate) kind: String,
    pub(crate) format: Option<Format>,
}

impl Summary {
    /// The kind of file of every frame.
    pub(crate) fn of_frames(&self) -> Format {
        let usual = if self.kind == "panorama" {
            Format::Exr
        } else {
            Format::Png
        };
        self.format.unwrap_or(usual)
    }
}

/// A job that is to be added.
pub(crate) struct New<'a> {
    pub(crate) id: JobId,
    pub(crate) key: Option<&'a str>,
    pub(crate) document: &'a str,
    pub(crate) summary: &'a Summary,
    pub(crate) frames: u32,
    /// What it may take of the store and the queue.
    pub(crate) bytes: u64,
}

/// What has come of adding a job.
pub(crate) enum Added {
    New,
    /// One of this key is there.
    Known(JobId),
    /// All jobs together would take more than they may.
    Full,
}

/// A job as its row holds it.
#[derive(Clone, Debug)]
pub(crate) struct Record {
    pub(crate) id: JobId,
    /// What a status tells of the document.
    pub(crate) summary: Summary,
    pub(crate) frames: u32,
    pub(crate) state: State,
    pub(crate) created_ms: i64,
    pub(crate) ended_ms: Option<i64>,
    /// What is to be said of it, such as a film that could not be made.
    pub(crate) notes: Vec<String>,
}

const COLUMNS: &str = "id, summary, frames, state, created_ms, ended_ms, notes";

impl Queue {
    /// Adds a job, unless one of this key is there or all together would take more than `most` bytes, however many are
    /// added at once: in SQLite one statement writes at a time, in PostgreSQL a lock lets one add at a time.
    pub(crate) async fn add(&self, job: &New<'_>, most: u64) -> Result<Added, JobError> {
        // Where there is no WHERE, SQLite takes ON CONFLICT for the ON of a join.
        let text = "INSERT INTO welkin_jobs (id, idempotency_key, document, summary, frames, state, created_ms, bytes) \
                    SELECT $1, $2, $3, $4, $5, 'queueing', $6, $7 \
                    WHERE (SELECT CAST(coalesce(sum(bytes), 0) AS BIGINT) FROM welkin_jobs) <= $8 \
                    ON CONFLICT (idempotency_key) DO NOTHING";
        let summary = serde_json::to_string(job.summary).map_err(|e| JobError::Damaged(e.to_string()))?;
        let room = i64::try_from(most).unwrap_or(i64::MAX);
        let bytes = i64::try_from(job.bytes).unwrap_or(i64::MAX);
        let added = on!(self, |pool, tasks| {
            let mut transaction = pool.begin().await?;
            if matches!(self, Self::Postgres(_)) {
                // Before the statement that sums, which sees what was there when it began.
                sqlx::query("SELECT pg_advisory_xact_lock(8386106348138)")
                    .execute(&mut *transaction)
                    .await?;
            }
            let added = sqlx::query(text)
                .bind(job.id.to_string())
                .bind(job.key)
                .bind(job.document)
                .bind(summary)
                .bind(i64::from(job.frames))
                .bind(now_ms())
                .bind(bytes)
                .bind(room.saturating_sub(bytes))
                .execute(&mut *transaction)
                .await?
                .rows_affected();
            transaction.commit().await?;
            added
        });
        if added == 1 {
            return Ok(Added::New);
        }
        let text = "SELECT id FROM welkin_jobs WHERE idempotency_key = $1";
        let known: Option<String> = on!(self, |pool, tasks| sqlx::query_scalar(text)
            .bind(job.key)
            .fetch_optional(pool)
            .await?);
        known.map_or(Ok(Added::Full), |id| Ok(Added::Known(id.parse()?)))
    }

    /// Says what a job takes of the store and the queue, now that it is known.
    pub(crate) async fn weigh(&self, id: JobId, bytes: u64) -> Result<(), JobError> {
        let text = "UPDATE welkin_jobs SET bytes = $2 WHERE id = $1";
        let bytes = i64::try_from(bytes).unwrap_or(i64::MAX);
        on!(self, |pool, tasks| {
            sqlx::query(text)
                .bind(id.to_string())
                .bind(bytes)
                .execute(pool)
                .await?;
        });
        Ok(())
    }

    /// What all jobs take, bytes.
    pub(crate) async fn weight(&self) -> Result<u64, JobError> {
        let text = "SELECT CAST(coalesce(sum(bytes), 0) AS BIGINT) FROM welkin_jobs";
        let bytes: i64 = on!(self, |pool, tasks| sqlx::query_scalar(text)
            .fetch_one(pool)
            .await?);
        Ok(u64::try_from(bytes).unwrap_or_default())
    }

    /// A job's document.
    pub(crate) async fn document(&self, id: JobId) -> Result<String, JobError> {
        let text = "SELECT document FROM welkin_jobs WHERE id = $1";
        let found: Option<String> = on!(self, |pool, tasks| sqlx::query_scalar(text)
            .bind(id.to_string())
            .fetch_optional(pool)
            .await?);
        found.ok_or_else(|| JobError::Unknown(id.to_string()))
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
                    summary: serde_json::from_str(row.try_get(1)?).map_err(|_| damaged())?,
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

    /// Counts that a task is begun once more, and tells how often that was.
    pub(crate) async fn begin(&self, key: &str) -> Result<u32, JobError> {
        let text = "INSERT INTO welkin_begins (task, count) VALUES ($1, 1) \
                    ON CONFLICT (task) DO UPDATE SET count = welkin_begins.count + 1 RETURNING count";
        let count: i64 = on!(self, |pool, tasks| sqlx::query_scalar(text)
            .bind(key)
            .fetch_one(pool)
            .await?);
        Ok(u32::try_from(count).unwrap_or(u32::MAX))
    }

    /// Forgets how often a task was begun, as it did not end its worker.
    pub(crate) async fn came_through(&self, key: &str) -> Result<(), JobError> {
        on!(self, |pool, tasks| {
            sqlx::query("DELETE FROM welkin_begins WHERE task = $1")
                .bind(key)
                .execute(pool)
                .await?;
        });
        Ok(())
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
