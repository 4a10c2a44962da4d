//! A renderer whose answers are told in advance and whose orders are written down.

use std::{
    pin::Pin,
    sync::{
        Arc, Mutex,
        atomic::{AtomicUsize, Ordering},
    },
    task::{Context, Poll},
    time::Duration,
};
use welkin_scene::{
    Irradiance, ProbeAnswer, Quality,
    job::Window,
    refinement::PASSES,
    renderer::{
        DeviceInfo, Frame, FrameFacts, FrameOrder, OnPass, Output, PassTime, Pixels, ProbeOrder, Refined,
        Render, RenderError, Reply,
    },
};

pub(crate) struct Fake {
    pub(crate) orders: Mutex<Vec<FrameOrder>>,
    pub(crate) probes: Mutex<Vec<ProbeOrder>>,
    pub(crate) cancelled: Arc<AtomicUsize>,
    delay: Box<dyn Fn(&FrameOrder) -> Duration + Send + Sync>,
    /// Errors given instead of frames, the first first.
    failures: Mutex<Vec<RenderError>>,
}

impl Fake {
    pub(crate) fn new() -> Arc<Self> {
        Self::slow(|_| Duration::ZERO)
    }

    pub(crate) fn slow(delay: impl Fn(&FrameOrder) -> Duration + Send + Sync + 'static) -> Arc<Self> {
        Arc::new(Self {
            orders: Mutex::default(),
            probes: Mutex::default(),
            cancelled: Arc::default(),
            delay: Box::new(delay),
            failures: Mutex::default(),
        })
    }

    pub(crate) fn failing(failures: impl Into<Vec<RenderError>>) -> Arc<Self> {
        let fake = Self::new();
        *fake.failures.lock().unwrap() = failures.into();
        fake
    }

    pub(crate) fn orders_of(&self, quality: Quality) -> usize {
        self.orders
            .lock()
            .unwrap()
            .iter()
            .filter(|order| order.quality == quality)
            .count()
    }

    fn failure(&self) -> Option<RenderError> {
        let mut failures = self.failures.lock().unwrap();
        (!failures.is_empty()).then(|| failures.remove(0))
    }
}

/// Counts itself where it is dropped before it was ready.
struct Watched<T> {
    work: Reply<T>,
    ready: bool,
    cancelled: Arc<AtomicUsize>,
}

impl<T> Future for Watched<T> {
    type Output = Result<T, RenderError>;

    fn poll(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
        let answer = self.work.as_mut().poll(context);
        self.ready = answer.is_ready();
        answer
    }
}

impl<T> Drop for Watched<T> {
    fn drop(&mut self) {
        if !self.ready {
            self.cancelled.fetch_add(1, Ordering::SeqCst);
        }
    }
}

impl Render for Fake {
    fn frame(&self, order: FrameOrder) -> Reply<Arc<Frame>> {
        let (delay, failure) = ((self.delay)(&order), self.failure());
        self.orders.lock().unwrap().push(order.clone());
        let work = async move {
            tokio::time::sleep(delay).await;
            assert!(order.scene.time_s < 1e8, "a scene made to break the renderer");
            failure.map_or_else(|| Ok(Arc::new(gradient(&order))), Err)
        };
        Box::pin(Watched {
            work: Box::pin(work),
            ready: false,
            cancelled: Arc::clone(&self.cancelled),
        })
    }

    /// Passes together take as long as their frame; whether somebody waits for them or not, as on a thread of their own.
    fn refine(&self, order: FrameOrder, seen: OnPass) -> Reply<Arc<Frame>> {
        let (delay, frame) = ((self.delay)(&order), Arc::new(gradient(&order)));
        tokio::spawn(async move {
            for pass in 1..PASSES {
                tokio::time::sleep(delay / u32::from(PASSES)).await;
                seen(Refined {
                    pass,
                    frame: Arc::clone(&frame),
                });
            }
        });
        self.frame(order)
    }

    fn window(&self, order: FrameOrder, window: Window) -> Reply<Arc<Frame>> {
        self.frame(FrameOrder {
            width_px: window.width_px,
            height_px: window.height_px,
            ..order
        })
    }

    fn probe(&self, order: ProbeOrder) -> Reply<ProbeAnswer> {
        self.probes.lock().unwrap().push(order.clone());
        let ProbeOrder { request, .. } = order;
        let failure = self.failure();
        Box::pin(async move {
            let count = request.directions.len();
            let answer = ProbeAnswer {
                radiance_w_m2_sr: request
                    .directions
                    .iter()
                    .map(|direction| direction.unit())
                    .collect(),
                transmittance: vec![[1.0; 3]; count],
                distance_m: vec![None; count],
                irradiance: Irradiance {
                    direct_w_m2: [1.0; 3],
                    direct_normal_w_m2: [1.0; 3],
                    moon_direct_normal_w_m2: [0.0; 3],
                    diffuse_w_m2: [1.0; 3],
                    sh9: [[0.0; 3]; 9],
                },
                sun: request.scene.sun_place(),
                moon: request.scene.moon_place(),
            };
            failure.map_or(Ok(answer), Err)
        })
    }

    fn device(&self) -> DeviceInfo {
        DeviceInfo {
            adapter: "Gradient \u{2122}".into(),
            kind: "other".into(),
            backend: "vulkan".into(),
            driver: "none".into(),
            max_side_px: 16_384,
            recoveries: 0,
        }
    }
}

/// Red grows to the right, green downwards; blue is the sun's azimuth.
fn gradient(order: &FrameOrder) -> Frame {
    let (width, height) = (order.width_px, order.height_px);
    let sun = order.scene.sun_place();
    let pixel = |x: u32, y: u32| {
        [
            f64::from(x) / f64::from(width),
            f64::from(y) / f64::from(height),
            sun.azimuth_deg / 360.0,
        ]
    };
    let samples = (0..height).flat_map(|y| (0..width).flat_map(move |x| pixel(x, y)));
    let pixels = match order.output {
        Output::Display => Pixels::Display(samples.map(|c| (c * 255.0) as u8).collect()),
        Output::Linear => Pixels::Linear(samples.map(|c| c as f32).collect()),
    };
    Frame {
        width_px: width,
        height_px: height,
        pixels,
        passes: vec![
            PassTime {
                pass: "transmittance",
                ms: 0.25,
            },
            PassTime { pass: "sky", ms: 0.5 },
        ],
        facts: FrameFacts {
            sun,
            sun_irradiance_w_m2: [1.0, 1.0, 1.0],
            moon: order.scene.moon_place(),
            moon_irradiance_w_m2: [0.0; 3],
            ev100: (order.output == Output::Display).then_some(14.5),
        },
    }
}
