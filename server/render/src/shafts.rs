//! How shafts of light are looked for.

use crate::{
    lens::Lens,
    uniforms::{ground::ShaftsUniform, narrow},
};
use glam::{DVec3, UVec2, Vec2};
use welkin_scene::{Quality, Scene, Shafts, shafts::RadialShafts};

/// How shafts are looked for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum ShaftSettings {
    /// At places along a ray, of one pixel in so many to a side.
    Exact { steps: u32, grain: u32 },
    /// Over the picture, from where the light's source is seen on it, in shares of its sides.
    Radial { shafts: RadialShafts, image: Vec2 },
}

/// Places of a picture over which shafts are smeared.
const RADIAL_PLACES: u32 = 1 << 13;

impl ShaftSettings {
    /// Pixels from one place to the next.
    pub(crate) fn grain(&self, frame_px: UVec2) -> u32 {
        match self {
            Self::Exact { grain, .. } => *grain,
            Self::Radial { .. } => {
                let pixels = frame_px.x.saturating_mul(frame_px.y);
                pixels.div_ceil(RADIAL_PLACES).isqrt().max(4)
            }
        }
    }

    pub(crate) fn uniform(&self) -> ShaftsUniform {
        match *self {
            Self::Exact { steps, .. } => ShaftsUniform {
                steps,
                ..ShaftsUniform::default()
            },
            Self::Radial { shafts, image } => ShaftsUniform {
                steps: shafts.steps,
                length: narrow(shafts.length),
                decay: narrow(shafts.decay),
                strength: narrow(shafts.strength),
                image,
            },
        }
    }

    pub(crate) const fn is_radial(&self) -> bool {
        matches!(self, Self::Radial { .. })
    }
}

/// Shafts that are counted where the light falls. Clouds alone draw none into a preview, whose air gets what they leave on
/// average.
pub(crate) fn exact_shafts(scene: &Scene, clouded: bool, quality: Quality) -> Option<ShaftSettings> {
    let Some(Shafts::Exact(exact)) = scene.shafts else {
        return None;
    };
    let casts = scene
        .terrain
        .as_ref()
        .is_some_and(|terrain| terrain.shadow().is_some());
    match quality {
        Quality::Final if casts || clouded => Some(ShaftSettings::Exact {
            grain: 2,
            steps: exact.steps,
        }),
        Quality::Preview if casts => Some(ShaftSettings::Exact {
            grain: 4,
            steps: (exact.steps / 3).max(8),
        }),
        Quality::Final | Quality::Preview => None,
    }
}

/// Shafts that are smeared over a picture of that size, where a light that comes from `towards` is before its lens.
pub(crate) fn radial_shafts(
    scene: &Scene,
    clouded: bool,
    size_px: UVec2,
    towards: DVec3,
) -> Option<ShaftSettings> {
    let Some(Shafts::Radial(shafts)) = scene.shafts else {
        return None;
    };
    let image = Lens::new(&scene.camera, size_px).image(towards)? / size_px.as_dvec2();
    (clouded || scene.terrain.is_some()).then_some(ShaftSettings::Radial {
        shafts,
        image: image.as_vec2(),
    })
}
