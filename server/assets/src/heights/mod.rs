//! Heightfields: a grey PNG, a GeoTIFF, or an array of numpy.

mod geotiff;
mod npy;

use crate::{
    Error, Form,
    png_file::{self, MAX_SIDE_PX},
};
use welkin_scene::HeightGrid;

/// The largest grid in memory, bytes.
pub(crate) const MOST_BYTES: u64 = (MAX_SIDE_PX as u64) * (MAX_SIDE_PX as u64) * 4;
/// No ground lies as far from the sea's level, metres: beyond, a file marks what it does not know.
const MOST_HEIGHT_M: f64 = 1e5;

/// Reads a file to its end.
pub(crate) fn read(form: Form, file: &[u8], digest: [u8; 32]) -> Result<HeightGrid, Error> {
    match form {
        Form::Tiff => geotiff::read(file, digest),
        Form::Npy => npy::read(file, digest),
        _ => {
            let facts = png_file::facts(file)?;
            check_sides(facts.width_px, facts.height_px)?;
            Ok(HeightGrid {
                width: facts.width_px,
                height: facts.height_px,
                heights: png_file::greys(file)?.into(),
                range_m: None,
                extent_m: None,
                digest,
            })
        }
    }
}

fn check_sides(width_px: u32, height_px: u32) -> Result<(), Error> {
    if width_px.max(height_px) > MAX_SIDE_PX {
        return Err(Error::Side { width_px, height_px });
    }
    if width_px.min(height_px) < 2 {
        return Err(Error::refused(format!(
            "it has {width_px} x {height_px} heights: a heightfield needs two a side or more"
        )));
    }
    Ok(())
}

/// Heights in metres as shares of their range. What is marked as unknown lies as low as the lowest that is known.
fn shares(
    heights_m: &[f64],
    width: u32,
    is_unknown: impl Fn(f64) -> bool,
) -> Result<(Vec<f32>, [f64; 2]), Error> {
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for (i, &height) in heights_m.iter().enumerate() {
        if is_unknown(height) {
            continue;
        }
        if height.is_nan() || height.abs() > MOST_HEIGHT_M {
            let (row, column) = (i / width as usize, i % width as usize);
            return Err(Error::refused(format!(
                "the height in row {row}, column {column} is {height}: heights are metres, {MOST_HEIGHT_M} at most"
            )));
        }
        (least, most) = (least.min(height), most.max(height));
    }
    if least > most {
        return Err(Error::refused("no height in it is known"));
    }
    let span = if most > least { most - least } else { 1.0 };
    #[allow(clippy::cast_possible_truncation, reason = "a share needs no more digits")]
    let share = |&height: &f64| {
        if is_unknown(height) {
            0.0
        } else {
            ((height - least) / span) as f32
        }
    };
    Ok((heights_m.iter().map(share).collect(), [least, most]))
}
