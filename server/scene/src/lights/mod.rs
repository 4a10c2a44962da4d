//! Lamps on the ground, and what raises pillars of their light.

mod check;
mod lamp;
mod town;

pub(crate) use check::check;
pub use lamp::Lamp;
pub use town::{AssetTown, ProceduralTown, Town};

use crate::bands::Bands;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Most lamps that a document lists.
pub const MAX_LIGHTS: usize = 20_000;

/// A lamp. It is seen as a small disc, and where there are ice crystals a pillar of its light stands over it.
///
/// How bright it is is said by `radiant_intensity_w_sr`, or by `luminous_intensity_cd` with the kind of `lamp`; without
/// either, by 1000 cd of a high-pressure sodium lamp.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Light {
    /// East and north of the scene's origin, and up from what `above` says, metres.
    #[schemars(inner(range(min = -1e6, max = 1e6)))]
    pub position_m: [f64; 3],
    /// What its height is measured from.
    pub above: Above,
    /// Radiant intensity in R, G and B, or one number for all three, W/sr (per nm).
    #[schemars(schema_with = "intensity")]
    pub radiant_intensity_w_sr: Option<Bands>,
    /// What kind of lamp it is, for its colour.
    pub lamp: Option<Lamp>,
    /// Colour temperature, kelvin; of the kinds `incandescent` (2700 where it is left out) and `white-led` (4000).
    #[schemars(range(min = 1000.0, max = 20_000.0))]
    pub colour_temperature_k: Option<f64>,
    /// Luminous intensity, candela, where the lamp sends the most.
    #[schemars(range(min = 0.0, max = 1e9))]
    pub luminous_intensity_cd: Option<f64>,
    /// Radius of the disc that it is seen as, metres; 0 is a point.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub radius_m: f64,
    /// Where it sends its light.
    pub emission: Emission,
}

/// Of the array's branch, a list of three; of the number's, a grey.
fn intensity(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let mut schema = <Option<Bands> as JsonSchema>::json_schema(generator);
    let mut bands = Bands::json_schema(generator);
    crate::bands::bound(&mut bands, 0.0, 1e9);
    if let (Some(to), Some(from)) = (schema.get_mut("anyOf"), bands.get("anyOf")) {
        let mut branches = from.as_array().cloned().unwrap_or_default();
        branches.push(serde_json::json!({"type": "null"}));
        *to = branches.into();
    }
    schema
}

/// What a height is measured from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Above {
    /// The planet's sphere, straight below.
    #[default]
    Sphere,
    /// The terrain straight below, or the sphere where it is higher.
    Ground,
}

/// Where a lamp sends its light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Emission {
    /// The same in all directions.
    #[default]
    Isotropic,
    /// Upwards alone, by the cosine of the angle from the zenith, as a floodlight on the ground.
    CosineUp,
    /// Downwards alone, as a street lamp that spares the sky: the same in all directions lower than 10° below the
    /// horizon, and less from there up to the horizon.
    FullCutoff,
}

/// What `luminous_intensity_cd` is where nothing is said, candela.
pub const DEFAULT_INTENSITY_CD: f64 = 1_000.0;

impl Light {
    /// What it sends out, whichever way it is said.
    #[must_use]
    pub fn power(&self) -> Power {
        match self.radiant_intensity_w_sr {
            Some(bands) => Power::Radiant(bands.rgb()),
            None => Power::Luminous {
                lamp: self.lamp.unwrap_or_default(),
                colour_temperature_k: self.colour_temperature_k,
                candela: self.luminous_intensity_cd.unwrap_or(DEFAULT_INTENSITY_CD),
            },
        }
    }
}

/// How much a lamp sends out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Power {
    /// In R, G and B, W/sr.
    Radiant([f64; 3]),
    /// By the eye's measure.
    Luminous {
        /// What it is.
        lamp: Lamp,
        /// Where it says so, kelvin.
        colour_temperature_k: Option<f64>,
        /// How much.
        candela: f64,
    },
}
