//! A worker: takes tasks from the queue for as long as it is let.

use crate::{
    JobError, JobId, Jobs, Queue, assets,
    frame::{Bench, Loaded, Trouble},
    id::{Part, Task},
    jobs::{beside, plan},
    metrics,
    queue::now_ms,
};
use apalis::{
    layers::WorkerBuilderExt,
    prelude::{
        AbortError, Attempt, BackendExt, BackoffConfig, BoxDynError, Data, WorkerBuilder, WorkerError,
    },
};
use apalis_postgres::PostgresStorage;
use apalis_sqlite::SqliteStorage;
use futures_util::FutureExt;
use moka::future::Cache;
use serde_json::Value;
use std::{
    any::Any,
    future::Future,
    panic::AssertUnwindSafe,
    pin::Pin,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};
use tokio::{
    sync::{RwLock, Semaphore, watch},
    time::sleep,
};
use tracing::Instrument;
use ulid::Ulid;
use welkin_scene::renderer::Render;

/// How often an idle worker looks for tasks: at first, and at most this long after. A file of this machine is looked
/// into for nothing, a server has a thousand workers.
const LOOK: Duration = Duration::from_millis(100);
const LOOK_SELDOM_HERE: Duration = Duration::from_millis(500);
const LOOK_SELDOM: Duration = Duration::from_secs(2);
/// How often a frame in work asks whether its job was stopped.
const CANCEL_LOOK: Duration = Duration::from_millis(500);
/// How often a worker that has ended tasks looks whether their jobs are done; and one that has not.
const TEND: Duration = Duration::from_secs(1);
const TEND_IDLE: u32 = 15;
/// Pause after the queue failed.
const QUEUE_PAUSE: Duration = Duration::from_secs(1);
/// Heartbeats that may be missed before a worker is taken for dead.
const MISSED_HEARTBEATS: usize = 3;
/// Jobs whose documents are kept.
const KNOWN_JOBS: u64 = 8;

/// Ready when batch work may take the device: a server's worker waits for live viewers here.
pub type Calm = Arc<dyn Fn() -> Pin<Box<dyn Future<Output = ()> + Send>> + Send + Sync>;

/// How a worker works.
#[derive(Clone, Debug)]
pub struct WorkerSettings {
    /// Frames in work at once: one is rendered while others are encoded and stored. From 1.
    pub frames: usize,
    /// How often it shows that it lives. Three times this long after the last, its frames go to others.
    pub heartbeat: Duration,
    /// The program's version, as files tell it.
    pub build: String,
}

/// A worker.
pub struct Worker {
    jobs: Jobs,
    renderer: Arc<dyn Render>,
    settings: WorkerSettings,
    calm: Calm,
}

/// What all tasks of a worker share.
struct Shop {
    jobs: Jobs,
    bench: Bench,
    known: Cache<JobId, Arc<Loaded>>,
    /// Shared by parts that are begun for the first time, held whole by one that is begun again.
    alone: RwLock<()>,
    /// A task has ended since jobs were looked at.
    ended: AtomicBool,
}

impl Worker {
    /// A worker that renders when it likes.
    #[must_use]
    pub fn new(jobs: Jobs, renderer: Arc<dyn Render>, settings: WorkerSettings) -> Self {
        Self {
            jobs,
            renderer,
            settings,
            calm: Arc::new(|| Box::pin(async {})),
        }
    }

    /// The same worker, which waits for `calm` before each frame.
    #[must_use]
    pub fn with_calm(self, calm: Calm) -> Self {
        Self { calm, ..self }
    }

    /// Works until `stop`; then gives up the frames in work, which others begin anew.
    pub async fn run(self, stop: impl Future<Output = ()>) {
        metrics::describe();
        let (stopping, is_stopping) = watch::channel(false);
        let shop = Arc::new(Shop {
            bench: Bench {
                renderer: self.renderer,
                store: self.jobs.store.clone(),
                build: self.settings.build.clone(),
                calm: self.calm,
                device: Semaphore::new(1),
                stopping: is_stopping.clone(),
            },
            jobs: self.jobs,
            known: Cache::new(KNOWN_JOBS),
            alone: RwLock::default(),
            ended: AtomicBool::new(true),
        });
        let works = async {
            while !*is_stopping.borrow() {
                // A name that was used before would have to be forgotten first.
                let name = format!("{}-{}", host(), Ulid::generate());
                if let Err(error) = take(&shop, &name, &self.settings).await {
                    tracing::warn!(%error, name, "the queue failed; trying again under another name");
                    sleep(QUEUE_PAUSE).await;
                }
            }
        };
        let stopped = async {
            stop.await;
            stopping.send_replace(true);
        };
        tokio::select! {
            ((), ()) = async { tokio::join!(works, stopped) } => {}
            () = tend(&shop) => {}
        }
    }
}

/// Takes tasks until the worker is to stop or the queue fails.
async fn take(shop: &Arc<Shop>, name: &str, settings: &WorkerSettings) -> Result<(), WorkerError> {
    let mut stopping = shop.bench.stopping.clone();
    let stop = async move {
        // The sender lives as long as the worker.
        let _ = stopping.wait_for(|stop| *stop).await;
        Ok::<_, WorkerError>(())
    };
    macro_rules! run {
        ($storage:ident, $config:path, $pool:expr, $seldom:expr) => {{
            let config = <$config>::default()
                .queue(crate::queue::NAME)
                .batch_size(1)
                .heartbeat_interval(settings.heartbeat)
                .missed_heartbeats(MISSED_HEARTBEATS);
            let backend = $storage::<Task>::new($pool)
                .with_config(config)
                .poll_with_backoff(LOOK, BackoffConfig::new($seldom));
            WorkerBuilder::new(name)
                .backend(backend)
                .data(Arc::clone(shop))
                .concurrency(settings.frames.max(1))
                .build(work)
                .run_until(stop)
                .await
        }};
    }
    match &shop.jobs.queue {
        Queue::Sqlite(pool) => run!(SqliteStorage, apalis_sqlite::Config, pool, LOOK_SELDOM_HERE),
        Queue::Postgres(pool) => run!(PostgresStorage, apalis_postgres::Config, pool, LOOK_SELDOM),
    }
}

/// One task. Its answer is what the queue keeps of it.
async fn work(task: Task, attempt: Attempt, shop: Data<Arc<Shop>>) -> Result<Value, BoxDynError> {
    let attempt = attempt.current();
    let span = tracing::info_span!("task", job = task.job, part = ?task.part, attempt);
    let done = shop.work(&task, attempt).instrument(span).await;
    shop.ended.store(true, Ordering::Relaxed);
    done
}

impl Shop {
    async fn work(&self, task: &Task, attempt: usize) -> Result<Value, BoxDynError> {
        let abort = |reason: String| -> BoxDynError { Box::new(AbortError::new(reason)) };
        if attempt == 1 {
            let waited_ms = u64::try_from(now_ms() - task.queued_ms).unwrap_or_default();
            metrics::waited(Duration::from_millis(waited_ms));
        }
        let id: JobId = task.job.parse().map_err(|e: JobError| abort(e.to_string()))?;
        let done = tokio::select! {
            done = self.tried(id, task.part, attempt) => done,
            () = self.cancelled(id) => Err(Trouble::Cancelled),
            () = self.stopping() => Err(Trouble::Stopping),
        };
        match done {
            Ok(told) => {
                metrics::ended("done");
                Ok(told)
            }
            Err(Trouble::Cancelled) => {
                metrics::ended("cancelled");
                Err(abort(Trouble::Cancelled.to_string()))
            }
            Err(trouble @ Trouble::Stopping) => Err(trouble.into()),
            Err(trouble) => {
                tracing::warn!(job = %id, part = ?task.part, attempt, %trouble, "not done");
                let last = matches!(trouble, Trouble::Lasting(_));
                metrics::ended(if last { "failed" } else { "again" });
                Err(if last {
                    abort(trouble.to_string())
                } else {
                    trouble.into()
                })
            }
        }
    }

    /// A part, as often as its job lets it be begun.
    ///
    /// The first time, parts are in work beside each other, and a death of the worker takes all of them. After that each
    /// is begun alone and counted, so that what ends its workers is found, and is given up without the others.
    async fn tried(&self, id: JobId, part: Part, attempt: usize) -> Result<Value, Trouble> {
        let attempts = self.load(id).await?.plan.request().attempts;
        let (_beside, _alone);
        let begun = if attempt == 1 {
            _beside = self.alone.read().await;
            1
        } else {
            _alone = self.alone.write().await;
            1 + self.jobs.queue.begin(&id.key(part)).await?
        };
        if begun > attempts {
            return Err(Trouble::Lasting(format!(
                "given up after {attempts} attempts, the last of which ended with its worker"
            )));
        }
        let done = AssertUnwindSafe(self.part(id, part)).catch_unwind().await;
        let done = done.unwrap_or_else(|panic| Err(fallen(&*panic)));
        // The queue hears of it only after the next part may have begun: should that end the worker, this one is begun
        // again for no fault of its own.
        if attempt > 1 && done.is_ok() {
            self.jobs.queue.came_through(&id.key(part)).await?;
        }
        match done {
            Err(Trouble::Passing(reason)) if begun == attempts => Err(Trouble::Lasting(reason)),
            done => done,
        }
    }

    async fn part(&self, id: JobId, part: Part) -> Result<Value, Trouble> {
        if self.jobs.queue.is_cancelled(id).await? {
            return Err(Trouble::Cancelled);
        }
        let job = self.load(id).await?;
        match part {
            Part::Frame(number) => self.bench.frame(&job, number).await,
            Part::Gather => self.bench.gather(&job, &self.jobs).await,
        }
    }

    /// The job, from the queue or as known.
    async fn load(&self, id: JobId) -> Result<Arc<Loaded>, Trouble> {
        if let Some(known) = self.known.get(&id).await {
            return Ok(known);
        }
        let document = self.jobs.queue.document(id).await?;
        let checked = beside(move || {
            let plan = plan(&document)?;
            let named = assets::names_in(&plan)?;
            Ok((plan, named))
        });
        let (plan, named) = checked.await?;
        let assets = assets::thaw(&self.jobs.store, id, named).await?;
        let job = Arc::new(Loaded { id, plan, assets });
        self.known.insert(id, Arc::clone(&job)).await;
        Ok(job)
    }

    /// Ready when the job was stopped.
    async fn cancelled(&self, id: JobId) {
        loop {
            sleep(CANCEL_LOOK).await;
            // Where the queue does not answer, the frame goes on.
            if self.jobs.queue.is_cancelled(id).await.unwrap_or_default() {
                return;
            }
        }
    }

    async fn stopping(&self) {
        let mut stopping = self.bench.stopping.clone();
        if stopping.wait_for(|stop| *stop).await.is_err() {
            std::future::pending::<()>().await;
        }
    }
}

/// Sees jobs to their end for as long as it is polled.
async fn tend(shop: &Shop) {
    let mut idle = 0;
    loop {
        sleep(TEND).await;
        idle += 1;
        if shop.ended.swap(false, Ordering::Relaxed) || idle >= TEND_IDLE {
            idle = 0;
            if let Err(error) = shop.jobs.tend().await {
                tracing::warn!(%error, "jobs were not looked at");
                shop.ended.store(true, Ordering::Relaxed);
            }
        }
    }
}

/// A panic is the task's own fault, or its scene's: the worker goes on.
fn fallen(panic: &(dyn Any + Send)) -> Trouble {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    Trouble::Passing(format!("panicked: {}", text.unwrap_or("without a word")))
}

/// The machine's name, as far as one is told.
fn host() -> String {
    let name = std::env::var("HOSTNAME").or_else(|_| std::fs::read_to_string("/etc/hostname"));
    let name: String = name.unwrap_or_default().trim().chars().take(63).collect();
    if name.is_empty() { "worker".into() } else { name }
}
