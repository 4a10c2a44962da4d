//! GeoTIFF: one band of numbers, metres, with the size of its pixels where the tags tell.

use super::{check_sides, shares};
use crate::Error;
use std::io::Cursor;
use tiff::{
    ColorType,
    decoder::{Decoder, DecodingResult, Limits},
    tags::Tag,
};
use welkin_scene::HeightGrid;

/// Metres of one degree of latitude on a sphere of the Earth's mean radius, 6371008.8 m × π / 180.
const DEGREE_M: f64 = 111_195.08;
/// The longest list that a tag may hold, bytes.
const MOST_TAG_BYTES: usize = 4 << 20;
/// One chunk of the picture, and all of it, bytes: 64-bit numbers on the longest sides.
const MOST_BYTES: usize = 128 << 20;

// Keys of the GeoKey directory (OGC 19-008r4), and the values that count here.
const MODEL_TYPE: u16 = 1024;
const GEOGRAPHIC: u16 = 2;
const LINEAR_UNITS: u16 = 3076;

pub(super) fn read(file: &[u8], digest: [u8; 32]) -> Result<HeightGrid, Error> {
    let mut limits = Limits::default();
    limits.decoding_buffer_size = MOST_BYTES;
    limits.intermediate_buffer_size = MOST_BYTES;
    limits.ifd_value_size = MOST_TAG_BYTES;
    let mut picture = Decoder::new(Cursor::new(file))
        .map_err(Error::damaged)?
        .with_limits(limits);
    let (width, height) = picture.dimensions().map_err(Error::damaged)?;
    check_sides(width, height)?;
    let colour = picture.colortype().map_err(Error::damaged)?;
    if !matches!(colour, ColorType::Gray(_)) {
        return Err(Error::refused(format!(
            "its pixels are {colour:?}: heights are one band of numbers"
        )));
    }
    let extent_m = extent_m(&mut picture, [width, height]);
    let unknown = unknown(&mut picture);
    let numbers = numbers(picture.read_image().map_err(Error::damaged)?)?;
    if numbers.len() as u64 != u64::from(width) * u64::from(height) {
        return Err(Error::damaged("it has not as many pixels as it says"));
    }
    // The mark is written as decimals of the number that the pixels hold, be it of 32 bits.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "compared as the pixels were rounded"
    )]
    let is_unknown = |height: f64| {
        unknown.is_some_and(|mark| {
            height == mark || height as f32 == mark as f32 || height.is_nan() && mark.is_nan()
        })
    };
    let (heights, range_m) = shares(&numbers, width, is_unknown)?;
    Ok(HeightGrid {
        width,
        height,
        heights: heights.into(),
        range_m: Some(range_m),
        extent_m,
        digest,
    })
}

fn numbers(picture: DecodingResult) -> Result<Vec<f64>, Error> {
    fn wide<T: Into<f64>>(numbers: Vec<T>) -> Vec<f64> {
        numbers.into_iter().map(Into::into).collect()
    }
    Ok(match picture {
        DecodingResult::U8(numbers) => wide(numbers),
        DecodingResult::I8(numbers) => wide(numbers),
        DecodingResult::U16(numbers) => wide(numbers),
        DecodingResult::I16(numbers) => wide(numbers),
        DecodingResult::U32(numbers) => wide(numbers),
        DecodingResult::I32(numbers) => wide(numbers),
        DecodingResult::F32(numbers) => wide(numbers),
        DecodingResult::F64(numbers) => numbers,
        _ => {
            return Err(Error::refused(
                "its numbers are of a type that no heights are: integers up to 32 bits and floats of 32 or 64 are read",
            ));
        }
    })
}

/// What stands where no height is known (GDAL's tag).
fn unknown(picture: &mut Decoder<Cursor<&[u8]>>) -> Option<f64> {
    let mark = picture.get_tag_ascii_string(Tag::GdalNodata).ok()?;
    mark.trim_matches(['\0', ' ', '\n']).parse().ok()
}

/// From the first pixel's middle to the last one's.
fn extent_m(picture: &mut Decoder<Cursor<&[u8]>>, sides_px: [u32; 2]) -> Option<[f64; 2]> {
    let scale = picture.get_tag_f64_vec(Tag::ModelPixelScaleTag).ok()?;
    let steps = sides_px.map(|side| f64::from(side) - 1.0);
    let [x, y] = [scale.first()? * steps[0], scale.get(1)? * steps[1]];
    let extent_m = if key(picture, MODEL_TYPE) == Some(GEOGRAPHIC) {
        // Pixel and place of one point: i, j, k, longitude, latitude, height.
        let tie = picture.get_tag_f64_vec(Tag::ModelTiepointTag).ok()?;
        let middle_deg = tie.get(4)? - scale[1] * (f64::from(sides_px[1]) / 2.0 - tie[1]);
        [x * DEGREE_M * middle_deg.to_radians().cos(), y * DEGREE_M]
    } else {
        let metres = match key(picture, LINEAR_UNITS) {
            None | Some(9001) => 1.0,
            Some(9002) => 0.3048,
            Some(9003) => 1200.0 / 3937.0,
            Some(_) => return None,
        };
        [x * metres, y * metres]
    };
    extent_m
        .iter()
        .all(|side| (1e-3..1e9).contains(side))
        .then_some(extent_m)
}

/// A short value of the GeoKey directory: after a head of four numbers, four numbers a key.
fn key(picture: &mut Decoder<Cursor<&[u8]>>, wanted: u16) -> Option<u16> {
    let directory = picture.get_tag_u16_vec(Tag::GeoKeyDirectoryTag).ok()?;
    let (keys, _) = directory.get(4..)?.as_chunks::<4>();
    keys.iter()
        .find(|[key, place, ..]| *key == wanted && *place == 0)
        .map(|[.., value]| *value)
}
