//! How large a preview may be so that it comes in time.

use std::time::Duration;

/// What a preview should take.
const TARGET: Duration = Duration::from_millis(60);
/// Above this the next is a step smaller.
const TOO_SLOW: Duration = Duration::from_millis(90);
/// Below this the next is a step larger. Four times the pixels then take at most [`TARGET`] plus a fixed part that
/// was counted four times, so that a step up is not followed by a step down.
const FAST: Duration = Duration::from_millis(20);
/// Twice as wide and high was too slow: that many previews pass before it is tried again.
const PATIENCE: u32 = 40;
/// Divisors of the full size.
const DIVISORS: [u16; 3] = [1, 2, 4];

/// Chooses the size of previews from the time that former ones took.
#[derive(Clone, Debug)]
pub(crate) struct Pace {
    step: usize,
    wait: u32,
}

impl Default for Pace {
    fn default() -> Self {
        Self { step: 1, wait: 0 }
    }
}

impl Pace {
    /// What the sides are divided by.
    pub(crate) fn divisor(&self) -> u16 {
        DIVISORS[self.step]
    }

    /// Learns from a preview that was rendered with `divisor`.
    pub(crate) fn learn(&mut self, divisor: u16, took: Duration) {
        if divisor != self.divisor() {
            return;
        }
        self.wait = self.wait.saturating_sub(1);
        if took > TOO_SLOW && self.step + 1 < DIVISORS.len() {
            self.step += 1;
            self.wait = PATIENCE;
        } else if self.step > 0 && (took < FAST || (took < TARGET / 2 && self.wait == 0)) {
            self.step -= 1;
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

    /// Previews of a device that needs `fixed` and `per_full` milliseconds more at full size.
    fn divisors(fixed: f64, per_full: f64) -> Vec<u16> {
        let mut pace = Pace::default();
        let preview = |_| {
            let divisor = pace.divisor();
            let ms = fixed + per_full / f64::from(divisor * divisor);
            pace.learn(divisor, Duration::from_secs_f64(ms / 1e3));
            divisor
        };
        (0..200).map(preview).collect()
    }

    #[test]
    fn a_fast_device_shows_full_size_and_a_slow_one_a_quarter() {
        assert_eq!(divisors(1.0, 5.0).last(), Some(&1));
        assert_eq!(divisors(5.0, 2000.0).last(), Some(&4));
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
            let changes = divisors(fixed, per_full)
                .windows(2)
                .filter(|pair| pair[0] != pair[1])
                .count();
            // Two steps to where it belongs, and a try every 40 previews that goes up and comes back.
            assert!(
                changes <= 2 + 2 * 200 / 40,
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
