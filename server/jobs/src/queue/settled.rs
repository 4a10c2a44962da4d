//! The frames of a job that are done.

use super::{
    NAME, Queue, on,
    tasks::{of_job, prefix},
};
use crate::{
    JobError,
    id::{JobId, Part},
};
use serde_json::Value;

/// A frame that is done, and what its worker said of it.
pub(crate) struct Settled {
    pub(crate) frame: u32,
    pub(crate) told: Value,
    pub(crate) worker: String,
}

impl Queue {
    /// What workers said of the frames that are done, in order.
    pub(crate) async fn settled(&self, id: JobId) -> Result<Vec<Settled>, JobError> {
        let rows: Vec<(String, Option<String>, Option<String>)> = on!(self, |pool, tasks| {
            let text = format!(
                "SELECT idempotency_key, CAST(last_result AS TEXT), lock_by FROM {tasks} WHERE {} AND status = 'Done' \
                 ORDER BY idempotency_key",
                of_job(self),
            );
            sqlx::query_as(sqlx::AssertSqlSafe(text))
                .bind(NAME)
                .bind(prefix(self, id))
                .fetch_all(pool)
                .await?
        });
        let settled = |(key, result, worker): (String, Option<String>, Option<String>)| {
            let Some(Part::Frame(frame)) = Part::of_key(&key) else {
                return None;
            };
            let result: Value = serde_json::from_str(result.as_deref()?).ok()?;
            let told = result.get("Ok").cloned().unwrap_or_default();
            let worker = worker.unwrap_or_default();
            Some(Settled { frame, told, worker })
        };
        Ok(rows.into_iter().filter_map(settled).collect())
    }

    /// What the files of the frames that are done take, bytes.
    pub(crate) async fn stored_bytes(&self, id: JobId) -> Result<u64, JobError> {
        let bytes: i64 = on!(self, |pool, tasks| {
            let told = match self {
                Self::Sqlite(_) => "json_extract(CAST(last_result AS TEXT), '$.Ok.bytes')",
                Self::Postgres(_) => "CAST(last_result::jsonb #>> '{Ok,bytes}' AS BIGINT)",
            };
            let text = format!(
                "SELECT CAST(coalesce(sum({told}), 0) AS BIGINT) FROM {tasks} WHERE {} AND status = 'Done'",
                of_job(self)
            );
            sqlx::query_scalar(sqlx::AssertSqlSafe(text))
                .bind(NAME)
                .bind(prefix(self, id))
                .fetch_one(pool)
                .await?
        });
        Ok(u64::try_from(bytes).unwrap_or_default())
    }

    /// Numbers of the frames that were done last, in order: `most` of them.
    pub(crate) async fn latest(&self, id: JobId, most: u32) -> Result<Vec<u32>, JobError> {
        let keys: Vec<String> = on!(self, |pool, tasks| {
            let text = format!(
                "SELECT idempotency_key FROM {tasks} WHERE {} AND status = 'Done' \
                 AND idempotency_key NOT LIKE '%gather' ORDER BY done_at DESC, idempotency_key DESC LIMIT {most}",
                of_job(self)
            );
            sqlx::query_scalar(sqlx::AssertSqlSafe(text))
                .bind(NAME)
                .bind(prefix(self, id))
                .fetch_all(pool)
                .await?
        });
        let number = |key: &String| match Part::of_key(key) {
            Some(Part::Frame(number)) => Some(number),
            _ => None,
        };
        let mut numbers: Vec<_> = keys.iter().filter_map(number).collect();
        numbers.sort_unstable();
        Ok(numbers)
    }
}
