//! The night's uniforms.

use super::{narrow, narrow3};
use crate::{
    cpu::{
        air::optical_depth_to_space,
        airglow::{NightLight, emission_per_m},
    },
    moonlight::{Moonlight, Uncovered},
};
use encase::ShaderType;
use glam::{DVec3, UVec2, Vec3};
use welkin_scene::{MoonSeen, Scene};

/// `Stretch` of `stars.wgsl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct StretchUniform {
    pub(crate) first: u32,
    pub(crate) count: u32,
    pub(crate) frame_width: u32,
    pub(crate) out: f32,
    pub(crate) origin_px: UVec2,
    pub(crate) size_px: UVec2,
    pub(crate) stride_px: u32,
}

/// `Airglow` of `lib/airglow.wgsl`.
#[derive(Clone, Debug, ShaderType)]
pub(crate) struct AirglowUniform {
    pub(crate) emission_per_m: Vec3,
    pub(crate) base_m: f32,
    pub(crate) scattered: Vec3,
    pub(crate) top_m: f32,
    pub(crate) ground_irradiance: Vec3,
    pub(crate) inside: f32,
    pub(crate) zenith_depth: Vec3,
}

/// Height over which an observer leaves the air that shines about them, metres.
const LEFT_BELOW_M: f64 = 20_000.0;

impl AirglowUniform {
    pub(crate) fn new(scene: &Scene, night: &NightLight, altitude_m: f64) -> Self {
        let glow = scene.atmosphere.as_ref().and_then(|air| air.airglow.as_ref());
        Self {
            emission_per_m: glow.map_or(Vec3::ZERO, |g| emission_per_m(g).as_vec3()),
            base_m: glow.map_or(0.0, |g| narrow(g.base_m)),
            scattered: night.mean_radiance_w_m2_sr.as_vec3(),
            top_m: glow.map_or(0.0, |g| narrow(g.top_m)),
            ground_irradiance: night.ground_irradiance_w_m2.as_vec3(),
            inside: narrow((-altitude_m / LEFT_BELOW_M).exp()),
            zenith_depth: narrow3(optical_depth_to_space(scene, altitude_m, 1.0).unwrap_or_default()),
        }
    }
}

/// `Moon` of `lib/moon.wgsl`.
#[derive(Clone, Debug, Default, ShaderType)]
pub(crate) struct MoonUniform {
    pub(crate) direction: Vec3,
    pub(crate) angular_radius: f32,
    pub(crate) east: Vec3,
    pub(crate) disc: f32,
    pub(crate) north: Vec3,
    pub(crate) sun_left: f32,
    pub(crate) light: Vec3,
    pub(crate) sun_disc_scale: f32,
    pub(crate) radiance: Vec3,
    pub(crate) earthshine: Vec3,
    pub(crate) glares: f32,
}

impl MoonUniform {
    pub(crate) fn new(
        disc: bool,
        glares: bool,
        seen: &MoonSeen,
        light: &Moonlight,
        uncovered: Uncovered,
    ) -> Self {
        let flag = |on: bool| if on { 1.0 } else { 0.0 };
        let [_, east, north] = light.axes.map(DVec3::as_vec3);
        Self {
            direction: DVec3::from_array(seen.direction).as_vec3(),
            angular_radius: narrow((seen.angular_diameter_deg / 2.0).to_radians()),
            east,
            disc: flag(disc),
            north,
            sun_left: narrow(uncovered.disc),
            light: light.light.as_vec3(),
            sun_disc_scale: narrow(1.0 / uncovered.sky),
            radiance: light.radiance_w_m2_sr.as_vec3(),
            earthshine: light.earthshine_w_m2_sr.as_vec3(),
            glares: flag(glares),
        }
    }
}
