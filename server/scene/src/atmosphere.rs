//! The air. Default values: Hillaire 2020 (Earth, clear), and in R, G and B what the three responses of Rec. 709 make of
//! the spectra of molecules and ozone (`docs/conventions.md`).

use crate::{
    airglow::Airglow,
    bands::{Bands, coefficient_per_m},
    frame::whole_or_null,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The air round the planet: molecules, aerosols, ozone. A part set to `null` is absent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Atmosphere {
    /// How it is computed.
    pub method: Method,
    /// Steps along each ray of view; null for as many as the promised accuracy takes.
    #[serde(deserialize_with = "whole_or_null")]
    #[schemars(range(min = 4, max = 256))]
    pub view_steps: Option<u32>,
    /// Steps along each ray to the sun: in every step of view (`nested`), or for each entry of the table (`table`,
    /// `lut`); null for as many as the promised accuracy takes.
    #[serde(deserialize_with = "whole_or_null")]
    #[schemars(range(min = 4, max = 256))]
    pub sun_steps: Option<u32>,
    /// Which orders of scattering count.
    pub orders: Orders,
    /// Height above the ground where the air ends, metres.
    #[schemars(range(min = 1e3, max = 1e6))]
    pub top_m: f64,
    /// Multiplies every density.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub density_factor: f64,
    /// Molecules.
    pub rayleigh: Option<Rayleigh>,
    /// Aerosols.
    pub mie: Option<Mie>,
    /// Ozone, which absorbs only.
    pub ozone: Option<Ozone>,
    /// The upper air's own light at night; `null` for none.
    pub airglow: Option<Airglow>,
}

impl Default for Atmosphere {
    fn default() -> Self {
        Self {
            method: Method::Lut,
            view_steps: None,
            sun_steps: None,
            orders: Orders::Multiple,
            top_m: 100_000.0,
            density_factor: 1.0,
            rayleigh: Some(Rayleigh::default()),
            mie: Some(Mie::default()),
            ozone: Some(Ozone::default()),
            airglow: Some(Airglow::default()),
        }
    }
}

/// How the light in the air is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// The optical depth towards the sun is integrated anew in every step along every ray: the first approach of
    /// Iniesta and Pérez 2015 (after Nishita 1993).
    Nested,
    /// The same with the optical depth by height and sun angle from a table, their second approach (after O'Neil
    /// 2005).
    Table,
    /// Tables of transmittance, multiple scattering and sky radiance (Hillaire 2020).
    #[default]
    Lut,
}

/// Which orders of scattering count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Orders {
    /// Light scattered once; the ground is lit by the sun alone.
    Single,
    /// All orders, and the light between ground and air.
    #[default]
    Multiple,
}

/// Molecules: density falls as e^(-h / scale height).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Rayleigh {
    /// Scattering coefficient at the ground in R, G and B, 1/m.
    #[schemars(inner(range(min = 0.0, max = 0.1)))]
    pub scattering_per_m: [f64; 3],
    /// Absorption coefficient at the ground in R, G and B, 1/m: next to nothing in clean air.
    #[schemars(inner(range(min = 0.0, max = 0.1)))]
    pub absorption_per_m: [f64; 3],
    /// Height over which the density falls to 1/e, metres.
    #[schemars(range(min = 10.0, max = 1e5))]
    pub scale_height_m: f64,
}

impl Default for Rayleigh {
    fn default() -> Self {
        Self {
            scattering_per_m: [7.09e-6, 13.75e-6, 33.1e-6],
            absorption_per_m: [0.0; 3],
            scale_height_m: 8_000.0,
        }
    }
}

/// Aerosols, with a forward peak (Cornette and Shanks 1992).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Mie {
    /// Scattering coefficient at the ground, one number or R, G and B, 1/m.
    #[schemars(schema_with = "coefficient_per_m")]
    pub scattering_per_m: Bands,
    /// Absorption coefficient at the ground, one number or R, G and B, 1/m: greater in blue for dust and smoke.
    #[schemars(schema_with = "coefficient_per_m")]
    pub absorption_per_m: Bands,
    /// Height over which the density falls to 1/e, metres.
    #[schemars(range(min = 10.0, max = 1e5))]
    pub scale_height_m: f64,
    /// Asymmetry g of the phase function: 0 even, towards 1 forward, towards -1 backward.
    #[schemars(range(min = -0.999, max = 0.999))]
    pub asymmetry: f64,
}

impl Default for Mie {
    fn default() -> Self {
        Self {
            scattering_per_m: Bands::Grey(3.996e-6),
            absorption_per_m: Bands::Grey(0.444e-6),
            scale_height_m: 1_200.0,
            asymmetry: 0.8,
        }
    }
}

/// Ozone: a layer whose density rises and falls linearly about its centre.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Ozone {
    /// Absorption coefficient at the centre in R, G and B, 1/m.
    #[schemars(inner(range(min = 0.0, max = 0.1)))]
    pub absorption_per_m: [f64; 3],
    /// Height of the centre, metres.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub centre_m: f64,
    /// Distance from the centre to where the layer ends, metres.
    #[schemars(range(min = 1.0, max = 1e6))]
    pub half_width_m: f64,
}

impl Default for Ozone {
    fn default() -> Self {
        Self {
            absorption_per_m: [2.7e-6, 1.66e-6, 0.02e-6],
            centre_m: 25_000.0,
            half_width_m: 15_000.0,
        }
    }
}
