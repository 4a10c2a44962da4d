//! The uniforms of pillars of light.

use super::{narrow, narrow3};
use bytemuck::{Pod, Zeroable};
use encase::ShaderType;
use glam::{DVec3, Vec3};
use std::f64::consts::TAU;
use welkin_scene::{
    CrystalLayer, IceCrystals, Scene,
    ice_crystals::{MAX_CRYSTAL_LAYERS, Reflectance, Tilt},
};

/// `Crystals` of `lib/pillar.wgsl`.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub(crate) struct CrystalsUniform {
    pub(crate) base_m: f32,
    pub(crate) top_m: f32,
    pub(crate) face_per_m: f32,
    pub(crate) extinction_per_m: f32,
    pub(crate) law: u32,
    pub(crate) sigma: f32,
    pub(crate) peak_per_sr: f32,
    pub(crate) cos_max: f32,
    pub(crate) sin_max: f32,
    pub(crate) outer: u32,
    pub(crate) uneven: f32,
    pub(crate) clumps_per_m: f32,
    pub(crate) moved_m: Vec3,
    pub(crate) stream: u32,
}

/// `Ice` of `lib/pillar_lamp.wgsl`.
#[derive(Clone, Debug, Default, ShaderType)]
pub(crate) struct IceUniform {
    pub(crate) count: u32,
    pub(crate) altitude_m: f32,
    pub(crate) three: u32,
    pub(crate) two: u32,
    pub(crate) layers: [CrystalsUniform; MAX_CRYSTAL_LAYERS],
}

/// `Distant` of `lib/pillar_sun.wgsl`.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub(crate) struct DistantUniform {
    pub(crate) direction: Vec3,
    pub(crate) angular_radius: f32,
    pub(crate) irradiance: Vec3,
}

/// `Scene` of `pillars.wgsl`.
#[derive(Clone, Debug, Default, ShaderType)]
pub(crate) struct PillarsUniform {
    pub(crate) east: Vec3,
    pub(crate) altitude_m: f32,
    pub(crate) north: Vec3,
    pub(crate) suns: u32,
    pub(crate) up: Vec3,
    pub(crate) cells_across: u32,
    pub(crate) glare: f32,
    pub(crate) pixel_angle: f32,
    pub(crate) first: u32,
    pub(crate) distant: [DistantUniform; 2],
}

/// `Sharing` of `pillar_shares.wgsl`.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub(crate) struct SharingUniform {
    pub(crate) first: u32,
    pub(crate) entries: u32,
    pub(crate) pixel_angle: f32,
    pub(crate) row: u32,
}

/// `Own` of `pillar_polar.wgsl`.
#[derive(Clone, Debug, ShaderType)]
pub(crate) struct OwnUniform {
    pub(crate) east: Vec3,
    pub(crate) north: Vec3,
    pub(crate) up: Vec3,
}

/// `Lamp` of `lib/pillar.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct LampUniform {
    pub(crate) place_m: [f32; 3],
    pub(crate) radius_m: f32,
    pub(crate) intensity: [f32; 3],
    pub(crate) emission: u32,
}

/// `Polar` of `lib/pillar_shaded.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub(crate) struct PolarUniform {
    pub(crate) columns: u32,
    pub(crate) rows: u32,
    pub(crate) sin_max: f32,
    pub(crate) words: u32,
}

/// The law of a tilt: its number, its spread in radians (as slopes, its tangent), and its density on the axis, 1/sr.
///
/// The density integrates to 1 over the upper hemisphere: a gaussian's constant is found by Simpson's rule, the others' in
/// closed form. What slopes lose beyond the maximum is not put back.
pub(crate) fn law(tilt: &Tilt) -> (u32, f64, f64) {
    match tilt {
        Tilt::Gaussian(tilt) => {
            let sigma = tilt.sigma_deg.to_radians();
            let reach = tilt.max_deg.to_radians();
            let at = |x: f64| (-0.5 * (x / sigma).powi(2)).exp() * x.sin();
            // Beyond nine spreads is nothing.
            let end = reach.min(9.0 * sigma);
            let step = end / 400.0;
            let sum: f64 = (0..200_u32)
                .map(|i| {
                    let from = 2.0 * f64::from(i) * step;
                    step / 3.0 * (at(from) + 4.0 * at(from + step) + at(from + 2.0 * step))
                })
                .sum();
            (0, sigma, 1.0 / (TAU * sum))
        }
        Tilt::Uniform(tilt) => {
            let reach = tilt.max_deg.to_radians();
            // 1 - cos, without cancelling.
            (1, reach, 1.0 / (TAU * 2.0 * (reach / 2.0).sin().powi(2)))
        }
        Tilt::Slope(tilt) => {
            let s = tilt.sigma_deg.to_radians().tan();
            (2, s, 1.0 / (TAU * s * s))
        }
    }
}

/// Streams of noise beside those of clouds.
const CLUMPS: u32 = 77;

impl CrystalsUniform {
    /// As an observer at an altitude sees it, at the scene's `time_s`; `east` and `north` of the observer from the scene's
    /// origin.
    fn new(layer: &CrystalLayer, altitude_m: f64, place_m: DVec3, time_s: f64) -> Self {
        let (law, sigma, peak_per_sr) = law(&layer.tilt);
        let (sin_max, cos_max) = layer.tilt.max_deg().to_radians().sin_cos();
        let variation = layer.variation.clone().unwrap_or_default();
        let (sin, cos) = variation.azimuth_deg.to_radians().sin_cos();
        let drift_m = DVec3::new(-sin, -cos, 0.0) * variation.speed_m_s * time_s;
        // The noise repeats; f32 needs no more of the way than that.
        let period_m = 64.0 * variation.scale_m;
        let moved = (drift_m - place_m).map(|c| c.rem_euclid(period_m));
        Self {
            base_m: narrow(layer.base_m - altitude_m),
            top_m: narrow(layer.top_m - altitude_m),
            face_per_m: narrow(layer.number_density_per_m3 * layer.plate_area_m2),
            extinction_per_m: narrow(layer.extinction_per_m),
            law,
            sigma: narrow(sigma),
            peak_per_sr: narrow(peak_per_sr),
            cos_max: narrow(cos_max),
            sin_max: narrow(sin_max),
            outer: u32::from(layer.reflectance == Reflectance::Outer),
            uneven: layer.variation.as_ref().map_or(0.0, |v| narrow(v.amount)),
            clumps_per_m: narrow(1.0 / variation.scale_m),
            moved_m: narrow3(moved.to_array()),
            stream: stream(variation.seed),
        }
    }
}

/// Any stream will do, as long as a seed has its own.
const fn stream(seed: u32) -> u32 {
    seed.wrapping_mul(0x9e37_79b9).wrapping_add(CLUMPS)
}

impl IceUniform {
    pub(crate) fn new(scene: &Scene, altitude_m: f64) -> Self {
        let mut ice = Self {
            altitude_m: narrow(altitude_m),
            three: 3,
            two: 2,
            ..Self::default()
        };
        let layers = scene.ice_crystals.as_ref().map(IceCrystals::layers);
        let place_m = DVec3::from_array(scene.camera.position_m);
        for layer in layers.unwrap_or_default() {
            if layer.number_density_per_m3 * layer.plate_area_m2 > 0.0 || layer.extinction_per_m > 0.0 {
                let at = ice.count as usize;
                ice.layers[at] = CrystalsUniform::new(layer, altitude_m, place_m, scene.time_s);
                ice.count += 1;
            }
        }
        ice
    }

    pub(crate) fn layers(&self) -> &[CrystalsUniform] {
        &self.layers[..self.count as usize]
    }
}
