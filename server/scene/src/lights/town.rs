//! Many lamps at once.

use super::{Above, Emission, Lamp, Light};
use crate::frame::whole;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Many lamps at once, beside those of `lights`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Town {
    /// Lamps along the streets of a town that is made for a seed.
    Procedural(ProceduralTown),
    /// Lamps of a file in the asset store.
    Asset(AssetTown),
}

/// A town with streets in rows, thicker in its middle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ProceduralTown {
    /// Chooses the town. The same seed gives the same lamps, of which a smaller `count` has the first ones.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 0, max = 4_294_967_295_u32))]
    pub seed: u32,
    /// Lamps.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 0, max = 20_000))]
    pub count: u32,
    /// East and north of the scene's origin of the town's middle, metres.
    #[schemars(inner(range(min = -1e6, max = 1e6)))]
    pub centre_m: [f64; 2],
    /// From its middle to its outermost lamps, metres.
    #[schemars(range(min = 10.0, max = 1e5))]
    pub radius_m: f64,
    /// Of the lamps' masts, metres.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub height_m: f64,
    /// What the masts stand on.
    pub above: Above,
    /// What kind all of them are; null for what towns have: mostly sodium and white diodes, some of the others.
    pub lamp: Option<Lamp>,
    /// The middle of their luminous intensities, which differ by factors up to two, candela.
    #[schemars(range(min = 0.0, max = 1e9))]
    pub luminous_intensity_cd: f64,
    /// Radius of the discs that they are seen as, metres.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub lamp_radius_m: f64,
    /// Where they send their light.
    pub emission: Emission,
}

impl Default for ProceduralTown {
    fn default() -> Self {
        Self {
            seed: 1,
            count: 300,
            centre_m: [0.0, 3_000.0],
            radius_m: 1_500.0,
            height_m: 9.0,
            above: Above::Sphere,
            lamp: None,
            luminous_intensity_cd: 1_000.0,
            lamp_radius_m: 0.2,
            emission: Emission::Isotropic,
        }
    }
}

/// The lamps of a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AssetTown {
    /// The file's name in the store of lights: up to 64 of the characters a-z, 0-9, `_` and `-`, the first a letter or
    /// a digit.
    #[schemars(regex(pattern = "^[a-z0-9][a-z0-9_-]{0,63}$"))]
    pub name: String,
    /// East and north of the scene's origin of the file's own, and up, metres.
    #[serde(default)]
    #[schemars(inner(range(min = -1e6, max = 1e6)))]
    pub position_m: [f64; 3],
    /// Turns the lamps about the file's origin, clockwise as seen from above, degrees.
    #[serde(default)]
    #[schemars(range(min = -360.0, max = 360.0))]
    pub azimuth_deg: f64,
    /// Multiplies what the lamps send out.
    #[serde(default = "one")]
    #[schemars(range(min = 0.0, max = 1e6))]
    pub factor: f64,
}

const fn one() -> f64 {
    1.0
}

impl AssetTown {
    /// One of the file's lamps as it stands in the scene.
    #[must_use]
    pub fn place(&self, light: &Light) -> Light {
        let (sin, cos) = self.azimuth_deg.to_radians().sin_cos();
        let [east, north, up] = light.position_m;
        let turned = [cos * east + sin * north, cos * north - sin * east, up];
        Light {
            position_m: [0, 1, 2].map(|i| turned[i] + self.position_m[i]),
            ..light.clone()
        }
    }
}

/// From one street to the next, metres.
const STREETS_M: f64 = 90.0;
/// Of the lamps of towns, by the share that comes with and before each.
const USUAL: [(f64, Lamp, Option<f64>); 6] = [
    (0.48, Lamp::HighPressureSodium, None),
    (0.66, Lamp::WhiteLed, Some(4_000.0)),
    (0.78, Lamp::WhiteLed, Some(3_000.0)),
    (0.88, Lamp::MetalHalide, None),
    (0.95, Lamp::Mercury, None),
    (1.0, Lamp::Incandescent, Some(2_700.0)),
];

impl ProceduralTown {
    /// The lamps.
    #[must_use]
    pub fn lights(&self) -> Vec<Light> {
        (0..self.count).map(|i| self.light(i)).collect()
    }

    fn light(&self, i: u32) -> Light {
        let chance = |k: u32| unit(self.seed, i, k);
        let (sin, cos) = (unit(self.seed, u32::MAX, 0) * TAU).sin_cos();
        let away_m = self.radius_m * chance(0).powf(0.8);
        let (y, x) = (chance(1) * TAU).sin_cos();
        let mut at = [x, y].map(|c| c * away_m);
        // Every lamp stands at a street of one of both ways; in a hamlet of less than two streets, anywhere.
        let across = usize::from(chance(2) < 0.5);
        if self.radius_m > 2.0 * STREETS_M {
            at[across] = (at[across] / STREETS_M).round() * STREETS_M + 8.0 * (chance(3) - 0.5);
        }
        let [x, y] = at;
        let [east, north] = [cos * x + sin * y, cos * y - sin * x];
        let drawn = chance(4);
        let usual = USUAL
            .iter()
            .find(|(share, ..)| drawn < *share)
            .unwrap_or(&USUAL[0]);
        let (lamp, colour_temperature_k) = match self.lamp {
            Some(lamp) => (lamp, None),
            None => (usual.1, usual.2),
        };
        Light {
            position_m: [self.centre_m[0] + east, self.centre_m[1] + north, self.height_m],
            above: self.above,
            lamp: Some(lamp),
            colour_temperature_k,
            luminous_intensity_cd: Some(self.luminous_intensity_cd * (2.0 * chance(5) - 1.0).exp2()),
            radius_m: self.lamp_radius_m,
            emission: self.emission,
            radiant_intensity_w_sr: None,
        }
    }
}

/// From 0 to 1, evenly, for a seed, a lamp, and a question about it (Steele et al. 2014, SplitMix64).
fn unit(seed: u32, i: u32, k: u32) -> f64 {
    let mut z = (u64::from(seed) << 32 | u64::from(i))
        .wrapping_add(u64::from(k + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^= z >> 31;
    #[allow(clippy::cast_precision_loss, reason = "53 bits, as many as there are")]
    let unit = (z >> 11) as f64 / (1_u64 << 53) as f64;
    unit
}
