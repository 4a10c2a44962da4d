//! One picture for one viewer.

use super::{
    header::{self, Header},
    pace::divided,
    view::{LiveFormat, LiveOutput, View},
};
use crate::{
    error::Error,
    state::{Held, Service},
};
use bytes::Bytes;
use serde_json::{Value, json};
use std::{
    sync::Arc,
    time::{Duration, Instant},
};
use welkin_encode::{EncodeError, Options, encode};
use welkin_scene::{
    frame::{Format, Quality},
    refinement::PASSES,
    renderer::{Frame, FrameOrder, Output, Pixels, Priority},
};

/// Quality of the JPEG of a picture that is soon followed by a better one.
pub(crate) const PASSING_JPEG_QUALITY: u8 = 80;

/// What is to be rendered next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stage {
    /// At once, each side divided.
    Preview { divisor: u16 },
    /// In full, after the preview.
    Refinement,
}

/// A picture ready to be sent.
pub(crate) struct Shot {
    pub(crate) stage: Stage,
    /// True where nothing comes after it.
    pub(crate) is_last: bool,
    pub(crate) quality: Quality,
    pub(crate) seq: u32,
    /// Header and picture.
    pub(crate) message: Bytes,
    /// The text that goes with it.
    pub(crate) stats: Value,
    /// From the order to the encoded picture, the queue included.
    pub(crate) took: Duration,
    /// The frame that was shown, where one was made for it alone.
    pub(crate) held: Option<Arc<Held>>,
}

impl Stage {
    /// How many passes there are with the preview: it, and those of its refinement.
    pub(crate) const fn passes(self, output: LiveOutput) -> u16 {
        match (output.quality, self) {
            (Quality::Final, _) => 1 + PASSES,
            (Quality::Preview, Self::Preview { divisor: 1 }) => 1,
            (Quality::Preview, _) => 2,
        }
    }
}

/// The order of a frame for a viewer.
pub(crate) async fn order(
    service: &Service,
    view: &View,
    (quality, priority): (Quality, Priority),
    (width_px, height_px): (u16, u16),
) -> Result<FrameOrder, Error> {
    let assets = service.assets_of(&view.scene).await;
    Ok(FrameOrder {
        scene: Arc::clone(&view.scene),
        assets: assets.map_err(|e| e.within("/scene"))?,
        width_px: width_px.into(),
        height_px: height_px.into(),
        quality,
        output: Output::Display,
        priority,
    })
}

/// Renders and encodes a frame that has no passes. Dropping the future cancels the order.
pub(crate) async fn take(service: Service, view: View, stage: Stage) -> Result<Shot, Error> {
    let output = view.output;
    let (turns, divisor, priority) = match stage {
        Stage::Preview { divisor } => (&service.previews, divisor, Priority::Interactive),
        // A refinement that nobody drags at must not hold up another viewer's drag.
        Stage::Refinement => (&service.refinements, 1, Priority::Batch),
    };
    let _turn = Arc::clone(turns)
        .acquire_owned()
        .await
        .map_err(|_| Error::Stopped)?;
    let (width_px, height_px) = divided(output.width_px, output.height_px, divisor);
    let order = order(
        &service,
        &view,
        (Quality::Preview, priority),
        (width_px, height_px),
    )
    .await?;
    let start = Instant::now();
    let held = service.render(order).await.map_err(|e| e.within("/output"))?;
    let held = Arc::new(held);
    let passes = stage.passes(output);
    let pass = match stage {
        Stage::Preview { .. } => 0,
        Stage::Refinement => passes - 1,
    };
    let head = Header {
        seq: view.seq,
        pass,
        passes,
        width_px,
        height_px,
        format: output.format,
    };
    let shown = Arc::clone(&held);
    let work = move || encoded(head, &shown.frame, PASSING_JPEG_QUALITY);
    let (message, stats) = develop(
        &service,
        &view,
        (head, Quality::Preview),
        (&held.frame, held.took),
        work,
    )
    .await?;
    Ok(Shot {
        stage,
        is_last: pass + 1 == passes,
        quality: Quality::Preview,
        seq: view.seq,
        message,
        stats,
        took: start.elapsed(),
        held: Some(held),
    })
}

/// Encodes a picture, and says what there is to say of the frame.
pub(crate) async fn develop(
    service: &Service,
    view: &View,
    (head, quality): (Header, Quality),
    (frame, rendering): (&Frame, Duration),
    work: impl FnOnce() -> Result<Vec<u8>, EncodeError> + Send + 'static,
) -> Result<(Bytes, Value), Error> {
    let (message, encoding) = service.encode(head.format, work).await?;
    let ms = |duration: Duration| duration.as_secs_f64() * 1e3;
    let facts = &frame.facts;
    let mut stats = json!({
        "passes": frame.passes, "render_ms": ms(rendering), "encode_ms": ms(encoding),
        "width_px": head.width_px, "height_px": head.height_px, "quality": quality, "ev100": facts.ev100,
        "sun": facts.sun, "moon": facts.moon, "adapter": service.renderer.device().adapter,
        "bytes": message.len() - header::LENGTH,
    });
    if let Some(at_s) = view.at_s {
        stats["at_s"] = at_s.into();
        stats["scene"] = json!(*view.scene);
    }
    Ok((message.into(), json!({"seq": view.seq, "stats": stats})))
}

/// Header and picture.
pub(crate) fn encoded(head: Header, frame: &Frame, jpeg_quality: u8) -> Result<Vec<u8>, EncodeError> {
    let options = Options {
        jpeg_quality,
        ..Options::default()
    };
    let mut message = head.bytes().to_vec();
    match (head.format, &frame.pixels) {
        (LiveFormat::Raw, Pixels::Display(rgb)) => {
            message.extend(
                rgb.as_chunks::<3>()
                    .0
                    .iter()
                    .flat_map(|&[r, g, b]| [r, g, b, u8::MAX]),
            );
        }
        (LiveFormat::Png, _) => message.extend(encode(frame, Format::Png, &options)?),
        // Radiance, which was not ordered, is refused by the encoder.
        (LiveFormat::Jpeg | LiveFormat::Raw, _) => message.extend(encode(frame, Format::Jpeg, &options)?),
    }
    Ok(message)
}
