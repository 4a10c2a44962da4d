//! What may be set.

use std::time::Duration;
use welkin_scene::frame::MAX_SIDE_PX;

/// How much the service takes on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// The program's version and what tells this build from others; part of every `ETag`.
    pub build: String,
    /// Encoded frames kept for the next who asks, bytes. 0 keeps none.
    pub cache_bytes: u64,
    /// Pixels of all frames in work, bytes. Files made from them come on top, one at a time for each encoder.
    pub frame_memory_bytes: u64,
    /// The largest frame, pixels.
    pub max_frame_pixels: u64,
    /// Live viewers at once.
    pub max_viewers: u32,
    /// How long a job is kept after its end, with its results; none for ever.
    pub keep_results: Option<Duration>,
    /// Frames encoded at once.
    pub encoders: u32,
    /// How long a request may take to send its body.
    pub body_timeout: Duration,
    /// How long a frame waits for memory before it is told to come back.
    pub memory_timeout: Duration,
    /// How long a live viewer may take to confirm a frame, besides the time its bytes need at 32 KiB/s.
    pub pong_timeout: Duration,
    /// How long frames in work may take to end at shutdown.
    pub shutdown_timeout: Duration,
}

impl Default for Settings {
    fn default() -> Self {
        let cores = std::thread::available_parallelism().map_or(2, std::num::NonZero::get);
        Self {
            build: env!("CARGO_PKG_VERSION").into(),
            cache_bytes: 256 << 20,
            frame_memory_bytes: 4 << 30,
            max_frame_pixels: u64::from(MAX_SIDE_PX) * u64::from(MAX_SIDE_PX),
            max_viewers: 64,
            keep_results: None,
            encoders: u32::try_from(cores).unwrap_or(2),
            body_timeout: Duration::from_secs(30),
            memory_timeout: Duration::from_secs(10),
            pong_timeout: Duration::from_secs(10),
            shutdown_timeout: Duration::from_secs(10),
        }
    }
}
