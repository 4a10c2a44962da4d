//! Seeing a job to its end: when its frames are done, what is made of them is put into the queue, and when that is
//! done, the job is.
//!
//! Any process may do it, and several at once: each step is one change from one state to the next, which one of them
//! makes.

use crate::{
    JobError, Jobs,
    assets::named_in,
    id::Part,
    jobs::{Checked, beside, plan},
    queue::{Record, State, now_ms},
};

/// After this long, who began to queue a job is thought to be gone, milliseconds.
const ABANDONED_MS: i64 = 60_000;

impl Jobs {
    /// Moves jobs on that are ready for it.
    ///
    /// # Errors
    /// Where the queue fails.
    pub(crate) async fn tend(&self) -> Result<(), JobError> {
        for record in self.queue.open_records().await? {
            match record.state {
                State::Queueing => self.take_over(&record).await?,
                State::Running => self.close_frames(&record).await?,
                State::Gathering => self.close(&record).await?,
                State::Done | State::Failed | State::Cancelled => {}
            }
        }
        Ok(())
    }

    /// A job whose sender went in the middle of it.
    async fn take_over(&self, record: &Record) -> Result<(), JobError> {
        if now_ms() - record.created_ms < ABANDONED_MS {
            return Ok(());
        }
        let (document, shelf) = (self.queue.document(record.id).await?, self.assets.clone());
        let checked = beside(move || {
            let plan = plan(&document)?;
            let assets = named_in(&plan, shelf.as_deref())?;
            Ok(Checked { plan, assets })
        });
        match checked.await {
            Ok(checked) => self.complete(record.id, &checked).await,
            // Here are not its assets; who has them will do it.
            Err(error) => {
                tracing::warn!(job = %record.id, %error, "a job that was not queued whole");
                Ok(())
            }
        }
    }

    async fn close_frames(&self, record: &Record) -> Result<(), JobError> {
        if !self.queue.is_open(record.id).await?
            && self
                .queue
                .advance(record.id, State::Running, State::Gathering)
                .await?
        {
            self.queue.push(record.id, &[Part::Gather]).await?;
        }
        Ok(())
    }

    async fn close(&self, record: &Record) -> Result<(), JobError> {
        // Where it is there, this changes nothing; where the one before went between two steps, it is the second.
        self.queue.push(record.id, &[Part::Gather]).await?;
        if self.queue.is_open(record.id).await? {
            return Ok(());
        }
        let failed = !self.queue.dead(record.id, 1).await?.is_empty();
        let end = if failed { State::Failed } else { State::Done };
        if self.queue.advance(record.id, State::Gathering, end).await? {
            self.settle(record.id).await?;
            tracing::info!(job = %record.id, state = end.name(), "a job has ended");
        }
        Ok(())
    }
}
