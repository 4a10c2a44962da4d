//! JSON Schema (draft 2020-12) of the documents, derived from their types. It is both what is served and what is
//! checked, so that a limit stands once.

use crate::{
    document::Scene,
    frame::FrameDocument,
    job::JobRequest,
    metar::{MetarAnswer, MetarRequest},
    probe::ProbeRequest,
    timeline::Timeline,
};
use schemars::{JsonSchema, Schema, generate::SchemaSettings, transform::RecursiveTransform};
use serde_json::Value;

/// The schema of [`Scene`]. A field with a unit has the keyword `x-unit`.
#[must_use]
pub fn scene_schema() -> Value {
    derive::<Scene>()
}

/// The schema of [`FrameRequest`](crate::FrameRequest).
#[must_use]
pub fn frame_request_schema() -> Value {
    derive::<FrameDocument>()
}

/// The schema of [`JobRequest`].
#[must_use]
pub fn job_request_schema() -> Value {
    derive::<JobRequest>()
}

/// The schema of [`Timeline`].
#[must_use]
pub fn timeline_schema() -> Value {
    derive::<Timeline>()
}

/// The schema of [`MetarRequest`].
#[must_use]
pub fn metar_request_schema() -> Value {
    derive::<MetarRequest>()
}

/// The schema of [`MetarAnswer`].
#[must_use]
pub fn metar_answer_schema() -> Value {
    derive::<MetarAnswer>()
}

/// The schema of [`ProbeRequest`].
#[must_use]
pub fn probe_request_schema() -> Value {
    derive::<ProbeRequest>()
}

/// A unit as field names end in it.
pub(crate) struct Unit {
    suffix: &'static str,
    symbol: &'static str,
    /// As a sentence says it.
    pub(crate) word: &'static str,
}

/// A suffix stands before any other that it ends in.
const UNITS: [Unit; 14] = [
    Unit {
        suffix: "_w_m2_sr",
        symbol: "W/m²/sr",
        word: "W/m²/sr",
    },
    Unit {
        suffix: "_w_sr",
        symbol: "W/sr",
        word: "W/sr",
    },
    Unit {
        suffix: "_per_m3",
        symbol: "1/m³",
        word: "per cubic metre",
    },
    Unit {
        suffix: "_cd",
        symbol: "cd",
        word: "candela",
    },
    Unit {
        suffix: "_per_m",
        symbol: "1/m",
        word: "per metre",
    },
    Unit {
        suffix: "_w_m2",
        symbol: "W/m²",
        word: "W/m²",
    },
    Unit {
        suffix: "_m2",
        symbol: "m²",
        word: "square metres",
    },
    Unit {
        suffix: "_deg",
        symbol: "°",
        word: "degrees",
    },
    Unit {
        suffix: "_px",
        symbol: "px",
        word: "pixels",
    },
    Unit {
        suffix: "_ev",
        symbol: "EV",
        word: "EV",
    },
    Unit {
        suffix: "_m_s",
        symbol: "m/s",
        word: "metres per second",
    },
    Unit {
        suffix: "_m",
        symbol: "m",
        word: "metres",
    },
    Unit {
        suffix: "_k",
        symbol: "K",
        word: "kelvin",
    },
    Unit {
        suffix: "_s",
        symbol: "s",
        word: "seconds",
    },
];

/// The field's name without its unit, and the unit. A name may be the unit itself (`ev`); its stem is empty.
pub(crate) fn split_unit(name: &str) -> (&str, Option<&'static Unit>) {
    for unit in &UNITS {
        if name == &unit.suffix[1..] {
            return ("", Some(unit));
        }
        if let Some(stem) = name.strip_suffix(unit.suffix) {
            return (stem, Some(unit));
        }
    }
    (name, None)
}

fn derive<T: JsonSchema>() -> Value {
    SchemaSettings::draft2020_12()
        .with_transform(RecursiveTransform(name_fields))
        .into_generator()
        .into_root_schema_for::<T>()
        .to_value()
}

/// Gives each field a title ("Vertical fov") and its unit.
fn name_fields(schema: &mut Schema) {
    let Some(fields) = schema.get_mut("properties").and_then(Value::as_object_mut) else {
        return;
    };
    for (name, field) in fields {
        let Some(field) = field.as_object_mut() else {
            continue;
        };
        let (stem, unit) = split_unit(name);
        let title = match unit {
            Some(unit) if stem.is_empty() => unit.symbol.into(),
            _ => title(stem),
        };
        field.entry("title").or_insert(title.into());
        if let Some(unit) = unit {
            field.insert("x-unit".into(), unit.symbol.into());
        }
    }
}

fn title(stem: &str) -> String {
    let words = stem.replace('_', " ");
    let mut letters = words.chars();
    letters
        .next()
        .map(|first| first.to_uppercase().chain(letters).collect())
        .unwrap_or_default()
}
