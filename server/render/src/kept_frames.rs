//! Frames kept for as long as nothing changes.

use std::{collections::VecDeque, sync::Arc};
use welkin_scene::renderer::{Frame, FrameOrder, Pixels, Priority};

/// Bytes that all kept frames may hold together: the largest picture that a live viewer may ask for, and some.
const MOST_BYTES: usize = 64 << 20;

/// The latest frames. A viewer to whom nothing changed costs no render.
#[derive(Default)]
pub(crate) struct KeptFrames {
    frames: VecDeque<(FrameOrder, Arc<Frame>)>,
}

const fn bytes(frame: &Frame) -> usize {
    match &frame.pixels {
        Pixels::Display(values) => values.len(),
        Pixels::Linear(values) => 4 * values.len(),
    }
}

impl KeptFrames {
    /// The frame of an equal order; no pass has run for it.
    pub(crate) fn find(&mut self, order: &FrameOrder) -> Option<Arc<Frame>> {
        let order = FrameOrder {
            priority: Priority::Batch,
            ..order.clone()
        };
        let at = self.frames.iter().position(|(kept, _)| *kept == order)?;
        let (order, frame) = self.frames.remove(at)?;
        let found = Arc::clone(&frame);
        self.frames.push_front((order, frame));
        Some(found)
    }

    pub(crate) fn keep(&mut self, order: FrameOrder, frame: &Arc<Frame>) {
        if bytes(frame) > MOST_BYTES {
            return;
        }
        // Who waited for it is not part of what was asked, and pixels of assets are not needed to tell them apart.
        let order = FrameOrder {
            assets: Arc::new(order.assets.without_content()),
            priority: Priority::Batch,
            ..order
        };
        let silent = Frame {
            passes: Vec::new(),
            ..Frame::clone(frame)
        };
        self.frames.push_front((order, Arc::new(silent)));
        while self.frames.iter().map(|(_, f)| bytes(f)).sum::<usize>() > MOST_BYTES {
            self.frames.pop_back();
        }
    }
}
