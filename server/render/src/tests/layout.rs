//! Every uniform as the shaders read it: distinct values written by `encase`, found at naga's offsets by name.

use crate::{
    camera::CameraUniform,
    shader::{self, Shader},
    uniforms::{
        AirUniform, IntegralUniform, MeterUniform, ObserverUniform, OrderUniform, Part, TileUniform,
        ToneUniform, ViewUniform,
        night::{AirglowUniform, MoonUniform, StretchUniform},
    },
};
use glam::{UVec2, Vec2, Vec3};
use naga::{ScalarKind, TypeInner};
use std::collections::BTreeMap;

/// Values of one member, as the shader sees them.
#[derive(Clone, Debug, PartialEq)]
enum Values {
    Floats(Vec<f32>),
    Wholes(Vec<u32>),
}

/// The members of the shader's struct `name`, read from `part` at the offsets that naga gives them.
fn as_shader_sees(shader: &Shader, name: &str, part: &Part) -> BTreeMap<String, Values> {
    let module = naga::front::wgsl::parse_str(shader.wgsl).unwrap();
    let (_, structure) = module
        .types
        .iter()
        .find(|(_, t)| t.name.as_deref() == Some(name))
        .expect("the shader has the struct");
    let TypeInner::Struct { span, .. } = &structure.inner else {
        panic!("{name} is no struct");
    };
    assert_eq!(*span as usize, part.0.len(), "{name} in {}: size", shader.name);
    let mut found = BTreeMap::new();
    read(&module, &structure.inner, &part.0, "", &mut found);
    found
}

/// The values of one type at the start of `bytes`, each under its place: `layers.0.base_m`.
fn read(
    module: &naga::Module,
    inner: &TypeInner,
    bytes: &[u8],
    place: &str,
    found: &mut BTreeMap<String, Values>,
) {
    let inside = |name: &str| {
        let dot = if place.is_empty() { "" } else { "." };
        format!("{place}{dot}{name}")
    };
    let (scalar, count) = match *inner {
        TypeInner::Struct { ref members, .. } => {
            for member in members {
                let of = &module.types[member.ty].inner;
                let name = member.name.as_deref().unwrap();
                read(module, of, &bytes[member.offset as usize..], &inside(name), found);
            }
            return;
        }
        TypeInner::Array { base, size, stride } => {
            let naga::ArraySize::Constant(count) = size else {
                panic!("{place}: {size:?}");
            };
            for k in 0..count.get() {
                let of = &module.types[base].inner;
                read(
                    module,
                    of,
                    &bytes[(k * stride) as usize..],
                    &inside(&k.to_string()),
                    found,
                );
            }
            return;
        }
        TypeInner::Scalar(scalar) => (scalar, 1),
        TypeInner::Vector { size, scalar } => (scalar, size as usize),
        ref other => panic!("{place}: {other:?}"),
    };
    let words = bytes.chunks_exact(4).take(count);
    let words: Vec<[u8; 4]> = words.map(|word| word.try_into().unwrap()).collect();
    let values = match scalar.kind {
        ScalarKind::Float => Values::Floats(words.into_iter().map(f32::from_le_bytes).collect()),
        ScalarKind::Uint => Values::Wholes(words.into_iter().map(u32::from_le_bytes).collect()),
        kind => panic!("{place}: {kind:?}"),
    };
    found.insert(place.to_owned(), values);
}

/// Distinct values for a struct's fields, and under which names and in which form they went in.
#[derive(Default)]
struct Filled {
    next: u16,
    /// Of the struct that is being filled: its place and a dot.
    place: String,
    members: BTreeMap<String, Values>,
}

impl Filled {
    fn keep(&mut self, name: &str, values: Values) {
        self.members.insert(format!("{}{name}", self.place), values);
    }

    fn number(&mut self) -> u16 {
        self.next += 1;
        self.next
    }

    fn f32(&mut self, name: &str) -> f32 {
        let value = f32::from(self.number());
        self.keep(name, Values::Floats(vec![value]));
        value
    }

    fn vec2(&mut self, name: &str) -> Vec2 {
        let value = [(); 2].map(|()| f32::from(self.number()));
        self.keep(name, Values::Floats(value.to_vec()));
        value.into()
    }

    fn vec3(&mut self, name: &str) -> Vec3 {
        let value = [(); 3].map(|()| f32::from(self.number()));
        self.keep(name, Values::Floats(value.to_vec()));
        value.into()
    }

    fn u32(&mut self, name: &str) -> u32 {
        let value = u32::from(self.number());
        self.keep(name, Values::Wholes(vec![value]));
        value
    }

    fn uvec2(&mut self, name: &str) -> UVec2 {
        let value = [(); 2].map(|()| u32::from(self.number()));
        self.keep(name, Values::Wholes(value.to_vec()));
        value.into()
    }
}

/// Fills each field by its own name.
macro_rules! filled {
    (@whole $filled:ident, $structure:ident { $($field:ident: $kind:ident),+ $(,)? }) => {
        $structure { $($field: $filled.$kind(stringify!($field))),+ }
    };
    ($filled:ident, $structure:ident { $($field:ident: $kind:ident),+ $(,)? }) => {
        Part::new(&filled!(@whole $filled, $structure { $($field: $kind),+ }))
    };
}

mod bound;
mod clouds;
mod ground;

fn check(shaders: &[&Shader], name: &str, part: &Part, filled: &Filled) {
    for shader in shaders {
        assert_eq!(
            as_shader_sees(shader, name, part),
            filled.members,
            "{name} in {}",
            shader.name
        );
    }
}

#[test]
fn air() {
    let mut f = Filled::default();
    let part = filled!(
        f,
        AirUniform {
            rayleigh_scattering_per_m: vec3,
            rayleigh_inverse_height_per_m: f32,
            rayleigh_extinction_per_m: vec3,
            mie_inverse_height_per_m: f32,
            mie_scattering_per_m: vec3,
            mie_asymmetry: f32,
            mie_extinction_per_m: vec3,
            ozone_centre_m: f32,
            ozone_absorption_per_m: vec3,
            ozone_inverse_half_width_per_m: f32,
            haze_scattering_per_m: vec3,
            haze_extinction_per_m: f32,
            ground_albedo: vec3,
            haze_top_m: f32,
            radius_m: f32,
            top_m: f32,
            multiple: f32,
        }
    );
    let shaders = [
        &shader::TRANSMITTANCE,
        &shader::MULTI_SCATTERING,
        &shader::SKY_VIEW,
        &shader::SKY,
        &shader::STARS,
        &shader::PROBE,
        &shader::AERIAL,
        &shader::CLOUD_VIEW_LIGHT,
    ];
    check(&shaders, "Air", &part, &f);
}

#[test]
fn observer() {
    let mut f = Filled::default();
    let part = filled!(
        f,
        ObserverUniform {
            altitude_m: f32,
            mu_s: f32,
            sin_s: f32,
            steps: u32,
            sun_steps: u32
        }
    );
    let shaders = [
        &shader::SKY_VIEW,
        &shader::SKY,
        &shader::PROBE,
        &shader::AERIAL,
        &shader::CLOUD_VIEW_LIGHT,
    ];
    check(&shaders, "Observer", &part, &f);
}

#[test]
fn view() {
    let mut f = Filled::default();
    let part = filled!(
        f,
        ViewUniform {
            up: vec3,
            altitude_m: f32,
            sun: vec3,
            mu_s: f32,
            sun_irradiance: vec3,
            sun_angular_radius: f32,
            limb_exponent: vec3,
            disc: f32,
        }
    );
    let shaders = [
        &shader::SKY,
        &shader::STARS,
        &shader::PROBE,
        &shader::CLOUD_VIEW_LIGHT,
    ];
    check(&shaders, "View", &part, &f);
}

#[test]
fn camera() {
    let mut f = Filled::default();
    let part = filled!(
        f,
        CameraUniform {
            right: vec3,
            half_field: f32,
            up: vec3,
            pixel_angle: f32,
            forward: vec3,
            size_px: vec2,
        }
    );
    check(&[&shader::SKY, &shader::CLOUD_VIEW_LIGHT], "Camera", &part, &f);
}

#[test]
fn tile_order_and_meter() {
    let mut f = Filled::default();
    let part = filled!(
        f,
        TileUniform {
            origin_px: uvec2,
            size_px: uvec2,
            stride_px: u32
        }
    );
    check(&[&shader::SKY, &shader::CLOUD_VIEW_LIGHT], "Tile", &part, &f);
    let mut f = Filled::default();
    let part = filled!(
        f,
        OrderUniform {
            last: u32,
            steps: u32
        }
    );
    check(&[&shader::MULTI_SCATTERING], "Order", &part, &f);
    let mut f = Filled::default();
    let part = filled!(f, IntegralUniform { steps: u32 });
    check(&[&shader::TRANSMITTANCE], "Integral", &part, &f);
    let mut f = Filled::default();
    let part = filled!(
        f,
        MeterUniform {
            size_px: uvec2,
            compensation_ev: f32
        }
    );
    check(&[&shader::EXPOSURE], "Meter", &part, &f);
}

#[test]
fn tone() {
    let mut f = Filled::default();
    let part = filled!(
        f,
        ToneUniform {
            white_r: vec3,
            dither: u32,
            white_g: vec3,
            metered: u32,
            white_b: vec3,
            glaring_angular_radius: f32,
            gain: vec3,
            glare: f32,
            glaring_irradiance: vec3,
            stride_px: u32,
            origin_px: uvec2,
            size_px: uvec2,
        }
    );
    check(&[&shader::TONE, &shader::SKY], "Tone", &part, &f);
}

#[test]
fn night() {
    let mut f = Filled::default();
    let part = filled!(
        f,
        AirglowUniform {
            emission_per_m: vec3,
            base_m: f32,
            scattered: vec3,
            top_m: f32,
            ground_irradiance: vec3,
            inside: f32,
            zenith_depth: vec3,
        }
    );
    check(&[&shader::SKY, &shader::PROBE], "Airglow", &part, &f);
    let mut f = Filled::default();
    let part = filled!(
        f,
        MoonUniform {
            direction: vec3,
            angular_radius: f32,
            east: vec3,
            disc: f32,
            north: vec3,
            sun_left: f32,
            light: vec3,
            sun_disc_scale: f32,
            radiance: vec3,
            earthshine: vec3,
            glares: f32,
        }
    );
    check(&[&shader::SKY, &shader::PROBE], "Moon", &part, &f);
    let mut f = Filled::default();
    let part = filled!(
        f,
        StretchUniform {
            first: u32,
            count: u32,
            frame_width: u32,
            out: f32,
            origin_px: uvec2,
            size_px: uvec2,
            stride_px: u32
        }
    );
    check(&[&shader::STARS], "Stretch", &part, &f);
}
