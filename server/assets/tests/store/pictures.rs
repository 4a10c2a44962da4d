//! Every form that PNG has, as the renderer gets it.

use crate::files::{MAPS, chunk, header, name, png, put, small, store};
use png::{BitDepth, ColorType};
use welkin_assets::{Colour, Put, Store};

fn rgba(store: &Store, file: &[u8]) -> Vec<u8> {
    let (asset, _) = put(store, "map", file).unwrap();
    let picture = store.weather_picture(&name("map")).unwrap();
    assert_eq!(picture.digest, asset.digest);
    assert_eq!(
        (picture.width_px, picture.height_px),
        (header(&asset).width_px, header(&asset).height_px)
    );
    picture.rgba.to_vec()
}

#[test]
fn every_colour_and_depth_becomes_rgba() {
    let (_folder, store) = store();
    let of = |colour, depth, samples: &[u8]| rgba(&store, &png((2, 1), colour, depth, samples, |_| {}));
    let grey = [10, 10, 10, 255, 200, 200, 200, 255];
    assert_eq!(of(ColorType::Grayscale, BitDepth::Eight, &[10, 200]), grey);
    assert_eq!(
        of(ColorType::GrayscaleAlpha, BitDepth::Eight, &[10, 1, 200, 2]),
        [10, 10, 10, 1, 200, 200, 200, 2]
    );
    assert_eq!(
        of(ColorType::Rgb, BitDepth::Eight, &[1, 2, 3, 4, 5, 6]),
        [1, 2, 3, 255, 4, 5, 6, 255]
    );
    let eight = [1, 2, 3, 4, 5, 6, 7, 8];
    assert_eq!(of(ColorType::Rgba, BitDepth::Eight, &eight), eight);
    // Two pixels of one bit: 1, 0; of two: 3, 1; of four: 15, 3.
    for (depth, byte, levels) in [
        (BitDepth::One, 0b1000_0000, [255, 0]),
        (BitDepth::Two, 0b1101_0000, [255, 85]),
        (BitDepth::Four, 0xf3, [255, 51]),
    ] {
        let [a, b] = levels;
        assert_eq!(
            of(ColorType::Grayscale, depth, &[byte]),
            [a, a, a, 255, b, b, b, 255]
        );
    }
}

#[test]
fn sixteen_bits_are_rounded_to_the_nearest_of_eight() {
    let (_folder, store) = store();
    for high in 0..=255_u16 {
        // Exact at multiples of 257, and to either side as far as the rounding goes.
        let exact = high * 257;
        let near = [exact.saturating_sub(128), exact, exact.saturating_add(128)];
        let samples: Vec<_> = near.iter().flat_map(|sample| sample.to_be_bytes()).collect();
        let file = png((3, 1), ColorType::Grayscale, BitDepth::Sixteen, &samples, |_| {});
        let high = high as u8;
        assert_eq!(rgba(&store, &file), [high, high, high, 255].repeat(3), "{exact}");
    }
    let samples = [0xffff_u16, 0, 0x8080, 0x0101].map(u16::to_be_bytes).concat();
    let file = png((1, 1), ColorType::Rgba, BitDepth::Sixteen, &samples, |_| {});
    assert_eq!(rgba(&store, &file), [255, 0, 128, 1]);
}

#[test]
fn palettes_and_transparent_colours_are_looked_up() {
    let (_folder, store) = store();
    let palette = png(
        (2, 1),
        ColorType::Indexed,
        BitDepth::Two,
        &[0b0110_0000],
        |encoder| {
            encoder.set_palette(&[1, 1, 1, 2, 2, 2, 3, 4, 5][..]);
            encoder.set_trns(&[255, 7][..]);
        },
    );
    assert_eq!(rgba(&store, &palette), [2, 2, 2, 7, 3, 4, 5, 255]);
    let keyed = png(
        (2, 1),
        ColorType::Rgb,
        BitDepth::Eight,
        &[1, 2, 3, 4, 5, 6],
        |encoder| {
            encoder.set_trns(&[0, 4, 0, 5, 0, 6][..]);
        },
    );
    assert_eq!(rgba(&store, &keyed), [1, 2, 3, 255, 4, 5, 6, 0]);
}

/// 3 x 2 grey pixels interlaced by hand. Of Adam7's seven passes, four have pixels here: pass 1 has (0,0), pass 4
/// (2,0), pass 6 (1,0), pass 7 the row y = 1.
#[test]
fn interlaced_files_are_put_in_order() {
    let (_folder, store) = store();
    let scanlines = [0, 10, 0, 30, 0, 20, 0, 40, 50, 60];
    let mut header = 3_u32.to_be_bytes().to_vec();
    header.extend(2_u32.to_be_bytes());
    header.extend([8, 0, 0, 0, 1]);
    let file = [
        b"\x89PNG\r\n\x1a\n".as_slice(),
        &chunk(b"IHDR", &header),
        &chunk(b"IDAT", &stored(&scanlines)),
        &chunk(b"IEND", &[]),
    ]
    .concat();
    let greys: Vec<_> = rgba(&store, &file).chunks(4).map(|pixel| pixel[0]).collect();
    assert_eq!(greys, [10, 20, 30, 40, 50, 60]);
}

/// A zlib stream (RFC 1950) of one stored block (RFC 1951 §3.2.4).
fn stored(data: &[u8]) -> Vec<u8> {
    let length = data.len() as u16;
    let mut stream = vec![0x78, 0x01, 1];
    stream.extend(length.to_le_bytes());
    stream.extend((!length).to_le_bytes());
    stream.extend(data);
    let (a, b) = data.iter().fold((1_u32, 0_u32), |(a, b), &byte| {
        let a = (a + u32::from(byte)) % 65_521;
        (a, (b + a) % 65_521)
    });
    stream.extend((b << 16 | a).to_be_bytes());
    stream
}

#[test]
fn of_an_animation_the_first_frame_is_taken() {
    let (_folder, store) = store();
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 2, 1);
    encoder.set_color(ColorType::Grayscale);
    encoder.set_animated(2, 0).unwrap();
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&[1, 2]).unwrap();
    writer.write_image_data(&[3, 4]).unwrap();
    writer.finish().unwrap();
    assert_eq!(rgba(&store, &file), [1, 1, 1, 255, 2, 2, 2, 255]);
}

#[test]
fn the_largest_side_is_taken_and_one_more_is_not() {
    let (_folder, store) = store();
    let line = |width: u32| {
        let samples = vec![0; width.div_ceil(8) as usize];
        png((width, 1), ColorType::Grayscale, BitDepth::One, &samples, |_| {})
    };
    assert_eq!(rgba(&store, &line(4096)).len(), 4096 * 4);
    let error = put(&store, "map", &line(4097)).unwrap_err().to_string();
    assert!(error.contains("4097 x 1") && error.contains("4096"), "{error}");
}

#[test]
fn files_are_kept_byte_by_byte_with_what_the_header_says() {
    let (folder, store) = store();
    // A text that no picture needs, and bytes after the end.
    let mut file = png((1, 2), ColorType::Rgb, BitDepth::Eight, &[1; 6], |encoder| {
        encoder.add_text_chunk("Title".into(), "A front".into()).unwrap();
    });
    file.extend(b"and more");
    let (asset, done) = put(&store, "front", &file).unwrap();
    assert_eq!(done, Put::Created);
    assert_eq!(
        (header(&asset).colour, header(&asset).bit_depth, asset.bytes),
        (Colour::Rgb, 8, file.len() as u64)
    );
    let (again, kept) = store.file(MAPS, &name("front")).unwrap();
    assert_eq!((again, &kept), (asset, &file));
    assert_eq!(
        std::fs::read(folder.path().join("weather-maps/front.png")).unwrap(),
        file
    );
}

/// The store is one of several that share a folder: what another writes is seen, however alike the files are.
#[test]
fn changes_by_others_are_seen_at_once() {
    let (folder, mine) = store();
    let other = Store::open(folder.path(), mine.limits()).unwrap();
    for seed in 0..20 {
        let (put_asset, _) = put(&other, "map", &small(seed)).unwrap();
        assert_eq!(mine.asset(MAPS, &name("map")).unwrap().unwrap(), put_asset);
        let picture = mine.weather_picture(&name("map")).unwrap();
        assert_eq!(picture.rgba[0], seed);
        assert!(
            std::sync::Arc::ptr_eq(&picture, &mine.weather_picture(&name("map")).unwrap()),
            "decoded once"
        );
    }
    other.delete(MAPS, &name("map"), |_| true).unwrap();
    assert!(mine.weather_picture(&name("map")).is_err());
    assert!(mine.list(MAPS).unwrap().is_empty());
}
