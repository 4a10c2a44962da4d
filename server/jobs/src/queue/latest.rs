//! The frames of a job that were done last.

use super::{
    NAME, Queue, on,
    tasks::{of_job, prefix},
};
use crate::{
    JobError,
    id::{JobId, Part},
};

impl Queue {
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
