//! Between two keyframes, member by member of their documents, which are complete.

use super::{
    curve::{Four, Moment},
    fade::faded,
    layers, place, sphere, weather,
};
use crate::shape::TAG;
use serde_json::{Map, Value};

/// Members that are angles about a circle, which are the same after a whole turn, and what half of them is.
const TURNING: [&str; 3] = ["azimuth_deg", "longitude_deg", "sidereal_time_deg"];
const TURN_DEG: f64 = 360.0;

/// Members that rise from the first to the second, and the greatest that the second may be.
const RISING: [(&str, &str, f64); 2] = [("base_m", "top_m", 1e5), ("low_freq_min", "low_freq_max", 1.0)];
/// The airglow's shell lies higher than clouds.
const AIRGLOW_MOST_M: f64 = 1e6;

/// The member of that name at a moment.
pub(super) fn tween(name: &str, values: Four<&Value>, moment: &Moment) -> Value {
    let ends = [values.from, values.to].map(|end| filled(name, end, values));
    let [Some(from), Some(to)] = &ends else {
        return switched(values, moment);
    };
    // A keyframe from which the part was lacking is where its fade ends.
    let neighbour = |end: &Value, known: &Value, beyond: Option<&Value>| match beyond {
        _ if end.is_null() && !known.is_null() => None,
        Some(Value::Null) => faded(name, known),
        other => other.cloned(),
    };
    let [before, after] = [
        neighbour(values.from, from, values.before),
        neighbour(values.to, to, values.after),
    ];
    let values = Four {
        before: before.as_ref(),
        from,
        to,
        after: after.as_ref(),
    };
    if from == to {
        return from.clone();
    }
    match (name, from, to) {
        ("weather_map", ..) => weather::between(from, to, moment),
        ("gradients", ..) => mixed(from, to, moment.share()),
        // Numbers between two seeds are yet others; those between two sizes are no powers of two.
        ("seed" | "size_px", ..) => switched(values, moment),
        ("direction" | "position", ..) => direction(values, moment),
        (_, Value::Number(_), Value::Number(_)) => number(name, values, moment),
        (_, Value::Array(_), Value::Array(_)) => array(name, values, moment),
        (_, Value::Object(_), Value::Object(_)) => object(name, values, moment),
        (_, Value::Array(_), Value::Number(_)) | (_, Value::Number(_), Value::Array(_)) => {
            bands(values, moment)
        }
        _ => switched(values, moment),
    }
}

/// An end of the stretch; where the part is lacking there alone, the other end's, faded.
fn filled(name: &str, end: &Value, values: Four<&Value>) -> Option<Value> {
    match (values.from, values.to) {
        (Value::Null, Value::Null) => Some(Value::Null),
        (Value::Null, known) | (known, Value::Null) if end.is_null() => faded(name, known),
        _ => Some(end.clone()),
    }
}

fn switched(values: Four<&Value>, moment: &Moment) -> Value {
    let end = if moment.is_late() { values.to } else { values.from };
    end.clone()
}

fn number(name: &str, values: Four<&Value>, moment: &Moment) -> Value {
    let Some(mut numbers) = values.part(Value::as_f64) else {
        return switched(values, moment);
    };
    let is_turning = TURNING.contains(&name);
    if is_turning {
        let near =
            |angle: f64, to: f64| to + (angle - to + TURN_DEG / 2.0).rem_euclid(TURN_DEG) - TURN_DEG / 2.0;
        numbers.before = numbers.before.map(|angle| near(angle, numbers.from));
        numbers.to = near(numbers.to, numbers.from);
        numbers.after = numbers.after.map(|angle| near(angle, numbers.to));
    }
    let mut number = moment.number(numbers);
    if is_turning {
        number = (number + TURN_DEG / 2.0).rem_euclid(TURN_DEG) - TURN_DEG / 2.0;
    }
    if values.from.is_u64() && values.to.is_u64() {
        whole(number)
    } else {
        Value::from(number)
    }
}

/// Steps and the like are whole.
fn whole(number: f64) -> Value {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between two numbers of 32 bits, which are not negative"
    )]
    Value::from(number.round() as u64)
}

fn array(name: &str, values: Four<&Value>, moment: &Moment) -> Value {
    if name == "layers" {
        return layers::between(values, moment);
    }
    let length = |value: &Value| value.as_array().map(Vec::len);
    if length(values.from) != length(values.to) {
        return switched(values, moment);
    }
    (0..length(values.from).unwrap_or_default())
        .filter_map(|i| values.part(|value| value.get(i)))
        .map(|items| tween("", items, moment))
        .collect()
}

/// One number for all three bands beside three.
fn bands(values: Four<&Value>, moment: &Moment) -> Value {
    (0..3)
        .filter_map(|i| {
            values.part(|value| {
                if value.is_number() {
                    Some(value)
                } else {
                    value.get(i)
                }
            })
        })
        .map(|items| tween("", items, moment))
        .collect()
}

/// Shapes of different kinds have nothing in common.
fn object(name: &str, values: Four<&Value>, moment: &Moment) -> Value {
    let kind = values.from.get(TAG);
    if values.to.get(TAG) != kind {
        return switched(values, moment);
    }
    let alike = |value: &&Value| value.get(TAG) == kind;
    let values = Four {
        before: values.before.filter(alike),
        after: values.after.filter(alike),
        ..values
    };
    let mut members = Map::new();
    for (member, _) in values.from.as_object().into_iter().flatten() {
        if let Some(parts) = values.part(|value| value.get(member)) {
            members.insert(member.clone(), tween(member, parts, moment));
        }
    }
    for (low, high, most) in RISING {
        let most = if name == "airglow" { AIRGLOW_MOST_M } else { most };
        let rise = values.part(|value| Some(value.get(high)?.as_f64()? - value.get(low)?.as_f64()?));
        if let (Some(rise), Some(from)) = (rise, members.get(low).and_then(Value::as_f64)) {
            // Both follow curves of their own; the second is told by how far it is above the first.
            let to = (from + moment.number(rise)).min(most).max(from.next_up());
            members.insert(high.into(), to.into());
        }
    }
    Value::Object(members)
}

fn direction(values: Four<&Value>, moment: &Moment) -> Value {
    if let Some(units) = values.part(sphere::unit) {
        return sphere::value(sphere::between(units, moment));
    }
    place::between(values, moment).unwrap_or_else(|| switched(values, moment))
}

/// Straight from one to the other, all numbers alike: what rises from number to number goes on doing so.
fn mixed(from: &Value, to: &Value, share: f64) -> Value {
    match (from, to) {
        (Value::Object(members), _) => members
            .iter()
            .filter_map(|(name, value)| Some((name.clone(), mixed(value, to.get(name)?, share))))
            .collect(),
        (Value::Array(items), Value::Array(others)) => items
            .iter()
            .zip(others)
            .map(|(a, b)| mixed(a, b, share))
            .collect(),
        _ => match from.as_f64().zip(to.as_f64()) {
            Some((a, b)) => Value::from(a * (1.0 - share) + b * share),
            None => to.clone(),
        },
    }
}
