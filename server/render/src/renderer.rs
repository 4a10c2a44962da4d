//! The renderer's thread: the one owner of the device. Orders reach it over a bounded queue, each with its own reply.

use crate::{
    engine::Engine,
    error::Error,
    frame_job::{FrameJob, TileBudget},
    gpu::AdapterChoice,
    kept_frames::KeptFrames,
    probe_job,
};
use futures_channel::oneshot;
use std::{
    collections::VecDeque,
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicUsize, Ordering},
        mpsc,
    },
    thread,
    time::Instant,
};
use welkin_scene::{
    ProbeAnswer, ProbeRequest, Quality, Scene,
    frame::MAX_SIDE_PX,
    renderer::{DeviceInfo, Frame, FrameOrder, Output, Priority, Render, RenderError, Reply},
};

/// How the renderer is set up.
#[derive(Clone, Debug)]
pub struct RendererSettings {
    /// Which adapter to open.
    pub adapter: AdapterChoice,
    /// Orders that may wait or run at once; more are refused.
    pub queue_places: usize,
}

impl Default for RendererSettings {
    fn default() -> Self {
        Self {
            adapter: AdapterChoice::default(),
            queue_places: 64,
        }
    }
}

/// The renderer. Clones share one thread and one device; the thread ends with the last clone.
#[derive(Clone)]
pub struct Renderer {
    queue: mpsc::Sender<Work>,
    shared: Arc<Shared>,
}

struct Shared {
    places: usize,
    taken: AtomicUsize,
    device: Mutex<DeviceInfo>,
    /// Running mean of the time of one order, milliseconds.
    mean_ms: Mutex<f64>,
}

enum Work {
    Frame(FrameJob, Answer<Arc<Frame>>),
    Probe(ProbeRequest, Answer<ProbeAnswer>),
}

/// Where an answer goes, and the order's place in the queue, given back when this is dropped.
struct Answer<T> {
    sender: oneshot::Sender<Result<T, RenderError>>,
    shared: Arc<Shared>,
}

impl<T> Answer<T> {
    fn send(self, result: Result<T, RenderError>) {
        let Self { sender, shared } = self;
        shared.taken.fetch_sub(1, Ordering::AcqRel);
        // An asker who has gone needs no answer.
        drop(sender.send(result));
    }
}

impl Work {
    const fn priority(&self) -> Priority {
        match self {
            Self::Frame(job, _) => job.order().priority,
            Self::Probe(..) => Priority::Interactive,
        }
    }

    fn abandoned(&self) -> bool {
        match self {
            Self::Frame(_, answer) => answer.sender.is_canceled(),
            Self::Probe(_, answer) => answer.sender.is_canceled(),
        }
    }

    fn refuse(self, error: RenderError) {
        match self {
            Self::Frame(_, answer) => answer.send(Err(error)),
            Self::Probe(_, answer) => answer.send(Err(error)),
        }
    }
}

impl Renderer {
    /// Opens the device and starts the thread. The first frame of the default scene is rendered small, so that the
    /// driver has compiled every shader before anybody waits.
    ///
    /// # Errors
    /// Where no adapter fits the settings, or the device cannot be opened.
    pub fn start(settings: RendererSettings) -> Result<Self, Error> {
        let (queue, orders) = mpsc::channel();
        let (opened, first) = mpsc::channel();
        let places = settings.queue_places.max(1);
        thread::Builder::new().name("renderer".into()).spawn(move || {
            let engine = match Engine::open(&settings.adapter) {
                Ok(engine) => engine,
                Err(error) => return drop(opened.send(Err(error))),
            };
            let device = Mutex::new(engine.gpu.info.clone());
            let shared = Shared {
                places,
                taken: AtomicUsize::new(0),
                device,
                mean_ms: Mutex::new(100.0),
            };
            let shared = Arc::new(shared);
            let worker = Worker::new(settings.adapter, engine, Arc::clone(&shared));
            if opened.send(Ok(shared)).is_ok() {
                worker.run(&orders);
            }
        })?;
        let shared = first
            .recv()
            .map_err(|_| Error::Open("the renderer's thread ended at once".to_owned()))??;
        let renderer = Self { queue, shared };
        renderer.warm_up();
        Ok(renderer)
    }

    fn warm_up(&self) {
        for output in [Output::Display, Output::Linear] {
            let order = FrameOrder {
                scene: Arc::new(Scene::default()),
                width_px: 16,
                height_px: 16,
                quality: Quality::Preview,
                output,
                priority: Priority::Interactive,
            };
            if let Err(error) = pollster::block_on(self.frame(order)) {
                tracing::warn!(%error, "the first frame failed");
            }
        }
    }

    fn order<T: Send + 'static>(&self, work: impl FnOnce(Answer<T>) -> Work) -> Reply<T> {
        let shared = &self.shared;
        if shared.taken.fetch_add(1, Ordering::AcqRel) >= shared.places {
            shared.taken.fetch_sub(1, Ordering::AcqRel);
            let error = RenderError::Busy {
                retry_after_s: shared.retry_after_s(),
            };
            return Box::pin(async move { Err(error) });
        }
        let (sender, receiver) = oneshot::channel();
        let sent = self
            .queue
            .send(work(Answer {
                sender,
                shared: Arc::clone(shared),
            }))
            .is_ok();
        Box::pin(async move {
            if !sent {
                return Err(RenderError::Stopped);
            }
            receiver.await.unwrap_or(Err(RenderError::Stopped))
        })
    }
}

impl Shared {
    /// When the orders that wait will be done, seconds.
    fn retry_after_s(&self) -> u32 {
        let mean_ms = *self.mean_ms.lock().unwrap_or_else(PoisonError::into_inner);
        let waiting = u32::try_from(self.taken.load(Ordering::Acquire)).unwrap_or(u32::MAX);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to 1..60 first"
        )]
        let seconds = (f64::from(waiting) * mean_ms * 1e-3).clamp(1.0, 60.0).ceil() as u32;
        seconds
    }
}

impl Render for Renderer {
    fn frame(&self, order: FrameOrder) -> Reply<Arc<Frame>> {
        let side = |px: u32| (1..=MAX_SIDE_PX).contains(&px);
        let (width_px, height_px) = (order.width_px, order.height_px);
        if !side(width_px) || !side(height_px) {
            let reason = format!("each side must be 1 to {MAX_SIDE_PX} pixels");
            return Box::pin(async move {
                Err(RenderError::Size {
                    width_px,
                    height_px,
                    reason,
                })
            });
        }
        self.order(|answer| Work::Frame(FrameJob::new(order), answer))
    }

    fn probe(&self, request: ProbeRequest) -> Reply<ProbeAnswer> {
        self.order(|answer| Work::Probe(request, answer))
    }

    fn device(&self) -> DeviceInfo {
        self.shared
            .device
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone()
    }
}

/// What lives on the thread.
struct Worker {
    adapter: AdapterChoice,
    engine: Option<Engine>,
    shared: Arc<Shared>,
    budget: TileBudget,
    kept: KeptFrames,
}

impl Worker {
    fn new(adapter: AdapterChoice, engine: Engine, shared: Arc<Shared>) -> Self {
        Self {
            adapter,
            engine: Some(engine),
            shared,
            budget: TileBudget::default(),
            kept: KeptFrames::default(),
        }
    }

    /// Serves orders until the last renderer is dropped. One piece of work at a time, then the queue is looked at
    /// again: interactive orders first, each of the same priority in turn.
    fn run(mut self, orders: &mpsc::Receiver<Work>) {
        let mut waiting: VecDeque<Work> = VecDeque::new();
        loop {
            if waiting.is_empty() {
                match orders.recv() {
                    Ok(work) => waiting.push_back(work),
                    Err(mpsc::RecvError) => return,
                }
            }
            waiting.extend(orders.try_iter());
            let highest = waiting.iter().map(Work::priority).max();
            let Some(at) = waiting.iter().position(|w| Some(w.priority()) == highest) else {
                continue;
            };
            let Some(work) = waiting.remove(at) else { continue };
            if work.abandoned() {
                work.refuse(RenderError::Stopped);
            } else if let Some(unfinished) = self.step(work) {
                waiting.push_back(unfinished);
            }
        }
    }

    /// One piece of work; the order again if there is more to do.
    fn step(&mut self, work: Work) -> Option<Work> {
        let begun = Instant::now();
        match work {
            Work::Frame(mut job, answer) => {
                if let Some(frame) = self.kept.find(job.order()) {
                    answer.send(Ok(frame));
                    return None;
                }
                let budget = &mut self.budget;
                match retried(&mut self.engine, &self.adapter, &self.shared, |engine| {
                    job.step(engine, budget)
                        .inspect_err(|_| job = FrameJob::new(job.order().clone()))
                }) {
                    Ok(None) => return Some(Work::Frame(job, answer)),
                    Ok(Some(frame)) => {
                        self.kept.keep(job.order().clone(), &frame);
                        answer.send(Ok(frame));
                    }
                    Err(error) => answer.send(Err(error)),
                }
            }
            Work::Probe(request, answer) => {
                let result = retried(&mut self.engine, &self.adapter, &self.shared, |engine| {
                    probe_job::answer(engine, &request)
                });
                answer.send(result);
            }
        }
        let mut mean_ms = self.shared.mean_ms.lock().unwrap_or_else(PoisonError::into_inner);
        *mean_ms += 0.1 * (begun.elapsed().as_secs_f64() * 1e3 - *mean_ms);
        None
    }
}

/// Runs `work`; after a failure opens the device anew and runs it once more.
fn retried<T>(
    engine: &mut Option<Engine>,
    adapter: &AdapterChoice,
    shared: &Shared,
    mut work: impl FnMut(&mut Engine) -> Result<T, Error>,
) -> Result<T, RenderError> {
    let mut last = String::new();
    for _ in 0..2 {
        if engine.is_none() {
            match Engine::open(adapter) {
                Ok(opened) => {
                    *engine = Some(opened);
                    let mut device = shared.device.lock().unwrap_or_else(PoisonError::into_inner);
                    device.recoveries += 1;
                }
                Err(error) => {
                    last = error.to_string();
                    continue;
                }
            }
        }
        let Some(open) = engine.as_mut() else { continue };
        match work(open) {
            Ok(done) => return Ok(done),
            Err(error) => {
                tracing::error!(%error, "the device failed; it is opened anew");
                last = error.to_string();
                *engine = None;
            }
        }
    }
    Err(RenderError::Device(last))
}
