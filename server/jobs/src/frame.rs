//! One frame of a job: rendered, encoded, put into the store.

use crate::{
    JobError, JobId, Store, assets::Thawed, jobs::beside, metrics, queue::now_ms, store::is_lasting,
    worker::Calm,
};
use bytes::Bytes;
use serde_json::{Value, json};
use std::{
    future::Future,
    sync::Arc,
    time::{Duration, Instant},
};
use tokio::{
    sync::{Semaphore, watch},
    time::{sleep, timeout},
};
use tracing::{Instrument, info_span};
use welkin_encode::{Options, encode, file_extension, output_for};
use welkin_scene::{
    JobPlan, ProbeRequest, SceneAssets,
    job::PlannedFrame,
    renderer::{Frame, FrameOrder, Priority, ProbeOrder, Render, RenderError, Reply},
};

/// Pauses between attempts at the same thing: 26 s in all, which outlasts the restart of a store.
const PAUSES_MS: [u64; 8] = [250, 500, 1000, 2000, 4000, 6000, 6000, 6000];
/// How long a full render queue is waited for at a time.
const BUSY: Duration = Duration::from_secs(1);

/// Why a frame was not made.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Trouble {
    /// The job was stopped.
    #[error("cancelled")]
    Cancelled,
    /// The worker is going.
    #[error("the worker was stopped")]
    Stopping,
    /// Another attempt would end the same.
    #[error("{0}")]
    Lasting(String),
    /// Another attempt may do better.
    #[error("{0}")]
    Passing(String),
}

impl From<JobError> for Trouble {
    fn from(error: JobError) -> Self {
        match error {
            JobError::Queue(_) => Self::Passing(error.to_string()),
            JobError::Store(_) if !is_lasting(&error) => Self::Passing(error.to_string()),
            _ => Self::Lasting(error.to_string()),
        }
    }
}

/// A job on this worker.
pub(crate) struct Loaded {
    pub(crate) id: JobId,
    pub(crate) plan: JobPlan,
    pub(crate) assets: Arc<Thawed>,
}

/// What frames are made with.
pub(crate) struct Bench {
    pub(crate) renderer: Arc<dyn Render>,
    pub(crate) store: Store,
    pub(crate) build: String,
    pub(crate) calm: Calm,
    /// One frame is rendered at a time: two would take turns, tile by tile, and each be done later.
    pub(crate) device: Semaphore,
    /// True once the worker is to go.
    pub(crate) stopping: watch::Receiver<bool>,
}

impl Bench {
    /// Makes a frame, and says of it what labels tell.
    pub(crate) async fn frame(&self, job: &Arc<Loaded>, number: u32) -> Result<Value, Trouble> {
        let (known, planning) = (Arc::clone(job), number);
        let (planned, assets) = beside(move || {
            let planned = known.plan.frame(planning)?;
            let assets = known.assets.of(&planned.scene)?;
            Ok((planned, assets))
        })
        .await?;
        let turn = self.device.acquire().await.map_err(|_| Trouble::Stopping)?;
        (self.calm)().await;
        let begun = Instant::now();
        let frame = self
            .rendered(|| self.order(job, &planned, &assets))
            .instrument(info_span!("render"))
            .await?;
        let rendering = begun.elapsed();
        metrics::passes(&frame);
        metrics::stage("render", rendering);
        let probe = self.probe(job, &planned, &assets).await?;
        drop(turn);

        let begun = Instant::now();
        let request = job.plan.request();
        let format = request.format();
        let options = Options {
            software: format!("Welkin {}", self.build),
            scene_json: serde_json::to_string(&*planned.scene).ok(),
            ..Options::default()
        };
        let encoded = Arc::clone(&frame);
        let bytes =
            beside(move || encode(&encoded, format, &options).map_err(|e| JobError::Damaged(e.to_string())));
        let bytes = Bytes::from(bytes.instrument(info_span!("encode")).await?);
        let encoding = begun.elapsed();
        metrics::stage("encode", encoding);

        let begun = Instant::now();
        let path = job.id.frame(number, file_extension(format));
        let length = bytes.len();
        self.patiently("store", || async {
            self.store
                .put_new(&path, bytes.clone())
                .await
                .map_err(Trouble::from)
        })
        .instrument(info_span!("store"))
        .await?;
        let storing = begun.elapsed();
        metrics::stage("store", storing);
        Ok(told(&frame, probe, length, [rendering, encoding, storing]))
    }

    fn order(&self, job: &Loaded, planned: &PlannedFrame, assets: &Arc<SceneAssets>) -> Reply<Arc<Frame>> {
        let request = job.plan.request();
        let order = FrameOrder {
            scene: Arc::clone(&planned.scene),
            assets: Arc::clone(assets),
            width_px: request.width_px,
            height_px: request.height_px,
            quality: request.quality,
            output: output_for(request.format()),
            priority: Priority::Batch,
        };
        match planned.window {
            Some(window) => self.renderer.window(order, window),
            None => self.renderer.frame(order),
        }
    }

    async fn probe(
        &self,
        job: &Loaded,
        planned: &PlannedFrame,
        assets: &Arc<SceneAssets>,
    ) -> Result<Value, Trouble> {
        let directions = &job.plan.request().probe;
        if directions.is_empty() {
            return Ok(Value::Null);
        }
        let order = || {
            self.renderer.probe(ProbeOrder {
                request: ProbeRequest {
                    scene: (*planned.scene).clone(),
                    directions: directions.clone(),
                },
                assets: Arc::clone(assets),
            })
        };
        Ok(json!(self.rendered(order).await?))
    }

    /// Waits for the renderer; a full queue is waited for without end.
    async fn rendered<T>(&self, order: impl Fn() -> Reply<T>) -> Result<T, Trouble> {
        self.patiently("render", || async {
            loop {
                match order().await {
                    Ok(answer) => return Ok(answer),
                    Err(RenderError::Busy { .. }) => sleep(BUSY).await,
                    Err(error @ RenderError::Size { .. }) => return Err(Trouble::Lasting(error.to_string())),
                    Err(RenderError::Stopped) => return Err(Trouble::Stopping),
                    Err(error @ RenderError::Device(_)) => return Err(Trouble::Passing(error.to_string())),
                }
            }
        })
        .await
    }

    /// Tries again after pauses, where that may help, until the worker is to go.
    pub(crate) async fn patiently<T, F: Future<Output = Result<T, Trouble>>>(
        &self,
        stage: &'static str,
        attempt: impl Fn() -> F,
    ) -> Result<T, Trouble> {
        let mut stopping = self.stopping.clone();
        for pause in PAUSES_MS {
            match attempt().await {
                Err(Trouble::Passing(reason)) => {
                    tracing::warn!(stage, reason, "to be tried again");
                    metrics::retried(stage);
                    if timeout(Duration::from_millis(pause), stopping.wait_for(|stop| *stop))
                        .await
                        .is_ok()
                    {
                        return Err(Trouble::Stopping);
                    }
                }
                done => return done,
            }
        }
        attempt().await
    }
}

/// What the queue keeps of a frame that is done.
fn told(frame: &Frame, probe: Value, bytes: usize, times: [Duration; 3]) -> Value {
    let [render_ms, encode_ms, store_ms] = times.map(|time| time.as_secs_f64() * 1e3);
    json!({
        "sun": frame.facts.sun,
        "sun_irradiance_w_m2": frame.facts.sun_irradiance_w_m2,
        "moon": frame.facts.moon,
        "moon_irradiance_w_m2": frame.facts.moon_irradiance_w_m2,
        "ev100": frame.facts.ev100,
        "probe": probe,
        "bytes": bytes,
        "render_ms": render_ms,
        "encode_ms": encode_ms,
        "store_ms": store_ms,
        "passes": frame.passes,
        "ended_ms": now_ms(),
    })
}
