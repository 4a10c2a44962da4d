//! A quantity in the three bands.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A quantity that may differ from band to band: one number for all three, or R, G and B. The range of the field that
/// holds it counts for each number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Bands {
    /// Grey. The same in all bands.
    Grey(f64),
    /// Red, green, blue.
    Rgb([f64; 3]),
}

impl Bands {
    /// R, G and B.
    #[must_use]
    pub const fn rgb(self) -> [f64; 3] {
        match self {
            Self::Grey(value) => [value; 3],
            Self::Rgb(values) => values,
        }
    }
}

/// Says what each number of a [`Bands`] may be: schemars' `range` reaches numbers alone, not the members of a union.
macro_rules! bounded_bands {
    ($name:ident, $least:expr, $most:expr) => {
        pub(crate) fn $name(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
            let mut schema = <crate::bands::Bands as schemars::JsonSchema>::json_schema(generator);
            crate::bands::bound(&mut schema, $least, $most);
            schema
        }
    };
}

pub(crate) fn bound(schema: &mut schemars::Schema, least: f64, most: f64) {
    let Some(branches) = schema.get_mut("anyOf").and_then(|b| b.as_array_mut()) else {
        return;
    };
    for branch in branches {
        let number = if branch["type"] == "array" {
            &mut branch["items"]
        } else {
            branch
        };
        number["minimum"] = least.into();
        number["maximum"] = most.into();
    }
}

bounded_bands!(coefficient_per_m, 0.0, 0.1);
bounded_bands!(share, 0.0, 1.0);
