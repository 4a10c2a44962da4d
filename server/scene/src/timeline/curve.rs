//! Numbers through keyframes: cubic Hermite splines without overshoot.
//!
//! Between two keyframes a number follows the cubic with given values and slopes at both. The slope at a keyframe is
//! the weighted harmonic mean of those to its neighbours, or 0 where it would turn there (Fritsch and Butland 1984):
//! so it stays between the values of its two keyframes and has no corner. The first and the last keyframe, beyond which
//! all stands still, have slope 0.

/// What two keyframes hold, and those before and after, if there are any and they can be compared.
#[derive(Clone, Copy, Debug)]
pub(super) struct Four<T> {
    pub(super) before: Option<T>,
    pub(super) from: T,
    pub(super) to: T,
    pub(super) after: Option<T>,
}

impl<T: Copy> Four<T> {
    /// A part of each, if both keyframes have it.
    pub(super) fn part<U>(self, part: impl Fn(T) -> Option<U>) -> Option<Four<U>> {
        Some(Four {
            before: self.before.and_then(&part),
            from: part(self.from)?,
            to: part(self.to)?,
            after: self.after.and_then(&part),
        })
    }
}

/// A time between two keyframes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment {
    /// From the keyframe before, seconds.
    pub(super) before_s: f64,
    /// Between both, seconds.
    pub(super) length_s: f64,
    /// To the keyframe after, seconds.
    pub(super) after_s: f64,
    /// How much of `length_s` is over, 0 to 1.
    pub(super) part: f64,
}

impl Moment {
    /// The half in which what cannot be mixed is that of the later keyframe.
    pub(super) fn is_late(&self) -> bool {
        self.part >= 0.5
    }

    /// From 0 to 1, level at both ends.
    pub(super) fn share(&self) -> f64 {
        smooth(self.part)
    }

    pub(super) fn number(&self, values: Four<f64>) -> f64 {
        let (from_slope, to_slope) = self.slopes(values);
        let Four { from, to, .. } = values;
        let s = self.part;
        let rest = 1.0 - s;
        // Hermite's basis: (1 + 2s)(1-s)², s(1-s)², s²(3-2s), -s²(1-s).
        let curve = (1.0 + 2.0 * s) * rest * rest * from
            + s * rest * rest * self.length_s * from_slope
            + s * s * (3.0 - 2.0 * s) * to
            - s * s * rest * self.length_s * to_slope;
        curve.clamp(from.min(to), from.max(to))
    }

    /// How fast [`Self::number`] changes, per second.
    pub(super) fn rate(&self, values: Four<f64>) -> f64 {
        let (from_slope, to_slope) = self.slopes(values);
        let s = self.part;
        6.0 * s * (1.0 - s) * (values.to - values.from) / self.length_s
            + (1.0 - s) * (1.0 - 3.0 * s) * from_slope
            + s * (3.0 * s - 2.0) * to_slope
    }

    fn slopes(&self, values: Four<f64>) -> (f64, f64) {
        let middle = (values.to - values.from) / self.length_s;
        let first = values.before.map_or(0.0, |before| {
            let secant = (values.from - before) / self.before_s;
            slope((self.before_s, secant), (self.length_s, middle))
        });
        let last = values.after.map_or(0.0, |after| {
            let secant = (after - values.to) / self.after_s;
            slope((self.length_s, middle), (self.after_s, secant))
        });
        (first, last)
    }
}

/// The slope between two stretches, each a length and its secant.
fn slope((length_0, secant_0): (f64, f64), (length_1, secant_1): (f64, f64)) -> f64 {
    if secant_0 * secant_1 <= 0.0 {
        return 0.0;
    }
    let (weight_0, weight_1) = (2.0 * length_1 + length_0, length_1 + 2.0 * length_0);
    (weight_0 + weight_1) / (weight_0 / secant_0 + weight_1 / secant_1)
}

/// 6s⁵ - 15s⁴ + 10s³: level at both ends, with no bend there either.
pub(super) fn smooth(s: f64) -> f64 {
    (s * s * s * s.mul_add(s.mul_add(6.0, -15.0), 10.0)).clamp(0.0, 1.0)
}
