//! The frame's pixels as the kind that a format holds, checked.

use crate::error::EncodeError;
use welkin_scene::{
    frame::{Format, MAX_SIDE_PX},
    renderer::{Frame, Pixels},
};

/// A checked view of a frame: `samples.len() == 3 * width * height`, sides 1 to [`MAX_SIDE_PX`].
pub(crate) struct View<'a, T> {
    pub(crate) width: u16,
    pub(crate) height: u16,
    pub(crate) samples: &'a [T],
}

impl<T> View<'_, T> {
    pub(crate) fn columns(&self) -> usize {
        usize::from(self.width)
    }

    pub(crate) fn rows(&self) -> usize {
        usize::from(self.height)
    }
}

/// The picture, for a display format.
pub(crate) fn display(frame: &Frame, format: Format) -> Result<View<'_, u8>, EncodeError> {
    match &frame.pixels {
        Pixels::Display(samples) => view(frame, samples),
        Pixels::Linear(_) => Err(EncodeError::Output {
            format,
            needs: "the picture (8-bit sRGB)",
        }),
    }
}

/// Finite radiance, for a linear format.
pub(crate) fn linear(frame: &Frame, format: Format) -> Result<View<'_, f32>, EncodeError> {
    let Pixels::Linear(samples) = &frame.pixels else {
        return Err(EncodeError::Output {
            format,
            needs: "radiance (W/m²/sr)",
        });
    };
    let view = view(frame, samples)?;
    let (pixels, _) = samples.as_chunks::<3>();
    match pixels
        .iter()
        .position(|pixel| !pixel.iter().all(|sample| sample.is_finite()))
    {
        None => Ok(view),
        Some(at) => Err(EncodeError::NotFinite {
            x: at % view.columns(),
            y: at / view.columns(),
            value: pixels[at],
        }),
    }
}

fn view<'a, T>(frame: &Frame, samples: &'a [T]) -> Result<View<'a, T>, EncodeError> {
    let side = |side_px: u32| {
        u16::try_from(side_px)
            .ok()
            .filter(|_| (1..=MAX_SIDE_PX).contains(&side_px))
    };
    match (side(frame.width_px), side(frame.height_px)) {
        (Some(width), Some(height)) if samples.len() == 3 * usize::from(width) * usize::from(height) => {
            Ok(View {
                width,
                height,
                samples,
            })
        }
        _ => Err(EncodeError::Size {
            width_px: frame.width_px,
            height_px: frame.height_px,
            samples: samples.len(),
        }),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, reason = "tests fail by panicking")]

    use crate::{EncodeError, Options, encode, output_for, sample};
    use welkin_scene::renderer::{Output, Pixels};

    #[test]
    fn the_first_pixel_that_is_not_finite_is_named_and_nothing_is_written() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            for format in sample::FORMATS
                .into_iter()
                .filter(|format| output_for(*format) == Output::Linear)
            {
                let mut frame = sample::linear(5, 4);
                let Pixels::Linear(samples) = &mut frame.pixels else {
                    unreachable!("made linear")
                };
                samples[3 * (2 * 5 + 3) + 1] = bad;
                samples[3 * (3 * 5) + 2] = bad;
                match encode(&frame, format, &Options::default()) {
                    Err(EncodeError::NotFinite { x: 3, y: 2, value }) => {
                        assert!(value[0].is_finite() && !value[1].is_finite());
                    }
                    other => panic!("{format:?} with {bad}: {other:?}"),
                }
            }
        }
    }

    #[test]
    fn the_other_kind_of_pixels_is_refused_with_the_cure() {
        for format in sample::FORMATS {
            let frame = match output_for(format) {
                Output::Display => sample::linear(3, 2),
                Output::Linear => sample::display(3, 2),
            };
            let error = encode(&frame, format, &Options::default()).unwrap_err();
            assert!(matches!(error, EncodeError::Output { .. }), "{error:?}");
            assert!(error.to_string().contains("output_for"), "{error}");
        }
    }

    #[test]
    fn pixels_that_do_not_fill_the_size_are_refused() {
        for format in sample::FORMATS {
            for (width_px, height_px) in [(3, 3), (0, 2), (2, 0), (16_385, 1), (u32::MAX, u32::MAX)] {
                let mut frame = sample::for_format(format, 3, 2);
                (frame.width_px, frame.height_px) = (width_px, height_px);
                let error = encode(&frame, format, &Options::default()).unwrap_err();
                assert!(
                    matches!(error, EncodeError::Size { samples: 18, .. }),
                    "{format:?}: {error:?}"
                );
            }
        }
    }
}
