//! JPEG: 8-bit sRGB, baseline. Exif: `Software`, and `ImageDescription` with the scene document.

use crate::{Options, error::EncodeError, metadata::ascii, pixels};
use exif::{Field, In, Tag, Value, experimental::Writer};
use jpeg_encoder::{ColorType, Encoder, SamplingFactor};
use std::io::Cursor;
use welkin_scene::{frame::Format, renderer::Frame};

/// Exif has one segment of 64 KiB for everything.
const LONGEST_SCENE_BYTES: usize = 60_000;
/// Text is cut here, so that it cannot fill the segment either.
const LONGEST_SOFTWARE_BYTES: usize = 1_000;
/// From this quality on, colour at half resolution would be the worst of the losses.
const FULL_COLOUR_QUALITY: u8 = 90;

pub(crate) fn encode(frame: &Frame, options: &Options) -> Result<Vec<u8>, EncodeError> {
    let view = pixels::display(frame, Format::Jpeg)?;
    let quality = options.jpeg_quality;
    if !(1..=100).contains(&quality) {
        return Err(EncodeError::Quality(quality));
    }
    let failed = EncodeError::encoder(Format::Jpeg);
    let mut out = Vec::new();
    let mut encoder = Encoder::new(&mut out, quality);
    encoder.set_sampling_factor(if quality < FULL_COLOUR_QUALITY {
        SamplingFactor::F_2_2
    } else {
        SamplingFactor::F_1_1
    });
    let exif = exif(options).map_err(|error| failed(error.into()))?;
    encoder
        .add_exif_metadata(&exif)
        .map_err(|error| failed(error.into()))?;
    encoder
        .encode(view.samples, view.width, view.height, ColorType::Rgb)
        .map_err(|error| failed(error.into()))?;
    Ok(out)
}

fn exif(options: &Options) -> Result<Vec<u8>, exif::Error> {
    let mut software = ascii(&options.software);
    software.truncate(LONGEST_SOFTWARE_BYTES);
    let scene = options
        .scene_json
        .as_deref()
        .map(ascii)
        .filter(|scene| scene.len() <= LONGEST_SCENE_BYTES);
    let field = |tag, text: String| Field {
        tag,
        ifd_num: In::PRIMARY,
        value: Value::Ascii(vec![text.into_bytes()]),
    };
    let mut fields = vec![field(Tag::Software, software)];
    fields.extend(scene.map(|scene| field(Tag::ImageDescription, scene)));
    let mut writer = Writer::new();
    fields.iter().for_each(|field| writer.push_field(field));
    let mut out = Cursor::new(Vec::new());
    writer.write(&mut out, true)?;
    Ok(out.into_inner())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use crate::sample;
    use welkin_scene::renderer::Pixels;

    fn decoded(file: &[u8]) -> (u16, u16, Vec<u8>) {
        let mut decoder = jpeg_decoder::Decoder::new(file);
        let pixels = decoder.decode().unwrap();
        let info = decoder.info().unwrap();
        (info.width, info.height, pixels)
    }

    fn tag(file: &[u8], tag: Tag) -> Option<String> {
        let exif = exif::Reader::new()
            .read_from_container(&mut Cursor::new(file))
            .unwrap();
        match &exif.get_field(tag, In::PRIMARY)?.value {
            Value::Ascii(texts) => Some(String::from_utf8(texts.concat()).unwrap()),
            other => panic!("{other:?}"),
        }
    }

    /// 12 of 255 at the worst sample: the corner of the blue channel is a step of 160 that no block border meets.
    /// A flip or a swap of channels is off by 100 and more.
    #[test]
    fn pixels_come_back_in_their_places() {
        for (width, height) in sample::SIZES {
            let frame = sample::display(width, height);
            let Pixels::Display(sent) = &frame.pixels else {
                unreachable!("made for display")
            };
            let file = encode(
                &frame,
                &Options {
                    jpeg_quality: 98,
                    ..Options::default()
                },
            )
            .unwrap();
            let (columns, rows, got) = decoded(&file);
            assert_eq!((columns, rows), (width, height));
            let worst = sent
                .iter()
                .zip(&got)
                .map(|(sent, got)| sent.abs_diff(*got))
                .max()
                .unwrap();
            assert!(worst <= 12, "{width} x {height}: {worst}");
        }
    }

    #[test]
    fn quality_decides_the_colour_resolution_and_the_size() {
        let frame = sample::display(131, 37);
        let lengths = [1, 50, 89, 90, 92, 100].map(|jpeg_quality| {
            let file = encode(
                &frame,
                &Options {
                    jpeg_quality,
                    ..Options::default()
                },
            )
            .unwrap();
            // SOF0: marker, length, precision, height, width, three components; then the sampling of the first.
            let start = file.windows(2).position(|marker| marker == [0xff, 0xc0]).unwrap();
            assert_eq!(
                file[start + 11],
                if jpeg_quality < 90 { 0x22 } else { 0x11 },
                "{jpeg_quality}"
            );
            file.len()
        });
        assert!(lengths.is_sorted(), "{lengths:?}");
        for jpeg_quality in [0, 101, 255] {
            let answer = encode(
                &frame,
                &Options {
                    jpeg_quality,
                    ..Options::default()
                },
            );
            assert!(matches!(answer, Err(EncodeError::Quality(quality)) if quality == jpeg_quality));
        }
    }

    #[test]
    fn text_is_kept_while_it_fits() {
        let frame = sample::display(8, 8);
        let options = |scene: String| Options {
            software: "Welkin é ".repeat(1_000),
            scene_json: Some(scene),
            ..Options::default()
        };
        let file = encode(&frame, &options("x".repeat(LONGEST_SCENE_BYTES))).unwrap();
        assert_eq!(
            tag(&file, Tag::ImageDescription).unwrap().len(),
            LONGEST_SCENE_BYTES
        );
        assert!(tag(&file, Tag::Software).unwrap().starts_with("Welkin \\u00e9 "));
        let file = encode(&frame, &options("x".repeat(LONGEST_SCENE_BYTES + 1))).unwrap();
        assert_eq!(tag(&file, Tag::ImageDescription), None);
        assert_eq!(decoded(&file).0, 8);
    }
}
