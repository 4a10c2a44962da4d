//! How large a preview may be so that it comes in time.

use std::time::Duration;

/// What the sides may be divided by, and the time at which a preview of that size is too slow. A quarter is so soft that
/// four pictures a second at half the size are better.
const STEPS: [(u16, Duration); 3] = [
    (1, Duration::from_millis(90)),
    (2, Duration::from_millis(250)),
    (4, Duration::MAX),
];
/// One preview may be slow because shaders were compiled or noise was made for it; so many in a row are not.
const SLOW_IN_A_ROW: u32 = 3;
/// Twice as wide and high is four times the work at most: it is tried at once where that would take so much of the time
/// that it may, leaving room for what varies from preview to preview.
const SURELY: f64 = 0.9 / 4.0;
/// Part of the work is the same at any size: full and half size are also tried where the time now is so much of what it
/// may be; half sooner than full size, since a quarter is so soft.
const PERHAPS: [f64; 2] = [1.0 / 3.0, 0.6];
/// Twice as wide and high was too slow: that many previews pass before it is perhaps tried again, and each time it fails
/// twice as many.
const PATIENCE: std::ops::RangeInclusive<u32> = 20..=80;

/// Chooses the size of previews from the time that former ones took.
#[derive(Clone, Debug)]
pub(crate) struct Pace {
    step: usize,
    /// Previews in a row that were too slow.
    slow: u32,
    patience: u32,
    wait: u32,
}

impl Default for Pace {
    fn default() -> Self {
        Self {
            step: 1,
            slow: 0,
            patience: *PATIENCE.start(),
            wait: 0,
        }
    }
}

impl Pace {
    /// What the sides are divided by.
    pub(crate) fn divisor(&self) -> u16 {
        STEPS[self.step].0
    }

    /// Learns from a preview that was rendered with `divisor`.
    pub(crate) fn learn(&mut self, divisor: u16, took: Duration) {
        if divisor != self.divisor() {
            return;
        }
        self.wait = self.wait.saturating_sub(1);
        if took > STEPS[self.step].1 {
            self.slow += 1;
            if self.slow == SLOW_IN_A_ROW {
                (self.step, self.slow, self.wait) = (self.step + 1, 0, self.patience);
                self.patience = (2 * self.patience).min(*PATIENCE.end());
            }
            return;
        }
        self.slow = 0;
        let Some(finer) = self.step.checked_sub(1) else {
            return;
        };
        let share = took.div_duration_f64(STEPS[finer].1);
        if share < SURELY || (share < PERHAPS[finer] && self.wait == 0) {
            self.step = finer;
        }
    }
}

/// A size divided, of the same shape: a cubemap strip stays six squares.
pub(crate) fn divided(width_px: u16, height_px: u16, divisor: u16) -> (u16, u16) {
    let part = |side: u16| side.div_ceil(divisor).max(1);
    let height = part(height_px);
    if u32::from(width_px) == 6 * u32::from(height_px) {
        (6 * height, height)
    } else {
        (part(width_px), height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sizes of 400 previews that take so many milliseconds at a divisor; `ms` knows which one it is.
    fn divisors(ms: impl Fn(usize, f64) -> f64) -> Vec<u16> {
        let mut pace = Pace::default();
        let preview = |i| {
            let divisor = pace.divisor();
            pace.learn(divisor, Duration::from_secs_f64(ms(i, f64::from(divisor)) / 1e3));
            divisor
        };
        (0..400).map(preview).collect()
    }

    /// A device that needs so many milliseconds at any size, and so many more at full size.
    fn device(fixed: f64, per_full: f64) -> impl Fn(usize, f64) -> f64 {
        move |_, divisor| fixed + per_full / (divisor * divisor)
    }

    #[test]
    fn a_fast_device_shows_full_size_and_a_slow_one_half() {
        assert_eq!(divisors(device(1.0, 5.0)).last(), Some(&1));
        for (fixed, per_full) in [(60.0, 50.0), (5.0, 900.0), (200.0, 190.0)] {
            let last = divisors(device(fixed, per_full))[200..].to_vec();
            assert!(
                last.iter().all(|divisor| *divisor == 2),
                "{fixed} + {per_full} ms"
            );
        }
    }

    /// Only where half takes over a quarter of a second.
    #[test]
    fn a_very_slow_device_shows_a_quarter() {
        assert_eq!(divisors(device(5.0, 8000.0)).last(), Some(&4));
        assert!(divisors(device(0.0, 999.0)).iter().all(|divisor| *divisor < 4));
    }

    /// Shaders that are compiled, noise that is made: two in a row, now and then.
    #[test]
    fn a_slow_preview_now_and_then_changes_nothing() {
        let now_and_then = |i: usize, _| if i % 20 < 2 { 3000.0 } else { 100.0 };
        assert!(divisors(now_and_then).iter().all(|divisor| *divisor == 2));
    }

    /// The machine was busy for a while.
    #[test]
    fn what_was_lost_comes_back_soon() {
        let busy = |i: usize, divisor| device(10.0, 150.0)(i, divisor) * if i < 40 { 10.0 } else { 1.0 };
        let seen = divisors(busy);
        assert_eq!((seen[39], seen[42]), (4, 2));
    }

    #[test]
    fn sizes_do_not_flicker() {
        for (fixed, per_full) in [
            (1.0, 5.0),
            (20.0, 100.0),
            (25.0, 300.0),
            (35.0, 80.0),
            (5.0, 2000.0),
            (80.0, 10.0),
        ] {
            let changes = divisors(device(fixed, per_full))
                .windows(2)
                .filter(|pair| pair[0] != pair[1])
                .count();
            // Two steps to where it belongs, and tries after 20, 40 and then every 80 previews that go up and come back.
            assert!(
                changes <= 2 + 2 * (2 + 400 / 80),
                "{fixed} + {per_full} ms: {changes} changes"
            );
        }
    }

    #[test]
    fn a_cubemap_strip_stays_six_squares() {
        assert_eq!(divided(606, 101, 2), (306, 51));
        assert_eq!(divided(1280, 720, 4), (320, 180));
        assert_eq!(divided(17, 16, 4), (5, 4));
    }
}
