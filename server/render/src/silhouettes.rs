//! Silhouettes of what stands on the ground, drawn smooth: a ray through a pixel's middle sees a mountain or the sky behind
//! it, but the pixel sees some of both.
//!
//! Morphological antialiasing (Reshetov 2009): where the border between two surfaces runs along pixels and steps by one at
//! an end, the straight line that it stands for passes through the step's middle, and the area between it and the pixels'
//! edges is the share that the pixel has of what lies beyond. Borders are found by distance, not by colour, so that neither
//! textures nor stars are blurred.

use glam::UVec2;
use welkin_scene::renderer::Pixels;

/// How far along a border its ends are looked for, pixels. A part of a frame needs as many about it, and two for the
/// slopes beside them.
const REACH: usize = 16;
pub(crate) const APRON_PX: u32 = 18;

/// Of the nearer one's nearness: what differs by less is one surface.
const LEAST_STEP: f32 = 0.05;
/// A plane's nearness, 1/m, changes evenly from pixel to pixel. A border is where it changes by so many times as much as
/// beside.
const STEEPER: f32 = 3.0;

/// A pixel gets a share of the one beside it.
struct Blend {
    to: usize,
    from: usize,
    share: f32,
}

/// Between two pixels that see surfaces of these nearnesses; `before` and `behind` are those next to them.
fn is_border(before: f32, a: f32, b: f32, behind: f32) -> bool {
    let step = (a - b).abs();
    let slope = (before - a).abs().min((behind - b).abs());
    step > LEAST_STEP * a.max(b) && step > STEEPER * slope
}

/// A picture's pixels in lines, its rows or its columns.
#[derive(Clone, Copy)]
struct Lines {
    count: usize,
    length: usize,
    /// From one line to the next, and from one pixel of a line to the next.
    apart: usize,
    stride: usize,
}

impl Lines {
    const fn at(self, line: usize, k: usize) -> usize {
        line * self.apart + k * self.stride
    }

    /// By the pixel before: borders between a line and the next.
    fn borders(self, near: &[f32]) -> Vec<bool> {
        let mut found = vec![false; near.len()];
        for line in 1..self.count {
            let (above, last) = (line.saturating_sub(2), self.count - 1);
            for k in 0..self.length {
                let nearness = |line: usize| near[self.at(line, k)];
                found[self.at(line - 1, k)] = is_border(
                    nearness(above),
                    nearness(line - 1),
                    nearness(line),
                    nearness((line + 1).min(last)),
                );
            }
        }
        found
    }

    /// What pixels on both sides of the borders between lines see of the other side. `steps` are the borders within lines.
    fn blends(self, borders: &[bool], steps: &[bool], blends: &mut Vec<Blend>) {
        for line in 1..self.count {
            let is_border = |k: usize| borders[self.at(line - 1, k)];
            // The border's way beyond a run's end: 1 into the line before, -1 into this one.
            let step = |k: Option<usize>| {
                let there = |line: usize| k.is_some_and(|k| steps[self.at(line, k)]);
                f32::from(i8::from(there(line - 1)) - i8::from(there(line)))
            };
            let mut k = 0;
            while k < self.length {
                if !is_border(k) {
                    k += 1;
                    continue;
                }
                let begin = k;
                while k < self.length && is_border(k) {
                    k += 1;
                }
                let ends = [
                    step(begin.checked_sub(1)),
                    step((k < self.length).then_some(k - 1)),
                ];
                for at in begin..k {
                    let (before, behind) = area(at - begin, k - 1 - at, ends);
                    let (above, below) = (self.at(line - 1, at), self.at(line, at));
                    if before > 0.0 {
                        blends.push(Blend {
                            to: above,
                            from: below,
                            share: before,
                        });
                    }
                    if behind > 0.0 {
                        blends.push(Blend {
                            to: below,
                            from: above,
                            share: behind,
                        });
                    }
                }
            }
        }
    }
}

/// Of a pixel on a border that many from the first and the last of its run, which step as told: the areas between border and
/// line on either side. From each end's step of half a pixel the line falls to the border at the run's middle,
/// ½(1 - s/h) at s of the half length h; that integrates to ½(s - s²/2h).
fn area(first: usize, last: usize, ends: [f32; 2]) -> (f32, f32) {
    #[allow(clippy::cast_precision_loss, reason = "no more than the reach")]
    let capped = |k: usize| k.min(REACH) as f32;
    let half = 0.5 * (capped(first) + capped(last) + 1.0);
    let integral = |s: f32| {
        let s = s.min(half);
        0.5 * (s - 0.5 * s * s / half)
    };
    let mut sides = (0.0, 0.0);
    for (away, end) in [first, last].into_iter().zip(ends) {
        if away < REACH {
            let part = end * (integral(capped(away) + 1.0) - integral(capped(away)));
            sides.0 += part.max(0.0);
            sides.1 += (-part).max(0.0);
        }
    }
    sides
}

/// IEC 61966-2-1.
fn srgb_decode(byte: u8) -> f32 {
    let v = f32::from(byte) / 255.0;
    if v <= 0.040_45 {
        v / 12.92
    } else {
        ((v + 0.055) / 1.055).powf(2.4)
    }
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "within 0 to 255"
)]
fn srgb_encode(v: f32) -> u8 {
    let shown = if v <= 0.003_130_8 {
        12.92 * v
    } else {
        1.055 * v.powf(1.0 / 2.4) - 0.055
    };
    (255.0 * shown).round().clamp(0.0, 255.0) as u8
}

fn mix<T: Copy>(values: &mut [T], blends: &[Blend], light: impl Fn(T) -> f32, value: impl Fn(f32) -> T) {
    // All of what is mixed is of the picture as it was.
    let mixed: Vec<(usize, [T; 3])> = blends
        .chunk_by(|a, b| a.to == b.to)
        .map(|of_one| {
            let whole: f32 = of_one.iter().map(|blend| blend.share).sum();
            let scale = 1.0 / whole.max(1.0);
            let to = of_one[0].to;
            let band = |c: usize| {
                let own = light(values[3 * to + c]);
                let gained: f32 = of_one
                    .iter()
                    .map(|blend| blend.share * (light(values[3 * blend.from + c]) - own))
                    .sum();
                value(own + scale * gained)
            };
            (to, [band(0), band(1), band(2)])
        })
        .collect();
    for (to, rgb) in mixed {
        values[3 * to..3 * to + 3].copy_from_slice(&rgb);
    }
}

/// `ways_m` tells how far away what stands on the ground is before each pixel, and is negative where nothing does.
pub(crate) fn smooth(pixels: &mut Pixels, ways_m: &[f32], size_px: UVec2) {
    let near: Vec<f32> = ways_m
        .iter()
        .map(|way_m| if *way_m > 0.0 { 1.0 / way_m } else { 0.0 })
        .collect();
    let [width, height] = size_px.to_array().map(|side| side as usize);
    let rows = Lines {
        count: height,
        length: width,
        apart: width,
        stride: 1,
    };
    let columns = Lines {
        count: width,
        length: height,
        apart: 1,
        stride: width,
    };
    let (between_rows, between_columns) = (rows.borders(&near), columns.borders(&near));
    let mut blends = Vec::new();
    rows.blends(&between_rows, &between_columns, &mut blends);
    columns.blends(&between_columns, &between_rows, &mut blends);
    blends.sort_by_key(|blend| blend.to);
    match pixels {
        Pixels::Display(values) => mix(values, &blends, srgb_decode, srgb_encode),
        Pixels::Linear(values) => mix(values, &blends, |v| v, |v| v),
    }
}

#[cfg(test)]
mod tests {
    #![allow(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "small numbers"
    )]

    use super::*;
    use proptest::prelude::*;

    /// Ways and light of a picture by a function of the place that is positive on a black hill.
    fn hill(size: UVec2, inside: impl Fn(f64, f64) -> f64) -> (Vec<f32>, Vec<f32>) {
        let places = (0..size.y).flat_map(|y| (0..size.x).map(move |x| (x, y)));
        let ways: Vec<f32> = places
            .map(|(x, y)| {
                if inside(f64::from(x) + 0.5, f64::from(y) + 0.5) > 0.0 {
                    5000.0
                } else {
                    -1.0
                }
            })
            .collect();
        let light = ways
            .iter()
            .flat_map(|way| [if *way > 0.0 { 0.0 } else { 1.0 }; 3])
            .collect();
        (ways, light)
    }

    /// Share of a pixel outside the hill, by 32×32 places.
    fn open_share(x: u32, y: u32, inside: impl Fn(f64, f64) -> f64) -> f64 {
        let place = |v: u32, k: u32| f64::from(v) + (f64::from(k) + 0.5) / 32.0;
        let open = (0..1024).filter(|k| inside(place(x, k % 32), place(y, k / 32)) <= 0.0);
        open.count() as f64 / 1024.0
    }

    proptest! {
        /// Straight silhouettes come out as the area that they leave open. The same pixels stand for lines that are up to
        /// half a pixel apart, which no smoothing can tell: most at a diagonal, where squares of errors, on average over six
        /// places of the line, are up to 0.62 of those that are not smoothed; elsewhere a tenth. Not lines that step more
        /// rarely than the ends of runs are looked for.
        #[test]
        fn straight_lines_are_as_their_areas(angle in 0.0..std::f64::consts::TAU, first in -3.0..3.0) {
            let size = UVec2::new(48, 48);
            let (s, c): (f64, f64) = f64::sin_cos(angle);
            let slope = (s / c).abs().min((c / s).abs());
            prop_assume!(slope > 1.0 / 24.0);
            let (mut before, mut after) = (0.0, 0.0);
            for k in 0..6 {
                let off = first + f64::from(k) / 6.0;
                let inside = |x: f64, y: f64| (x - 24.0) * s + (y - 24.0) * c + off;
                let (ways, light) = hill(size, inside);
                let mut smoothed = Pixels::Linear(light.clone());
                smooth(&mut smoothed, &ways, size);
                let Pixels::Linear(smoothed) = smoothed else { unreachable!() };
                for y in 2..46 {
                    for x in 2..46 {
                        let truth = open_share(x, y, inside);
                        let i = 3 * (y * size.x + x) as usize;
                        before += (f64::from(light[i]) - truth).powi(2);
                        after += (f64::from(smoothed[i]) - truth).powi(2);
                    }
                }
            }
            prop_assert!(after <= 0.7 * before, "{before} {after}");
        }

        /// What does not lie on a border stays as it is, and nothing is brighter or darker than what is mixed.
        #[test]
        fn only_borders_change(seed in any::<u64>()) {
            let size = UVec2::new(24, 16);
            let bit = |k: usize| (seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(k as u32 % 64) >> 17) & 1 == 1;
            let ways: Vec<f32> = (0..384).map(|k| if bit(k / 5) { 100.0 } else { -1.0 }).collect();
            let light: Vec<f32> = (0..1152).map(|k| (k % 7) as f32).collect();
            let mut smoothed = Pixels::Linear(light.clone());
            smooth(&mut smoothed, &ways, size);
            let Pixels::Linear(smoothed) = smoothed else { unreachable!() };
            for (k, (new, old)) in smoothed.iter().zip(&light).enumerate() {
                let (x, y) = (k / 3 % 24, k / 72);
                let beside = |dx: usize, dy: usize| ways[(y + dy).clamp(1, 16) * 24 + (x + dx).clamp(1, 24) - 25];
                let alike = [beside(0, 1), beside(2, 1), beside(1, 0), beside(1, 2)].iter().all(|way| *way == beside(1, 1));
                prop_assert!(!alike || new == old, "{x} {y}");
                prop_assert!((0.0..=6.0).contains(new));
            }
        }
    }

    /// The plain before a low observer is no staircase: distances grow from row to row by more than a twentieth, but
    /// evenly in their inverses.
    #[test]
    fn a_plain_has_no_borders() {
        let size = UVec2::new(40, 40);
        let ways: Vec<f32> = (0..1600).map(|k| 900.0 / (k / 40 + 1) as f32).collect();
        let light: Vec<f32> = (0..4800).map(|k| (k / 120) as f32).collect();
        let mut smoothed = Pixels::Linear(light.clone());
        smooth(&mut smoothed, &ways, size);
        assert!(matches!(smoothed, Pixels::Linear(smoothed) if smoothed == light));
    }

    #[test]
    fn bytes_come_back_as_they_were() {
        for byte in 0..=255 {
            assert_eq!(srgb_encode(srgb_decode(byte)), byte);
        }
    }
}
