//! From the scene, in user units, to the structures that the shaders read. All conversion stands here.

pub(crate) mod clouds;
pub(crate) mod ground;
pub(crate) mod night;

use crate::{camera::CameraUniform, colour, lights::Glare, method::Steps};
use encase::{ShaderSize, ShaderType, internal::WriteInto};
use glam::{DVec3, UVec2, Vec3};
use welkin_scene::{Atmosphere, Exposure, Haze, Orders, Scene, Sun};

/// The bytes of one uniform: what a pass binds, and what its fingerprint is made of.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Part(pub(crate) Vec<u8>);

impl Part {
    pub(crate) fn new(value: &(impl ShaderSize + WriteInto)) -> Self {
        let mut bytes = vec![0; usize::try_from(value.size().get()).unwrap_or(0)];
        let mut writer = encase::UniformBuffer::new(&mut bytes);
        // The buffer has the value's own size.
        let written = writer.write(value);
        debug_assert!(written.is_ok(), "a uniform fits the buffer made for it");
        Self(bytes)
    }

    pub(crate) fn upload(&self, gpu: &crate::gpu::Gpu, label: &str) -> wgpu::Buffer {
        gpu.filled(label, &self.0, wgpu::BufferUsages::UNIFORM)
    }
}

/// f64 to the f32 that shaders take.
#[allow(
    clippy::cast_possible_truncation,
    reason = "shaders take f32; every scene value is far inside its range"
)]
pub(crate) const fn narrow(value: f64) -> f32 {
    value as f32
}

pub(crate) fn narrow3(v: [f64; 3]) -> Vec3 {
    Vec3::new(narrow(v[0]), narrow(v[1]), narrow(v[2]))
}

/// `Air` of `lib/air.wgsl`.
#[derive(Clone, Debug, ShaderType)]
pub(crate) struct AirUniform {
    pub(crate) rayleigh_scattering_per_m: Vec3,
    pub(crate) rayleigh_inverse_height_per_m: f32,
    pub(crate) rayleigh_extinction_per_m: Vec3,
    pub(crate) mie_inverse_height_per_m: f32,
    pub(crate) mie_scattering_per_m: Vec3,
    pub(crate) mie_asymmetry: f32,
    pub(crate) mie_extinction_per_m: Vec3,
    pub(crate) ozone_centre_m: f32,
    pub(crate) ozone_absorption_per_m: Vec3,
    pub(crate) ozone_inverse_half_width_per_m: f32,
    pub(crate) haze_scattering_per_m: Vec3,
    pub(crate) haze_extinction_per_m: f32,
    pub(crate) ground_albedo: Vec3,
    pub(crate) haze_top_m: f32,
    pub(crate) radius_m: f32,
    pub(crate) top_m: f32,
    pub(crate) multiple: f32,
}

impl AirUniform {
    pub(crate) fn new(scene: &Scene) -> Self {
        let planet = &scene.planet;
        // Vacuum is air of no density.
        let vacuum = Atmosphere {
            density_factor: 0.0,
            ..Atmosphere::default()
        };
        let air = scene.atmosphere.as_ref().unwrap_or(&vacuum);
        let rayleigh = air.rayleigh.clone().unwrap_or_default();
        let mie = air.mie.clone().unwrap_or_default();
        let ozone = air.ozone.clone().unwrap_or_default();
        let share = |present: bool| if present { air.density_factor } else { 0.0 };
        let (with_rayleigh, with_mie) = (share(air.rayleigh.is_some()), share(air.mie.is_some()));
        let with_ozone = share(air.ozone.is_some());
        let haze_extinction = scene.haze.as_ref().map_or(0.0, Haze::extinction);
        let haze = scene.haze.clone().unwrap_or_default();
        let both = |a: [f64; 3], b: [f64; 3], factor: f64| narrow3([0, 1, 2].map(|i| (a[i] + b[i]) * factor));
        let none = [0.0; 3];
        let (mie_scattering, mie_absorption) = (mie.scattering_per_m.rgb(), mie.absorption_per_m.rgb());
        let scatters = air.density_factor > 0.0 || haze_extinction > 0.0;
        Self {
            rayleigh_scattering_per_m: both(rayleigh.scattering_per_m, none, with_rayleigh),
            rayleigh_inverse_height_per_m: narrow(1.0 / rayleigh.scale_height_m),
            rayleigh_extinction_per_m: both(
                rayleigh.scattering_per_m,
                rayleigh.absorption_per_m,
                with_rayleigh,
            ),
            mie_inverse_height_per_m: narrow(1.0 / mie.scale_height_m),
            mie_scattering_per_m: both(mie_scattering, none, with_mie),
            mie_asymmetry: narrow(mie.asymmetry),
            mie_extinction_per_m: both(mie_scattering, mie_absorption, with_mie),
            ozone_centre_m: narrow(ozone.centre_m),
            ozone_absorption_per_m: both(ozone.absorption_per_m, none, with_ozone),
            ozone_inverse_half_width_per_m: narrow(1.0 / ozone.half_width_m),
            haze_scattering_per_m: both(haze.albedo.rgb(), none, haze_extinction),
            haze_extinction_per_m: narrow(haze_extinction),
            ground_albedo: narrow3(planet.ground_albedo),
            haze_top_m: narrow(haze.top_m),
            radius_m: narrow(planet.radius_m),
            top_m: narrow(air.top_m),
            multiple: if air.orders == Orders::Multiple && scatters {
                1.0
            } else {
                0.0
            },
        }
    }
}

/// `Integral` of `transmittance.wgsl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct IntegralUniform {
    pub(crate) steps: u32,
}

/// `Observer` of `lib/view_ray.wgsl`.
#[derive(Clone, Debug, ShaderType)]
pub(crate) struct ObserverUniform {
    pub(crate) altitude_m: f32,
    pub(crate) mu_s: f32,
    pub(crate) sin_s: f32,
    pub(crate) steps: u32,
    pub(crate) sun_steps: u32,
}

/// Cosine and sine of the angle between the sun and the observer's zenith, and the altitude.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Standpoint {
    pub(crate) altitude_m: f64,
    pub(crate) up: DVec3,
    pub(crate) sun: DVec3,
}

impl Standpoint {
    pub(crate) fn new(scene: &Scene) -> Self {
        let observer = scene.observer();
        Self {
            altitude_m: observer.altitude_m.max(0.0),
            up: DVec3::from_array(observer.up),
            sun: DVec3::from_array(scene.sun_direction()),
        }
    }

    /// True where the sun lights no cloud over the observer: 6° below the horizon.
    pub(crate) fn is_night(&self) -> bool {
        self.up.dot(self.sun) < -0.1
    }

    pub(crate) fn observer(&self, steps: Steps) -> ObserverUniform {
        ObserverUniform {
            altitude_m: narrow(self.altitude_m),
            mu_s: narrow(self.up.dot(self.sun)),
            sin_s: narrow(self.up.cross(self.sun).length()),
            steps: steps.view,
            sun_steps: steps.sun,
        }
    }
}

/// `View` of `lib/light.wgsl`.
#[derive(Clone, Debug, ShaderType)]
pub(crate) struct ViewUniform {
    pub(crate) up: Vec3,
    pub(crate) altitude_m: f32,
    pub(crate) sun: Vec3,
    pub(crate) mu_s: f32,
    pub(crate) sun_irradiance: Vec3,
    pub(crate) sun_angular_radius: f32,
    pub(crate) limb_exponent: Vec3,
    pub(crate) disc: f32,
}

/// Neckel and Labs 1994 as powers of the limb's cosine (Hestroffer and Magnan 1998) at 680, 550 and 440 nm.
const LIMB_EXPONENT: Vec3 = Vec3::new(0.397, 0.503, 0.652);

impl ViewUniform {
    pub(crate) fn new(sun: &Sun, stand: &Standpoint) -> Self {
        Self {
            up: stand.up.as_vec3(),
            altitude_m: narrow(stand.altitude_m),
            sun: stand.sun.as_vec3(),
            mu_s: narrow(stand.up.dot(stand.sun)),
            sun_irradiance: narrow3(sun.irradiance_w_m2),
            sun_angular_radius: narrow((sun.angular_diameter_deg / 2.0).to_radians()),
            limb_exponent: if sun.limb_darkening {
                LIMB_EXPONENT
            } else {
                Vec3::ZERO
            },
            disc: if sun.disc { 1.0 } else { 0.0 },
        }
    }
}

/// `Tile` of `sky.wgsl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct TileUniform {
    pub(crate) origin_px: UVec2,
    /// Pixels that are computed.
    pub(crate) size_px: UVec2,
    /// From one of them to the next in the frame.
    pub(crate) stride_px: u32,
}

/// `Order` of `multi_scattering.wgsl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct OrderUniform {
    pub(crate) last: u32,
    pub(crate) steps: u32,
}

/// `Meter` of `exposure.wgsl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct MeterUniform {
    pub(crate) size_px: UVec2,
    pub(crate) compensation_ev: f32,
}

/// `Tone` of `lib/picture.wgsl`.
#[derive(Clone, Debug, Default, ShaderType)]
pub(crate) struct ToneUniform {
    pub(crate) white_r: Vec3,
    pub(crate) dither: u32,
    pub(crate) white_g: Vec3,
    pub(crate) metered: u32,
    pub(crate) white_b: Vec3,
    pub(crate) glaring_angular_radius: f32,
    pub(crate) gain: Vec3,
    pub(crate) glare: f32,
    pub(crate) glaring_irradiance: Vec3,
    pub(crate) stride_px: u32,
    pub(crate) origin_px: UVec2,
    pub(crate) size_px: UVec2,
}

/// EV at ISO 100 at which one W/m²/sr in the green band becomes 1: full scale is at 1.2 · 2^EV cd/m² (ISO 12232).
fn ev_of_gain(gain: f64) -> f64 {
    (colour::LUMINANCE_PER_RADIANCE[1] / (1.2 * gain)).log2()
}

impl ToneUniform {
    /// The settings, and the exposure value where it is known before metering.
    pub(crate) fn new(
        scene: &Scene,
        camera: &CameraUniform,
        stand: &Standpoint,
        tile: TileUniform,
        glare: &Glare,
    ) -> (Self, Option<f64>) {
        let display = &scene.display;
        let (gain, ev) = match display.exposure {
            Exposure::Ev { ev } => {
                let scale = (-ev).exp2() / 1.2;
                (colour::LUMINANCE_PER_RADIANCE.map(|k| k * scale), Some(ev))
            }
            Exposure::Auto { .. } => ([0.0; 3], None),
            Exposure::Pupil { gain } => {
                let towards = f64::from(camera.forward.dot(stand.sun.as_vec3()));
                let opened = gain * (1.0 - towards / 4.0).clamp(0.0, 1.0);
                ([opened; 3], (opened > 0.0).then(|| ev_of_gain(opened)))
            }
        };
        let white = colour::white_balance(display.white_balance_k);
        let tone = Self {
            white_r: narrow3(white[0]),
            white_g: narrow3(white[1]),
            metered: u32::from(matches!(display.exposure, Exposure::Auto { .. })),
            white_b: narrow3(white[2]),
            dither: u32::from(display.dither),
            gain: narrow3(gain),
            glare: narrow(display.glare),
            glaring_irradiance: narrow3(glare.irradiance_w_m2),
            glaring_angular_radius: narrow((glare.diameter_deg / 2.0).to_radians()),
            origin_px: tile.origin_px,
            size_px: tile.size_px,
            stride_px: tile.stride_px,
        };
        (tone, ev)
    }
}
