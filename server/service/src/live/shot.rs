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
    renderer::{Frame, FrameOrder, Output, Pixels, Priority},
};

/// Quality of a preview's JPEG: it is looked at for the blink of an eye.
const PREVIEW_JPEG_QUALITY: u8 = 80;

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
    pub(crate) quality: Quality,
    pub(crate) seq: u32,
    /// Header and picture.
    pub(crate) message: Bytes,
    /// The text that goes with it.
    pub(crate) stats: Value,
    /// From the order to the encoded picture, the queue included.
    pub(crate) took: Duration,
}

impl Stage {
    /// The refinement pass that this is, and how many there are.
    fn passes(self, output: LiveOutput) -> (u16, u16) {
        match self {
            Self::Preview { divisor: 1 } if output.quality == Quality::Preview => (0, 1),
            Self::Preview { .. } => (0, 2),
            Self::Refinement => (1, 2),
        }
    }

    /// True where nothing comes after it.
    pub(crate) fn is_last(self, output: LiveOutput) -> bool {
        let (pass, passes) = self.passes(output);
        pass + 1 == passes
    }
}

/// Renders and encodes. Dropping the future cancels the order.
pub(crate) async fn take(service: Service, view: View, stage: Stage) -> Result<Shot, Error> {
    let output = view.output;
    let (turns, divisor, quality, priority) = match stage {
        Stage::Preview { divisor } => (
            &service.previews,
            divisor,
            Quality::Preview,
            Priority::Interactive,
        ),
        // A refinement that nobody drags at must not hold up another viewer's drag.
        Stage::Refinement => (&service.refinements, 1, output.quality, Priority::Batch),
    };
    let _turn = Arc::clone(turns)
        .acquire_owned()
        .await
        .map_err(|_| Error::Stopped)?;
    let assets = service.assets_of(&view.scene).await;
    let assets = assets.map_err(|e| e.within("/scene"))?;
    let (width_px, height_px) = divided(output.width_px, output.height_px, divisor);
    let order = FrameOrder {
        scene: Arc::clone(&view.scene),
        assets,
        width_px: width_px.into(),
        height_px: height_px.into(),
        quality,
        output: Output::Display,
        priority,
    };
    let start = Instant::now();
    let Held {
        frame,
        memory,
        took: rendering,
    } = service.render(order).await.map_err(|e| e.within("/output"))?;
    let (pass, passes) = stage.passes(output);
    let head = Header {
        seq: view.seq,
        pass,
        passes,
        width_px,
        height_px,
        format: output.format,
    };
    let (passes, facts) = (frame.passes.clone(), frame.facts);
    let work = move || {
        let _memory = memory;
        picture(head, &frame, quality)
    };
    let (message, encoding) = service.encode(output.format, work).await?;
    let ms = |duration: Duration| duration.as_secs_f64() * 1e3;
    let mut stats = json!({
        "passes": passes, "render_ms": ms(rendering), "encode_ms": ms(encoding),
        "width_px": width_px, "height_px": height_px, "quality": quality, "ev100": facts.ev100,
        "sun": facts.sun, "moon": facts.moon, "adapter": service.renderer.device().adapter,
        "bytes": message.len() - header::LENGTH,
    });
    if let Some(at_s) = view.at_s {
        stats["at_s"] = at_s.into();
        stats["scene"] = json!(*view.scene);
    }
    let message = message.into();
    Ok(Shot {
        stage,
        quality,
        seq: view.seq,
        message,
        stats: json!({"seq": view.seq, "stats": stats}),
        took: start.elapsed(),
    })
}

fn picture(head: Header, frame: &Frame, quality: Quality) -> Result<Vec<u8>, EncodeError> {
    let jpeg_quality = match quality {
        Quality::Preview => PREVIEW_JPEG_QUALITY,
        Quality::Final => Options::default().jpeg_quality,
    };
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
