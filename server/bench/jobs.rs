//! Jobs: how much faster two workers are than one, and what queue and store cost beside the rendering.
//!
//! Each worker is a process of its own with one thread of software Vulkan, so that two of them have a core each where
//! there are two. The error of `frames` is the overhead: the time on the clock over what the workers spent rendering,
//! less one.

use super::{
    Account, Case, Limits, Setup, Size, Work,
    stopwatch::{Spent, peak_memory_bytes},
};
use crate::{commands::Failure, settings::Settings};
use serde_json::{Map, json};
use std::{
    path::Path,
    process::{Child, Command, Stdio},
    time::{Duration, Instant},
};
use tempfile::TempDir;
use welkin_jobs::{JobId, Jobs, Queue, Store};

/// A frame of this size takes about a second on one core.
const SIZES: [Size; 1] = [Size::new(640, 360)];
const FRAMES: u32 = 40;
const TASKS: u32 = 10_000;
const LOOK: Duration = Duration::from_millis(20);
/// The overhead that is promised for tasks of a second.
const OVERHEAD: f64 = 0.03;
/// How long 40 frames may take.
const PATIENCE: Duration = Duration::from_secs(1800);

pub(super) struct JobCase;

impl Case for JobCase {
    fn name(&self) -> &'static str {
        "jobs"
    }

    fn rounds(&self) -> u32 {
        1
    }

    fn limits(&self, _setup: &Setup, work: &str) -> Limits {
        Limits {
            error: (work == "frames").then_some(OVERHEAD),
            ..Limits::default()
        }
    }

    fn setups(&self, sizes: Option<&[Size]>) -> Vec<Setup> {
        let setup = |size: &Size, workers: u32| Setup {
            size: *size,
            parameters: Map::from_iter([("workers".to_owned(), json!(workers))]),
        };
        let sizes = sizes.unwrap_or(&SIZES).iter();
        sizes
            .flat_map(|size| [1, 2].map(|workers| setup(size, workers)))
            .collect()
    }

    fn slower(&self, setup: &Setup) -> Option<Setup> {
        let mut alone = setup.clone();
        let workers = alone.parameters.insert("workers".to_owned(), json!(1));
        (workers != Some(json!(1))).then_some(alone)
    }

    fn measure(&self, setup: &Setup, settings: &Settings) -> Result<Account, Failure> {
        let runtime = tokio::runtime::Runtime::new().map_err(Failure::file("starting"))?;
        let device = crate::open_renderer(settings)?.device();
        let works = runtime.block_on(works(setup, settings))?;
        Ok(Account {
            device,
            works,
            peak_memory_bytes: peak_memory_bytes(),
        })
    }
}

async fn works(setup: &Setup, settings: &Settings) -> Result<Vec<Work>, Failure> {
    let folder = TempDir::with_prefix("welkin-bench-").map_err(Failure::file("making a folder"))?;
    let queue = format!("sqlite:{}", folder.path().join("jobs.db").display());
    let jobs = Jobs::new(
        Queue::open(&queue).await?,
        Store::folder(&folder.path().join("results"))?,
        None,
    );
    let begun = Instant::now();
    let many = jobs.send(document(setup.size, TASKS), None).await?.id;
    let sent = work("send-10000", begun.elapsed(), None);
    jobs.cancel(many).await?;

    let count: usize = setup.parameter("workers")?;
    // One frame for each, so that shaders are compiled and all of them are there before the clock runs.
    let warm = jobs.send(document(setup.size, 4), None).await?.id;
    let _workers = (0..count)
        .map(|_| Worker::start(folder.path(), settings))
        .collect::<Result<Vec<_>, _>>()?;
    ended(&jobs, warm).await?;
    let begun = Instant::now();
    let id = jobs.send(document(setup.size, FRAMES), None).await?.id;
    ended(&jobs, id).await?;
    let took = begun.elapsed();
    let rendering = jobs.rendering(id).await?.as_secs_f64();
    #[allow(clippy::cast_precision_loss, reason = "two workers")]
    let overhead = took.as_secs_f64() * count as f64 / rendering - 1.0;
    Ok(vec![sent, work("frames", took, Some(overhead))])
}

fn document(size: Size, frames: u32) -> String {
    let Size { width_px, height_px } = size;
    json!({
        "frames": {"kind": "random", "count": frames, "ranges": [
            {"field": "/sun/position/azimuth_deg", "from": 0, "to": 360},
            {"field": "/clouds/coverage", "from": 0.45, "to": 0.55}]},
        "width_px": width_px, "height_px": height_px,
    })
    .to_string()
}

/// Waits until all frames of a job are done.
async fn ended(jobs: &Jobs, id: JobId) -> Result<(), Failure> {
    let begun = Instant::now();
    loop {
        let status = jobs.status(id).await?;
        if status.counts.failed > 0 {
            return Err(Failure::Bench(format!("frames failed: {:?}", status.failures)));
        }
        if status.counts.done == status.frames {
            return Ok(());
        }
        if begun.elapsed() > PATIENCE {
            return Err(Failure::Bench("the frames took too long".into()));
        }
        tokio::time::sleep(LOOK).await;
    }
}

fn work(name: &str, took: Duration, error: Option<f64>) -> Work {
    Work {
        work: name.to_owned(),
        varied: Map::new(),
        spent: Spent::on_the_clock(took),
        passes: Vec::new(),
        error,
        flip: None,
        fault: None,
    }
}

/// A worker as a process, gone with this.
struct Worker(Child);

impl Worker {
    fn start(folder: &Path, settings: &Settings) -> Result<Self, Failure> {
        let program = std::env::current_exe().map_err(Failure::file("finding this program"))?;
        let mut command = Command::new(program);
        command
            .arg("worker")
            .arg("--queue")
            .arg(format!("sqlite:{}", folder.join("jobs.db").display()))
            .arg("--store")
            .arg(format!("file:{}", folder.join("results").display()))
            .args(["--log", "warn"])
            .env("LP_NUM_THREADS", "1")
            .stdin(Stdio::null())
            .stdout(Stdio::null());
        if let Some(adapter) = &settings.adapter {
            command.args(["--adapter", adapter]);
        }
        command
            .spawn()
            .map(Self)
            .map_err(Failure::file("starting a worker"))
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        // One that has ended already needs no end.
        drop(self.0.kill());
        drop(self.0.wait());
    }
}
