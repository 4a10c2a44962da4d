//! The ground's uniforms.

use encase::ShaderType;
use glam::{UVec2, Vec2, Vec3};

/// `Ground` of `lib/ground.wgsl`.
#[derive(Clone, Debug, Default, ShaderType)]
pub(crate) struct GroundUniform {
    pub(crate) east: Vec3,
    pub(crate) radius_m: f32,
    pub(crate) north: Vec3,
    pub(crate) highest_m: f32,
    pub(crate) up: Vec3,
    pub(crate) lowest_m: f32,
    pub(crate) place_m: Vec3,
    pub(crate) bend_per_m: f32,
    pub(crate) corner_m: Vec2,
    pub(crate) cell_m: Vec2,
    pub(crate) cells: UVec2,
    pub(crate) levels: u32,
}

/// `GroundShadow` of `lib/ground_shadow.wgsl`.
#[derive(Clone, Debug, Default, ShaderType)]
pub(crate) struct GroundShadowUniform {
    pub(crate) right: Vec3,
    pub(crate) size_px: u32,
    pub(crate) up: Vec3,
    pub(crate) lift_px: f32,
    pub(crate) light: Vec3,
    pub(crate) middle_m: Vec3,
    pub(crate) half_m: Vec3,
}

/// `Skin` of `lib/ground_skin.wgsl`.
#[derive(Clone, Debug, Default, ShaderType)]
pub(crate) struct SkinUniform {
    pub(crate) grass: Vec3,
    pub(crate) grass_line_m: f32,
    pub(crate) rock: Vec3,
    pub(crate) snow_line_m: f32,
    pub(crate) snow: Vec3,
    pub(crate) line_width_m: f32,
    pub(crate) grass_cosine: f32,
    pub(crate) snow_cosine: f32,
    pub(crate) ambient: f32,
    pub(crate) diffuse: f32,
    pub(crate) specular: f32,
    pub(crate) shininess: f32,
    #[shader(align(16))]
    pub(crate) sphere: Vec3,
    pub(crate) fade: f32,
    pub(crate) mottled: f32,
    pub(crate) water: f32,
}

/// `Stand` of `ground_view.wgsl`.
#[derive(Clone, Debug, Default, ShaderType)]
pub(crate) struct StandUniform {
    pub(crate) up: Vec3,
    pub(crate) altitude_m: f32,
}

/// `Part` of `ground_sky.wgsl`.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub(crate) struct SkyPartUniform {
    pub(crate) first: u32,
}

/// `Shafts` of `shafts.wgsl`.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub(crate) struct ShaftsUniform {
    pub(crate) steps: u32,
    pub(crate) length: f32,
    pub(crate) decay: f32,
    pub(crate) strength: f32,
    pub(crate) image: Vec2,
}

/// `LightSettings` of `ground_light.wgsl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct LightSettingsUniform {
    pub(crate) first_place_px: UVec2,
    pub(crate) places_across: u32,
    pub(crate) grain: u32,
    pub(crate) wind_m_s: f32,
}
