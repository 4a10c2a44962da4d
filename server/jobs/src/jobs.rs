//! What one may do with jobs: send, look, stop, and fetch what has come of them.

use crate::{
    JobError, JobId, Queue, Store, assets,
    id::Part,
    limits::{Limits, Weight, weigh},
    metrics,
    queue::{Added, New, State, Summary},
    status::{FileInfo, JobStatus},
    store::ByteStream,
};
use moka::future::Cache;
use std::{collections::BTreeSet, sync::Arc, time::Duration};
use welkin_assets::{Kind, Name};
use welkin_encode::file_extension;
use welkin_scene::{JobPlan, JobRequest};

/// Jobs in a queue and their results in a store. Clones are the same.
#[derive(Clone)]
pub struct Jobs {
    pub(crate) queue: Queue,
    pub(crate) store: Store,
    pub(crate) assets: Option<Arc<welkin_assets::Store>>,
    limits: Limits,
    /// What was found a moment ago, so that many who watch cost no more than one; and what will not change any more.
    pub(crate) lately: Cache<JobId, JobStatus>,
    pub(crate) ended: Cache<JobId, JobStatus>,
}

/// A job that was sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sent {
    /// Its name.
    pub id: JobId,
    /// False where the idempotency key stood for it already.
    pub is_new: bool,
}

/// A frame that is done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rendered {
    /// The worker that rendered it.
    pub worker: String,
    /// When its file was in the store, milliseconds since 1970.
    pub ended_ms: i64,
    /// How long it was rendered.
    pub rendering: Duration,
}

/// A request and all that its frames need from elsewhere, checked.
pub(crate) struct Checked {
    pub(crate) plan: JobPlan,
    /// Names of assets that its scenes refer to.
    pub(crate) assets: BTreeSet<(Kind, Name)>,
}

/// Statuses that are kept.
const KNOWN: u64 = 1000;
/// How long a status is news.
const LATELY: Duration = Duration::from_millis(250);
/// How long the status of a job that has ended is: another process may remove it.
const FOR_GOOD: Duration = Duration::from_secs(60);

impl Jobs {
    /// Jobs of a queue and a store. Scenes take their assets from `assets`; what a job names is copied into the store
    /// when the job is sent, so that workers anywhere have it, and it stays as it was.
    #[must_use]
    pub fn new(queue: Queue, store: Store, assets: Option<Arc<welkin_assets::Store>>) -> Self {
        Self {
            queue,
            store,
            assets,
            limits: Limits::default(),
            lately: Cache::builder().max_capacity(KNOWN).time_to_live(LATELY).build(),
            ended: Cache::builder()
                .max_capacity(KNOWN)
                .time_to_live(FOR_GOOD)
                .build(),
        }
    }

    /// The same jobs, of which no more are taken than this.
    #[must_use]
    pub fn with_limits(self, limits: Limits) -> Self {
        Self { limits, ..self }
    }

    /// Checks a whole job and puts it into the queue. A key stands for one document: sent again, it is the same job.
    ///
    /// # Errors
    /// [`JobError::Scene`] where any frame is not a scene, [`JobError::Assets`] where one names what is not there,
    /// [`JobError::KeyTaken`]; [`JobError::Full`]; [`JobError::Queue`] and [`JobError::Store`], after which it may be sent again.
    pub async fn send(&self, document: String, key: Option<&str>) -> Result<Sent, JobError> {
        let shelf = self.assets.clone();
        let checked = beside(move || {
            let plan = JobPlan::new(JobRequest::from_json(&document)?)?;
            let assets = assets::named_in(&plan, shelf.as_deref())?;
            Ok(Checked { plan, assets })
        });
        let checked = checked.await?;
        let request = checked.plan.request();
        let document = serde_json::to_string(request).map_err(|e| JobError::Damaged(e.to_string()))?;
        let weight = self.weight(&checked, &document).await?;
        self.limits.check(&checked.plan, &weight)?;
        let id = JobId::new();
        let new = New {
            id,
            key,
            document: &document,
            summary: &Summary {
                name: request.name.clone(),
                kind: request.frames.kind().into(),
                format: request.format,
            },
            frames: checked.plan.count(),
            bytes: weight.all,
        };
        match self.queue.add(&new, self.limits.store_bytes).await? {
            Added::New => {}
            Added::Full => {
                return Err(JobError::Full {
                    bytes: weight.all,
                    taken: self.queue.weight().await?,
                    most: self.limits.store_bytes,
                });
            }
            Added::Known(known) => {
                if self.queue.document(known).await? != document {
                    return Err(JobError::KeyTaken {
                        key: key.unwrap_or_default().to_owned(),
                        job: known.to_string(),
                    });
                }
                // Whoever sent it first may have gone in the middle of it.
                if self.queue.record(known).await?.state == State::Queueing {
                    self.complete(known, &checked).await?;
                }
                return Ok(Sent {
                    id: known,
                    is_new: false,
                });
            }
        }
        self.complete(id, &checked).await?;
        Ok(Sent { id, is_new: true })
    }

    /// What a job may take.
    pub(crate) async fn weight(&self, checked: &Checked, document: &str) -> Result<Weight, JobError> {
        let mut assets = 0;
        for (kind, name) in &checked.assets {
            let (shelf, kind, name) = (self.assets.clone(), *kind, name.clone());
            let found = beside(move || shelf.map_or(Ok(None), |shelf| Ok(shelf.asset(kind, &name)?)));
            assets += found.await?.map_or(0, |asset| asset.bytes);
        }
        weigh(&checked.plan, document, assets)
    }

    /// Says what a job that has ended takes, now that it is known: frames that are being stored right now count whole.
    pub(crate) async fn settle(&self, id: JobId) -> Result<(), JobError> {
        let document = self.queue.document(id).await?;
        let plan = plan(&document)?;
        let weight = weigh(&plan, &document, 0)?;
        let frames = self.queue.stored_bytes(id).await?;
        let files: u64 = self.files(id).await?.iter().map(|file| file.bytes).sum();
        let assets: u64 = self
            .store
            .list(&id.assets())
            .await?
            .iter()
            .map(|(_, bytes)| bytes)
            .sum();
        let running = u64::from(self.queue.counts(id).await?.running);
        let all = weight.kept + assets + frames + files + running * weight.frame;
        self.queue.weigh(id, all).await
    }

    /// Puts assets into the store and tasks into the queue, as far as they are not there.
    pub(crate) async fn complete(&self, id: JobId, checked: &Checked) -> Result<(), JobError> {
        for (kind, name) in &checked.assets {
            assets::freeze(self, id, *kind, name).await?;
        }
        let parts: Vec<_> = (0..checked.plan.count()).map(Part::Frame).collect();
        self.queue.push(id, &parts).await?;
        self.queue.advance(id, State::Queueing, State::Running).await?;
        Ok(())
    }

    /// How a job is doing.
    ///
    /// # Errors
    /// [`JobError::Unknown`], and where queue or store fail.
    pub async fn status(&self, id: JobId) -> Result<JobStatus, JobError> {
        self.known_status(id, None).await
    }

    /// How jobs are doing: `most` of those sent before `before`, the last first.
    ///
    /// # Errors
    /// Where queue or store fail.
    pub async fn list(&self, before: Option<JobId>, most: u32) -> Result<Vec<JobStatus>, JobError> {
        let mut all = Vec::new();
        for record in self.queue.records_before(before, most).await? {
            all.push(self.known_status(record.id, Some(record)).await?);
        }
        Ok(all)
    }

    /// Stops a job: what waits is not begun, what runs ends at the next tile. What is done stays. A job that has ended
    /// is left as it is.
    ///
    /// # Errors
    /// [`JobError::Unknown`], and where the queue fails.
    pub async fn cancel(&self, id: JobId) -> Result<(), JobError> {
        self.queue.record(id).await?;
        if self.queue.cancel(id).await? {
            self.queue.withdraw(id).await?;
            self.settle(id).await?;
        }
        self.lately.invalidate(&id).await;
        Ok(())
    }

    /// A result by its name: a frame's number, or the name of a file that is made of all of them. Gives also the file's
    /// own name and its length in bytes.
    ///
    /// # Errors
    /// [`JobError::Unknown`], [`JobError::NoResult`], and where queue or store fail.
    pub async fn result(&self, id: JobId, name: &str) -> Result<(FileInfo, ByteStream), JobError> {
        let record = self.queue.record(id).await?;
        let none = || JobError::NoResult {
            job: id.to_string(),
            name: name.chars().take(80).collect(),
        };
        let (path, file) = if let Ok(number) = name.parse::<u32>() {
            let extension = file_extension(record.summary.of_frames());
            (id.frame(number, extension), format!("{number:06}.{extension}"))
        } else {
            // Only what jobs make: the store may hold other things.
            let files = self.files(id).await?;
            let file = files
                .into_iter()
                .find(|file| file.name == name)
                .ok_or_else(none)?;
            (id.whole(&file.name), file.name)
        };
        let (bytes, stream) = self.store.stream(&path).await?.ok_or_else(none)?;
        Ok((FileInfo { name: file, bytes }, stream))
    }

    /// Who rendered the frames of a job that are done, when, and how long that took, in the frames' order.
    ///
    /// # Errors
    /// Where the queue fails.
    pub async fn rendering(&self, id: JobId) -> Result<Vec<Rendered>, JobError> {
        let settled = self.queue.settled(id).await?;
        let rendered = settled.into_iter().map(|frame| Rendered {
            rendering: Duration::from_secs_f64(frame.told["render_ms"].as_f64().unwrap_or_default() / 1e3),
            ended_ms: frame.told["ended_ms"].as_i64().unwrap_or_default(),
            worker: frame.worker,
        });
        Ok(rendered.collect())
    }

    /// Files that were made of all frames of a job.
    pub(crate) async fn files(&self, id: JobId) -> Result<Vec<FileInfo>, JobError> {
        let folder = id.whole("");
        let found = self.store.list_folder(&folder).await?;
        Ok(found
            .into_iter()
            .filter_map(|(path, bytes)| {
                let name = path.filename()?.to_owned();
                Some(FileInfo { name, bytes })
            })
            .collect())
    }

    /// Tells the recorder of metrics how many tasks of all jobs wait and run, how many workers were heard of lately, and
    /// what all jobs take.
    ///
    /// # Errors
    /// Where the queue fails.
    pub async fn tell_load(&self, heartbeat_s: u32) -> Result<(), JobError> {
        metrics::describe();
        let (waiting, running) = self.queue.depth().await?;
        metrics::load(&metrics::Load {
            waiting,
            running,
            workers: self.queue.workers(3 * i64::from(heartbeat_s)).await?,
            bytes: self.queue.weight().await?,
        });
        Ok(())
    }
}

/// The plan of a document that the queue holds.
pub(crate) fn plan(document: &str) -> Result<JobPlan, JobError> {
    let request: JobRequest = serde_json::from_str(document).map_err(|e| JobError::Damaged(e.to_string()))?;
    Ok(JobPlan::new(request)?)
}

/// Runs what takes long beside the asynchronous work.
pub(crate) async fn beside<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, JobError> + Send + 'static,
) -> Result<T, JobError> {
    let done = tokio::task::spawn_blocking(work).await;
    done.map_err(|e| JobError::Damaged(format!("a thread ended early: {e}")))?
}
