//! The scene document.

use crate::{
    atmosphere::Atmosphere, camera::Camera, clouds::Clouds, display::Display, haze::Haze, moon::Moon,
    planet::Planet, shafts::Shafts, stars::Stars, sun::Sun, terrain::Terrain,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One sky: who looks from where, sun, planet, air, and how it is shown. `{}` is a fair-weather afternoon.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Scene {
    /// Time since the scene's beginning, seconds. Moves the clouds, and the sun where it is
    /// given by time and place.
    #[schemars(range(min = -1e9, max = 1e9))]
    pub time_s: f64,
    /// The observer.
    pub camera: Camera,
    /// The sun.
    pub sun: Sun,
    /// The moon; `null` for none.
    pub moon: Option<Moon>,
    /// The stars; `null` for none.
    pub stars: Option<Stars>,
    /// The ground's sphere.
    pub planet: Planet,
    /// The air; `null` is vacuum.
    pub atmosphere: Option<Atmosphere>,
    /// The clouds; `null` for a clear sky.
    pub clouds: Option<Clouds>,
    /// Haze or fog on the ground, in addition to the air's aerosols; `null` is none.
    pub haze: Option<Haze>,
    /// Mountains, or a mesh such as a town, on the planet's sphere; `null` for none.
    pub terrain: Option<Terrain>,
    /// Shafts of light and of shadow that terrain and clouds draw into the air; `null` for none.
    pub shafts: Option<Shafts>,
    /// From radiance to a picture.
    pub display: Display,
}

impl Default for Scene {
    fn default() -> Self {
        Self {
            time_s: 0.0,
            camera: Camera::default(),
            sun: Sun::default(),
            moon: Some(Moon::default()),
            stars: Some(Stars::default()),
            planet: Planet::default(),
            atmosphere: Some(Atmosphere::default()),
            clouds: Some(Clouds::default()),
            haze: None,
            terrain: None,
            shafts: Some(Shafts::default()),
            display: Display::default(),
        }
    }
}

impl Scene {
    /// The default scene under a clear sky.
    #[must_use]
    pub fn clear() -> Self {
        Self {
            clouds: None,
            ..Self::default()
        }
    }
}
