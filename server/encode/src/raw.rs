//! Raw: 32-bit little-endian floats, R G B, rows from the top, nothing else.

use crate::{error::EncodeError, pixels};
use welkin_scene::{frame::Format, renderer::Frame};

pub(crate) fn encode(frame: &Frame) -> Result<Vec<u8>, EncodeError> {
    Ok(append(Vec::new(), pixels::linear(frame, Format::Raw)?.samples))
}

/// The samples as little-endian bytes behind a header.
pub(crate) fn append(header: Vec<u8>, samples: &[f32]) -> Vec<u8> {
    let start = header.len();
    let mut out = header;
    out.resize(start + size_of_val(samples), 0);
    let (words, _) = out[start..].as_chunks_mut::<4>();
    for (word, sample) in words.iter_mut().zip(samples) {
        *word = sample.to_le_bytes();
    }
    out
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use crate::sample;
    use welkin_scene::renderer::Pixels;

    #[test]
    fn samples_are_little_endian_floats_and_nothing_else() {
        let mut frame = sample::linear(1, 1);
        frame.pixels = Pixels::Linear(vec![1.0, -2.0, 0.0]);
        assert_eq!(
            encode(&frame).unwrap(),
            [0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0, 0, 0, 0, 0]
        );
        for (width, height) in sample::SIZES {
            let frame = sample::linear(width, height);
            let file = encode(&frame).unwrap();
            let samples = file
                .as_chunks::<4>()
                .0
                .iter()
                .map(|word| f32::from_le_bytes(*word))
                .collect();
            assert_eq!(Pixels::Linear(samples), frame.pixels);
        }
    }
}
