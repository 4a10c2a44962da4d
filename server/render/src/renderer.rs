//! The renderer's thread: the one owner of the device. Orders reach it over a bounded queue, each with its own reply.

use crate::{
    engine::Engine,
    error::Error,
    frame_job::{FrameJob, TileBudget},
    gpu::AdapterChoice,
    kept_frames::KeptFrames,
    noise_cache::DiskCache,
    probe_job::ProbeJob,
    work::{Answer, Shared, Work},
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
    ProbeAnswer, Quality, Scene,
    frame::MAX_SIDE_PX,
    job::{MAX_PANORAMA_PX, Window},
    renderer::{
        DeviceInfo, Frame, FrameOrder, OnPass, Output, Priority, ProbeOrder, Render, RenderError, Reply,
    },
};

#[cfg(test)]
mod tests;

/// How the renderer is set up.
#[derive(Clone, Debug)]
pub struct RendererSettings {
    /// Which adapter to open.
    pub adapter: AdapterChoice,
    /// Orders that may wait or run at once; more are refused.
    pub queue_places: usize,
    /// Where the noise of clouds is kept between starts. Without it, it is made at each start.
    pub disk_cache: Option<DiskCache>,
}

impl Default for RendererSettings {
    fn default() -> Self {
        Self {
            adapter: AdapterChoice::default(),
            queue_places: 64,
            disk_cache: None,
        }
    }
}

/// The renderer. Clones share one thread and one device; dropping the last one waits until the thread has closed the
/// device.
#[derive(Clone)]
pub struct Renderer {
    thread: Arc<RendererThread>,
    shared: Arc<Shared>,
}

/// The way to the thread.
struct RendererThread {
    /// None once it shall end.
    queue: Option<mpsc::Sender<Work>>,
    handle: Option<thread::JoinHandle<()>>,
}

impl Drop for RendererThread {
    /// A process that ends while the thread still holds the device crashes in the driver's own clean-up.
    fn drop(&mut self) {
        self.queue = None;
        if let Some(handle) = self.handle.take()
            && handle.join().is_err()
        {
            tracing::error!("the renderer's thread panicked");
        }
    }
}

impl Renderer {
    /// Opens the device and starts the thread. The first frame of a clear sky is rendered small, so that the
    /// driver has compiled the shaders of the air before anybody waits.
    ///
    /// # Errors
    /// Where no adapter fits the settings, or the device cannot be opened.
    pub fn start(settings: RendererSettings) -> Result<Self, Error> {
        let (queue, orders) = mpsc::channel();
        let (opened, first) = mpsc::channel();
        let places = settings.queue_places.max(1);
        let handle = thread::Builder::new().name("renderer".into()).spawn(move || {
            let engine = match Engine::open(&settings, 0) {
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
            let worker = Worker::new(settings, engine, Arc::clone(&shared));
            if opened.send(Ok(shared)).is_ok() {
                worker.run(&orders);
            }
        })?;
        let shared = first
            .recv()
            .map_err(|_| Error::Open("the renderer's thread ended at once".to_owned()))??;
        let thread = RendererThread {
            queue: Some(queue),
            handle: Some(handle),
        };
        let renderer = Self {
            thread: Arc::new(thread),
            shared,
        };
        renderer.warm_up();
        Ok(renderer)
    }

    fn warm_up(&self) {
        for output in [Output::Display, Output::Linear] {
            let order = FrameOrder {
                scene: Arc::new(Scene::clear()),
                assets: Arc::default(),
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

    fn queue_frame(&self, order: FrameOrder, seen: Option<OnPass>) -> Reply<Arc<Frame>> {
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
        self.order(|answer| Work::Frame(Box::new(FrameJob::new(order, seen)), answer))
    }

    fn queue_window(&self, order: FrameOrder, window: Window) -> Reply<Arc<Frame>> {
        let beyond =
            |first: u32, size: u32, whole: u32| first.checked_add(size).is_none_or(|end| end > whole);
        let side = |px: u32, most: u32| (1..=most).contains(&px);
        let fits = side(order.width_px, MAX_PANORAMA_PX)
            && side(order.height_px, MAX_PANORAMA_PX)
            && side(window.width_px, MAX_SIDE_PX)
            && side(window.height_px, MAX_SIDE_PX)
            && !beyond(window.x_px, window.width_px, order.width_px)
            && !beyond(window.y_px, window.height_px, order.height_px);
        if fits {
            return self
                .order(|answer| Work::Frame(Box::new(FrameJob::windowed(order, window, None)), answer));
        }
        Box::pin(async move {
            Err(RenderError::Size {
                width_px: order.width_px,
                height_px: order.height_px,
                reason: format!(
                    "a part of a frame must lie in it and have sides of 1 to {MAX_SIDE_PX} pixels, the frame 1 to \
                     {MAX_PANORAMA_PX}"
                ),
            })
        })
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
        let order = work(Answer {
            sender,
            shared: Arc::clone(shared),
        });
        let sent = self
            .thread
            .queue
            .as_ref()
            .is_some_and(|queue| queue.send(order).is_ok());
        Box::pin(async move {
            if !sent {
                return Err(RenderError::Stopped);
            }
            receiver.await.unwrap_or(Err(RenderError::Stopped))
        })
    }
}

impl Render for Renderer {
    fn frame(&self, order: FrameOrder) -> Reply<Arc<Frame>> {
        self.queue_frame(order, None)
    }

    fn refine(&self, order: FrameOrder, seen: OnPass) -> Reply<Arc<Frame>> {
        self.queue_frame(order, Some(seen))
    }

    fn window(&self, order: FrameOrder, window: Window) -> Reply<Arc<Frame>> {
        self.queue_window(order, window)
    }

    fn probe(&self, order: ProbeOrder) -> Reply<ProbeAnswer> {
        self.order(|answer| Work::Probe(Box::new(ProbeJob::new(order)), answer))
    }

    fn device(&self) -> DeviceInfo {
        self.shared
            .device
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone()
    }
}

/// An order on the thread.
struct Task {
    work: Work,
    /// Times that the device failed under it.
    failures: u32,
    /// When its work began.
    begun: Option<Instant>,
}

/// An order is tried again once after the device failed under it; a second failure is its own.
const MOST_FAILURES: u32 = 2;

/// What lives on the thread.
struct Worker {
    settings: RendererSettings,
    /// None after a failure, until the next order opens it anew.
    engine: Option<Engine>,
    shared: Arc<Shared>,
    budget: TileBudget,
    kept: KeptFrames,
}

impl Worker {
    fn new(settings: RendererSettings, engine: Engine, shared: Arc<Shared>) -> Self {
        Self {
            settings,
            engine: Some(engine),
            shared,
            budget: TileBudget::default(),
            kept: KeptFrames::default(),
        }
    }

    /// Serves orders until the last renderer is dropped. One piece of work at a time, then the queue is looked at
    /// again: interactive orders first, each of the same priority in turn.
    fn run(mut self, orders: &mpsc::Receiver<Work>) {
        let mut waiting: VecDeque<Task> = VecDeque::new();
        let task = |work| Task {
            work,
            failures: 0,
            begun: None,
        };
        loop {
            if waiting.is_empty() {
                match orders.recv() {
                    Ok(work) => waiting.push_back(task(work)),
                    Err(mpsc::RecvError) => return,
                }
            }
            waiting.extend(orders.try_iter().map(task));
            let highest = waiting.iter().map(|t| t.work.priority()).max();
            let Some(at) = waiting.iter().position(|t| Some(t.work.priority()) == highest) else {
                continue;
            };
            let Some(task) = waiting.remove(at) else { continue };
            if task.work.abandoned() {
                task.work.refuse(RenderError::Stopped);
            } else if let Some(unfinished) = self.step(task) {
                waiting.push_back(unfinished);
            }
        }
    }

    /// One piece of work; the order again if there is more to do.
    fn step(&mut self, mut task: Task) -> Option<Task> {
        let begun = *task.begun.get_or_insert_with(Instant::now);
        match self.advance(task.work) {
            Ok(Some(work)) => return Some(Task { work, ..task }),
            Ok(None) => self.shared.learn(begun.elapsed().as_secs_f64() * 1e3),
            Err((work, error)) => {
                tracing::error!(%error, "the device failed; it is opened anew");
                self.engine = None;
                task.failures += 1;
                if task.failures < MOST_FAILURES {
                    return Some(Task { work, ..task });
                }
                work.refuse(RenderError::Device(error.to_string()));
            }
        }
        None
    }

    /// The order again if there is more to do; the order and the reason if the device failed.
    fn advance(&mut self, work: Work) -> Result<Option<Work>, (Work, Error)> {
        let engine = match open(&mut self.engine, &self.settings, &self.shared) {
            Ok(engine) => engine,
            Err(error) => return Err((work, error)),
        };
        match work {
            Work::Frame(mut job, answer) => {
                if let Some(frame) = self.kept.find(job.order()).filter(|_| job.is_whole()) {
                    answer.send(Ok(frame));
                    return Ok(None);
                }
                match job.step(engine, &mut self.budget) {
                    Ok(None) => return Ok(Some(Work::Frame(job, answer))),
                    Ok(Some(frame)) => {
                        if job.is_whole() {
                            self.kept.keep(job.order().clone(), &frame);
                        }
                        answer.send(Ok(frame));
                    }
                    Err(error) => return Err((Work::Frame(job, answer), error)),
                }
            }
            Work::Probe(mut job, answer) => match job.step(engine) {
                Ok(None) => return Ok(Some(Work::Probe(job, answer))),
                Ok(Some(result)) => answer.send(Ok(result)),
                Err(error) => return Err((Work::Probe(job, answer), error)),
            },
        }
        Ok(None)
    }
}

/// The engine, opened anew where it was lost.
fn open<'a>(
    engine: &'a mut Option<Engine>,
    settings: &RendererSettings,
    shared: &Shared,
) -> Result<&'a mut Engine, Error> {
    let open = match engine.take() {
        Some(open) => open,
        None => {
            let mut device = shared.device.lock().unwrap_or_else(PoisonError::into_inner);
            device.recoveries += 1;
            Engine::open(settings, device.recoveries)?
        }
    };
    Ok(engine.insert(open))
}
