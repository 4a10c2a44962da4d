//! Heightfields in each of their forms, and files that are none.

use crate::files::{name, png, store};
use ::png::{BitDepth, ColorType};
use npyz::WriterBuilder;
use proptest::prelude::*;
use std::{io::Cursor, sync::Arc};
use tiff::{
    encoder::{TiffEncoder, colortype},
    tags::Tag,
};
use welkin_assets::{Error, Facts, Form, Kind, Store};
use welkin_scene::HeightGrid;

const KIND: Kind = Kind::Heightfields;

fn read(store: &Store, file: &[u8]) -> Result<Arc<HeightGrid>, Error> {
    store.put(KIND, &name("it"), file, |_| true)?;
    store.height_grid(&name("it"))
}

fn refused(store: &Store, file: &[u8], told: &str) {
    let error = read(store, file).unwrap_err();
    assert!(!matches!(error, Error::Folder { .. }), "{error}");
    assert!(error.to_string().contains(told), "{error}");
}

fn npy<T: npyz::AutoSerialize + Copy>(shape: &[u64], order: npyz::Order, numbers: &[T]) -> Vec<u8> {
    let mut file = Vec::new();
    let mut writer = npyz::WriteOptions::new()
        .default_dtype()
        .shape(shape)
        .order(order)
        .writer(&mut file)
        .begin_nd()
        .unwrap();
    writer.extend(numbers.iter().copied()).unwrap();
    writer.finish().unwrap();
    file
}

/// What a GeoTIFF's tags say of its place.
#[derive(Default)]
struct Place {
    pixel: Option<[f64; 3]>,
    tie: Option<[f64; 6]>,
    /// Keys and their values.
    keys: Vec<(u16, u16)>,
    unknown: Option<&'static str>,
}

fn geotiff<C>(width: u32, numbers: &[C::Inner], place: &Place) -> Vec<u8>
where
    C: colortype::ColorType,
    [C::Inner]: tiff::encoder::TiffValue,
{
    let mut file = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut file).unwrap();
    let pixels = (numbers.len() / C::BITS_PER_SAMPLE.len()) as u32;
    let mut picture = encoder.new_image::<C>(width, pixels / width).unwrap();
    let tags = picture.encoder();
    if let Some(pixel) = &place.pixel {
        tags.write_tag(Tag::ModelPixelScaleTag, &pixel[..]).unwrap();
    }
    if let Some(tie) = &place.tie {
        tags.write_tag(Tag::ModelTiepointTag, &tie[..]).unwrap();
    }
    let mut directory = vec![1, 1, 0, place.keys.len() as u16];
    directory.extend(place.keys.iter().flat_map(|&(key, value)| [key, 0, 1, value]));
    tags.write_tag(Tag::GeoKeyDirectoryTag, &directory[..]).unwrap();
    if let Some(unknown) = place.unknown {
        tags.write_tag(Tag::GdalNodata, unknown).unwrap();
    }
    picture.write_data(numbers).unwrap();
    file.into_inner()
}

#[test]
fn a_grey_picture_holds_shares_of_the_whole_height() {
    let (folder, store) = store();
    let samples = [0_u16, 1, 0x8000, 0xffff].map(u16::to_be_bytes).concat();
    let file = png((2, 2), ColorType::Grayscale, BitDepth::Sixteen, &samples, |_| {});
    let grid = read(&store, &file).unwrap();
    assert_eq!((grid.width, grid.height), (2, 2));
    // All 65,536 levels are told apart: 24 bits of a float hold them.
    let levels: Vec<_> = grid.heights.iter().map(|height| height * 65535.0).collect();
    assert_eq!(levels, [0.0, 1.0, 32768.0, 65535.0]);
    assert_eq!((grid.range_m, grid.extent_m), (None, None));
    let eight = png(
        (2, 2),
        ColorType::Grayscale,
        BitDepth::Eight,
        &[0, 51, 102, 255],
        |_| {},
    );
    assert_eq!(read(&store, &eight).unwrap().heights[..], [0.0, 0.2, 0.4, 1.0]);
    assert!(folder.path().join("heightfields/it.png").is_file());
    let colours = png((2, 2), ColorType::Rgb, BitDepth::Eight, &[0; 12], |_| {});
    refused(&store, &colours, "colours");
    let line = png((4, 1), ColorType::Grayscale, BitDepth::Eight, &[0; 4], |_| {});
    refused(&store, &line, "4 x 1");
}

#[test]
fn an_array_holds_metres_in_either_order_and_of_any_type() {
    let (_folder, store) = store();
    let rows: [f32; 6] = [100.0, 200.0, 300.0, 400.0, 500.0, 600.0];
    let expected = [0.0, 0.2, 0.4, 0.6, 0.8, 1.0];
    let same = |grid: &HeightGrid| {
        assert_eq!((grid.width, grid.height), (3, 2));
        assert_eq!(grid.range_m, Some([100.0, 600.0]));
        // Shares are rounded to 24 bits.
        assert!(
            grid.heights
                .iter()
                .zip(expected)
                .all(|(a, b)| (a - b).abs() < 1e-7),
            "{grid:?}"
        );
    };
    same(&read(&store, &npy(&[2, 3], npyz::Order::C, &rows)).unwrap());
    same(&read(&store, &npy(&[2, 3], npyz::Order::C, &rows.map(f64::from))).unwrap());
    same(&read(&store, &npy(&[2, 3], npyz::Order::C, &rows.map(|h| h as u16))).unwrap());
    same(&read(&store, &npy(&[2, 3], npyz::Order::C, &rows.map(|h| h as i32))).unwrap());
    let columns = [rows[0], rows[3], rows[1], rows[4], rows[2], rows[5]];
    same(&read(&store, &npy(&[2, 3], npyz::Order::Fortran, &columns)).unwrap());
    let flat = read(&store, &npy(&[2, 2], npyz::Order::C, &[7.0_f32; 4])).unwrap();
    assert_eq!(
        (&flat.heights[..], flat.range_m),
        (&[0.0; 4][..], Some([7.0, 7.0]))
    );
}

#[test]
fn arrays_that_are_no_heights_are_refused() {
    let (_folder, store) = store();
    let of = |shape: &[u64], numbers: &[f32]| npy(shape, npyz::Order::C, numbers);
    refused(&store, &of(&[4], &[0.0; 4]), "1 dimensions");
    refused(&store, &of(&[2, 2, 1], &[0.0; 4]), "3 dimensions");
    refused(&store, &of(&[1, 4], &[0.0; 4]), "4 x 1");
    refused(
        &store,
        &of(&[2, 2], &[0.0, f32::NAN, 0.0, 0.0]),
        "row 0, column 1 is NaN",
    );
    refused(
        &store,
        &of(&[2, 2], &[0.0, 0.0, f32::INFINITY, 0.0]),
        "row 1, column 0 is inf",
    );
    refused(&store, &of(&[2, 2], &[0.0, 0.0, 0.0, -3e38]), "row 1, column 1");
    refused(&store, &npy(&[2, 2], npyz::Order::C, &[0_i64; 4]), "of the type");
    let whole = of(&[2, 2], &[0.0; 4]);
    for length in 0..whole.len() {
        assert!(read(&store, &whole[..length]).is_err(), "{length}");
    }
}

/// Shapes and headers that claim what no machine has.
#[test]
fn arrays_that_claim_too_much_are_refused_by_their_header() {
    let (_folder, store) = store();
    let headed = |shape: &str| {
        let dict = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({shape}), }}");
        let mut file = b"\x93NUMPY\x01\0".to_vec();
        file.extend((dict.len() as u16 + 1).to_le_bytes());
        file.extend(dict.as_bytes());
        file.push(b'\n');
        file
    };
    refused(&store, &headed("4097, 2"), "2 x 4097");
    refused(&store, &headed("1000000, 1000000"), "1000000 x 1000000");
    refused(&store, &headed("4096, 4096"), "damaged");
    for shape in [
        "18446744073709551615, 18446744073709551615",
        "9999999999999999999999, 2",
        "-1, 2",
        "2, x",
    ] {
        assert!(read(&store, &headed(shape)).is_err(), "{shape}");
    }
    let mut long = b"\x93NUMPY\x02\0".to_vec();
    long.extend(u32::MAX.to_le_bytes());
    refused(&store, &long, "4294967295 bytes");
}

#[test]
fn a_geotiff_tells_its_size() {
    let (folder, store) = store();
    let metres = Place {
        pixel: Some([30.0, 20.0, 0.0]),
        keys: vec![(1024, 1), (3076, 9001)],
        ..Place::default()
    };
    let grid = read(
        &store,
        &geotiff::<colortype::Gray16>(3, &[400, 500, 600, 700, 800, 900], &metres),
    )
    .unwrap();
    assert_eq!((grid.width, grid.height), (3, 2));
    assert_eq!(grid.extent_m, Some([60.0, 20.0]));
    assert_eq!(grid.range_m, Some([400.0, 900.0]));
    assert!(folder.path().join("heightfields/it.tif").is_file());
    let asset = store.asset(KIND, &name("it")).unwrap().unwrap();
    assert_eq!(asset.form, Form::Tiff);
    assert!(matches!(asset.facts, Facts::Heights(facts) if facts.extent_m == Some([60.0, 20.0])));
    let feet = Place {
        keys: vec![(1024, 1), (3076, 9002)],
        ..metres
    };
    let grid = read(&store, &geotiff::<colortype::GrayI16>(2, &[-5, 0, 5, 10], &feet)).unwrap();
    // A foot is 0.3048 m; products are rounded.
    let [x, y] = grid.extent_m.unwrap();
    assert!((x - 30.0 * 0.3048).abs() < 1e-12 && (y - 20.0 * 0.3048).abs() < 1e-12);
    assert_eq!(grid.range_m, Some([-5.0, 10.0]));
    // One arc second about 60° north: a degree is half as wide as it is high.
    let degrees = Place {
        pixel: Some([1.0 / 3600.0, 1.0 / 3600.0, 0.0]),
        tie: Some([0.0, 0.0, 0.0, 10.0, 60.0, 0.0]),
        keys: vec![(1024, 2)],
        ..Place::default()
    };
    let grid = read(
        &store,
        &geotiff::<colortype::Gray32Float>(2, &[0.0, 1.0, 2.0, 3.0], &degrees),
    )
    .unwrap();
    let [x, y] = grid.extent_m.unwrap();
    // 30.89 m: the mean radius times an arc second, against 30.82 to 30.93 on the spheroid.
    assert!((y - 30.887).abs() < 1e-3 && (x / y - 0.5).abs() < 1e-4, "{x} {y}");
    let bare = read(
        &store,
        &geotiff::<colortype::Gray8>(2, &[0, 1, 2, 3], &Place::default()),
    )
    .unwrap();
    assert_eq!((bare.extent_m, bare.range_m), (None, Some([0.0, 3.0])));
}

#[test]
fn unknown_heights_lie_as_low_as_the_lowest() {
    let (_folder, store) = store();
    let sea = Place {
        unknown: Some("-32768"),
        ..Place::default()
    };
    let grid = read(
        &store,
        &geotiff::<colortype::GrayI16>(2, &[-32768, 10, 20, 30], &sea),
    )
    .unwrap();
    assert_eq!(
        (&grid.heights[..], grid.range_m),
        (&[0.0, 0.0, 0.5, 1.0][..], Some([10.0, 30.0]))
    );
    // As GDAL writes the least float, in decimals that are none of it exactly.
    let least = Place {
        unknown: Some("-3.40282346638529e+38"),
        ..Place::default()
    };
    let grid = read(
        &store,
        &geotiff::<colortype::Gray32Float>(2, &[f32::MIN, 1.0, 2.0, 3.0], &least),
    )
    .unwrap();
    assert_eq!(grid.range_m, Some([1.0, 3.0]));
    let nan = Place {
        unknown: Some("nan"),
        ..Place::default()
    };
    let grid = read(
        &store,
        &geotiff::<colortype::Gray32Float>(2, &[f32::NAN, 1.0, 2.0, 3.0], &nan),
    )
    .unwrap();
    assert_eq!(grid.range_m, Some([1.0, 3.0]));
    let undeclared = geotiff::<colortype::Gray32Float>(2, &[f32::NAN, 1.0, 2.0, 3.0], &Place::default());
    refused(&store, &undeclared, "row 0, column 0 is NaN");
    let nothing = geotiff::<colortype::GrayI16>(2, &[-32768; 4], &sea);
    refused(&store, &nothing, "no height in it is known");
}

#[test]
fn tiffs_that_are_no_heights_are_refused() {
    let (_folder, store) = store();
    refused(
        &store,
        &geotiff::<colortype::RGB8>(2, &[0; 12], &Place::default()),
        "one band",
    );
    let whole = geotiff::<colortype::Gray16>(2, &[1, 2, 3, 4], &Place::default());
    // The data come first, the directory last.
    for length in 0..whole.len() {
        assert!(read(&store, &whole[..length]).is_err(), "{length}");
    }
    refused(&store, b"{}", "not a heightfield: send a grey PNG");
}

#[test]
fn a_file_of_another_form_takes_the_place() {
    let (folder, store) = store();
    let array = npy(&[2, 2], npyz::Order::C, &[1.0_f32, 2.0, 3.0, 4.0]);
    read(&store, &array).unwrap();
    let picture = png((2, 2), ColorType::Grayscale, BitDepth::Eight, &[9; 4], |_| {});
    read(&store, &picture).unwrap();
    let there: Vec<_> = std::fs::read_dir(folder.path().join("heightfields"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    assert_eq!(there, ["it.png"]);
    assert_eq!(store.usage().unwrap().count, 1);
    // By hand, under the longer ending.
    let by_hand = geotiff::<colortype::Gray16>(2, &[1, 2, 3, 4], &Place::default());
    std::fs::write(folder.path().join("heightfields/other.tiff"), by_hand).unwrap();
    assert_eq!(
        store.height_grid(&name("other")).unwrap().range_m,
        Some([1.0, 4.0])
    );
    store.delete(KIND, &name("other"), |_| true).unwrap();
    assert!(!folder.path().join("heightfields/other.tiff").exists());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Whatever a file says, it is answered, and what is taken is whole.
    #[test]
    fn changed_files_are_refused_or_hold_heights(
        which in 0_usize..2, changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let (_folder, store) = store();
        let mut file = match which {
            0 => npy(&[3, 2], npyz::Order::C, &[1.0_f32, 2.0, 3.0, 4.0, 5.0, 6.0]),
            _ => geotiff::<colortype::Gray16>(3, &[1, 2, 3, 4, 5, 6], &Place {
                pixel: Some([1.0; 3]), unknown: Some("3"), keys: vec![(1024, 1)], ..Place::default()
            }),
        };
        for (at, byte) in changes {
            let at = at.index(file.len());
            file[at] = byte;
        }
        if let Ok(grid) = read(&store, &file) {
            prop_assert_eq!(grid.heights.len(), grid.width as usize * grid.height as usize);
            prop_assert!(grid.heights.iter().all(|height| (0.0..=1.0).contains(height)));
        }
    }
}
