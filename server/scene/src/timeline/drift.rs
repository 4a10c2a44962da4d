//! How far a wind that changes has carried the clouds.
//!
//! A scene's clouds have come `drift_m + v·t` at the time t. With a wind v(t) they have come D = ∫ v dt, so that
//! `drift_m` must be D - v(t)·t; otherwise a wind that freshens after an hour would move all clouds by an hour's way.

use super::{
    curve::{Four, Moment},
    track::{Place, Track},
    tween::tween,
};
use crate::clouds::Wind;
use serde_json::{Value, json};

/// Gauss and Legendre's five nodes on 0 to 1 and their weights, exact for polynomials up to the ninth degree.
const NODES: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_6, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];
/// The most that a scene's `drift_m` may be, metres.
const MOST_M: f64 = 1e12;

/// What the wind does in a timeline where it changes.
#[derive(Debug)]
pub(super) struct Drift {
    /// Of each keyframe: its clouds with nothing but their wind; null where there are no clouds.
    winds: Vec<Value>,
    /// How far clouds have come at each keyframe, metres.
    come_m: Vec<[f64; 3]>,
}

impl Drift {
    /// None where the wind is always the same.
    pub(super) fn new(track: &Track) -> Option<Self> {
        let wind = |document: &Value| match document.pointer("/clouds/wind") {
            Some(wind) => json!({ "wind": wind }),
            None => Value::Null,
        };
        let winds: Vec<Value> = track.keys().iter().map(|key| wind(&key.document)).collect();
        let speeds: Vec<_> = winds
            .iter()
            .filter(|wind| !wind.is_null())
            .map(velocity)
            .collect();
        if speeds.windows(2).all(|pair| pair[0] == pair[1]) {
            return None;
        }
        let mut drift = Self {
            winds,
            come_m: Vec::new(),
        };
        let begin_s = track.time_s(track.keys()[0].at_s);
        let mut come_m = velocity(&drift.winds[0]).map(|v| v * begin_s);
        drift.come_m.push(come_m);
        for i in 0..track.keys().len() - 1 {
            come_m = sum(come_m, drift.way(track, i, 1.0));
            drift.come_m.push(come_m);
        }
        Some(drift)
    }

    /// From a keyframe to a part of the way to the next, metres.
    fn way(&self, track: &Track, i: usize, part: f64) -> [f64; 3] {
        let length_s = track.moment(i, part).length_s * part;
        NODES.iter().fold([0.0; 3], |way, (node, weight)| {
            let moment = track.moment(i, node * part);
            let seconds = weight * length_s * track.pace(i, &moment);
            sum(way, self.velocity(i, &moment).map(|v| v * seconds))
        })
    }

    fn velocity(&self, i: usize, moment: &Moment) -> [f64; 3] {
        let winds = Four {
            before: i.checked_sub(1).and_then(|i| self.winds.get(i)),
            from: &self.winds[i],
            to: &self.winds[i + 1],
            after: self.winds.get(i + 2),
        };
        velocity(&tween("clouds", winds, moment))
    }

    /// Adds to the wind's `drift_m` what a change of wind makes of it.
    pub(super) fn add_to(&self, document: &mut Value, track: &Track, at_s: f64) {
        let time_s = track.time_s(at_s);
        let (velocity, come_m) = match track.place(at_s) {
            Place::At(i) => {
                let velocity = velocity(&self.winds[i]);
                let since_s = time_s - track.time_s(track.keys()[i].at_s);
                (velocity, sum(self.come_m[i], velocity.map(|v| v * since_s)))
            }
            Place::Between(i, moment) => (
                self.velocity(i, &moment),
                sum(self.come_m[i], self.way(track, i, moment.part)),
            ),
        };
        let Some(Value::Array(drift_m)) = document.pointer_mut("/clouds/wind/drift_m") else {
            return;
        };
        for (i, axis) in drift_m.iter_mut().enumerate().take(3) {
            let more_m = come_m[i] - velocity[i] * time_s;
            *axis = (axis.as_f64().unwrap_or_default() + more_m)
                .clamp(-MOST_M, MOST_M)
                .into();
        }
    }
}

fn velocity(clouds: &Value) -> [f64; 3] {
    let wind = serde_json::from_value::<Wind>(clouds["wind"].clone());
    wind.map_or([0.0; 3], |wind| wind.velocity_m_s())
}

fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] + b[i])
}
