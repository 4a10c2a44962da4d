//! Jobs: how much faster two workers are than one, and what queue and store cost beside the rendering.
//!
//! Each worker is a process of its own with one thread of software Vulkan, so that two of them have a core each where
//! there are two. The error of `frames` is the overhead: the time on the clock over what the workers spent rendering,
//! less one, each worker from the end of its first frame to the end of its last. `alone` is the same frames in as many
//! processes that know neither queue nor store: the machine's own ceiling.

use super::{
    Account, Case, Limits, Setup, Size, Work, process,
    stopwatch::{Spent, Stopwatch, peak_memory_bytes},
    viewer::Viewer,
};
use crate::{commands::Failure, settings::Settings};
use serde_json::{Map, json};
use std::{
    collections::BTreeMap,
    path::Path,
    process::{Child, Command, Stdio},
    sync::Arc,
    thread,
    time::{Duration, Instant},
};
use tempfile::TempDir;
use welkin_jobs::{JobId, Jobs, Queue, Rendered, Store};
use welkin_scene::{JobPlan, JobRequest};

/// A frame of this size takes about a second on one core.
const SIZES: [Size; 1] = [Size::new(640, 360)];
const FRAMES: u32 = 40;
/// Seeds of the frames that are measured, and of those before them: other scenes, or they would be known already.
const MEASURED: u32 = 0;
const BEFORE: u32 = 1;
/// A setup with this parameter is one of the processes of `alone`, and this the first of its frames.
const FIRST: &str = "first";
/// One software thread, so that two processes have a core each.
const ONE_THREAD: (&str, &str) = ("LP_NUM_THREADS", "1");
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
        if setup.parameters.contains_key(FIRST) {
            return share(setup, settings);
        }
        let runtime = tokio::runtime::Runtime::new().map_err(Failure::file("starting"))?;
        let device = crate::open_renderer(settings)?.device();
        let mut works = runtime.block_on(works(setup, settings))?;
        works.insert(1, alone(self, setup, settings)?);
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
    let many = jobs.send(document(setup.size, TASKS, BEFORE), None).await?.id;
    let sent = work("send-10000", begun.elapsed(), None);
    jobs.cancel(many).await?;

    let count: usize = setup.parameter("workers")?;
    // Some frames for each, so that shaders are compiled and all of them are there before the clock runs.
    let warm = jobs.send(document(setup.size, 4, BEFORE), None).await?.id;
    let _workers = (0..count)
        .map(|_| Worker::start(folder.path(), settings))
        .collect::<Result<Vec<_>, _>>()?;
    ended(&jobs, warm).await?;
    let begun = Instant::now();
    let id = jobs.send(document(setup.size, FRAMES, MEASURED), None).await?.id;
    ended(&jobs, id).await?;
    let took = begun.elapsed();
    let overhead = overhead(&jobs.rendering(id).await?);
    Ok(vec![sent, work("frames", took, overhead)])
}

/// How much longer than they rendered the workers took for all frames but their first; none where each had but one.
fn overhead(frames: &[Rendered]) -> Option<f64> {
    let mut workers: BTreeMap<&str, Vec<&Rendered>> = BTreeMap::new();
    for frame in frames {
        workers.entry(&frame.worker).or_default().push(frame);
    }
    let (mut took, mut rendering) = (Duration::ZERO, Duration::ZERO);
    for own in workers.values_mut() {
        own.sort_by_key(|frame| frame.ended_ms);
        if let [first, .., last] = own.as_slice() {
            took += Duration::from_millis((last.ended_ms - first.ended_ms).unsigned_abs());
            rendering += own[1..].iter().map(|frame| frame.rendering).sum::<Duration>();
        }
    }
    (!rendering.is_zero()).then(|| took.as_secs_f64() / rendering.as_secs_f64() - 1.0)
}

/// The frames by themselves, in as many processes as there would be workers: the time of the last that is done.
fn alone(case: &JobCase, setup: &Setup, settings: &Settings) -> Result<Work, Failure> {
    let count: u32 = setup.parameter("workers")?;
    let start = |first| {
        let mut own = setup.clone();
        own.parameters.insert(FIRST.to_owned(), json!(first));
        process::start(case, &own, settings, None, &[ONE_THREAD])
    };
    let runs = thread::scope(|scope| {
        let threads: Vec<_> = (0..count)
            .map(|first| scope.spawn(move || start(first)))
            .collect();
        let ended = || Failure::Bench("a thread ended early".into());
        let runs = threads.into_iter().map(|one| one.join().map_err(|_| ended())?);
        runs.collect::<Result<Vec<_>, _>>()
    })?;
    let walls_ms = runs
        .iter()
        .flat_map(|run| &run.works)
        .map(|work| work.spent.wall_ms);
    let took = Duration::from_secs_f64(walls_ms.fold(0.0, f64::max) / 1e3);
    Ok(work("alone", took, None))
}

/// One process of `alone`: every frame of which the number, divided by the workers, leaves this one's.
fn share(setup: &Setup, settings: &Settings) -> Result<Account, Failure> {
    let (first, workers): (u32, usize) = (setup.parameter(FIRST)?, setup.parameter("workers")?);
    let plan = |seed| JobPlan::new(JobRequest::from_json(&document(setup.size, FRAMES, seed))?);
    let (before, measured) = (plan(BEFORE)?, plan(MEASURED)?);
    let renderer = crate::open_renderer(settings)?;
    let viewer = Viewer {
        renderer: &*renderer,
        size: setup.size,
        quality: measured.request().quality,
        assets: Arc::default(),
    };
    for number in [0, 1] {
        viewer.see("before", &before.frame(number)?.scene)?;
    }
    let watch = Stopwatch::start();
    for number in (first..FRAMES).step_by(workers.max(1)) {
        viewer.see("alone", &measured.frame(number)?.scene)?;
    }
    let spent = watch.stop();
    let took = Duration::from_secs_f64(spent.wall_ms / 1e3);
    Ok(Account {
        device: renderer.device(),
        works: vec![work("alone", took, None)],
        peak_memory_bytes: peak_memory_bytes(),
    })
}

fn document(size: Size, frames: u32, seed: u32) -> String {
    let Size { width_px, height_px } = size;
    json!({
        "frames": {"kind": "random", "count": frames, "seed": seed, "ranges": [
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
            .envs([ONE_THREAD])
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;

    #[test]
    fn the_overhead_is_what_a_worker_took_over_what_it_rendered() {
        let frame = |worker: &str, ended_ms, rendering_ms| Rendered {
            worker: worker.to_owned(),
            ended_ms,
            rendering: Duration::from_millis(rendering_ms),
        };
        // In any order; the first of each worker only says when it began: 2200 ms for 2000 ms of rendering.
        let frames = [
            frame("a", 3100, 500),
            frame("b", 2000, 700),
            frame("a", 2000, 900),
            frame("b", 3100, 1000),
            frame("a", 2550, 500),
        ];
        // To the rounding of one division.
        assert!((overhead(&frames).unwrap() - 0.1).abs() < 1e-9);
        assert_eq!(overhead(&frames[..2]), None);
    }
}
