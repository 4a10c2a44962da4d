//! The lamps of a scene: where they stand, and how much they send out in the bands.

use crate::{colour::LUMINANCE_PER_RADIANCE, error::Error, memo::Fingerprint};
use glam::DVec3;
use std::{
    collections::HashMap,
    hash::{DefaultHasher, Hash, Hasher},
};
use welkin_scene::{
    Light, Scene, Town,
    assets::SceneAssets,
    lights::{Above, Emission, Lamp as Kind, Power},
};

/// A lamp in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lamp {
    /// East and north of the scene's origin, and height over what `on_ground` says, metres.
    pub(crate) place_m: DVec3,
    pub(crate) on_ground: bool,
    pub(crate) radius_m: f64,
    /// W/sr.
    pub(crate) intensity: [f64; 3],
    /// As `lib/pillar.wgsl` numbers it.
    pub(crate) emission: u32,
}

impl Hash for Lamp {
    fn hash<H: Hasher>(&self, state: &mut H) {
        for value in self.place_m.to_array().iter().chain(&self.intensity) {
            value.to_bits().hash(state);
        }
        (self.radius_m.to_bits(), self.on_ground, self.emission).hash(state);
    }
}

/// Colours of kinds already found: a spectrum is summed once for each of a town's few kinds.
type Colours = HashMap<(Kind, Option<u64>), [f64; 3]>;

/// What tells the lamps of one scene from those of another, without making them.
pub(crate) fn lamps_made_from(scene: &Scene, assets: &SceneAssets) -> Fingerprint {
    let mut hasher = DefaultHasher::new();
    for light in &scene.lights {
        for value in light.position_m {
            value.to_bits().hash(&mut hasher);
        }
        let bits = |value: Option<f64>| value.map(f64::to_bits);
        let radiant = light
            .radiant_intensity_w_sr
            .map(|bands| bands.rgb().map(f64::to_bits));
        let (kelvin, candela) = (
            bits(light.colour_temperature_k),
            bits(light.luminous_intensity_cd),
        );
        (light.above, radiant, light.lamp, kelvin, candela).hash(&mut hasher);
        (light.radius_m.to_bits(), light.emission).hash(&mut hasher);
    }
    let file = match &scene.town {
        Some(Town::Asset(town)) => assets.lights.get(&town.name).map(|list| list.digest),
        _ => None,
    };
    Fingerprint::of((hasher.finish(), format!("{:?}", scene.town), file))
}

/// All lamps that send out light.
pub(crate) fn lamps(scene: &Scene, assets: &SceneAssets) -> Result<Vec<Lamp>, Error> {
    let mut colours = Colours::new();
    let mut all: Vec<Lamp> = scene.lights.iter().map(|l| lamp(l, 1.0, &mut colours)).collect();
    match &scene.town {
        None => {}
        Some(Town::Procedural(town)) => {
            all.extend(town.lights().iter().map(|l| lamp(l, 1.0, &mut colours)));
        }
        Some(Town::Asset(town)) => {
            let list = assets.lights.get(&town.name);
            let list = list.ok_or_else(|| Error::Asset(town.name.clone()))?;
            let placed = list.lights.iter().map(|light| town.place(light));
            all.extend(placed.map(|l| lamp(&l, town.factor, &mut colours)));
        }
    }
    all.retain(|lamp| lamp.intensity.iter().any(|i| *i > 0.0));
    Ok(all)
}

fn lamp(light: &Light, factor: f64, colours: &mut Colours) -> Lamp {
    let intensity = match light.power() {
        Power::Radiant(bands) => bands,
        Power::Luminous {
            lamp,
            colour_temperature_k,
            candela,
        } => {
            let key = (lamp, colour_temperature_k.map(f64::to_bits));
            let colour = *colours
                .entry(key)
                .or_insert_with(|| lamp.colour(colour_temperature_k));
            // The colour's luminance is 1, and a band of one W/m²/sr has that much.
            [0, 1, 2].map(|i| candela * colour[i] / LUMINANCE_PER_RADIANCE[i])
        }
    };
    Lamp {
        place_m: DVec3::from_array(light.position_m),
        on_ground: light.above == Above::Ground,
        radius_m: light.radius_m,
        intensity: intensity.map(|i| i * factor),
        emission: match light.emission {
            Emission::Isotropic => 0,
            Emission::CosineUp => 1,
            Emission::FullCutoff => 2,
        },
    }
}

/// Down from the level of the scene's origin to the sphere there; none where there is no sphere.
pub(crate) fn fall_m(radius_m: f64, place_m: DVec3) -> Option<f64> {
    let squared = place_m.truncate().length_squared();
    let root = (radius_m * radius_m - squared).max(0.0).sqrt();
    (squared < radius_m * radius_m).then(|| squared / (radius_m + root))
}
