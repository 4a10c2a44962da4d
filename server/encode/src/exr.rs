//! OpenEXR: one part, channels R G B, scan lines with ZIP over 16 of them, as every reader expects.
//!
//! Attributes: `chromaticities` of Rec. 709; `software`; `sunAzimuthDeg`, `sunElevationDeg` and `sunIrradiance`
//! (R G B, W/m², at the observer on a plane that faces the sun); the same three of the moon, `moonAzimuthDeg` and so on,
//! where there is one; `radianceUnit`; `scene`; `clampedSamples`.

use crate::{
    Options,
    error::EncodeError,
    metadata::ascii,
    pixels::{self, View},
};
use exr::prelude::*;
use std::io::Cursor;
use welkin_scene::{
    frame::Format,
    renderer::{Frame, FrameFacts},
};

/// ITU-R BT.709-6, table 1.
pub(crate) const REC_709: attribute::Chromaticities = attribute::Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.30, 0.60),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.3290),
};

/// Half floats. Magnitudes above the largest half become that value and are counted in `clampedSamples`; the half
/// beyond it is infinity, which spreads through every filter that touches it.
pub(crate) fn encode_half(frame: &Frame, options: &Options) -> std::result::Result<Vec<u8>, EncodeError> {
    let view = pixels::linear(frame, Format::Exr)?;
    let largest = f16::MAX.to_f32();
    let clamped = view
        .samples
        .iter()
        .filter(|sample| sample.abs() > largest)
        .count();
    let mut attributes = attributes(&frame.facts, options);
    let clamped = AttributeValue::I32(i32::try_from(clamped).unwrap_or(i32::MAX));
    attributes.other.insert(Text::from("clampedSamples"), clamped);
    write(&view, Format::Exr, attributes, move |sample| {
        f16::from_f32(sample.clamp(-largest, largest))
    })
}

/// 32-bit floats, exact.
pub(crate) fn encode_float(frame: &Frame, options: &Options) -> std::result::Result<Vec<u8>, EncodeError> {
    let view = pixels::linear(frame, Format::ExrFloat)?;
    write(
        &view,
        Format::ExrFloat,
        attributes(&frame.facts, options),
        |sample| sample,
    )
}

/// Samples are converted as the blocks are compressed, so the frame is never copied whole.
fn write<T: IntoSample>(
    view: &View<'_, f32>,
    format: Format,
    attributes: LayerAttributes,
    convert: impl Fn(f32) -> T + Sync,
) -> std::result::Result<Vec<u8>, EncodeError> {
    let columns = view.columns();
    let channels = SpecificChannels::rgb(|Vec2(x, y): Vec2<usize>| {
        let at = 3 * (y * columns + x);
        (
            convert(view.samples[at]),
            convert(view.samples[at + 1]),
            convert(view.samples[at + 2]),
        )
    });
    let layer = Layer::new(
        (columns, view.rows()),
        attributes,
        Encoding::SMALL_LOSSLESS,
        channels,
    );
    let mut image = Image::from_layer(layer);
    image.attributes.chromaticities = Some(REC_709);
    let mut out = Cursor::new(Vec::new());
    image
        .write()
        .to_buffered(&mut out)
        .map_err(|error| EncodeError::encoder(format)(error.into()))?;
    Ok(out.into_inner())
}

#[allow(
    clippy::cast_possible_truncation,
    reason = "EXR's vectors are of 32-bit floats"
)]
pub(crate) fn attributes(facts: &FrameFacts, options: &Options) -> LayerAttributes {
    let text = |text: &str| Text::from(ascii(text).as_str());
    let sun = facts.sun;
    let [r, g, b] = facts.sun_irradiance_w_m2.map(|value| value as f32);
    let mut attributes = LayerAttributes {
        software_name: Some(text(&options.software)),
        ..Default::default()
    };
    let mut add = |name: &str, value| attributes.other.insert(Text::from(name), value);
    add("sunAzimuthDeg", AttributeValue::F32(sun.azimuth_deg as f32));
    add("sunElevationDeg", AttributeValue::F32(sun.elevation_deg as f32));
    add("sunIrradiance", AttributeValue::FloatVec3((r, g, b)));
    if let Some(moon) = facts.moon {
        let [r, g, b] = facts.moon_irradiance_w_m2.map(|value| value as f32);
        add("moonAzimuthDeg", AttributeValue::F32(moon.azimuth_deg as f32));
        add("moonElevationDeg", AttributeValue::F32(moon.elevation_deg as f32));
        add("moonIrradiance", AttributeValue::FloatVec3((r, g, b)));
    }
    add("radianceUnit", AttributeValue::Text(Text::from("W m^-2 sr^-1")));
    if let Some(scene) = &options.scene_json {
        add("scene", AttributeValue::Text(text(scene)));
    }
    attributes
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use crate::sample;
    use welkin_scene::renderer::Pixels;

    type Decoded = Image<Layer<AnyChannels<FlatSamples>>>;

    fn decoded(file: &[u8]) -> Decoded {
        let reader = read().no_deep_data().largest_resolution_level().all_channels();
        reader
            .first_valid_layer()
            .all_attributes()
            .from_buffered(Cursor::new(file))
            .unwrap()
    }

    /// Samples in the order of the frame.
    fn samples(image: &Decoded) -> Vec<f32> {
        let channels = &image.layer_data.channel_data.list;
        let names: Vec<_> = channels.iter().map(|channel| channel.name.to_string()).collect();
        assert_eq!(names, ["B", "G", "R"], "OpenEXR wants channels sorted by name");
        let count = image.layer_data.size.area();
        let pixel = |at| {
            [2, 1, 0].map(|channel: usize| channels[channel].sample_data.value_by_flat_index(at).to_f32())
        };
        (0..count).flat_map(pixel).collect()
    }

    fn sent(frame: &Frame) -> &[f32] {
        let Pixels::Linear(samples) = &frame.pixels else {
            unreachable!("made linear")
        };
        samples
    }

    #[test]
    fn floats_come_back_exactly() {
        for (width, height) in sample::SIZES {
            let frame = sample::linear(width, height);
            let image = decoded(&encode_float(&frame, &Options::default()).unwrap());
            assert_eq!(image.layer_data.size, Vec2(width.into(), height.into()));
            assert_eq!(samples(&image), sent(&frame));
        }
    }

    #[test]
    fn halves_come_back_rounded_to_nearest() {
        for (width, height) in sample::SIZES {
            let frame = sample::linear(width, height);
            let image = decoded(&encode_half(&frame, &Options::default()).unwrap());
            for (sent, got) in sent(&frame).iter().zip(samples(&image)) {
                // A half has 11 significant bits, so rounding moves a value by at most 2^-12 of its power of two.
                assert!((sent - got).abs() <= sent * 2f32.powi(-11), "{sent} became {got}");
            }
        }
    }

    #[test]
    fn samples_beyond_halves_are_clamped_and_counted() {
        let mut frame = sample::linear(3, 1);
        frame.pixels = Pixels::Linear(vec![
            65_504.0, 65_519.0, 7e4, 1e30, -1e9, 2.8e4, 0.0, 1e-9, 6.1e-5,
        ]);
        let image = decoded(&encode_half(&frame, &Options::default()).unwrap());
        let got = samples(&image);
        assert_eq!(
            got[..8],
            [
                65_504.0, 65_504.0, 65_504.0, 65_504.0, -65_504.0, 28_000.0, 0.0, 0.0
            ]
        );
        let count = &image.layer_data.attributes.other[&Text::from("clampedSamples")];
        assert_eq!(*count, AttributeValue::I32(4));
        let image = decoded(&encode_float(&frame, &Options::default()).unwrap());
        assert_eq!(samples(&image), sent(&frame));
    }

    #[test]
    fn the_header_says_what_the_numbers_are() {
        let frame = sample::linear(17, 3);
        let options = Options {
            scene_json: Some("{\"name\":\"é\"}".to_owned()),
            ..Options::default()
        };
        for file in [
            encode_half(&frame, &options).unwrap(),
            encode_float(&frame, &options).unwrap(),
        ] {
            let image = decoded(&file);
            let attributes = &image.layer_data.attributes;
            assert_eq!(image.attributes.chromaticities, Some(REC_709));
            assert_eq!(
                attributes.software_name,
                Some(Text::from(options.software.as_str()))
            );
            assert_eq!(
                attributes.layer_name, None,
                "a named layer hides the channels' plain names"
            );
            for (name, value) in [
                ("sunAzimuthDeg", AttributeValue::F32(123.25)),
                ("sunElevationDeg", AttributeValue::F32(-4.5)),
                ("sunIrradiance", AttributeValue::FloatVec3((1.5, 1.25, 0.75))),
                ("moonAzimuthDeg", AttributeValue::F32(40.5)),
                ("moonElevationDeg", AttributeValue::F32(30.25)),
                ("moonIrradiance", AttributeValue::FloatVec3((4e-6, 3e-6, 2e-6))),
                ("radianceUnit", AttributeValue::Text(Text::from("W m^-2 sr^-1"))),
                (
                    "scene",
                    AttributeValue::Text(Text::from("{\"name\":\"\\u00e9\"}")),
                ),
            ] {
                assert_eq!(attributes.other[&Text::from(name)], value, "{name}");
            }
        }
    }
}
