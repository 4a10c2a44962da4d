//! A renderer that draws a gradient of the scene's own numbers, as slowly as it is told.

use std::{
    sync::{
        Arc, Mutex,
        atomic::{AtomicU32, Ordering},
    },
    time::Duration,
};
use welkin_scene::{
    Irradiance, ProbeAnswer,
    job::Window,
    renderer::{
        DeviceInfo, Frame, FrameFacts, FrameOrder, OnPass, Output, PassTime, Pixels, ProbeOrder, Render,
        RenderError, Reply,
    },
};

/// What it does with an order before it draws.
type Before = Box<dyn Fn(&FrameOrder) -> Result<Duration, RenderError> + Send + Sync>;

pub(crate) struct Fake {
    before: Before,
    pub(crate) orders: Mutex<Vec<f64>>,
    pub(crate) in_work: Arc<AtomicU32>,
    pub(crate) dropped: Arc<AtomicU32>,
}

/// Counts an order that was given up before it was drawn.
struct InWork {
    fake: (Arc<AtomicU32>, Arc<AtomicU32>),
    done: bool,
}

impl Drop for InWork {
    fn drop(&mut self) {
        self.fake.0.fetch_sub(1, Ordering::SeqCst);
        if !self.done {
            self.fake.1.fetch_add(1, Ordering::SeqCst);
        }
    }
}

impl Fake {
    pub(crate) fn quick() -> Arc<Self> {
        Self::with(|_| Ok(Duration::ZERO))
    }

    pub(crate) fn with(
        before: impl Fn(&FrameOrder) -> Result<Duration, RenderError> + Send + Sync + 'static,
    ) -> Arc<Self> {
        Arc::new(Self {
            before: Box::new(before),
            orders: Mutex::default(),
            in_work: Arc::default(),
            dropped: Arc::default(),
        })
    }
}

fn draw(order: &FrameOrder, window: Window) -> Frame {
    let seed = order.scene.time_s + order.scene.sun_place().elevation_deg;
    let places = (window.y_px..window.y_px + window.height_px)
        .flat_map(|y| (window.x_px..window.x_px + window.width_px).map(move |x| (x, y)));
    let value = |(x, y): (u32, u32), channel: u32| f64::from(x * 7 + y * 13 + channel) * 0.01 + seed.abs();
    let values = places.flat_map(|place| (0..3).map(move |channel| value(place, channel)));
    Frame {
        width_px: window.width_px,
        height_px: window.height_px,
        pixels: match order.output {
            Output::Display => Pixels::Display(values.map(|v| (v * 10.0) as u64 as u8).collect()),
            Output::Linear => Pixels::Linear(values.map(|v| v as f32).collect()),
        },
        passes: vec![PassTime {
            pass: "fake",
            ms: 1.0,
        }],
        facts: FrameFacts {
            sun: order.scene.sun_place(),
            sun_irradiance_w_m2: [1.0; 3],
            moon: None,
            moon_irradiance_w_m2: [0.0; 3],
            ev100: matches!(order.output, Output::Display).then_some(14.5),
        },
    }
}

impl Render for Fake {
    fn frame(&self, order: FrameOrder) -> Reply<Arc<Frame>> {
        let window = Window {
            x_px: 0,
            y_px: 0,
            width_px: order.width_px,
            height_px: order.height_px,
        };
        self.window(order, window)
    }

    fn window(&self, order: FrameOrder, window: Window) -> Reply<Arc<Frame>> {
        self.orders.lock().unwrap().push(order.scene.time_s);
        let before = (self.before)(&order);
        self.in_work.fetch_add(1, Ordering::SeqCst);
        let mut in_work = InWork {
            fake: (Arc::clone(&self.in_work), Arc::clone(&self.dropped)),
            done: false,
        };
        Box::pin(async move {
            let delay = before.inspect_err(|_| in_work.done = true)?;
            if delay > Duration::ZERO {
                tokio::time::sleep(delay).await;
            }
            let frame = draw(&order, window);
            in_work.done = true;
            drop(in_work);
            Ok(Arc::new(frame))
        })
    }

    fn refine(&self, order: FrameOrder, _: OnPass) -> Reply<Arc<Frame>> {
        self.frame(order)
    }

    fn probe(&self, order: ProbeOrder) -> Reply<ProbeAnswer> {
        let request = order.request;
        let count = request.directions.len();
        Box::pin(async move {
            Ok(ProbeAnswer {
                radiance_w_m2_sr: request.directions.iter().map(|d| d.unit()).collect(),
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
            })
        })
    }

    fn device(&self) -> DeviceInfo {
        DeviceInfo {
            adapter: "fake".into(),
            kind: "other".into(),
            backend: "none".into(),
            driver: "none".into(),
            max_side_px: 16_384,
            recoveries: 0,
        }
    }
}
