//! Jobs that are forgotten.

use super::{
    NAME, Queue, on,
    tasks::{of_job, prefix},
};
use crate::{JobError, id::JobId};

impl Queue {
    /// Jobs that ended before a time, milliseconds since 1970, the first first: `most` of them.
    pub(crate) async fn ended_before(&self, time_ms: i64, most: u32) -> Result<Vec<JobId>, JobError> {
        let text = format!("SELECT id FROM welkin_jobs WHERE ended_ms < $1 ORDER BY ended_ms LIMIT {most}");
        let found: Vec<String> = on!(self, |pool, tasks| {
            sqlx::query_scalar(sqlx::AssertSqlSafe(text))
                .bind(time_ms)
                .fetch_all(pool)
                .await?
        });
        found.iter().map(|id| id.parse()).collect()
    }

    /// Forgets a job: its tasks, what is known of them, and its row. All of it or nothing.
    pub(crate) async fn forget(&self, id: JobId) -> Result<(), JobError> {
        on!(self, |pool, tasks| {
            let mut transaction = pool.begin().await?;
            let text = format!("DELETE FROM {tasks} WHERE {}", of_job(self));
            sqlx::query(sqlx::AssertSqlSafe(text))
                .bind(NAME)
                .bind(prefix(self, id))
                .execute(&mut *transaction)
                .await?;
            // Keys begin with the job's name, and it has no letter that LIKE takes for another.
            sqlx::query("DELETE FROM welkin_begins WHERE task LIKE $1")
                .bind(format!("{id}/%"))
                .execute(&mut *transaction)
                .await?;
            sqlx::query("DELETE FROM welkin_jobs WHERE id = $1")
                .bind(id.to_string())
                .execute(&mut *transaction)
                .await?;
            transaction.commit().await?;
        });
        Ok(())
    }
}
