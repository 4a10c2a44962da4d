//! Frames for tests: no two pixels alike, no symmetry, so that a flip, a shift or a swap of channels shows.

use crate::output_for;
use welkin_scene::{
    frame::Format,
    moon::MoonPlace,
    probe::SunPlace,
    renderer::{Frame, FrameFacts, Output, Pixels},
};

pub(crate) const FORMATS: [Format; 7] = [
    Format::Png,
    Format::Jpeg,
    Format::Exr,
    Format::ExrFloat,
    Format::Hdr,
    Format::Npy,
    Format::Raw,
];

/// Odd sizes: one pixel, one column, one row, sides that no block size divides.
pub(crate) const SIZES: [(u16, u16); 6] = [(1, 1), (1, 7), (7, 1), (17, 3), (8, 2), (131, 37)];

/// The picture: red grows to the right, green down, blue tells the corner at the top left.
pub(crate) fn display(width: u16, height: u16) -> Frame {
    let (columns, rows) = (usize::from(width), usize::from(height));
    let ramp = |at: usize, of: usize| u8::try_from(20 + at * 200 / of).unwrap_or(u8::MAX);
    let corner = |x, y| if x * 2 < columns && y * 2 < rows { 200 } else { 40 };
    let pixels = (0..rows)
        .flat_map(|y| (0..columns).flat_map(move |x| [ramp(x, columns), ramp(y, rows), corner(x, y)]))
        .collect();
    frame(width, height, Pixels::Display(pixels))
}

/// Radiance over many orders of magnitude, all of which a half float holds.
pub(crate) fn linear(width: u16, height: u16) -> Frame {
    let count = 3 * usize::from(width) * usize::from(height);
    let value = |at: usize| {
        let at = u16::try_from(at % 60_013).unwrap_or_default();
        (1.0 + f32::from(at) / 60_013.0) * 2f32.powi(i32::from(at % 27) - 12)
    };
    frame(width, height, Pixels::Linear((0..count).map(value).collect()))
}

pub(crate) fn for_format(format: Format, width: u16, height: u16) -> Frame {
    match output_for(format) {
        Output::Display => display(width, height),
        Output::Linear => linear(width, height),
    }
}

fn frame(width: u16, height: u16, pixels: Pixels) -> Frame {
    Frame {
        width_px: width.into(),
        height_px: height.into(),
        pixels,
        passes: Vec::new(),
        facts: FrameFacts {
            sun: SunPlace {
                azimuth_deg: 123.25,
                elevation_deg: -4.5,
            },
            sun_irradiance_w_m2: [1.5, 1.25, 0.75],
            moon: Some(MoonPlace {
                azimuth_deg: 40.5,
                elevation_deg: 30.25,
                phase_angle_deg: 20.0,
                illuminated_fraction: 0.97,
                angular_diameter_deg: 0.518,
                distance_m: 3.844e8,
            }),
            moon_irradiance_w_m2: [4e-6, 3e-6, 2e-6],
            ev100: None,
        },
    }
}
