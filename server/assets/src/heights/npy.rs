//! Arrays of numpy: two dimensions of numbers, metres, rows from the north.

use super::{check_sides, shares};
use crate::Error;
use npyz::{NpyFile, NpyHeader, Order};
use std::io::Cursor;
use welkin_scene::HeightGrid;

/// The longest header, bytes; those of plain arrays have 118.
const MOST_HEADER_BYTES: u32 = 4096;

pub(super) fn read(file: &[u8], digest: [u8; 32]) -> Result<HeightGrid, Error> {
    check_header(file)?;
    let array = NpyFile::new(Cursor::new(file)).map_err(Error::damaged)?;
    let [rows, columns] = *array.shape() else {
        let sides = array.shape().len();
        return Err(Error::refused(format!(
            "the array has {sides} dimensions: heights have two, rows and columns"
        )));
    };
    let side = |length: u64| u32::try_from(length).unwrap_or(u32::MAX);
    let (width, height) = (side(columns), side(rows));
    check_sides(width, height)?;
    let order = array.order();
    let numbers = numbers(array)?;
    let numbers = match order {
        Order::C => numbers,
        Order::Fortran => {
            let (width, height) = (width as usize, height as usize);
            let at = |i: usize| numbers[i % width * height + i / width];
            (0..numbers.len()).map(at).collect()
        }
    };
    let (heights, range_m) = shares(&numbers, width, |_| false)?;
    Ok(HeightGrid {
        width,
        height,
        heights: heights.into(),
        range_m: Some(range_m),
        extent_m: None,
        digest,
    })
}

/// The reader makes room for as long a header as the file says, up to 4 GiB.
fn check_header(file: &[u8]) -> Result<(), Error> {
    let bytes = match file.get(6..12) {
        Some([1, _, low, high, ..]) => u32::from(u16::from_le_bytes([*low, *high])),
        Some([2 | 3, _, a, b, c, d]) => u32::from_le_bytes([*a, *b, *c, *d]),
        _ => return Err(Error::damaged("its header is cut short or of another version")),
    };
    if bytes > MOST_HEADER_BYTES {
        return Err(Error::damaged(format!("its header has {bytes} bytes")));
    }
    Ok(())
}

/// The numbers in the file's order, of whichever type.
fn numbers(array: NpyFile<Cursor<&[u8]>>) -> Result<Vec<f64>, Error> {
    macro_rules! read_as {
        ($array:ident, $($number:ty),*) => {{
            let dtype = $array.dtype().descr();
            $( let $array = match $array.try_data::<$number>() {
                Ok(data) => {
                    let numbers = data.map(|number| number.map(f64::from));
                    return numbers.collect::<Result<_, _>>().map_err(Error::damaged);
                }
                Err(array) => array,
            }; )*
            let _: &NpyHeader = $array.header();
            Err(Error::refused(format!(
                "its numbers are of the type {dtype}: integers up to 32 bits and floats of 32 or 64 are read"
            )))
        }};
    }
    read_as!(array, f32, f64, u16, i16, i32, u32, u8, i8)
}
