//! Jobs that are no longer wanted, with all that has come of them.

use crate::{
    JobError, JobId, Jobs,
    queue::{State, now_ms},
};
use std::time::Duration;

/// Jobs that one look removes; the next takes the others.
const AT_ONCE: u32 = 100;

impl Jobs {
    /// Removes a job that has ended: its results, labels and copies of assets in the store, its tasks and its row in
    /// the queue. Its idempotency key is free again. Files go first, so that one that was cut short can be done again.
    ///
    /// # Errors
    /// [`JobError::Unknown`]; [`JobError::Open`] while it has not ended, or a frame of it is still in work; and where
    /// queue or store fail, after which it may be removed again.
    pub async fn remove(&self, id: JobId) -> Result<(), JobError> {
        let state = self.queue.record(id).await?.state;
        if !state.has_ended() || self.queue.is_open(id).await? {
            return Err(JobError::Open {
                job: id.to_string(),
                state: if state.has_ended() { State::Running } else { state }.name(),
            });
        }
        self.store.remove(&id.folder()).await?;
        self.queue.forget(id).await?;
        self.lately.invalidate(&id).await;
        self.ended.invalidate(&id).await;
        Ok(())
    }

    /// Removes jobs that ended longer ago than they are kept, and says how many.
    ///
    /// # Errors
    /// Where queue or store fail; what is left is for the next time.
    pub async fn remove_old(&self, kept: Duration) -> Result<u32, JobError> {
        let before = now_ms().saturating_sub(i64::try_from(kept.as_millis()).unwrap_or(i64::MAX));
        let mut removed = 0;
        for id in self.queue.ended_before(before, AT_ONCE).await? {
            match self.remove(id).await {
                Ok(()) => removed += 1,
                // Another process was first, or a frame that was stopped is still ending.
                Err(JobError::Unknown(_) | JobError::Open { .. }) => {}
                Err(error) => return Err(error),
            }
        }
        Ok(removed)
    }
}
