//! The clouds' uniforms.

use encase::ShaderType;
use glam::{Vec2, Vec3, Vec4};
/// As many of each as the shaders have room for.
pub(crate) const MOST: usize = welkin_scene::clouds::MAX_LAYERS;

/// `CloudLayer` of `lib/cloud.wgsl`.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub(crate) struct LayerUniform {
    #[shader(align(16))]
    pub(crate) base_m: f32,
    pub(crate) inverse_thickness_per_m: f32,
    pub(crate) cloud_type: f32,
    pub(crate) coverage: f32,
    pub(crate) share: f32,
    pub(crate) extinction_per_m: f32,
    pub(crate) anvil: f32,
}

/// `CloudBand` of `lib/cloud.wgsl`.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub(crate) struct BandUniform {
    #[shader(align(16))]
    pub(crate) base_m: f32,
    pub(crate) top_m: f32,
    pub(crate) first: u32,
    pub(crate) count: u32,
    pub(crate) thickness_m: f32,
    pub(crate) leak: f32,
}

/// `CloudSheet` of `lib/cloud.wgsl`.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub(crate) struct SheetUniform {
    pub(crate) turn: Vec2,
    pub(crate) drift: Vec2,
    pub(crate) height_m: f32,
    pub(crate) coverage: f32,
    pub(crate) optical_depth: f32,
    pub(crate) channel: u32,
}

/// `WeatherSource` of `lib/cloud.wgsl`.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub(crate) struct WeatherUniform {
    pub(crate) even: Vec3,
    pub(crate) convention: u32,
    pub(crate) drift: Vec2,
    pub(crate) second_drift: Vec2,
    pub(crate) inverse_extent_per_m: f32,
    pub(crate) twice: f32,
}

/// `Clouds` of `lib/cloud.wgsl`.
#[derive(Clone, Debug, ShaderType)]
pub(crate) struct CloudsUniform {
    pub(crate) layers: [LayerUniform; MOST],
    pub(crate) bands: [BandUniform; MOST],
    pub(crate) sheets: [SheetUniform; MOST],
    pub(crate) weather: [WeatherUniform; 2],
    pub(crate) gradients: [Vec4; 3],
    pub(crate) place_m: Vec3,
    pub(crate) radius_m: f32,
    pub(crate) base_drift: Vec3,
    pub(crate) base_inverse_scale_per_m: f32,
    pub(crate) detail_drift: Vec3,
    pub(crate) detail_inverse_scale_per_m: f32,
    pub(crate) shear_m: Vec2,
    pub(crate) curl_inverse_scale_per_m: f32,
    pub(crate) curl_m: f32,
    pub(crate) layer_count: u32,
    pub(crate) band_count: u32,
    pub(crate) sheet_count: u32,
    pub(crate) weather_share: f32,
    pub(crate) low_least: f32,
    pub(crate) low_inverse_range: f32,
    pub(crate) erosion: f32,
    pub(crate) precipitation: f32,
    pub(crate) fineness: f32,
    pub(crate) albedo: Vec3,
    pub(crate) asymmetry: f32,
    pub(crate) sun_colour: Vec3,
    pub(crate) forward: f32,
    pub(crate) other: f32,
    pub(crate) other_share: f32,
    pub(crate) alpha: f32,
    pub(crate) sun_factor: f32,
    pub(crate) ambient_factor: f32,
    pub(crate) powder: f32,
    pub(crate) octaves: u32,
    pub(crate) light_steps: u32,
    pub(crate) haze: f32,
}

/// `CloudShade` of `lib/cloud_shade.wgsl`.
#[derive(Clone, Debug, Default, ShaderType)]
pub(crate) struct ShadeUniform {
    pub(crate) middles_m: [Vec4; 4],
    pub(crate) centre_m: Vec2,
    pub(crate) reach_m: f32,
    pub(crate) count: u32,
    pub(crate) direct_left: f32,
    pub(crate) diffuse_left: f32,
    pub(crate) asymmetry: f32,
    pub(crate) base_m: f32,
    pub(crate) even_depth: f32,
    pub(crate) spread_left: f32,
}

/// `Shadow` of `cloud_shadow.wgsl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct ShadowUniform {
    pub(crate) light: Vec3,
    pub(crate) step_m: f32,
    pub(crate) most_steps: f32,
}

/// `Dome` of `lib/dome.wgsl`.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub(crate) struct DomeUniform {
    pub(crate) cells: u32,
    pub(crate) sun_left: f32,
    pub(crate) moon_left: f32,
    pub(crate) under_clouds: u32,
}

/// `CloudFrame` of `lib/sky_light.wgsl`.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub(crate) struct CloudFrameUniform {
    pub(crate) place_m: Vec3,
    pub(crate) light: Vec3,
}
