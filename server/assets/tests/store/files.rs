//! PNG files made for the tests, and folders for them.

use png::{BitDepth, ColorType, Encoder};
use std::fs;
use tempfile::TempDir;
use welkin_assets::{Asset, Error, Facts, Kind, Limits, Name, PngFacts, Put, Store};

pub(crate) const MAPS: Kind = Kind::WeatherMaps;

pub(crate) fn name(name: &str) -> Name {
    Name::new(name).unwrap()
}

pub(crate) fn store() -> (TempDir, Store) {
    store_of(Limits::default())
}

pub(crate) fn store_of(limits: Limits) -> (TempDir, Store) {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(folder.path(), limits).unwrap();
    (folder, store)
}

/// Puts without a condition.
pub(crate) fn put(store: &Store, to: &str, file: &[u8]) -> Result<(Asset, Put), Error> {
    store.put(MAPS, &name(to), file, |_| true)
}

/// What the header of a weather map says.
pub(crate) fn header(asset: &Asset) -> PngFacts {
    match asset.facts {
        Facts::Picture(picture) => picture,
        other => panic!("{other:?}"),
    }
}

/// A file placed in the folder by other means than the store.
pub(crate) fn plant(folder: &TempDir, file_name: &str, file: &[u8]) {
    fs::create_dir_all(folder.path().join("weather-maps")).unwrap();
    fs::write(folder.path().join("weather-maps").join(file_name), file).unwrap();
}

/// A PNG of samples as they stand in the file.
pub(crate) fn png(
    (width, height): (u32, u32),
    colour: ColorType,
    depth: BitDepth,
    samples: &[u8],
    set: impl FnOnce(&mut Encoder<'_, &mut Vec<u8>>),
) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width, height);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    set(&mut encoder);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(samples).unwrap();
    writer.finish().unwrap();
    file
}

/// A small RGBA picture that differs for each `seed`.
pub(crate) fn small(seed: u8) -> Vec<u8> {
    let samples: Vec<_> = (0..4 * 4 * 4).map(|i| seed.wrapping_add(i)).collect();
    png((4, 4), ColorType::Rgba, BitDepth::Eight, &samples, |_| {})
}

/// A chunk with its length and checksum.
pub(crate) fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let mut chunk = (data.len() as u32).to_be_bytes().to_vec();
    chunk.extend(kind);
    chunk.extend(data);
    let crc = crc32(&chunk[4..]);
    chunk.extend(crc.to_be_bytes());
    chunk
}

/// The checksum of PNG (ISO 3309), bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32| (crc >> 1) ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 };
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| step(crc))
    })
}

/// Signature and header, then whatever follows.
pub(crate) fn headed(width_px: u32, height_px: u32, depth: u8, colour: u8, rest: &[u8]) -> Vec<u8> {
    let mut header = width_px.to_be_bytes().to_vec();
    header.extend(height_px.to_be_bytes());
    header.extend([depth, colour, 0, 0, 0]);
    [b"\x89PNG\r\n\x1a\n".as_slice(), &chunk(b"IHDR", &header), rest].concat()
}
