//! A preview that becomes the final frame pass by pass.

use super::{
    header::Header,
    mixture::mixture,
    shot::{PASSING_JPEG_QUALITY, Shot, Stage, develop, encoded, order},
    view::View,
};
use crate::{
    calm::Attended,
    error::Error,
    metrics::{self, Counted},
    state::{Held, Service},
};
use std::{sync::Arc, time::Duration};
use tokio::{
    sync::{OwnedSemaphorePermit, watch},
    time::{Instant, sleep_until},
};
use welkin_encode::Options;
use welkin_scene::{
    frame::Quality,
    refinement::PASSES,
    renderer::{Frame, Priority, Refined, Reply},
};

/// Between pictures: passes that are quicker are shown together.
const BETWEEN: Duration = Duration::from_millis(150);

/// Frames in memory at once: the renderer's, the last that it has shown, the one that is shown from, and the mixture.
const COPIES: u64 = 4;

/// A final frame in work. Dropping it cancels the order at the next tile.
pub(crate) struct Refining {
    service: Service,
    view: View,
    /// What stands where nothing is final yet.
    preview: Arc<Held>,
    frame: Reply<Arc<Frame>>,
    /// The latest pass.
    passes: watch::Receiver<Option<Refined>>,
    memory: Arc<OwnedSemaphorePermit>,
    _turn: OwnedSemaphorePermit,
    _in_work: (Counted, Attended),
    begun: Instant,
    /// The last pass that was shown, and when.
    shown: (u16, Instant),
}

impl Refining {
    /// Orders the final frame.
    pub(crate) async fn begin(service: Service, view: View, preview: Arc<Held>) -> Result<Self, Error> {
        let turn = Arc::clone(&service.refinements)
            .acquire_owned()
            .await
            .map_err(|_| Error::Stopped)?;
        let size = (view.output.width_px, view.output.height_px);
        // A refinement that nobody drags at must not hold up another viewer's drag.
        let order = order(&service, &view, (Quality::Final, Priority::Batch), size).await?;
        let memory = Arc::new(service.reserve(&order, COPIES).await?);
        let (sender, passes) = watch::channel(None);
        let seen = Box::new(move |refined| drop(sender.send_replace(Some(refined))));
        let begun = Instant::now();
        let attended = service.attention.order();
        let frame = service.renderer.refine(order, seen);
        Ok(Self {
            service,
            view,
            preview,
            frame,
            passes,
            memory,
            _turn: turn,
            _in_work: (Counted::frame_in_work(), attended),
            begun,
            shown: (0, begun),
        })
    }

    /// The next picture, and the rest where it is not the last. The renderer waits for nobody: of passes that were done
    /// meanwhile the latest is shown.
    pub(crate) async fn next(mut self) -> Result<(Shot, Option<Self>), Error> {
        let (last, since) = self.shown;
        let passes = &mut self.passes;
        let later = async {
            sleep_until(since + BETWEEN).await;
            let later = |seen: &Option<Refined>| seen.as_ref().is_some_and(|seen| seen.pass > last);
            // The last sender goes with the order, of which the frame itself tells.
            passes.wait_for(later).await.ok().and_then(|seen| seen.clone())
        };
        tokio::select! {
            biased;
            done = &mut self.frame => {
                let frame = done.map_err(|error| {
                    metrics::refused(&error);
                    Error::from_render(error, self.service.renderer.device().max_side_px).within("/output")
                })?;
                metrics::rendered(&frame, self.begun.elapsed().as_secs_f64());
                Ok((self.show(PASSES, frame).await?, None))
            }
            Some(Refined { pass, frame }) = later => {
                let shot = self.show(pass, frame).await?;
                self.shown = (pass, Instant::now());
                Ok((shot, Some(self)))
            }
        }
    }

    async fn show(&mut self, pass: u16, frame: Arc<Frame>) -> Result<Shot, Error> {
        let output = self.view.output;
        let head = Header {
            seq: self.view.seq,
            pass,
            passes: Stage::Refinement.passes(output),
            width_px: output.width_px,
            height_px: output.height_px,
            format: output.format,
        };
        let (preview, refined, memory) = (
            Arc::clone(&self.preview),
            Arc::clone(&frame),
            Arc::clone(&self.memory),
        );
        let work = move || {
            let _memory = memory;
            if pass == PASSES {
                return encoded(head, &refined, Options::default().jpeg_quality);
            }
            encoded(
                head,
                &mixture(&preview.frame, &refined, pass),
                PASSING_JPEG_QUALITY,
            )
        };
        let rendering = self.begun.elapsed();
        let said = develop(
            &self.service,
            &self.view,
            (head, Quality::Final),
            (&frame, rendering),
            work,
        );
        let (message, stats) = said.await?;
        Ok(Shot {
            stage: Stage::Refinement,
            is_last: pass == PASSES,
            quality: Quality::Final,
            seq: self.view.seq,
            message,
            stats,
            took: self.begun.elapsed(),
            held: None,
        })
    }
}
