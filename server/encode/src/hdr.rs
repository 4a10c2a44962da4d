//! Radiance HDR: 8 bits a channel and one exponent for the three (Ward, "Real Pixels", Graphics Gems II, 1991),
//! run-length coded for widths of 8 to 32,767 pixels.

use crate::{
    error::EncodeError,
    pixels::{self, View},
};
use image::{ExtendedColorType, ImageEncoder, codecs::hdr::HdrEncoder};
use std::borrow::Cow;
use welkin_scene::{frame::Format, renderer::Frame};

/// The exponent byte reaches from 2^-128 to 2^127. The encoder takes the exponent from a logarithm that may round
/// up, so the ends stay clear of that.
const SMALLEST: f32 = 1e-38;
const LARGEST: f32 = 1e38;

pub(crate) fn encode(frame: &Frame) -> Result<Vec<u8>, EncodeError> {
    let view = pixels::linear(frame, Format::Hdr)?;
    let samples = within_range(&view);
    let mut out = Vec::new();
    HdrEncoder::new(&mut out)
        .write_image(
            bytemuck::cast_slice(&samples),
            view.width.into(),
            view.height.into(),
            ExtendedColorType::Rgb32F,
        )
        .map_err(|error| EncodeError::encoder(Format::Hdr)(error.into()))?;
    Ok(out)
}

/// The encoder lets the exponent byte wrap round, which turns 1e-40 into 1e37: such pixels are made black or the
/// largest value before. Frames without them, which is all that nature makes, are not copied.
fn within_range<'a>(view: &View<'a, f32>) -> Cow<'a, [f32]> {
    let (pixels, _) = view.samples.as_chunks::<3>();
    let holds = |pixel: &[f32; 3]| {
        let brightest = pixel.iter().copied().fold(0.0, f32::max);
        brightest == 0.0 || (SMALLEST..=LARGEST).contains(&brightest)
    };
    if pixels.iter().all(holds) {
        return Cow::Borrowed(view.samples);
    }
    let fit = |pixel: &[f32; 3]| {
        let fitted = pixel.map(|sample| sample.min(LARGEST));
        if holds(&fitted) { fitted } else { [0.0; 3] }
    };
    pixels.iter().flat_map(fit).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use crate::sample;
    use image::{ImageDecoder, codecs::hdr::HdrDecoder};
    use proptest::prelude::*;
    use welkin_scene::renderer::Pixels;

    fn decoded(file: &[u8]) -> (u32, u32, Vec<f32>) {
        let decoder = HdrDecoder::new(file).unwrap();
        let (width, height) = decoder.dimensions();
        let mut samples = vec![0.0; 3 * usize::try_from(width * height).unwrap()];
        decoder
            .read_image(bytemuck::cast_slice_mut(&mut samples))
            .unwrap();
        (width, height, samples)
    }

    fn row(samples: Vec<f32>) -> Frame {
        let mut frame = sample::linear(u16::try_from(samples.len() / 3).unwrap(), 1);
        frame.pixels = Pixels::Linear(samples);
        frame
    }

    /// The mantissa is cut to 8 bits, of which the brightest channel uses the upper half: off by less than 1/128
    /// of it. The encoder takes the exponent from a logarithm, which may be one off beside a power of two: 1/64.
    fn assert_close(sent: &[f32], got: &[f32]) {
        for (sent, got) in sent.as_chunks::<3>().0.iter().zip(got.as_chunks::<3>().0) {
            let brightest = sent.iter().copied().fold(0.0, f32::max);
            let off = sent
                .iter()
                .zip(got)
                .map(|(sent, got)| (sent.max(0.0) - got).abs())
                .fold(0.0, f32::max);
            assert!(off <= brightest / 64.0, "{sent:?} became {got:?}");
        }
    }

    #[test]
    fn pixels_come_back_in_their_places_flat_and_run_length_coded() {
        let wide = [(7, 3), (8, 3), (16_384, 2)];
        for (width, height) in sample::SIZES.into_iter().chain(wide) {
            let frame = sample::linear(width, height);
            let Pixels::Linear(sent) = &frame.pixels else {
                unreachable!("made linear")
            };
            let (columns, rows, got) = decoded(&encode(&frame).unwrap());
            assert_eq!((columns, rows), (width.into(), height.into()));
            assert_close(sent, &got);
        }
    }

    #[test]
    fn long_runs_are_coded_short_and_come_back() {
        let frame = row([0.25, 0.5, 1.0].repeat(1_000));
        let file = encode(&frame).unwrap();
        assert!(file.len() < 200, "{} bytes for 1000 equal pixels", file.len());
        assert_eq!(decoded(&file).2, [0.25, 0.5, 1.0].repeat(1_000));
    }

    #[test]
    fn extremes_are_held_or_become_the_nearest_that_is() {
        for (sent, expected) in [
            (0.0, 0.0),
            (-1.0, 0.0),
            (f32::from_bits(1), 0.0),
            (1e-40, 0.0),
            (1.1e-38, 1.1e-38),
            (1e30, 1e30),
            (1e38, 1e38),
            (f32::MAX, LARGEST),
        ] {
            let got = decoded(&encode(&row(vec![sent; 3])).unwrap()).2;
            assert_close(&[expected; 3], &got);
        }
    }

    proptest! {
        #[test]
        fn any_finite_radiance_comes_back(samples in prop::collection::vec(1e-37f32..1e37, 3..300)) {
            let samples = samples[..samples.len() / 3 * 3].to_vec();
            let got = decoded(&encode(&row(samples.clone())).unwrap()).2;
            assert_close(&samples, &got);
        }
    }
}
