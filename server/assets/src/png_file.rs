//! PNG files: what they are, and their pixels as 8-bit RGBA.

use crate::Error;
use png::{BitDepth, ColorType, Decoder, DecodingError, OutputInfo, Transformations};
use serde::Serialize;
use std::io::Cursor;

/// The longest side of a picture, pixels.
pub const MAX_SIDE_PX: u32 = 4096;
/// Bytes of a pixel in memory.
pub(crate) const BYTES_PER_PIXEL: u64 = 4;

/// What a PNG's header says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct PngFacts {
    /// Width, pixels.
    pub width_px: u32,
    /// Height, pixels.
    pub height_px: u32,
    /// Bits of a sample, or of an index into the palette: 1, 2, 4, 8 or 16.
    pub bit_depth: u8,
    /// What a pixel is.
    pub colour: Colour,
}

/// What a pixel of a PNG is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Colour {
    /// One grey.
    Grey,
    /// Grey and alpha.
    GreyAlpha,
    /// Red, green, blue.
    Rgb,
    /// Red, green, blue, alpha.
    Rgba,
    /// One of up to 256 colours.
    Palette,
}

impl PngFacts {
    /// Bytes of the picture as 8-bit RGBA.
    pub(crate) fn rgba_bytes(self) -> u64 {
        u64::from(self.width_px) * u64::from(self.height_px) * BYTES_PER_PIXEL
    }
}

/// Reads the header, which alone tells how much memory the picture will take.
pub(crate) fn facts(file: &[u8]) -> Result<PngFacts, Error> {
    facts_of(&mut decoder(file, Transformations::IDENTITY))
}

/// Reads the whole file to its end. Of an animation, the picture that viewers without animation show.
pub(crate) fn rgba(file: &[u8]) -> Result<Vec<u8>, Error> {
    let (frame, samples) = samples(decoder(file, Transformations::EXPAND | Transformations::ALPHA))?;
    let samples = match frame.bit_depth {
        BitDepth::Sixteen => to_eight_bits(&samples),
        _ => samples,
    };
    match frame.color_type {
        ColorType::Rgba => Ok(samples),
        ColorType::GrayscaleAlpha => Ok(spread_grey(&samples)),
        other => Err(Error::Damaged {
            reason: format!("unexpected samples: {other:?}"),
        }),
    }
}

/// The greys of a picture that has nothing else, each from 0 to 1.
pub(crate) fn greys(file: &[u8]) -> Result<Vec<f32>, Error> {
    let (frame, samples) = samples(decoder(file, Transformations::EXPAND))?;
    match (frame.color_type, frame.bit_depth) {
        (ColorType::Grayscale, BitDepth::Sixteen) => {
            let (pairs, _) = samples.as_chunks::<2>();
            let share = |&pair: &[u8; 2]| f32::from(u16::from_be_bytes(pair)) / f32::from(u16::MAX);
            Ok(pairs.iter().map(share).collect())
        }
        (ColorType::Grayscale, _) => Ok(samples
            .iter()
            .map(|&sample| f32::from(sample) / f32::from(u8::MAX))
            .collect()),
        _ => Err(Error::refused(
            "the PNG has colours or transparency: heights are greys, best of 16 bits",
        )),
    }
}

fn samples(mut decoder: Decoder<Cursor<&[u8]>>) -> Result<(OutputInfo, Vec<u8>), Error> {
    facts_of(&mut decoder)?;
    let mut reader = decoder.read_info().map_err(Error::damaged)?;
    let too_large = || Error::damaged(DecodingError::LimitsExceeded);
    let mut samples = vec![0; reader.output_buffer_size().ok_or_else(too_large)?];
    let frame = reader.next_frame(&mut samples).map_err(Error::damaged)?;
    // The end mark has to be there too, or the file was cut.
    reader.finish().map_err(Error::damaged)?;
    Ok((frame, samples))
}

fn decoder(file: &[u8], transformations: Transformations) -> Decoder<Cursor<&[u8]>> {
    let mut decoder = Decoder::new(Cursor::new(file));
    decoder.set_transformations(transformations);
    // Compressed texts and profiles can grow a thousandfold, and nobody reads them.
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    decoder
}

fn facts_of(decoder: &mut Decoder<Cursor<&[u8]>>) -> Result<PngFacts, Error> {
    let info = decoder.read_header_info().map_err(Error::damaged)?;
    let (width_px, height_px) = (info.width, info.height);
    if width_px.max(height_px) > MAX_SIDE_PX {
        return Err(Error::Side { width_px, height_px });
    }
    Ok(PngFacts {
        width_px,
        height_px,
        bit_depth: info.bit_depth as u8,
        colour: match info.color_type {
            ColorType::Grayscale => Colour::Grey,
            ColorType::GrayscaleAlpha => Colour::GreyAlpha,
            ColorType::Rgb => Colour::Rgb,
            ColorType::Rgba => Colour::Rgba,
            ColorType::Indexed => Colour::Palette,
        },
    })
}

/// To the nearest: 65535 is 255 × 257, so that halves are at 128 of 257.
fn to_eight_bits(samples: &[u8]) -> Vec<u8> {
    let (pairs, _) = samples.as_chunks::<2>();
    let nearest = |&pair: &[u8; 2]| (u32::from(u16::from_be_bytes(pair)) + 128) / 257;
    pairs
        .iter()
        .map(|pair| u8::try_from(nearest(pair)).unwrap_or(u8::MAX))
        .collect()
}

fn spread_grey(samples: &[u8]) -> Vec<u8> {
    let (pairs, _) = samples.as_chunks::<2>();
    pairs
        .iter()
        .flat_map(|&[grey, alpha]| [grey, grey, grey, alpha])
        .collect()
}
