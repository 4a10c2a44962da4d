//! Orders on their way: what waits, where its answer goes, and when there will be room.

use crate::{frame_job::FrameJob, probe_job::ProbeJob};
use futures_channel::oneshot;
use std::sync::{
    Arc, Mutex, PoisonError,
    atomic::{AtomicUsize, Ordering},
};
use welkin_scene::{
    ProbeAnswer,
    renderer::{DeviceInfo, Frame, Priority, RenderError},
};

/// What the renderer and its thread both know.
pub(crate) struct Shared {
    pub(crate) places: usize,
    pub(crate) taken: AtomicUsize,
    pub(crate) device: Mutex<DeviceInfo>,
    /// Running mean of the time of one order, milliseconds.
    pub(crate) mean_ms: Mutex<f64>,
}

impl Shared {
    pub(crate) fn learn(&self, ms: f64) {
        let mut mean_ms = self.mean_ms.lock().unwrap_or_else(PoisonError::into_inner);
        *mean_ms += 0.1 * (ms - *mean_ms);
    }

    /// When the orders that wait will be done, seconds.
    pub(crate) fn retry_after_s(&self) -> u32 {
        let mean_ms = *self.mean_ms.lock().unwrap_or_else(PoisonError::into_inner);
        let waiting = u32::try_from(self.taken.load(Ordering::Acquire)).unwrap_or(u32::MAX);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to 1..60 first"
        )]
        let seconds = (f64::from(waiting) * mean_ms * 1e-3).clamp(1.0, 60.0).ceil() as u32;
        seconds
    }
}

pub(crate) enum Work {
    Frame(Box<FrameJob>, Answer<Arc<Frame>>),
    Probe(Box<ProbeJob>, Answer<ProbeAnswer>),
}

/// Where an answer goes, and the order's place in the queue, given back when this is dropped.
pub(crate) struct Answer<T> {
    pub(crate) sender: oneshot::Sender<Result<T, RenderError>>,
    pub(crate) shared: Arc<Shared>,
}

impl<T> Answer<T> {
    pub(crate) fn send(self, result: Result<T, RenderError>) {
        let Self { sender, shared } = self;
        shared.taken.fetch_sub(1, Ordering::AcqRel);
        // An asker who has gone needs no answer.
        drop(sender.send(result));
    }
}

impl Work {
    pub(crate) const fn priority(&self) -> Priority {
        match self {
            Self::Frame(job, _) => job.order().priority,
            Self::Probe(..) => Priority::Interactive,
        }
    }

    pub(crate) fn abandoned(&self) -> bool {
        match self {
            Self::Frame(_, answer) => answer.sender.is_canceled(),
            Self::Probe(_, answer) => answer.sender.is_canceled(),
        }
    }

    pub(crate) fn refuse(self, error: RenderError) {
        match self {
            Self::Frame(_, answer) => answer.send(Err(error)),
            Self::Probe(_, answer) => answer.send(Err(error)),
        }
    }
}
