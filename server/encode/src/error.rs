//! Why there is no file.

use welkin_scene::frame::{Format, MAX_SIDE_PX};

/// Why a frame could not be encoded, or a format not be told.
#[derive(Debug, thiserror::Error)]
pub enum EncodeError {
    /// The frame holds the picture where the format holds radiance, or the other way round.
    #[error(
        "{format:?} holds {needs}, and the frame does not: order it with the output that `output_for` names"
    )]
    Output {
        /// The format.
        format: Format,
        /// What the format holds.
        needs: &'static str,
    },
    /// The pixels do not fill the size.
    #[error(
        "a frame of {width_px} x {height_px} pixels cannot hold {samples} samples; it needs three a pixel and sides of 1 to {MAX_SIDE_PX} pixels"
    )]
    Size {
        /// Width, pixels.
        width_px: u32,
        /// Height, pixels.
        height_px: u32,
        /// Samples in the frame.
        samples: usize,
    },
    /// A sample is NaN or infinite.
    #[error(
        "radiance at column {x}, row {y} is {value:?}, which is not finite: this is a fault of the renderer, please report the scene"
    )]
    NotFinite {
        /// Column of the first such pixel.
        x: usize,
        /// Row of the first such pixel.
        y: usize,
        /// Its samples, R G B.
        value: [f32; 3],
    },
    /// The JPEG quality is out of range.
    #[error("JPEG quality is {0}; it may be 1 to 100")]
    Quality(u8),
    /// The `Accept` header names nothing that is offered.
    #[error("`{asked}` accepts nothing that is offered: {offered}")]
    NotAcceptable {
        /// The header.
        asked: String,
        /// Media types offered.
        offered: String,
    },
    /// The file's name does not tell the format.
    #[error("`{path}` does not tell the format; its name may end in {offered}")]
    Extension {
        /// The file's name.
        path: String,
        /// Extensions known.
        offered: String,
    },
    /// The encoder of the format failed.
    #[error("writing {format:?}: {source}")]
    Encoder {
        /// The format.
        format: Format,
        /// What it said.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}

impl EncodeError {
    /// Wraps what an encoder said.
    pub(crate) fn encoder(format: Format) -> impl Fn(Box<dyn std::error::Error + Send + Sync>) -> Self {
        move |source| Self::Encoder { format, source }
    }
}
