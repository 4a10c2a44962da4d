//! How much of the store and the queue a job may take, told before its first frame.

use crate::JobError;
use welkin_scene::{
    Format, JobPlan,
    job::Frames,
    problem::{Problem, SceneError},
};

/// What jobs may take of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// All jobs together, bytes in the store and the queue.
    pub store_bytes: u64,
    /// The largest frame, or tile of a panorama, pixels.
    pub max_frame_pixels: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            store_bytes: u64::MAX,
            max_frame_pixels: u64::MAX,
        }
    }
}

/// A task in the queue with its indices, what its worker says of it and its label, bytes; without its scene.
const TASK_BYTES: u64 = 8 << 10;
/// A label's and an answer's words of one probed direction, bytes: three lines of numbers.
const PROBED_BYTES: u64 = 512;
/// Headers of a frame's file beside the scene in it, bytes.
const FILE_BYTES: u64 = 4 << 10;

/// What a pixel takes at most, bytes: no coder of ours makes noise longer than this. JPEG's blocks of noise come near 4.
const fn pixel_bytes(format: Format) -> u64 {
    match format {
        Format::Png => 4,
        Format::Jpeg | Format::Hdr => 5,
        Format::Exr => 7,
        Format::ExrFloat | Format::Npy | Format::Raw => 13,
    }
}

/// The most that a job's files and tasks take, bytes.
pub(crate) struct Weight {
    /// One frame.
    pub(crate) frame: u64,
    /// Tasks, labels and the document.
    pub(crate) kept: u64,
    /// All of it.
    pub(crate) all: u64,
}

/// Weighs a job, with its assets' bytes.
pub(crate) fn weigh(plan: &JobPlan, document: &str, assets: u64) -> Result<Weight, JobError> {
    let request = plan.request();
    let frames = u64::from(plan.count());
    let first = plan.frame(0)?;
    // Frames differ in values, not in what is there; a list's scenes are no longer than twice the document.
    let scene = serde_json::to_string(&*first.scene).map_or(0, |text| text.len() as u64);
    let (width_px, height_px) = first
        .window
        .map_or((request.width_px, request.height_px), |window| {
            (window.width_px, window.height_px)
        });
    let pixels = u64::from(width_px) * u64::from(height_px);
    let frame = pixels * pixel_bytes(request.format()) + FILE_BYTES + 2 * scene;
    let probed = request.probe.len() as u64 * PROBED_BYTES;
    let kept = frames * (TASK_BYTES + 2 * probed + 2 * scene) + 2 * document.len() as u64 + assets;
    let whole = match &request.frames {
        Frames::Timeline(lapse) => lapse.films.len() as u64 * frames * pixels * pixel_bytes(Format::Png),
        Frames::Panorama(_) => frames * frame,
        Frames::List(_) | Frames::Grid(_) | Frames::Random(_) => 0,
    };
    Ok(Weight {
        frame,
        kept,
        all: kept + frames * frame + whole,
    })
}

impl Limits {
    /// Refuses a job that is too large by itself, with the field that makes it so.
    pub(crate) fn check(&self, plan: &JobPlan, weight: &Weight) -> Result<(), JobError> {
        let request = plan.request();
        let (width_px, height_px) = match &request.frames {
            Frames::Panorama(panorama) => (panorama.tile_px, panorama.tile_px),
            _ => (request.width_px, request.height_px),
        };
        let pixels = u64::from(width_px) * u64::from(height_px);
        let refuse = |pointer: &str, value: u64, allowed: String, message: String| {
            let problem = Problem {
                pointer: pointer.into(),
                value: value.into(),
                allowed,
                message,
            };
            Err(JobError::Scene(SceneError::Invalid(vec![problem])))
        };
        if pixels > self.max_frame_pixels {
            let pointer = match &request.frames {
                Frames::Panorama(_) => "/frames/tile_px",
                _ => "/width_px",
            };
            let most = self.max_frame_pixels;
            let allowed = format!("such that a frame has {most} pixels at most");
            let message =
                format!("a frame of this job has {pixels} pixels; this server renders {most} at most");
            return refuse(pointer, width_px.into(), allowed, message);
        }
        if weight.all > self.store_bytes {
            let most = self.store_bytes;
            let allowed = format!("such that all results take {most} bytes at most");
            let message = format!(
                "the job may take {} bytes, and all jobs here may take {most}: ask for fewer or smaller frames",
                weight.all
            );
            return refuse("/frames", plan.count().into(), allowed, message);
        }
        Ok(())
    }
}
