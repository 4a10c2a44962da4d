//! Values for the fields that change from frame to frame.

use crate::frame::whole;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// Most values of one field.
const MAX_VALUES: u32 = 10_000;

/// A field of the scene and the values it takes in turn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum Axis {
    /// From one number to another in even steps.
    Steps(Steps),
    /// These.
    Values(Values),
}

/// A field of the scene and what its value is drawn from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum Spread {
    /// Any number between two, all alike likely.
    Range(Range),
    /// One of these, all alike likely.
    Values(Values),
}

/// Numbers in even steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Steps {
    /// The field, as a JSON pointer (RFC 6901) in the scene.
    pub field: String,
    /// The first value.
    pub from: f64,
    /// The last value.
    pub to: f64,
    /// How many values.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 2, max = 10_000))]
    pub steps: u32,
}

/// Values of any kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Values {
    /// The field, as a JSON pointer (RFC 6901) in the scene.
    pub field: String,
    /// What it may be.
    #[schemars(length(min = 1, max = MAX_VALUES))]
    pub values: Vec<Value>,
}

/// Numbers between two.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Range {
    /// The field, as a JSON pointer (RFC 6901) in the scene.
    pub field: String,
    /// The least number.
    pub from: f64,
    /// The greatest number.
    pub to: f64,
    /// Whole numbers only, both ends included.
    #[serde(default)]
    pub whole: bool,
}

impl Axis {
    pub(super) fn field(&self) -> &str {
        match self {
            Self::Steps(steps) => &steps.field,
            Self::Values(values) => &values.field,
        }
    }

    pub(super) fn count(&self) -> u64 {
        match self {
            Self::Steps(steps) => steps.steps.into(),
            Self::Values(values) => values.values.len() as u64,
        }
    }

    /// The value at a step, from 0.
    pub(super) fn value(&self, step: u64) -> Value {
        match self {
            Self::Steps(Steps { from, to, steps, .. }) => {
                #[allow(clippy::cast_precision_loss, reason = "steps are ten thousand at most")]
                let share = step as f64 / f64::from(steps - 1);
                // Both ends exactly.
                json!(from * (1.0 - share) + to * share)
            }
            Self::Values(values) => pick(&values.values, step),
        }
    }
}

impl Spread {
    pub(super) fn field(&self) -> &str {
        match self {
            Self::Range(range) => &range.field,
            Self::Values(values) => &values.field,
        }
    }

    /// The value that 64 random bits choose.
    pub(super) fn value(&self, bits: u64) -> Value {
        match self {
            Self::Range(Range {
                from,
                to,
                whole: true,
                ..
            }) => {
                let (least, most) = (from.ceil(), to.floor());
                // 53 bits over the count of numbers: no multiple of it is off by more than one in 2^53.
                json!((least + (unit(bits) * (most - least + 1.0)).floor()).min(most))
            }
            Self::Range(Range { from, to, .. }) => {
                let share = unit(bits);
                json!((from * (1.0 - share) + to * share).clamp(from.min(*to), to.max(*from)))
            }
            Self::Values(Values { values, .. }) => {
                let one = (u128::from(bits) * values.len() as u128) >> 64;
                pick(values, u64::try_from(one).unwrap_or_default())
            }
        }
    }
}

fn pick(values: &[Value], at: u64) -> Value {
    usize::try_from(at)
        .ok()
        .and_then(|at| values.get(at))
        .cloned()
        .unwrap_or_default()
}

/// From 0 up to but not 1, in steps of 2^-53.
#[allow(clippy::cast_precision_loss, reason = "53 bits are what a double holds")]
fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 * 2f64.powi(-53)
}

/// Random bits of a field in a frame: SplitMix64 (Steele, Lea and Flood 2014) started from all three, so that any frame
/// can be made without those before it.
pub(super) fn bits(seed: u32, frame: u32, field: usize) -> u64 {
    let mix = |state: u64| {
        let z = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    mix(mix(mix(seed.into()) ^ u64::from(frame)) ^ field as u64)
}

#[cfg(test)]
mod tests {
    #![allow(
        clippy::unwrap_used,
        clippy::cast_precision_loss,
        reason = "tests fail by panicking"
    )]

    use super::*;

    /// `bits` through the public face: the spread of a million is even to what chance allows.
    #[test]
    fn random_values_are_even_and_of_no_pattern() {
        let count = 100_000_u32;
        for field in 0..3 {
            let values: Vec<f64> = (0..count).map(|frame| unit(bits(7, frame, field))).collect();
            let mean = values.iter().sum::<f64>() / f64::from(count);
            // The mean of n even values has a deviation of 1/sqrt(12 n); five of them are never seen.
            assert!(
                (mean - 0.5).abs() < 5.0 / (12.0 * f64::from(count)).sqrt(),
                "{mean}"
            );
            let beside: f64 = values.windows(2).map(|w| (w[0] - 0.5) * (w[1] - 0.5)).sum();
            // Products of two independent even values: 1/12 deviation each.
            assert!(beside.abs() < 5.0 / 12.0 * f64::from(count).sqrt(), "{beside}");
        }
    }

    #[test]
    fn whole_numbers_reach_both_ends() {
        let range = Spread::Range(Range {
            field: String::new(),
            from: 1.0,
            to: 6.0,
            whole: true,
        });
        let mut seen = [0_u32; 6];
        for frame in 0..6000 {
            let value = range.value(bits(1, frame, 0)).as_f64().unwrap();
            assert!(value.fract() == 0.0 && (1.0..=6.0).contains(&value));
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "one to six"
            )]
            let at = value as usize - 1;
            seen[at] += 1;
        }
        // A binomial deviation of sqrt(6000 * 5/36) = 29; five of them.
        assert!(seen.iter().all(|count| count.abs_diff(1000) < 145), "{seen:?}");
        assert_eq!(range.value(u64::MAX).as_f64(), Some(6.0));
        assert_eq!(range.value(0).as_f64(), Some(1.0));
    }

    #[test]
    fn steps_reach_both_ends_exactly() {
        let axis = Axis::Steps(Steps {
            field: String::new(),
            from: 0.1,
            to: 0.7,
            steps: 4,
        });
        assert_eq!(axis.value(0), json!(0.1));
        assert_eq!(axis.value(3), json!(0.7));
    }
}
