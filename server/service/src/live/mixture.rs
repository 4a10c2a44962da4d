//! What is shown of a frame that is being refined: the preview, corrected by what is final so far.

use welkin_scene::{
    refinement::{STRIDE, pass_of},
    renderer::{Frame, Pixels},
};

/// A final pixel beside one that is not: columns and rows to it, and how much it counts.
type Tap = (isize, isize, f32);

/// Final pixels as they are; for the others what the preview shows, and the difference that final pixels about have from
/// it, interpolated. So the preview's outlines stay, and no pattern shows through.
pub(crate) fn mixture(preview: &Frame, refined: &Frame, pass: u16) -> Frame {
    let (Pixels::Display(coarse), Pixels::Display(done)) = (&preview.pixels, &refined.pixels) else {
        // Radiance is never shown live.
        return refined.clone();
    };
    let base = enlarged(
        coarse,
        [preview.width_px, preview.height_px],
        [refined.width_px, refined.height_px],
    );
    let (width, height) = (refined.width_px as usize, refined.height_px as usize);
    let (base, _) = base.as_chunks::<3>();
    let (done, _) = done.as_chunks::<3>();
    let taps = taps(pass);
    let mut pixels = Vec::with_capacity(3 * base.len());
    for y in 0..height {
        for x in 0..width {
            let at = y * width + x;
            let taps = &taps[y % SIDE][x % SIDE];
            if taps.is_empty() {
                pixels.extend(done[at]);
                continue;
            }
            let (mut off, mut weights) = ([0.0; 3], 0.0);
            for &(right, down, weight) in taps {
                let (Some(x), Some(y)) = (x.checked_add_signed(right), y.checked_add_signed(down)) else {
                    continue;
                };
                if x < width && y < height {
                    let from = y * width + x;
                    weights += weight;
                    for c in 0..3 {
                        off[c] += weight * (f32::from(done[from][c]) - f32::from(base[from][c]));
                    }
                }
            }
            pixels.extend([0, 1, 2].map(|c| nearest(f32::from(base[at][c]) + off[c] / weights)));
        }
    }
    Frame {
        pixels: Pixels::Display(pixels),
        ..refined.clone()
    }
}

const SIDE: usize = STRIDE as usize;

/// Of each pixel of a square, those about it that are final; none where it is final itself. The weights are a tent as
/// wide as the widest gap, so that between four of a square lattice the interpolation is bilinear.
fn taps(pass: u16) -> [[Vec<Tap>; SIDE]; SIDE] {
    // After four passes every second pixel of every second row is final.
    let reach: i16 = if pass < 4 { 4 } else { 2 };
    let is_final = |x: i16, y: i16| {
        let within = |at: i16| u32::from(at.rem_euclid(4).unsigned_abs());
        pass_of(within(x), within(y)) <= pass
    };
    let about = |x: i16, y: i16| {
        let places = (1 - reach..reach).flat_map(|down| (1 - reach..reach).map(move |right| (right, down)));
        let finals = places.filter(|(right, down)| is_final(x + right, y + down));
        let tent = |off: i16| f32::from(reach - off.abs());
        finals
            .map(|(right, down)| (isize::from(right), isize::from(down), tent(right) * tent(down)))
            .collect()
    };
    [0, 1, 2, 3].map(|y| [0, 1, 2, 3].map(|x| if is_final(x, y) { Vec::new() } else { about(x, y) }))
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to 0..255 first"
)]
const fn nearest(value: f32) -> u8 {
    (value.clamp(0.0, 255.0) + 0.5) as u8
}

/// A picture of another size, bilinear.
fn enlarged(values: &[u8], from: [u32; 2], to: [u32; 2]) -> Vec<u8> {
    if from == to {
        return values.to_vec();
    }
    let (pixels, _) = values.as_chunks::<3>();
    let [columns, rows] = [0, 1].map(|axis| stops(from[axis], to[axis]));
    let width = from[0] as usize;
    let mut larger = Vec::with_capacity(3 * columns.len() * rows.len());
    for &(top, bottom, down) in &rows {
        for &(left, right, across) in &columns {
            let at = |row: usize, column: usize, c: usize| f32::from(pixels[row * width + column][c]);
            let mix = |a: f32, b: f32, part: f32| a + part * (b - a);
            let row = |row, c| mix(at(row, left, c), at(row, right, c), across);
            larger.extend([0, 1, 2].map(|c| nearest(mix(row(top, c), row(bottom, c), down))));
        }
    }
    larger
}

/// For each of `to` pixels the two of `from` that its centre lies between, and how far on the way.
fn stops(from: u32, to: u32) -> Vec<(usize, usize, f32)> {
    let last = from.saturating_sub(1);
    let stop = |i: u32| {
        let at = (f64::from(i) + 0.5) * f64::from(from) / f64::from(to) - 0.5;
        let at = at.clamp(0.0, f64::from(last));
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to the picture first; its fraction is from 0 to 1"
        )]
        let (low, part) = (at as u32, at.fract() as f32);
        (low as usize, last.min(low + 1) as usize, part)
    };
    (0..to).map(stop).collect()
}

#[cfg(test)]
mod tests {
    #![allow(
        clippy::unwrap_used,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "tests fail by panicking; colours are from 0 to 1"
    )]

    use super::*;
    use welkin_scene::{FrameRequest, Scene, refinement::PASSES, renderer::FrameFacts};

    const SIZE: [u32; 2] = [90, 61];

    fn frame([width_px, height_px]: [u32; 2], pixel: impl Fn(f64, f64) -> [f64; 3]) -> Frame {
        let places = (0..height_px).flat_map(|y| (0..width_px).map(move |x| (x, y)));
        let values = places.flat_map(|(x, y)| {
            let (x, y) = (
                (f64::from(x) + 0.5) / f64::from(width_px),
                (f64::from(y) + 0.5) / f64::from(height_px),
            );
            pixel(x, y).map(|c| (255.0 * c).round() as u8)
        });
        let scene: Scene = FrameRequest::default().scene;
        Frame {
            width_px,
            height_px,
            pixels: Pixels::Display(values.collect()),
            passes: Vec::new(),
            facts: FrameFacts {
                sun: scene.sun_place(),
                sun_irradiance_w_m2: [0.0; 3],
                moon: None,
                moon_irradiance_w_m2: [0.0; 3],
                ev100: None,
            },
        }
    }

    /// The final frame without the pixels of later passes.
    fn after(whole: &Frame, pass: u16) -> Frame {
        let mut frame = whole.clone();
        let Pixels::Display(values) = &mut frame.pixels else {
            unreachable!()
        };
        for (i, pixel) in (0..).zip(values.chunks_exact_mut(3)) {
            if pass_of(i % whole.width_px, i / whole.width_px) > pass {
                pixel.fill(0);
            }
        }
        frame
    }

    fn values(frame: &Frame) -> &[u8] {
        match &frame.pixels {
            Pixels::Display(values) => values,
            Pixels::Linear(_) => unreachable!(),
        }
    }

    fn mean_error(a: &Frame, b: &Frame) -> f64 {
        let off = values(a)
            .iter()
            .zip(values(b))
            .map(|(a, b)| f64::from(a.abs_diff(*b)));
        off.sum::<f64>() / values(a).len() as f64
    }

    /// A sky with a bright edge and ripples, as it is.
    fn sharp(x: f64, y: f64) -> [f64; 3] {
        let cloud = if (x - 0.5).hypot(y - 0.4) < 0.25 { 0.4 } else { 0.0 };
        let ripples = 0.05 * (70.0 * x).sin() * (50.0 * y).cos();
        [0.3 + cloud + ripples, 0.4 + cloud + ripples, 0.6 * y + 0.3]
    }

    /// The same seen roughly: darker, and its edge not quite where it is.
    fn rough(x: f64, y: f64) -> [f64; 3] {
        let cloud = if (x - 0.51).hypot(y - 0.4) < 0.24 {
            0.35
        } else {
            0.0
        };
        [0.27 + cloud, 0.38 + cloud, 0.58 * y + 0.3]
    }

    #[test]
    fn the_error_falls_from_pass_to_pass() {
        let whole = frame(SIZE, sharp);
        for preview_size in [SIZE, [45, 31], [23, 16]] {
            let preview = frame(preview_size, rough);
            let mut last = mean_error(&frame(SIZE, rough), &whole);
            for pass in 1..=PASSES {
                let shown = mixture(&preview, &after(&whole, pass), pass);
                let error = mean_error(&shown, &whole);
                assert!(
                    error < last,
                    "{preview_size:?}, pass {pass}: {error} after {last}"
                );
                last = error;
            }
            assert_eq!(last, 0.0);
        }
    }

    /// Where the preview is wrong by the same everywhere, the first pass mends all of it: no pixel stands out.
    #[test]
    fn no_pattern_shows() {
        let whole = frame(SIZE, |x, y| [0.5 + 0.3 * x, 0.4, 0.3 + 0.2 * y]);
        let preview = frame(SIZE, |x, y| [0.4 + 0.3 * x, 0.5, 0.3 + 0.1 * y]);
        for pass in 1..=PASSES {
            let shown = mixture(&preview, &after(&whole, pass), pass);
            let most = values(&shown)
                .iter()
                .zip(values(&whole))
                .map(|(a, b)| a.abs_diff(*b))
                .max();
            // Three roundings of half a step each, and at the lower edge three rows of a slope of 0.4 steps a row that
            // nothing final lies beyond.
            assert!(most.unwrap() <= 2, "pass {pass}: {most:?}");
        }
    }

    #[test]
    fn enlarging_keeps_slopes_and_corners() {
        let slope = |x: f64, y: f64| [x, y, 0.5];
        let larger = enlarged(values(&frame([30, 20], slope)), [30, 20], [90, 60]);
        let expected = frame([90, 60], slope);
        for (i, (a, b)) in larger.iter().zip(values(&expected)).enumerate() {
            let (x, y) = (i / 3 % 90, i / 270);
            // Outside the outermost centres the picture goes on as it is there; elsewhere two roundings.
            let inside = (1..89).contains(&x) && (1..59).contains(&y);
            assert!(a.abs_diff(*b) <= if inside { 1 } else { 5 }, "{x} {y}: {a} {b}");
        }
    }
}
