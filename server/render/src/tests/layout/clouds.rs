//! The clouds' uniforms.

use super::{Filled, Values, check};
use crate::{
    shader,
    uniforms::{
        Part,
        clouds::{
            BandUniform, CloudFrameUniform, CloudsUniform, DomeUniform, LayerUniform, ShadeUniform,
            ShadowUniform, SheetUniform, WeatherUniform,
        },
    },
};
use glam::Vec4;

impl Filled {
    fn vec4(&mut self, name: &str) -> Vec4 {
        let value = [(); 4].map(|()| f32::from(self.number()));
        self.keep(name, Values::Floats(value.to_vec()));
        value.into()
    }

    fn vec4s<const N: usize>(&mut self, name: &str) -> [Vec4; N] {
        std::array::from_fn(|k| self.vec4(&format!("{name}.{k}")))
    }

    /// Structs in an array.
    fn each<T, const N: usize>(&mut self, name: &str, fill: impl Fn(&mut Self) -> T) -> [T; N] {
        std::array::from_fn(|k| {
            self.place = format!("{name}.{k}.");
            let filled = fill(self);
            self.place.clear();
            filled
        })
    }

    fn layers<const N: usize>(&mut self, name: &str) -> [LayerUniform; N] {
        self.each(name, |f| {
            filled!(@whole f, LayerUniform {
                base_m: f32,
                inverse_thickness_per_m: f32,
                cloud_type: f32,
                coverage: f32,
                share: f32,
                extinction_per_m: f32,
                anvil: f32,
            })
        })
    }

    fn bands<const N: usize>(&mut self, name: &str) -> [BandUniform; N] {
        self.each(name, |f| {
            filled!(@whole f, BandUniform {
                base_m: f32,
                top_m: f32,
                first: u32,
                count: u32,
                thickness_m: f32,
                leak: f32,
            })
        })
    }

    fn sheets<const N: usize>(&mut self, name: &str) -> [SheetUniform; N] {
        self.each(name, |f| {
            filled!(@whole f, SheetUniform {
                turn: vec2,
                drift: vec2,
                height_m: f32,
                coverage: f32,
                optical_depth: f32,
                channel: u32,
            })
        })
    }

    fn weather<const N: usize>(&mut self, name: &str) -> [WeatherUniform; N] {
        self.each(name, |f| {
            filled!(@whole f, WeatherUniform {
                even: vec3,
                convention: u32,
                drift: vec2,
                second_drift: vec2,
                inverse_extent_per_m: f32,
                twice: f32,
            })
        })
    }
}

#[test]
fn clouds() {
    let mut f = Filled::default();
    let part = filled!(
        f,
        CloudsUniform {
            layers: layers,
            bands: bands,
            sheets: sheets,
            weather: weather,
            gradients: vec4s,
            place_m: vec3,
            radius_m: f32,
            base_drift: vec3,
            base_inverse_scale_per_m: f32,
            detail_drift: vec3,
            detail_inverse_scale_per_m: f32,
            shear_m: vec2,
            curl_inverse_scale_per_m: f32,
            curl_m: f32,
            layer_count: u32,
            band_count: u32,
            sheet_count: u32,
            weather_share: f32,
            low_least: f32,
            low_inverse_range: f32,
            erosion: f32,
            precipitation: f32,
            fineness: f32,
            albedo: vec3,
            asymmetry: f32,
            sun_colour: vec3,
            forward: f32,
            other: f32,
            other_share: f32,
            alpha: f32,
            sun_factor: f32,
            ambient_factor: f32,
            powder: f32,
            octaves: u32,
            light_steps: u32,
            haze: f32,
        }
    );
    check(
        &[
            &shader::CLOUD_SHADOW,
            &shader::CLOUD_VIEW,
            &shader::CLOUD_VIEW_LIGHT,
        ],
        "Clouds",
        &part,
        &f,
    );
}

#[test]
fn shade_shadow_dome_and_frame() {
    let mut f = Filled::default();
    let part = filled!(
        f,
        ShadeUniform {
            middles_m: vec4s,
            centre_m: vec2,
            reach_m: f32,
            count: u32,
            direct_left: f32,
            diffuse_left: f32,
            asymmetry: f32,
            base_m: f32,
            even_depth: f32,
            spread_left: f32,
        }
    );
    let shaders = [
        &shader::CLOUD_AIR,
        &shader::CLOUD_SHADOW,
        &shader::CLOUD_VIEW_LIGHT,
        &shader::SKY,
        &shader::PROBE,
    ];
    check(&shaders, "CloudShade", &part, &f);
    let mut f = Filled::default();
    let part = filled!(
        f,
        ShadowUniform {
            light: vec3,
            step_m: f32,
            most_steps: f32
        }
    );
    check(&[&shader::CLOUD_SHADOW], "Shadow", &part, &f);
    let mut f = Filled::default();
    let part = filled!(
        f,
        DomeUniform {
            cells: u32,
            sun_left: f32,
            moon_left: f32,
            under_clouds: u32,
        }
    );
    let shaders = [
        &shader::CLOUD_DOME,
        &shader::CLOUD_DOME_LIGHT,
        &shader::SKY,
        &shader::STARS,
    ];
    check(&shaders, "Dome", &part, &f);
    let mut f = Filled::default();
    let part = filled!(
        f,
        CloudFrameUniform {
            place_m: vec3,
            light: vec3
        }
    );
    let shaders = [&shader::CLOUD_AIR, &shader::SKY, &shader::PROBE];
    check(&shaders, "CloudFrame", &part, &f);
}
