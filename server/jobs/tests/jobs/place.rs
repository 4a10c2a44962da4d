//! A queue and a store of a test's own, and workers on them.

use crate::fake::Fake;
use futures_util::{StreamExt, TryStreamExt};
use serde_json::{Value, json};
use std::{
    path::PathBuf,
    sync::Arc,
    time::{Duration, Instant},
};
use tempfile::TempDir;
use tokio::{sync::oneshot, task::JoinHandle};
use welkin_jobs::{JobId, JobStatus, Jobs, Queue, State, Store, Worker, WorkerSettings};
use welkin_scene::renderer::Render;

pub(crate) struct Place {
    pub(crate) jobs: Jobs,
    queue: Queue,
    folder: TempDir,
}

impl Place {
    /// SQLite and a folder.
    pub(crate) async fn new() -> Self {
        let folder = TempDir::new().unwrap();
        let queue = format!("sqlite:{}", folder.path().join("queue.db").display());
        let store = Store::folder(&folder.path().join("results")).unwrap();
        let queue = Queue::open(&queue).await.unwrap();
        Self {
            jobs: Jobs::new(queue.clone(), store, None),
            queue,
            folder,
        }
    }

    /// The same place with another store.
    pub(crate) fn with_store(self, store: Store) -> Self {
        Self {
            jobs: Jobs::new(self.queue.clone(), store, None),
            ..self
        }
    }

    /// The same place with assets that scenes may name.
    pub(crate) fn with_assets(self, assets: Arc<welkin_assets::Store>) -> Self {
        let store = Store::folder(&self.results()).unwrap();
        Self {
            jobs: Jobs::new(self.queue.clone(), store, Some(assets)),
            ..self
        }
    }

    /// The queue's address.
    pub(crate) fn queue(&self) -> String {
        format!("sqlite:{}", self.folder.path().join("queue.db").display())
    }

    /// The store's address.
    pub(crate) fn store(&self) -> String {
        format!("file:{}", self.results().display())
    }

    pub(crate) fn results(&self) -> PathBuf {
        self.folder.path().join("results")
    }

    pub(crate) async fn send(&self, document: &Value) -> JobId {
        self.jobs.send(document.to_string(), None).await.unwrap().id
    }

    /// Waits for the end of a job.
    pub(crate) async fn ended(&self, id: JobId) -> JobStatus {
        self.until(id, |status| status.state.has_ended()).await
    }

    /// Waits until a job is so far.
    pub(crate) async fn until(&self, id: JobId, far: impl Fn(&JobStatus) -> bool) -> JobStatus {
        let begun = Instant::now();
        loop {
            let status = self.jobs.status(id).await.unwrap();
            if far(&status) {
                return status;
            }
            assert!(begun.elapsed() < Duration::from_secs(100), "{status:#?}");
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
    }

    /// A file among a job's results.
    pub(crate) async fn file(&self, id: JobId, name: &str) -> Vec<u8> {
        let (_, bytes) = self.jobs.result(id, name).await.unwrap();
        let parts: Vec<_> = bytes
            .map(|part| part.map(|b| b.to_vec()))
            .try_collect()
            .await
            .unwrap();
        parts.concat()
    }

    pub(crate) fn worker(&self, renderer: Arc<Fake>) -> Running {
        Running::start(&self.jobs, renderer)
    }
}

/// A worker on a task of its own.
pub(crate) struct Running {
    stop: Option<oneshot::Sender<()>>,
    handle: JoinHandle<()>,
}

impl Running {
    pub(crate) fn start(jobs: &Jobs, renderer: Arc<dyn Render>) -> Self {
        let settings = WorkerSettings {
            frames: 2,
            heartbeat: Duration::from_secs(1),
            build: "test".into(),
        };
        let (stop, stopped) = oneshot::channel();
        let worker = Worker::new(jobs.clone(), renderer, settings);
        let handle = tokio::spawn(worker.run(async {
            let _ = stopped.await;
        }));
        Self {
            stop: Some(stop),
            handle,
        }
    }

    /// Asks it to go, and waits.
    pub(crate) async fn stop(mut self) {
        self.stop.take().unwrap().send(()).unwrap();
        self.handle.await.unwrap();
    }
}

/// Small frames of the default scene at so many times.
pub(crate) fn list(count: u32) -> Value {
    let scenes: Vec<_> = (0..count).map(|n| json!({"clouds": null, "time_s": n})).collect();
    json!({"frames": {"kind": "list", "scenes": scenes}, "width_px": 8, "height_px": 4})
}

pub(crate) fn assert_done(status: &JobStatus, frames: u32) {
    assert_eq!(status.state, State::Done, "{status:#?}");
    assert_eq!(
        (status.frames, status.counts.done),
        (frames, frames),
        "{status:#?}"
    );
    assert!(status.failures.is_empty(), "{status:#?}");
}
