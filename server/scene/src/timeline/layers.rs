//! Layers of cloud through keyframes. Those at the same place in the list and of the same kind (sheets, of the same
//! genus) pass into one another; one without a partner fades by its coverage.

use super::{
    curve::{Four, Moment, smooth},
    tween::tween,
};
use crate::{clouds::MAX_LAYERS, shape::TAG};
use serde_json::Value;

pub(super) fn between(values: Four<&Value>, moment: &Moment) -> Value {
    let at = |value: &Value, i: usize| value.get(i).cloned();
    let length = |value: &Value| value.as_array().map_or(0, Vec::len);
    let (mut kept, mut leaving, mut coming) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..length(values.from).max(length(values.to)) {
        let (from, to) = (at(values.from, i), at(values.to, i));
        let [before, after] = [values.before, values.after].map(|value| value.and_then(|v| at(v, i)));
        if let (Some(from), Some(to)) = (&from, &to)
            && alike(from, to)
        {
            kept.push(passing(before, from, to, after, moment));
            continue;
        }
        leaving.extend(from);
        coming.extend(to);
    }
    // Where a scene has no room for both, the new ones come when the old ones are gone.
    let is_crowded = kept.len() + leaving.len() + coming.len() > MAX_LAYERS;
    let (gone, come) = if is_crowded {
        (
            smooth((2.0 * moment.part).min(1.0)),
            smooth((2.0 * moment.part - 1.0).max(0.0)),
        )
    } else {
        (moment.share(), moment.share())
    };
    let is_there = |late: bool| !is_crowded || moment.is_late() == late;
    let thinned = |layers: Vec<Value>, share: f64| layers.into_iter().map(move |layer| thinned(layer, share));
    if is_there(false) {
        kept.extend(thinned(leaving, 1.0 - gone));
    }
    if is_there(true) {
        kept.extend(thinned(coming, come));
    }
    kept.into()
}

/// A neighbour without this layer is where its fade ends.
fn passing(before: Option<Value>, from: &Value, to: &Value, after: Option<Value>, moment: &Moment) -> Value {
    let neighbour = |layer: Option<Value>, known: &Value| {
        layer.map(|layer| {
            if alike(&layer, known) {
                layer
            } else {
                thinned(known.clone(), 0.0)
            }
        })
    };
    let (before, after) = (neighbour(before, from), neighbour(after, to));
    let values = Four {
        before: before.as_ref(),
        from,
        to,
        after: after.as_ref(),
    };
    tween("layer", values, moment)
}

fn alike(a: &Value, b: &Value) -> bool {
    [TAG, "genus"].iter().all(|name| a.get(name) == b.get(name))
}

fn thinned(mut layer: Value, share: f64) -> Value {
    let coverage = layer["coverage"].as_f64().unwrap_or_default();
    layer["coverage"] = (coverage * share).into();
    layer
}
