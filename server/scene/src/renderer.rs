//! What may be asked of a renderer, whichever it is. The service and the workers know only this.

use crate::{
    assets::SceneAssets,
    document::Scene,
    frame::Quality,
    job::Window,
    moon::MoonPlace,
    probe::{ProbeAnswer, ProbeRequest, SunPlace},
};
use serde::{Deserialize, Serialize};
use std::{future::Future, pin::Pin, sync::Arc};

/// The answer that a renderer will give. Dropping it cancels the work at the next tile.
pub type Reply<T> = Pin<Box<dyn Future<Output = Result<T, RenderError>> + Send>>;

/// Told of a frame after each pass of its refinement. It is called where the device is waited for, and must not wait.
pub type OnPass = Box<dyn Fn(Refined) + Send>;

/// A frame that is being refined.
#[derive(Clone, Debug)]
pub struct Refined {
    /// The last pass that was done, from 1. After a loss of the device it begins anew.
    pub pass: u16,
    /// The frame so far; pixels of later passes are zero.
    pub frame: Arc<Frame>,
}

/// Renders validated scenes.
pub trait Render: Send + Sync {
    /// One frame. The work is queued by the call itself, not at the first poll.
    fn frame(&self, order: FrameOrder) -> Reply<Arc<Frame>>;
    /// The same frame in the order of [`crate::refinement`], each pixel once; `seen` is told of each pass but the last. A
    /// frame that is quickly done, or that was kept, is made at once, as is a preview.
    fn refine(&self, order: FrameOrder, seen: OnPass) -> Reply<Arc<Frame>>;
    /// A part of a frame: the same pixels as the whole frame has there. The frame's sides are 1 to
    /// [`crate::job::MAX_PANORAMA_PX`] pixels, the part's as those of a frame.
    fn window(&self, order: FrameOrder, window: Window) -> Reply<Arc<Frame>>;
    /// Radiance at exact directions.
    fn probe(&self, order: ProbeOrder) -> Reply<ProbeAnswer>;
    /// The device that renders.
    fn device(&self) -> DeviceInfo;
}

/// One frame to render. The scene has been validated.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameOrder {
    /// What is seen.
    pub scene: Arc<Scene>,
    /// Every asset that the scene names.
    pub assets: Arc<SceneAssets>,
    /// Width, pixels, 1 to [`crate::frame::MAX_SIDE_PX`].
    pub width_px: u32,
    /// Height, pixels, 1 to [`crate::frame::MAX_SIDE_PX`].
    pub height_px: u32,
    /// How much work goes into it.
    pub quality: Quality,
    /// Picture or radiance.
    pub output: Output,
    /// Who waits for it.
    pub priority: Priority,
}

/// Directions to probe. The request has been validated.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ProbeOrder {
    /// What is asked.
    pub request: ProbeRequest,
    /// Every asset that the request's scene names.
    pub assets: Arc<SceneAssets>,
}

/// Of a scene that names no asset.
impl From<ProbeRequest> for ProbeOrder {
    fn from(request: ProbeRequest) -> Self {
        Self {
            request,
            assets: Arc::default(),
        }
    }
}

/// What the pixels are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Output {
    /// The picture, 8-bit sRGB.
    Display,
    /// Radiance, W/m²/sr.
    Linear,
}

/// Who waits. Interactive work goes before batch work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Priority {
    /// Nobody looks at the clock.
    Batch,
    /// A person waits.
    Interactive,
}

/// A rendered frame, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Width, pixels.
    pub width_px: u32,
    /// Height, pixels.
    pub height_px: u32,
    /// The pixels.
    pub pixels: Pixels,
    /// Time spent, one entry a pass that ran, in the order they ran. Empty where the frame was kept from before.
    pub passes: Vec<PassTime>,
    /// What the frame says of itself.
    pub facts: FrameFacts,
}

/// Three values a pixel.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// sRGB, R G B.
    Display(Vec<u8>),
    /// Radiance, R G B, W/m²/sr.
    Linear(Vec<f32>),
}

/// Time that one pass took.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PassTime {
    /// The pass, as its shader is named.
    pub pass: &'static str,
    /// Milliseconds.
    pub ms: f64,
}

/// What a frame says of itself.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrameFacts {
    /// Where the sun stands at the scene's origin.
    pub sun: SunPlace,
    /// Irradiance from the sun at the observer on a plane that faces it, W/m²; zero where the ground hides it.
    pub sun_irradiance_w_m2: [f64; 3],
    /// Where the moon stands; `None` where there is none.
    pub moon: Option<MoonPlace>,
    /// Irradiance from the moon at the observer on a plane that faces it, W/m².
    pub moon_irradiance_w_m2: [f64; 3],
    /// Exposure value at ISO 100 that the picture was taken with; `None` for radiance.
    pub ev100: Option<f64>,
}

/// The device that renders.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DeviceInfo {
    /// The adapter's name.
    pub adapter: String,
    /// `cpu`, `discrete-gpu`, `integrated-gpu`, `virtual-gpu` or `other`.
    pub kind: String,
    /// `vulkan`, `metal` or `dx12`.
    pub backend: String,
    /// Driver and its version.
    pub driver: String,
    /// Longest side of a frame, pixels.
    pub max_side_px: u32,
    /// Times the device was lost and opened anew since the start.
    pub recoveries: u64,
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RenderError {
    /// The queue is full.
    #[error("all places in the render queue are taken; try again in {retry_after_s} s")]
    Busy {
        /// When to come back, seconds.
        retry_after_s: u32,
    },
    /// The size cannot be rendered.
    #[error("a frame of {width_px} x {height_px} pixels: {reason}")]
    Size {
        /// Asked width, pixels.
        width_px: u32,
        /// Asked height, pixels.
        height_px: u32,
        /// What is allowed.
        reason: String,
    },
    /// The device failed and was opened anew; the work was not done.
    #[error("the device failed: {0}")]
    Device(String),
    /// The renderer is shutting down.
    #[error("the renderer is shutting down")]
    Stopped,
}
