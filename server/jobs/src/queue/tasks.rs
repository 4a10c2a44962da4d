//! The tasks of a job.

use super::{NAME, Queue, now_ms, on};
use crate::{
    JobError,
    id::{JobId, Part, Task},
};
use apalis::prelude::{Task as Queued, TaskBuilder, TaskId, TaskSink};
use apalis_postgres::PostgresStorage;
use futures_util::stream;
use serde::Serialize;
use serde_json::Value;
use std::collections::HashSet;
use ulid::Generator;

/// Tasks of one transaction.
const CHUNK: usize = 2000;
/// How often a task may be fetched; how often it is begun is for workers to count.
const MOST_FETCHES: usize = 1_000_000;
/// What the table holds of a task that was stopped before it began; a worker that stops one writes the same reason.
const CANCELLED_RESULT: &str = r#"{"Err": "cancelled"}"#;

/// How many frames of a job are how far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Nobody has begun them, or they are to be begun again.
    pub waiting: u32,
    /// They are being rendered.
    pub running: u32,
    /// Their files are in the store.
    pub done: u32,
    /// They were given up.
    pub failed: u32,
    /// They were stopped.
    pub cancelled: u32,
    /// Times that one was begun again.
    pub retries: u32,
}

/// A task that was given up.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Dead {
    /// The frame's number; null for what is made of all frames.
    pub frame: Option<u32>,
    /// How often it was begun.
    pub attempts: u32,
    /// Why the last attempt failed.
    pub reason: String,
}

impl Queue {
    /// Puts tasks into the queue, each unless it is there.
    pub(crate) async fn push(&self, id: JobId, parts: &[Part]) -> Result<(), JobError> {
        let known = match parts {
            [one] => self.known(&id.key(*one)).await?,
            _ => self.keys(id).await?,
        };
        let missing: Vec<_> = parts
            .iter()
            .copied()
            .filter(|part| !known.contains(&id.key(*part)))
            .collect();
        let mut names = Generator::new();
        for chunk in missing.chunks(CHUNK) {
            let tasks = chunk
                .iter()
                .map(|part| task(id, *part, &mut names))
                .collect::<Result<Vec<_>, _>>()?;
            self.push_chunk(tasks).await?;
        }
        Ok(())
    }

    async fn push_chunk(&self, tasks: Vec<Queued<Task>>) -> Result<(), JobError> {
        let failed = |e: &dyn std::fmt::Display| JobError::Queue(e.to_string());
        match self {
            Self::Sqlite(pool) => {
                let bytes = |task: Queued<Task>| task.try_map_args(|args| serde_json::to_vec(&args));
                let tasks: Vec<_> = tasks
                    .into_iter()
                    .map(bytes)
                    .collect::<Result<_, _>>()
                    .map_err(|e| failed(&e))?;
                let mut transaction = pool.begin().await?;
                apalis_sqlite::queries::push_tasks(&mut *transaction, NAME, &tasks)
                    .await
                    .map_err(|e| failed(&e))?;
                transaction.commit().await?;
            }
            Self::Postgres(pool) => {
                let config = apalis_postgres::Config::default().queue(NAME);
                let mut storage = PostgresStorage::<Task>::new(pool).with_config(config);
                storage
                    .push_all(stream::iter(tasks))
                    .await
                    .map_err(|e| failed(&e))?;
            }
        }
        Ok(())
    }

    /// Keys of a job's tasks.
    async fn keys(&self, id: JobId) -> Result<HashSet<String>, JobError> {
        on!(self, |pool, tasks| {
            let text = format!("SELECT idempotency_key FROM {tasks} WHERE {}", of_job(self));
            let keys = sqlx::query_scalar(sqlx::AssertSqlSafe(text))
                .bind(NAME)
                .bind(prefix(self, id));
            Ok(keys.fetch_all(pool).await?.into_iter().collect())
        })
    }

    /// A key, if a task has it.
    async fn known(&self, key: &str) -> Result<HashSet<String>, JobError> {
        on!(self, |pool, tasks| {
            let text =
                format!("SELECT idempotency_key FROM {tasks} WHERE job_type = $1 AND idempotency_key = $2");
            let keys = sqlx::query_scalar(sqlx::AssertSqlSafe(text)).bind(NAME).bind(key);
            Ok(keys.fetch_all(pool).await?.into_iter().collect())
        })
    }

    /// How many of a job's frames are how far.
    pub(crate) async fn counts(&self, id: JobId) -> Result<Counts, JobError> {
        let rows: Vec<(String, bool, i64, i64)> = on!(self, |pool, tasks| {
            let text = format!(
                "SELECT status, {} AS cancelled, count(*), \
                 CAST(sum(CASE WHEN attempts > 1 THEN attempts - 1 ELSE 0 END) AS BIGINT) FROM {tasks} \
                 WHERE {} AND idempotency_key NOT LIKE '%gather' GROUP BY 1, 2",
                is_cancelled(self),
                of_job(self),
            );
            sqlx::query_as(sqlx::AssertSqlSafe(text))
                .bind(NAME)
                .bind(prefix(self, id))
                .fetch_all(pool)
                .await?
        });
        let mut counts = Counts::default();
        for (status, cancelled, count, retries) in rows {
            let count = u32::try_from(count).unwrap_or(u32::MAX);
            counts.retries += u32::try_from(retries).unwrap_or(u32::MAX);
            match (status.as_str(), cancelled) {
                ("Running", _) => counts.running += count,
                ("Done", _) => counts.done += count,
                ("Killed", true) => counts.cancelled += count,
                ("Killed", false) => counts.failed += count,
                _ => counts.waiting += count,
            }
        }
        Ok(counts)
    }

    /// Frames done since a time, seconds since 1970.
    pub(crate) async fn done_since(&self, id: JobId, since_s: i64) -> Result<u32, JobError> {
        let count: i64 = on!(self, |pool, tasks| {
            let done_at = match self {
                Self::Sqlite(_) => "CAST(done_at AS INTEGER) >= $3",
                Self::Postgres(_) => "done_at >= to_timestamp($3)",
            };
            let text = format!(
                "SELECT count(*) FROM {tasks} WHERE {} AND status = 'Done' AND {done_at}",
                of_job(self)
            );
            let count = sqlx::query_scalar(sqlx::AssertSqlSafe(text))
                .bind(NAME)
                .bind(prefix(self, id))
                .bind(since_s);
            count.fetch_one(pool).await?
        });
        Ok(u32::try_from(count).unwrap_or(u32::MAX))
    }

    /// Tasks that were given up, with their reasons, in order.
    pub(crate) async fn dead(&self, id: JobId, most: u32) -> Result<Vec<Dead>, JobError> {
        let rows: Vec<(String, i64, Option<String>)> = on!(self, |pool, tasks| {
            let text = format!(
                "SELECT idempotency_key, CAST(attempts AS BIGINT), CAST(last_result AS TEXT) FROM {tasks} \
                 WHERE {} AND status = 'Killed' AND NOT {} ORDER BY idempotency_key LIMIT {most}",
                of_job(self),
                is_cancelled(self),
            );
            sqlx::query_as(sqlx::AssertSqlSafe(text))
                .bind(NAME)
                .bind(prefix(self, id))
                .fetch_all(pool)
                .await?
        });
        let dead = |(key, attempts, result): (String, i64, Option<String>)| Dead {
            frame: match Part::of_key(&key) {
                Some(Part::Frame(number)) => Some(number),
                _ => None,
            },
            attempts: u32::try_from(attempts).unwrap_or(u32::MAX),
            reason: reason(result.as_deref().unwrap_or_default()),
        };
        Ok(rows.into_iter().map(dead).collect())
    }

    /// True while a task of the job waits or runs.
    pub(crate) async fn is_open(&self, id: JobId) -> Result<bool, JobError> {
        let count: i64 = on!(self, |pool, tasks| {
            let text = format!(
                "SELECT count(*) FROM (SELECT 1 FROM {tasks} WHERE {} AND status NOT IN ('Done', 'Killed') LIMIT 1) AS one",
                of_job(self)
            );
            sqlx::query_scalar(sqlx::AssertSqlSafe(text))
                .bind(NAME)
                .bind(prefix(self, id))
                .fetch_one(pool)
                .await?
        });
        Ok(count > 0)
    }

    /// Takes the tasks that nobody has begun out of the queue.
    pub(crate) async fn withdraw(&self, id: JobId) -> Result<(), JobError> {
        on!(self, |pool, tasks| {
            let (result, now) = match self {
                Self::Sqlite(_) => ("$3", "strftime('%s', 'now')"),
                Self::Postgres(_) => ("CAST($3 AS jsonb)", "now()"),
            };
            let text = format!(
                "UPDATE {tasks} SET status = 'Killed', last_result = {result}, done_at = {now} \
                 WHERE {} AND status IN ('Pending', 'Failed')",
                of_job(self)
            );
            sqlx::query(sqlx::AssertSqlSafe(text))
                .bind(NAME)
                .bind(prefix(self, id))
                .bind(CANCELLED_RESULT)
                .execute(pool)
                .await?;
        });
        Ok(())
    }

    /// Tasks of all jobs that wait, and those that run.
    pub(crate) async fn depth(&self) -> Result<(u64, u64), JobError> {
        let rows: Vec<(String, i64)> = on!(self, |pool, tasks| {
            let text = format!(
                "SELECT status, count(*) FROM {tasks} WHERE job_type = $1 AND status NOT IN ('Done', 'Killed') GROUP BY 1"
            );
            sqlx::query_as(sqlx::AssertSqlSafe(text))
                .bind(NAME)
                .fetch_all(pool)
                .await?
        });
        let of = |running: bool| {
            let rows = rows.iter().filter(|(status, _)| (status == "Running") == running);
            rows.map(|(_, count)| u64::try_from(*count).unwrap_or_default())
                .sum()
        };
        Ok((of(false), of(true)))
    }

    /// Workers whose heartbeat was heard in the last `within_s` seconds.
    pub(crate) async fn workers(&self, within_s: i64) -> Result<u64, JobError> {
        let count: i64 = match self {
            Self::Sqlite(pool) => {
                let text = "SELECT count(*) FROM Workers WHERE worker_type = $1 \
                            AND CAST(last_seen AS INTEGER) >= CAST(strftime('%s', 'now') AS INTEGER) - $2";
                sqlx::query_scalar(text)
                    .bind(NAME)
                    .bind(within_s)
                    .fetch_one(pool)
                    .await?
            }
            Self::Postgres(pool) => {
                let text = "SELECT count(*) FROM apalis.workers WHERE worker_type = $1 \
                            AND last_seen >= now() - make_interval(secs => $2)";
                #[allow(clippy::cast_precision_loss, reason = "seconds of a heartbeat")]
                let within_s = within_s as f64;
                sqlx::query_scalar(text)
                    .bind(NAME)
                    .bind(within_s)
                    .fetch_one(pool)
                    .await?
            }
        };
        Ok(u64::try_from(count).unwrap_or_default())
    }
}

fn task(id: JobId, part: Part, names: &mut Generator) -> Result<Queued<Task>, JobError> {
    // In order, as tasks of one second are taken in the order of their names.
    let name = names.generate().map_err(|e| JobError::Queue(e.to_string()))?;
    let (job, queued_ms) = (id.to_string(), now_ms());
    let task = TaskBuilder::new(Task { job, part, queued_ms })
        .task_id(TaskId::from_string(name.to_string()))
        .idempotency_key(id.key(part))
        .max_attempts(MOST_FETCHES)
        .priority(usize::from(part == Part::Gather));
    Ok(task.build())
}

/// The condition that picks a job's tasks: `$1` is the queue's name, `$2` the job's [`prefix`].
pub(super) const fn of_job(queue: &Queue) -> &'static str {
    match queue {
        // LIKE would not use the index: it does not tell letters' case apart.
        Queue::Sqlite(_) => "job_type = $1 AND idempotency_key GLOB $2",
        Queue::Postgres(_) => "job_type = $1 AND idempotency_key LIKE $2",
    }
}

pub(super) fn prefix(queue: &Queue, id: JobId) -> String {
    match queue {
        Queue::Sqlite(_) => format!("{id}/*"),
        Queue::Postgres(_) => format!("{id}/%"),
    }
}

const fn is_cancelled(queue: &Queue) -> &'static str {
    match queue {
        Queue::Sqlite(_) => "(coalesce(last_result, '') LIKE '%cancelled\"}')",
        Queue::Postgres(_) => "(coalesce(last_result::text, '') LIKE '%cancelled\"}')",
    }
}

/// The reason in a task's result, without what apalis writes before it.
fn reason(result: &str) -> String {
    let result: Value = serde_json::from_str(result).unwrap_or_default();
    let told = result["Err"].as_str().unwrap_or("no reason was told");
    told.strip_prefix("AbortError: ").unwrap_or(told).to_owned()
}
