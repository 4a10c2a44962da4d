//! What the handlers share.

use crate::{
    assets::Shelf,
    calm::Attention,
    error::Error,
    frames::picture::Picture,
    metrics::{self, Counted},
    settings::Settings,
};
use moka::{future::Cache, policy::EvictionPolicy};
use std::{
    sync::Arc,
    time::{Duration, Instant},
};
use tokio::sync::{OwnedSemaphorePermit, Semaphore, watch};
use welkin_encode::EncodeError;
use welkin_jobs::Jobs;
use welkin_scene::renderer::{Frame, FrameOrder, Output, Render};

/// The budget is counted in these.
const BYTES_PER_PERMIT: u64 = 1024;
/// Live previews rendered at once; the others wait in line, so that none starves.
const LIVE_PREVIEWS: usize = 4;
/// Files taken in at once; each is held in memory until it is checked and stored.
const UPLOADS: u64 = 4;
/// Live refinements rendered at once.
const LIVE_REFINEMENTS: usize = 2;

/// The service: a renderer, its limits and what is kept between requests. Clones are the same service.
#[derive(Clone)]
pub struct Service {
    pub(crate) renderer: Arc<dyn Render>,
    pub(crate) settings: Arc<Settings>,
    pub(crate) assets: Shelf,
    pub(crate) jobs: Option<Jobs>,
    pub(crate) attention: Arc<Attention>,
    pub(crate) pictures: Cache<[u8; 32], Arc<Picture>>,
    pub(crate) viewers: Arc<Semaphore>,
    pub(crate) previews: Arc<Semaphore>,
    pub(crate) refinements: Arc<Semaphore>,
    pub(crate) uploads: Arc<Semaphore>,
    memory: Arc<Semaphore>,
    encoders: Arc<Semaphore>,
    stopping: watch::Sender<bool>,
}

/// A rendered frame with its share of the memory budget.
pub(crate) struct Held {
    pub(crate) frame: Arc<Frame>,
    pub(crate) memory: OwnedSemaphorePermit,
    /// From the order to the frame, the queue included.
    pub(crate) took: Duration,
}

impl Service {
    /// A service round a renderer.
    #[must_use]
    pub fn new(renderer: Arc<dyn Render>, settings: Settings) -> Self {
        let pictures = Cache::builder()
            .max_capacity(settings.cache_bytes)
            .weigher(|_, picture: &Arc<Picture>| u32::try_from(picture.bytes.len()).unwrap_or(u32::MAX))
            .eviction_policy(EvictionPolicy::lru())
            .build();
        let semaphore = |permits: u64| {
            Arc::new(Semaphore::new(
                usize::try_from(permits)
                    .unwrap_or(usize::MAX)
                    .min(Semaphore::MAX_PERMITS),
            ))
        };
        Self {
            pictures,
            viewers: semaphore(settings.max_viewers.into()),
            previews: semaphore(LIVE_PREVIEWS as u64),
            refinements: semaphore(LIVE_REFINEMENTS as u64),
            uploads: semaphore(UPLOADS),
            assets: Shelf::default(),
            jobs: None,
            attention: Arc::default(),
            memory: semaphore(settings.frame_memory_bytes / BYTES_PER_PERMIT),
            encoders: semaphore(settings.encoders.max(1).into()),
            stopping: watch::Sender::new(false),
            renderer,
            settings: Arc::new(settings),
        }
    }

    /// Tells live viewers to go and `/readyz` to say no. Frames in work go on.
    pub fn stop(&self) {
        self.stopping.send_replace(true);
    }

    /// True from [`Self::stop`] on, and told to whoever waits for it.
    pub(crate) fn stopping(&self) -> watch::Receiver<bool> {
        self.stopping.subscribe()
    }

    /// Returns when the last live viewer is gone.
    pub(crate) async fn viewers_gone(&self) {
        let _all = self.viewers.acquire_many(self.settings.max_viewers).await;
    }

    /// Orders a frame once its pixels fit in memory. Dropping the future cancels the order.
    pub(crate) async fn render(&self, order: FrameOrder) -> Result<Held, Error> {
        let memory = self.reserve(&order, 1).await?;
        let start = Instant::now();
        let _in_work = (Counted::frame_in_work(), self.attention.order());
        let frame = self.renderer.frame(order).await.map_err(|error| {
            metrics::refused(&error);
            Error::from_render(error, self.renderer.device().max_side_px)
        })?;
        let took = start.elapsed();
        metrics::rendered(&frame, took.as_secs_f64());
        Ok(Held { frame, memory, took })
    }

    /// Runs an encoder beside the asynchronous work, as many at once as settings allow.
    pub(crate) async fn encode(
        &self,
        format: impl serde::Serialize,
        encoder: impl FnOnce() -> Result<Vec<u8>, EncodeError> + Send + 'static,
    ) -> Result<(Vec<u8>, Duration), Error> {
        let place = Arc::clone(&self.encoders)
            .acquire_owned()
            .await
            .map_err(|_| Error::Stopped)?;
        let work = move || {
            let _place = place;
            let start = Instant::now();
            encoder().map(|bytes| (bytes, start.elapsed()))
        };
        let done = tokio::task::spawn_blocking(work).await;
        let (bytes, took) = done.map_err(|e| Error::Internal {
            cause: format!("encoder: {e}"),
        })??;
        metrics::encoded(format, took.as_secs_f64());
        Ok((bytes, took))
    }

    /// The memory of a frame's pixels, so many times over, once there is room.
    pub(crate) async fn reserve(
        &self,
        order: &FrameOrder,
        copies: u64,
    ) -> Result<OwnedSemaphorePermit, Error> {
        let pixels = u64::from(order.width_px) * u64::from(order.height_px);
        let bytes = copies * pixels * bytes_per_pixel(order.output);
        let busy = || Error::Busy {
            what: "frames in work fill the memory they may have".into(),
            retry_after_s: 5,
        };
        let permits = u32::try_from(bytes.div_ceil(BYTES_PER_PERMIT)).map_err(|_| busy())?;
        let turn = Arc::clone(&self.memory).acquire_many_owned(permits);
        let turn = tokio::time::timeout(self.settings.memory_timeout, turn)
            .await
            .map_err(|_| busy())?;
        turn.map_err(|_| Error::Stopped)
    }
}

/// Bytes of a pixel in memory before it is encoded.
pub(crate) const fn bytes_per_pixel(output: Output) -> u64 {
    match output {
        Output::Display => 3,
        Output::Linear => 12,
    }
}
