//! NPY: an array of shape (height, width, 3) and type `<f4`, rows from the top.

use crate::{error::EncodeError, pixels, raw};
use npyz::WriterBuilder;
use welkin_scene::{frame::Format, renderer::Frame};

pub(crate) fn encode(frame: &Frame) -> Result<Vec<u8>, EncodeError> {
    let view = pixels::linear(frame, Format::Npy)?;
    let failed = EncodeError::encoder(Format::Npy);
    let header = npyz::WriteOptions::<f32>::new()
        .dtype(npyz::DType::Plain(
            "<f4"
                .parse()
                .map_err(|error: npyz::ParseTypeStrError| failed(error.into()))?,
        ))
        .shape(&[view.height.into(), view.width.into(), 3])
        .writer(Vec::new())
        .write_header_only()
        .map_err(|error| failed(error.into()))?;
    Ok(raw::append(header, view.samples))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use crate::sample;
    use welkin_scene::renderer::Pixels;

    /// Read by the format's specification (numpy.lib.format, version 1.0): magic, version, length of the header,
    /// a Python dictionary padded to a multiple of 64 bytes, then the samples.
    #[test]
    fn numpy_would_read_the_same_array() {
        for (width, height) in sample::SIZES {
            let frame = sample::linear(width, height);
            let file = encode(&frame).unwrap();
            assert_eq!(file[..8], *b"\x93NUMPY\x01\x00");
            let start = 10 + usize::from(u16::from_le_bytes([file[8], file[9]]));
            assert_eq!(start % 64, 0);
            let header = std::str::from_utf8(&file[10..start]).unwrap().replace(' ', "");
            assert!(header.ends_with('\n'));
            for entry in [
                "'descr':'<f4'".to_owned(),
                "'fortran_order':False".to_owned(),
                format!("'shape':({height},{width},3"),
            ] {
                assert!(header.contains(&entry), "{header} lacks {entry}");
            }
            let samples = file[start..]
                .as_chunks::<4>()
                .0
                .iter()
                .map(|word| f32::from_le_bytes(*word))
                .collect();
            assert_eq!(Pixels::Linear(samples), frame.pixels);
        }
    }
}
