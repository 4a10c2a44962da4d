//! PNG: 8-bit sRGB, lossless. Text: `Software`, and `Scene` with the scene document.

use crate::{
    Options,
    error::EncodeError,
    metadata::ascii,
    pixels::{self, View},
};
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, SrgbRenderingIntent};
use welkin_scene::{frame::Format, renderer::Frame};

pub(crate) fn encode(frame: &Frame, options: &Options) -> Result<Vec<u8>, EncodeError> {
    let view = pixels::display(frame, Format::Png)?;
    write(&view, options).map_err(|error| EncodeError::encoder(Format::Png)(error.into()))
}

fn write(view: &View<'_, u8>, options: &Options) -> Result<Vec<u8>, EncodingError> {
    let mut out = Vec::new();
    let mut encoder = Encoder::new(&mut out, view.width.into(), view.height.into());
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    encoder.add_text_chunk("Software".to_owned(), ascii(&options.software))?;
    if let Some(scene) = &options.scene_json {
        encoder.add_text_chunk("Scene".to_owned(), ascii(scene))?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(view.samples)?;
    writer.finish()?;
    Ok(out)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use crate::sample;
    use std::io::Cursor;
    use welkin_scene::renderer::Pixels;

    #[test]
    fn every_pixel_comes_back_with_srgb_and_text() {
        for (width, height) in sample::SIZES {
            let frame = sample::display(width, height);
            let options = Options {
                scene_json: Some("{\"name\":\"é\"}".to_owned()),
                ..Options::default()
            };
            let file = encode(&frame, &options).unwrap();
            let mut reader = png::Decoder::new(Cursor::new(file)).read_info().unwrap();
            let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
            let info = reader.next_frame(&mut pixels).unwrap();
            assert_eq!((info.width, info.height), (width.into(), height.into()));
            assert_eq!(
                (info.color_type, info.bit_depth),
                (ColorType::Rgb, BitDepth::Eight)
            );
            assert_eq!(Pixels::Display(pixels), frame.pixels);
            assert_eq!(reader.info().srgb, Some(SrgbRenderingIntent::Perceptual));
            let text = &reader.info().uncompressed_latin1_text;
            let text: Vec<_> = text
                .iter()
                .map(|chunk| (chunk.keyword.as_str(), chunk.text.as_str()))
                .collect();
            assert_eq!(
                text,
                [
                    ("Software", options.software.as_str()),
                    ("Scene", "{\"name\":\"\\u00e9\"}")
                ]
            );
        }
    }
}
