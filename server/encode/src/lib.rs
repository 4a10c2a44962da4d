//! Frames to files: the picture as PNG or JPEG, radiance as OpenEXR, Radiance HDR, NPY or raw floats.
//!
//! Rows go from the top, columns from the left, samples are R G B in every format. Radiance is linear, in W/m²/sr,
//! with the primaries and white of Rec. 709. What each format can hold stands in its module.
//!
//! A frame with a sample that is not finite is refused, whatever the format: NaN in a file is an error that shows
//! up far from its cause.

mod accept;
mod error;
mod exr;
mod hdr;
mod jpeg;
mod metadata;
mod names;
mod npy;
mod pixels;
mod png;
mod raw;
#[cfg(test)]
mod sample;
mod tiled;

pub use accept::format_from_accept;
pub use error::EncodeError;
pub use names::{OFFERED_MEDIA_TYPES, file_extension, format_from_path, media_type, output_for};
pub use tiled::{Tiles, decode_exr, write_tiled_exr};

use welkin_scene::{frame::Format, renderer::Frame};

/// How a frame becomes a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// JPEG quality, 1 to 100. From 90 up, colour is kept at full resolution (4:4:4), below at half (4:2:0).
    pub jpeg_quality: u8,
    /// Name and build of the program, for the file's `Software` entry.
    pub software: String,
    /// The scene document as JSON, kept in the file so that it can be rendered again. PNG, JPEG and EXR hold it
    /// (JPEG up to 60,000 bytes of it; a longer document is left out); the other formats have no place for it.
    pub scene_json: Option<String>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            jpeg_quality: 92,
            software: concat!("Welkin ", env!("CARGO_PKG_VERSION")).to_owned(),
            scene_json: None,
        }
    }
}

/// Encodes a frame. The pixels must be what [`output_for`] says the format holds.
///
/// - EXR with half floats holds magnitudes up to 65,504 W/m²/sr; brighter samples become that value, and the
///   attribute `clampedSamples` counts them. The sun's disc at its default irradiance, 2.8e4 W/m²/sr, fits.
/// - Radiance HDR keeps 8 bits of the brightest channel and shares its exponent, for zero and 1e-38 to 1e38
///   W/m²/sr. Dimmer and negative samples become zero, brighter ones the largest value.
/// - EXR with 32-bit floats, NPY and raw hold every sample exactly.
///
/// # Errors
/// [`EncodeError`] where the pixels are of the other kind, of another count than the size says or not finite, or
/// where an option is out of range.
pub fn encode(frame: &Frame, format: Format, options: &Options) -> Result<Vec<u8>, EncodeError> {
    match format {
        Format::Png => png::encode(frame, options),
        Format::Jpeg => jpeg::encode(frame, options),
        Format::Exr => exr::encode_half(frame, options),
        Format::ExrFloat => exr::encode_float(frame, options),
        Format::Hdr => hdr::encode(frame),
        Format::Npy => npy::encode(frame),
        Format::Raw => raw::encode(frame),
    }
}
