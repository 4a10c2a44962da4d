//! Weather maps through keyframes: one fades into the other.

use super::curve::{Moment, smooth};
use serde_json::{Value, json};

/// A stretch of a cross-fade: `share` goes from the first to the second number.
struct Leg<'a> {
    from: &'a Value,
    to: &'a Value,
    shares: [f64; 2],
}

/// A blend cannot hold blends. One from such a map goes to the nearer of its two first, one to such a map comes from
/// there; so there are up to three legs, each as long as the others.
pub(super) fn between(from: &Value, to: &Value, moment: &Moment) -> Value {
    let mut legs = Vec::new();
    let (first, last) = (nearest(from), nearest(to));
    if let Some(shares) = same_pair(from, to) {
        legs.push(leg(from, shares));
    } else {
        if is_blend(from) {
            legs.push(leg(from, [share(from), near_share(from)]));
        }
        if first != last {
            legs.push(Leg {
                from: first,
                to: last,
                shares: [0.0, 1.0],
            });
        }
        if is_blend(to) {
            legs.push(leg(to, [near_share(to), share(to)]));
        }
    }
    let count = legs.len() as f64;
    let mut part = moment.part * count;
    for leg in &legs {
        if part < 1.0 {
            let [a, b] = leg.shares;
            let share = a + (b - a) * smooth(part);
            return json!({"kind": "blend", "from": leg.from, "to": leg.to, "share": share.clamp(0.0, 1.0)});
        }
        part -= 1.0;
    }
    to.clone()
}

fn leg(blend: &Value, shares: [f64; 2]) -> Leg<'_> {
    Leg {
        from: &blend["from"],
        to: &blend["to"],
        shares,
    }
}

/// Two blends of the same maps, or one and an end of it, differ by their shares alone.
fn same_pair(from: &Value, to: &Value) -> Option<[f64; 2]> {
    (is_blend(from) && is_blend(to) && from["from"] == to["from"] && from["to"] == to["to"])
        .then(|| [share(from), share(to)])
}

fn is_blend(map: &Value) -> bool {
    map["kind"] == "blend"
}

fn share(map: &Value) -> f64 {
    map["share"].as_f64().unwrap_or_default()
}

fn near_share(map: &Value) -> f64 {
    if share(map) < 0.5 { 0.0 } else { 1.0 }
}

fn nearest(map: &Value) -> &Value {
    match is_blend(map) {
        false => map,
        true if share(map) < 0.5 => &map["from"],
        true => &map["to"],
    }
}
