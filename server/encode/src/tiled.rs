//! Large pictures as tiled OpenEXR, put together from tiles one at a time, so that memory holds one of them.

use crate::{
    Options,
    error::EncodeError,
    exr::{REC_709, attributes},
};
use exr::prelude::*;
use std::{
    io::{Cursor, Seek, Write},
    sync::{Mutex, PoisonError},
};
use welkin_scene::{frame::Format, renderer::FrameFacts};

/// How a large picture is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tiles {
    /// Width of the whole, pixels.
    pub width_px: u32,
    /// Height of the whole, pixels.
    pub height_px: u32,
    /// Side of a tile, pixels; those at the right and bottom edges are cut.
    pub tile_px: u32,
}

/// Gives the radiance of a tile by its number, rows of tiles from the top: R G B of each pixel, rows from the top.
type TileSource<'a> = dyn FnMut(u32) -> std::result::Result<Vec<f32>, String> + Send + 'a;

struct Current<'a> {
    source: Box<TileSource<'a>>,
    tile: Option<(u32, Vec<f32>)>,
    fault: Option<String>,
}

/// Writes one file: channels R G B as halves, or as 32-bit floats where the format says so, ZIP in tiles. The
/// attributes are those of a frame, but for the count of clamped samples.
///
/// # Errors
/// [`EncodeError`] where a tile cannot be had or is of another size, or the file cannot be written.
pub fn write_tiled_exr<'a>(
    to: impl Write + Seek,
    tiles: Tiles,
    format: Format,
    facts: &FrameFacts,
    options: &Options,
    source: impl FnMut(u32) -> std::result::Result<Vec<f32>, String> + Send + 'a,
) -> std::result::Result<(), EncodeError> {
    let current = Mutex::new(Current {
        source: Box::new(source),
        tile: None,
        fault: None,
    });
    let attributes = attributes(facts, options);
    let written = if format == Format::ExrFloat {
        write(to, tiles, attributes, |Vec2(x, y)| sample(&current, tiles, x, y))
    } else {
        let half = f16::from_f32;
        write(to, tiles, attributes, |Vec2(x, y)| {
            let (r, g, b) = sample(&current, tiles, x, y);
            (half(r), half(g), half(b))
        })
    };
    let fault = current.into_inner().unwrap_or_else(PoisonError::into_inner).fault;
    if let Some(fault) = fault {
        return Err(EncodeError::encoder(format)(fault.into()));
    }
    written.map_err(|error| EncodeError::encoder(format)(error.into()))
}

fn write<T: IntoSample>(
    to: impl Write + Seek,
    tiles: Tiles,
    attributes: LayerAttributes,
    pixel: impl Fn(Vec2<usize>) -> (T, T, T) + Sync,
) -> exr::error::UnitResult {
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::Tiles(Vec2(tiles.tile_px as usize, tiles.tile_px as usize)),
        line_order: LineOrder::Increasing,
    };
    let size = (tiles.width_px as usize, tiles.height_px as usize);
    let layer = Layer::new(size, attributes, encoding, SpecificChannels::rgb(pixel));
    let mut image = Image::from_layer(layer);
    image.attributes.chromaticities = Some(REC_709);
    // One block after the other, in the order of the tiles: each tile is asked for once.
    image.write().non_parallel().to_buffered(to)
}

/// A pixel of the tile that it lies in.
fn sample(current: &Mutex<Current<'_>>, tiles: Tiles, x: usize, y: usize) -> (f32, f32, f32) {
    let side = tiles.tile_px as usize;
    let (column, row) = (x / side, y / side);
    let width = side.min(tiles.width_px as usize - column * side);
    let height = side.min(tiles.height_px as usize - row * side);
    let across = tiles.width_px.div_ceil(tiles.tile_px) as usize;
    let number = u32::try_from(row * across + column).unwrap_or(u32::MAX);
    let mut current = current.lock().unwrap_or_else(PoisonError::into_inner);
    if current.tile.as_ref().is_none_or(|(known, _)| *known != number) {
        let samples = match (current.source)(number) {
            Ok(samples) if samples.len() == 3 * width * height => samples,
            other => {
                let fault = match other {
                    Ok(samples) => format!("tile {number} has {} samples", samples.len()),
                    Err(fault) => fault,
                };
                current.fault.get_or_insert(fault);
                vec![0.0; 3 * width * height]
            }
        };
        current.tile = Some((number, samples));
    }
    let at = 3 * ((y - row * side) * width + (x - column * side));
    match current
        .tile
        .as_ref()
        .and_then(|(_, samples)| samples.get(at..at + 3))
    {
        Some([r, g, b]) => (*r, *g, *b),
        _ => (0.0, 0.0, 0.0),
    }
}

/// Reads a file that [`encode`](crate::encode) has written: its width and height in pixels, and R G B of each pixel.
///
/// # Errors
/// [`EncodeError`] where it is no such file.
pub fn decode_exr(file: &[u8]) -> std::result::Result<(usize, usize, Vec<f32>), EncodeError> {
    let failed = |error: Error| EncodeError::encoder(Format::Exr)(error.into());
    let set = |image: &mut (usize, usize, Vec<f32>), Vec2(x, y): Vec2<usize>, (r, g, b): (f32, f32, f32)| {
        let at = 3 * (y * image.0 + x);
        image.2[at..at + 3].copy_from_slice(&[r, g, b]);
    };
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size: Vec2<usize>, _: &RgbChannels| (size.width(), size.height(), vec![0.0; 3 * size.area()]),
            set,
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(file))
        .map_err(failed)?;
    Ok(image.layer_data.channel_data.pixels)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use crate::{encode, sample};
    use welkin_scene::renderer::Pixels;

    fn cut(all: &[f32], tiles: Tiles, number: u32) -> Vec<f32> {
        let across = tiles.width_px.div_ceil(tiles.tile_px);
        let (left, top) = (number % across * tiles.tile_px, number / across * tiles.tile_px);
        let (right, bottom) = (
            (left + tiles.tile_px).min(tiles.width_px),
            (top + tiles.tile_px).min(tiles.height_px),
        );
        let row = |y: u32| {
            let at = |x: u32| 3 * (y * tiles.width_px + x) as usize;
            all[at(left)..at(right)].to_vec()
        };
        (top..bottom).flat_map(row).collect()
    }

    #[test]
    fn tiles_come_back_as_one_picture_each_asked_for_once() {
        for (width_px, height_px, tile_px) in [(64, 32, 16), (50, 33, 16), (7, 5, 16), (48, 48, 48)] {
            let frame = sample::linear(width_px, height_px);
            let (width_px, height_px) = (u32::from(width_px), u32::from(height_px));
            let Pixels::Linear(all) = &frame.pixels else {
                unreachable!("made linear")
            };
            let tiles = Tiles {
                width_px,
                height_px,
                tile_px,
            };
            let mut asked = Vec::new();
            let mut file = Cursor::new(Vec::new());
            let source = |number| {
                asked.push(number);
                Ok(cut(all, tiles, number))
            };
            write_tiled_exr(
                &mut file,
                tiles,
                Format::ExrFloat,
                &frame.facts,
                &Options::default(),
                source,
            )
            .unwrap();
            let (width, height, samples) = decode_exr(file.get_ref()).unwrap();
            assert_eq!((width, height), (width_px as usize, height_px as usize));
            assert_eq!(&samples, all);
            let count = width_px.div_ceil(tile_px) * height_px.div_ceil(tile_px);
            assert_eq!(asked, (0..count).collect::<Vec<_>>());
            let meta = exr::meta::MetaData::read_from_buffered(file.get_ref().as_slice(), true).unwrap();
            assert!(matches!(
                meta.headers[0].blocks,
                exr::meta::BlockDescription::Tiles(_)
            ));
        }
    }

    #[test]
    fn halves_are_those_of_a_frame() {
        let frame = sample::linear(20, 10);
        let whole = encode(&frame, Format::Exr, &Options::default()).unwrap();
        let (_, _, all) = decode_exr(&whole).unwrap();
        let tiles = Tiles {
            width_px: 20,
            height_px: 10,
            tile_px: 16,
        };
        let mut file = Cursor::new(Vec::new());
        let source = |number| Ok(cut(&all, tiles, number));
        write_tiled_exr(
            &mut file,
            tiles,
            Format::Exr,
            &frame.facts,
            &Options::default(),
            source,
        )
        .unwrap();
        assert_eq!(decode_exr(file.get_ref()).unwrap().2, all);
    }

    #[test]
    fn a_tile_that_cannot_be_had_is_an_error() {
        let frame = sample::linear(20, 10);
        let tiles = Tiles {
            width_px: 20,
            height_px: 10,
            tile_px: 16,
        };
        let write = |source: &mut (dyn FnMut(u32) -> std::result::Result<Vec<f32>, String> + Send)| {
            write_tiled_exr(
                Cursor::new(Vec::new()),
                tiles,
                Format::Exr,
                &frame.facts,
                &Options::default(),
                source,
            )
        };
        let lost = write(&mut |_| Err("lost".into())).unwrap_err();
        assert!(format!("{lost:?}").contains("lost"), "{lost:?}");
        assert!(write(&mut |_| Ok(vec![0.0; 3])).is_err());
    }
}
