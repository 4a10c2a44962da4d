//! Many frames ordered at once: the document of a job, and which frames it stands for.
//!
//! A job is a pure function of its document: frame `n` is the same whoever renders it, and in whatever order.

mod check;
mod frames;
mod plan;
mod vary;

pub use frames::{Film, FrameGrid, FrameList, Frames, Panorama, RandomFrames, TimelineFrames};
pub use plan::{JobPlan, PlannedFrame, Window};
pub use vary::{Axis, Spread};

use crate::{
    direction::Direction,
    frame::{Format, Quality, whole},
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Most frames of a job.
pub const MAX_FRAMES: u32 = 100_000;
/// The longest side of a panorama, pixels.
pub const MAX_PANORAMA_PX: u32 = 32_768;
/// Most directions that every frame of a job is probed at.
pub const MAX_PROBED: usize = 256;

/// A job: frames that nobody waits for one by one. `{"frames": {"kind": "list", "scenes": [{}]}}` is the shortest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JobRequest {
    /// What people call it; null for no name.
    #[serde(default)]
    #[schemars(length(max = 100))]
    pub name: Option<String>,
    /// Which frames.
    pub frames: Frames,
    /// Width of every frame, pixels.
    #[serde(default = "width", deserialize_with = "whole")]
    #[schemars(range(min = 1, max = 32_768))]
    pub width_px: u32,
    /// Height of every frame, pixels.
    #[serde(default = "height", deserialize_with = "whole")]
    #[schemars(range(min = 1, max = 32_768))]
    pub height_px: u32,
    /// Kind of file. A panorama is `exr` or `exr-float`; null for `exr` there and `png` elsewhere.
    #[serde(default)]
    pub format: Option<Format>,
    /// How much work goes into each frame.
    #[serde(default)]
    pub quality: Quality,
    /// Directions at which each frame's labels tell radiance and transmittance. None: no frame is probed.
    #[serde(default)]
    #[schemars(length(max = 256))]
    pub probe: Vec<Direction>,
    /// How often a frame is begun before it counts as failed. A worker that dies takes one attempt from its frames.
    #[serde(default = "attempts", deserialize_with = "whole")]
    #[schemars(range(min = 1, max = 100))]
    pub attempts: u32,
}

const fn width() -> u32 {
    1280
}

const fn height() -> u32 {
    720
}

const fn attempts() -> u32 {
    5
}

impl JobRequest {
    /// The kind of file of every frame.
    #[must_use]
    pub fn format(&self) -> Format {
        let usual = match self.frames {
            Frames::Panorama(_) => Format::Exr,
            _ => Format::Png,
        };
        self.format.unwrap_or(usual)
    }
}
