//! Directions through keyframes: a cubic Bézier curve drawn on the sphere, by de Casteljau's construction with great
//! circles for lines (Shoemake 1985).

use super::curve::{Four, Moment};
use crate::direction::Direction;
use serde_json::Value;

type Unit = [f64; 3];

/// Angles below this are none, radians.
const NO_ANGLE: f64 = 1e-9;
/// A curve with speeds up to three times those of its stretches does not turn back; this keeps well below.
const MOST_SPEED: f64 = 1.5;

/// The unit vector, if the value is a direction.
pub(super) fn unit(value: &Value) -> Option<Unit> {
    let is_like = value.is_array() || value.get("azimuth_deg").is_some();
    let direction = is_like.then(|| serde_json::from_value::<Direction>(value.clone()).ok())?;
    Some(direction?.unit())
}

/// A direction as the scene has it.
pub(super) fn value(unit: Unit) -> Value {
    let angles = Direction::Vector(unit).to_angles();
    serde_json::json!({"azimuth_deg": angles.azimuth_deg, "elevation_deg": angles.elevation_deg})
}

pub(super) fn between(units: Four<Unit>, moment: &Moment) -> Unit {
    let Four {
        before,
        from,
        to,
        after,
    } = units;
    let (
        Moment {
            before_s,
            length_s,
            after_s,
            part,
        },
        third,
    ) = (*moment, moment.length_s / 3.0);
    let leaving = before.map_or([0.0; 3], |before| speed(before, before_s, from, length_s, to));
    let arriving = after.map_or([0.0; 3], |after| speed(from, length_s, to, after_s, after));
    let points = [
        from,
        moved(from, leaving.map(|v| v * third)),
        moved(to, arriving.map(|v| -v * third)),
        to,
    ];
    let [a, b, c] = [0, 1, 2].map(|i| slerp(points[i], points[i + 1], part));
    let [a, b] = [slerp(a, b, part), slerp(b, c, part)];
    slerp(a, b, part)
}

/// The point on the great circle from `a` to `b`.
pub(super) fn slerp(a: Unit, b: Unit, share: f64) -> Unit {
    moved(a, towards(a, b).map(|v| v * share))
}

/// Velocity at `at` on the way from `before` to `after`, radians per second.
fn speed(before: Unit, before_s: f64, at: Unit, after_s: f64, after: Unit) -> Unit {
    let back = towards(at, before);
    let [came, goes] = [
        back.map(|v| -v / before_s),
        towards(at, after).map(|v| v / after_s),
    ];
    if dot(came, goes) <= 0.0 {
        return [0.0; 3];
    }
    let whole = before_s + after_s;
    let mean = [0, 1, 2].map(|i| (came[i] * after_s + goes[i] * before_s) / whole);
    let most = MOST_SPEED * length(came).min(length(goes));
    let factor = (most / length(mean)).min(1.0);
    mean.map(|v| v * factor)
}

/// The tangent at `a` that leads to `b`, as long as their angle, radians. Towards the opposite it leads by the zenith,
/// or north if it is at the zenith itself.
fn towards(a: Unit, b: Unit) -> Unit {
    let cosine = dot(a, b);
    let across = |v: Unit| {
        let along = dot(a, v);
        [0, 1, 2].map(|i| v[i] - along * a[i])
    };
    let side = across(b);
    let sine = length(side);
    if sine > NO_ANGLE {
        let angle = sine.atan2(cosine);
        return side.map(|v| v / sine * angle);
    }
    if cosine > 0.0 {
        return side;
    }
    let up = across([0.0, 0.0, 1.0]);
    let way = if length(up) > NO_ANGLE {
        up
    } else {
        across([0.0, 1.0, 0.0])
    };
    let size = length(way);
    way.map(|v| v / size * std::f64::consts::PI)
}

/// Along a tangent as far as it is long, radians.
fn moved(from: Unit, tangent: Unit) -> Unit {
    let angle = length(tangent);
    if angle == 0.0 {
        return from;
    }
    let (sin, cos) = angle.sin_cos();
    let point = [0, 1, 2].map(|i| from[i] * cos + tangent[i] / angle * sin);
    let size = length(point);
    point.map(|v| v / size)
}

fn dot(a: Unit, b: Unit) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(v: Unit) -> f64 {
    dot(v, v).sqrt()
}
