//! The kinds of job.

use super::{MAX_FRAMES, vary::Axis, vary::Spread};
use crate::{document::Scene, frame::whole, timeline::Timeline};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// Which frames a job has.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Frames {
    /// These scenes, in this order.
    List(FrameList),
    /// One scene, and every combination of values for some of its fields.
    Grid(FrameGrid),
    /// One scene, and random values for some of its fields.
    Random(RandomFrames),
    /// Moments of a timeline, and films of them.
    Timeline(TimelineFrames),
    /// One large picture of all directions, computed in tiles and put together.
    Panorama(Panorama),
}

impl Frames {
    /// As the document names it.
    #[must_use]
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::List(_) => "list",
            Self::Grid(_) => "grid",
            Self::Random(_) => "random",
            Self::Timeline(_) => "timeline",
            Self::Panorama(_) => "panorama",
        }
    }
}

/// Scenes one by one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrameList {
    /// One a frame.
    #[schemars(with = "Vec<Scene>", length(min = 1, max = MAX_FRAMES))]
    pub scenes: Vec<Value>,
}

/// Every combination of values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrameGrid {
    /// What all frames begin with.
    #[serde(default = "any_scene")]
    #[schemars(with = "Scene")]
    pub scene: Value,
    /// Fields and their values. The last one's value changes from frame to frame, the first one's most seldom.
    #[schemars(length(min = 1, max = 16))]
    pub axes: Vec<Axis>,
}

/// Random values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RandomFrames {
    /// What all frames begin with.
    #[serde(default = "any_scene")]
    #[schemars(with = "Scene")]
    pub scene: Value,
    /// Fields and what their values are drawn from, each for itself.
    #[schemars(length(min = 1, max = 64))]
    pub ranges: Vec<Spread>,
    /// How many frames.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 1, max = MAX_FRAMES))]
    pub count: u32,
    /// Chooses the values. Frame `n` of a seed is the same whatever `count` is.
    #[serde(default, deserialize_with = "whole")]
    #[schemars(range(min = 0, max = 4_294_967_295_u32))]
    pub seed: u32,
}

/// A time-lapse.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimelineFrames {
    /// What changes, and when.
    pub timeline: Timeline,
    /// Time of the first frame, seconds as keyframes count them.
    #[serde(default)]
    #[schemars(range(min = -1e9, max = 1e9))]
    pub from_s: f64,
    /// Time of the last frame, seconds as keyframes count them.
    #[schemars(range(min = -1e9, max = 1e9))]
    pub to_s: f64,
    /// How many frames, evenly apart.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 1, max = MAX_FRAMES))]
    pub count: u32,
    /// Frames that films show in a second.
    #[serde(default = "frame_rate", deserialize_with = "whole")]
    #[schemars(range(min = 1, max = 120))]
    pub fps: u32,
    /// Films that are made of the frames. MP4 and WebM need ffmpeg where the worker runs; the job says where it lacks.
    #[serde(default = "films")]
    #[schemars(length(max = 4))]
    pub films: Vec<Film>,
}

/// A film of all frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Film {
    /// H.264.
    Mp4,
    /// VP9.
    Webm,
    /// Every pixel as it is in the frames.
    Apng,
    /// 256 colours a frame.
    Gif,
}

impl Film {
    /// What the film's file name ends with.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Mp4 => "mp4",
            Self::Webm => "webm",
            Self::Apng => "apng",
            Self::Gif => "gif",
        }
    }
}

/// All directions in one picture, as an equirectangular map. Its frames are tiles, rows from the top; their picture is
/// a tiled OpenEXR file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Panorama {
    /// What is seen; its camera's projection counts for nothing.
    #[serde(default = "any_scene")]
    #[schemars(with = "Scene")]
    pub scene: Value,
    /// Side of a tile, pixels: a multiple of 16.
    #[serde(default = "tile", deserialize_with = "whole")]
    #[schemars(range(min = 16, max = 4096))]
    pub tile_px: u32,
}

fn any_scene() -> Value {
    json!({})
}

const fn frame_rate() -> u32 {
    24
}

fn films() -> Vec<Film> {
    vec![Film::Mp4, Film::Apng]
}

const fn tile() -> u32 {
    512
}
