//! The sun by time and place through keyframes: times pass into one another as times, places as numbers.

use super::curve::{Four, Moment};
use crate::solar::moment as parsed;
use chrono::{DateTime, SecondsFormat, TimeDelta, Utc};
use serde_json::{Value, json};

const NANOSECONDS: f64 = 1e9;

/// None where one of both is not given so.
pub(super) fn between(values: Four<&Value>, moment: &Moment) -> Option<Value> {
    let times = values.part(|value| parsed(value.get("time")?.as_str()?))?;
    let begin = times.from;
    let seconds = times.part(|time| Some(seconds(time - begin)))?;
    let passed = TimeDelta::nanoseconds(nanoseconds(moment.number(seconds)));
    let member = |name: &str| {
        let numbers = values.part(|value| value.get(name))?;
        Some(super::tween::tween(name, numbers, moment))
    };
    Some(json!({
        "time": text(begin.checked_add_signed(passed)?),
        "latitude_deg": member("latitude_deg")?,
        "longitude_deg": member("longitude_deg")?,
        "refraction": member("refraction")?,
    }))
}

/// A time as short as it can be written.
pub(super) fn text(time: DateTime<Utc>) -> String {
    time.to_rfc3339_opts(SecondsFormat::AutoSi, true)
}

fn seconds(span: TimeDelta) -> f64 {
    #[allow(
        clippy::cast_precision_loss,
        reason = "two centuries are 2⁵³ units of a microsecond"
    )]
    let whole = span.num_seconds() as f64;
    whole + f64::from(span.subsec_nanos()) / NANOSECONDS
}

fn nanoseconds(seconds: f64) -> i64 {
    #[allow(
        clippy::cast_possible_truncation,
        reason = "two centuries are below 2⁶³ nanoseconds"
    )]
    let nanoseconds = (seconds * NANOSECONDS).round() as i64;
    nanoseconds
}
