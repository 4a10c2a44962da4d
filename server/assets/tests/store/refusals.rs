//! Files that are no assets.

use crate::files::{MAPS, chunk, headed, name, png, put, small, store};
use png::{BitDepth, ColorType};
use proptest::prelude::*;
use welkin_assets::{Error, Name};

#[test]
fn what_is_not_a_png_is_told_so() {
    let (_folder, store) = store();
    let jpeg = b"\xff\xd8\xff\xe0\0\x10JFIF".as_slice();
    for file in [b"".as_slice(), b"\x89PNG", b"{}", b"GIF89a", jpeg, &[0; 1000]] {
        assert!(
            matches!(put(&store, "map", file), Err(Error::Form { .. })),
            "{file:?}"
        );
    }
    assert!(store.asset(MAPS, &name("map")).unwrap().is_none());
}

/// Each claims far more than it holds; all are refused by the header alone, or by what follows being missing.
#[test]
fn bombs_do_not_go_off() {
    let (_folder, store) = store();
    let end = chunk(b"IEND", &[]);
    for (width, height) in [
        (u32::MAX, 1),
        (1, 1 << 31),
        (0x7fff_ffff, 0x7fff_ffff),
        (4097, 4097),
    ] {
        let file = headed(width, height, 16, 6, &end);
        assert!(
            matches!(
                put(&store, "map", &file),
                Err(Error::Side { .. } | Error::Damaged { .. })
            ),
            "{width} x {height}"
        );
    }
    let full_size = |rest: &[u8]| headed(4096, 4096, 16, 6, rest);
    let long = [0xff, 0xff, 0xff, 0xf0, b'I', b'D', b'A', b'T'];
    for rest in [
        vec![],
        end.clone(),
        long.to_vec(),
        chunk(b"IDAT", &[]),
        chunk(b"IDAT", b"no zlib"),
        [chunk(b"IDAT", &[0x78, 0x9c, 3, 0, 0, 0, 0, 1]), end.clone()].concat(),
    ] {
        let error = put(&store, "map", &full_size(&rest)).unwrap_err();
        assert!(matches!(error, Error::Damaged { .. }), "{error}");
    }
    for (width, height) in [(0, 5), (5, 0), (0, 0)] {
        let error = put(&store, "map", &headed(width, height, 8, 0, &end)).unwrap_err();
        assert!(matches!(error, Error::Damaged { .. }), "{error}");
    }
}

/// A text and a profile that would each unpack to 16 MiB are passed over, and the picture is taken.
#[test]
fn what_is_packed_beside_the_picture_is_passed_over() {
    let (_folder, store) = store();
    let side = 4096;
    let zeros = vec![0; (side * side) as usize];
    let large = png(
        (side, side),
        ColorType::Grayscale,
        BitDepth::Eight,
        &zeros,
        |_| {},
    );
    let data_at = large.windows(4).position(|kind| kind == b"IDAT").unwrap() + 4;
    // Up to the checksum and the end mark, 4 and 12 bytes.
    let packed = &large[data_at..large.len() - 16];
    let whole = png((1, 1), ColorType::Grayscale, BitDepth::Eight, &[5], |_| {});
    // Signature and header are 8 and 25 bytes.
    let (head, rest) = whole.split_at(33);
    for (kind, before) in [(b"zTXt", b"key\0\0".as_slice()), (b"iCCP", b"name\0\0")] {
        let bomb = chunk(kind, &[before, packed].concat());
        put(&store, "map", &[head, &bomb, rest].concat()).unwrap();
        assert_eq!(
            &store.weather_picture(&name("map")).unwrap().rgba[..],
            [5, 5, 5, 255]
        );
    }
}

/// The frame control of an animation may say that its first frame is smaller than the picture; that is against the
/// standard, and would leave pixels unset.
#[test]
fn a_first_frame_that_leaves_pixels_unset_is_refused() {
    let (_folder, store) = store();
    let data = &small(0)[33..];
    let mut control = [0_u32, 2, 2, 0, 0].map(u32::to_be_bytes).concat();
    control.extend([0, 1, 0, 1, 0, 0]);
    let animation = chunk(b"acTL", &[0, 0, 0, 1, 0, 0, 0, 0]);
    let rest = [&animation, &chunk(b"fcTL", &control), data].concat();
    let error = put(&store, "map", &headed(4, 4, 8, 6, &rest)).unwrap_err();
    assert!(matches!(error, Error::Damaged { .. }), "{error}");
}

#[test]
fn a_file_cut_anywhere_is_refused() {
    let (_folder, store) = store();
    let whole = small(9);
    for length in 0..whole.len() {
        let error = put(&store, "map", &whole[..length]).unwrap_err();
        assert!(
            matches!(error, Error::Form { .. } | Error::Damaged { .. }),
            "{length}: {error}"
        );
    }
    put(&store, "map", &whole).unwrap();
}

proptest! {
    #[test]
    fn no_bytes_break_the_reader(
        rest in proptest::collection::vec(any::<u8>(), 0..400),
        (width, height) in (0_u32..40, 0_u32..40),
        depth in prop_oneof![Just(1_u8), Just(2), Just(4), Just(8), Just(16), any::<u8>()],
        colour in 0_u8..8,
    ) {
        let (_folder, store) = store();
        // Whatever it says, it answers.
        let _ = put(&store, "map", &headed(width, height, depth, colour, &rest));
        let data = [chunk(b"PLTE", &rest[..rest.len() / 3 * 3]), chunk(b"IDAT", &rest), chunk(b"IEND", &[])];
        let _ = put(&store, "map", &headed(width, height, depth, colour, &data.concat()));
    }

    /// The checksums of PNG tell a changed byte wherever it matters; where it does not (a byte of a checksum of
    /// what is not read), the picture is the same.
    #[test]
    fn a_changed_byte_is_refused_or_changes_nothing(at in 0_usize..1000, flip in 1_u8..=255) {
        let (_folder, store) = store();
        let mut file = small(3);
        let at = at % file.len();
        put(&store, "whole", &file).unwrap();
        file[at] ^= flip;
        if put(&store, "map", &file).is_ok() {
            let [whole, changed] = ["whole", "map"].map(|n| store.weather_picture(&name(n)).unwrap());
            prop_assert_eq!(&whole.rgba, &changed.rgba);
        }
    }

    #[test]
    fn names_cannot_lead_out(text in any::<String>()) {
        if let Ok(name) = Name::new(&text) {
            prop_assert!(!name.as_str().contains(['/', '\\', '.', '\0', ':']) && !text.is_empty());
        }
    }
}
