//! Clouds: layers of volume and thin sheets, the weather that spreads them, and how light goes through them.

mod check;
mod layer;
mod phase;
mod shape;
mod weather;
mod wind;

pub(crate) use check::check;
pub use layer::{Genus, Layer, SheetLayer, VolumeLayer};
pub use phase::{Droplets, DualHenyeyGreenstein, Phase};
pub use shape::{Gradients, Shape};
pub use weather::{AssetMap, BlendMap, Convention, PlainMap, ProceduralMap, UniformMap, WeatherMap};
pub use wind::Wind;

use crate::frame::whole;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Most layers that a scene may have.
pub const MAX_LAYERS: usize = 8;

/// The clouds. `{}` is fair weather: cumulus under thin cirrus.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Clouds {
    /// Share of the sky's area that clouds cover, 0 none to 1 all. A layer may say otherwise for itself.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub coverage: f64,
    /// Multiplies the extinction of every layer.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub density: f64,
    /// How much of the rain that the weather map holds falls: 0 none to 1 all. Rain clouds are darker.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub precipitation: f64,
    /// Chooses the weather and the shapes. The same seed gives the same clouds.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 0, max = 4_294_967_295_u32))]
    pub seed: u32,
    /// The layers, in any order; they may overlap.
    #[schemars(length(max = MAX_LAYERS))]
    pub layers: Vec<Layer>,
    /// Where there are clouds, of which type, and where it rains.
    pub weather_map: WeatherMap,
    /// How noise carves the clouds.
    pub shape: Shape,
    /// What moves and changes them as `time_s` goes on.
    pub wind: Wind,
    /// Where the droplets send the light.
    pub phase: Phase,
    /// Extinction coefficient where a cloud is densest, 1/m. The mean free path of light is its inverse.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub extinction_per_m: f64,
    /// Share of the extinction that is scattering.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub albedo: f64,
    /// Multiplies the light that the clouds get from sun and moon.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub sun_factor: f64,
    /// Multiplies the light that the clouds get from the sky above and the ground below.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub ambient_factor: f64,
    /// Tints the light that the clouds get from sun and moon: a factor for each of R, G and B.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub sun_colour: [f64; 3],
    /// The clouds' own colour: multiplies their albedo in R, G and B.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub base_colour: [f64; 3],
    /// Darkens thin edges that are seen with the sun behind the observer (Schneider 2015): 0 not, 1 fully.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub powder: f64,
    /// Orders of scattering by small angles whose lobes are followed, each wider than the one before; the light of higher
    /// orders is even.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 1, max = 8))]
    pub octaves: u32,
    /// Most steps along a ray of view.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 16, max = 1024))]
    pub steps: u32,
    /// Steps on the light's way through the clouds about a place, towards the light and away from it, over half of the
    /// shape noise's scale; what lies beyond is in coarser maps, and 64 steps leave nothing to them. Final frames only:
    /// previews take all of it from the maps.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 1, max = 64))]
    pub light_steps: u32,
    /// Clouds cast shadows on the ground and through the air.
    pub shadows: bool,
    /// How much clouds fade into the sky behind them with distance, beyond what the air in between does: 0 not,
    /// 1 fully.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub haze: f64,
}

impl Default for Clouds {
    fn default() -> Self {
        Self {
            // Few to scattered, two to three eighths, as fair weather is reported.
            coverage: 0.3,
            density: 1.0,
            precipitation: 0.0,
            seed: 1,
            layers: vec![
                Layer::Volume(VolumeLayer {
                    cloud_type: Some(0.8),
                    ..VolumeLayer::default()
                }),
                Layer::Sheet(SheetLayer {
                    coverage: Some(0.3),
                    ..SheetLayer::default()
                }),
            ],
            weather_map: WeatherMap::default(),
            shape: Shape::default(),
            wind: Wind::default(),
            phase: Phase::default(),
            extinction_per_m: 0.04,
            albedo: 0.9999,
            sun_factor: 1.0,
            ambient_factor: 1.0,
            sun_colour: [1.0; 3],
            base_colour: [1.0; 3],
            powder: 0.5,
            octaves: 8,
            steps: 128,
            light_steps: 6,
            shadows: true,
            haze: 0.0,
        }
    }
}
