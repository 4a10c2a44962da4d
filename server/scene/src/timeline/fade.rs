//! What a part looks like just before it is gone.

use serde_json::{Map, Value};

/// The part without effect; none where a part of this name cannot fade and is switched.
pub(super) fn faded(name: &str, part: &Value) -> Option<Value> {
    let mut members = part.as_object()?.clone();
    match name {
        "clouds" => {
            silence(&mut members, |name| matches!(name, "coverage" | "density"));
            let layers = members.get_mut("layers").and_then(Value::as_array_mut);
            for layer in layers.into_iter().flatten().filter_map(Value::as_object_mut) {
                silence(layer, |name| name == "coverage");
            }
        }
        "haze" | "rayleigh" | "mie" | "ozone" => silence(&mut members, |name| name.ends_with("_per_m")),
        "airglow" => silence(&mut members, |name| name == "zenith_radiance_w_m2_sr"),
        "atmosphere" => {
            silence(&mut members, |name| name == "density_factor");
            if let Some(airglow) = members
                .get("airglow")
                .and_then(|airglow| faded("airglow", airglow))
            {
                members.insert("airglow".into(), airglow);
            }
        }
        "stars" => silence(&mut members, |name| name == "intensity"),
        "moon" => silence(&mut members, |name| {
            matches!(name, "irradiance_scale" | "earthshine")
        }),
        _ => return None,
    }
    Some(Value::Object(members))
}

fn silence(members: &mut Map<String, Value>, is_it: impl Fn(&str) -> bool) {
    for (name, value) in members.iter_mut() {
        if is_it(name) {
            *value = zero(value);
        }
    }
}

fn zero(value: &Value) -> Value {
    match value {
        Value::Array(numbers) => numbers.iter().map(zero).collect(),
        Value::Null => Value::Null,
        _ => Value::from(0.0),
    }
}
