//! Skies as others published them.

use super::{Preset, looking, sun, volume};
use crate::{
    atmosphere::{Atmosphere, Mie, Orders, Rayleigh},
    bands::Bands,
    clouds::{Clouds, DualHenyeyGreenstein, Gradients, Layer, Phase, ProceduralMap, Shape, WeatherMap},
    display::{Display, Exposure, ToneCurve},
    document::Scene,
    planet::Planet,
    sun::Sun,
};

pub(super) fn presets() -> Vec<Preset> {
    vec![
        Preset {
            name: "complutense",
            title: "Complutense",
            description: "The air, the eye and the curve of a thesis of the Universidad Complutense de Madrid \
                          (Iniesta and Pérez 2015): light scattered once, no ozone.",
            scene: complutense(),
        },
        Preset {
            name: "bauman",
            title: "Bauman",
            description: "The cloud shell, the noise scales, the two lobes and the steps of a thesis of the Bauman \
                          University, Moscow: clouds 20 km thick over a planet of 6400 km.",
            scene: in_the_shell(bauman()),
        },
        Preset {
            name: "horizon",
            title: "Horizon",
            description: "The same shell with the noise scales, the lobes and the haze of a published rendering after \
                          the clouds of Horizon Zero Dawn.",
            scene: in_the_shell(horizon()),
        },
    ]
}

/// The thesis follows single scattering alone and sees no ground in its sky, hence the black ground.
fn complutense() -> Scene {
    const MIE_SCATTERING_PER_M: f64 = 2.0e-5;
    Scene {
        sun: Sun {
            irradiance_w_m2: [30.0; 3],
            ..Sun::default()
        },
        planet: Planet {
            radius_m: 6_371_000.0,
            ground_albedo: [0.0; 3],
            ..Planet::default()
        },
        atmosphere: Some(Atmosphere {
            orders: Orders::Single,
            top_m: 100_000.0,
            density_factor: 1.0,
            rayleigh: Some(Rayleigh {
                scattering_per_m: [5.8e-6, 13.5e-6, 33.1e-6],
                scale_height_m: 7_994.0,
                ..Rayleigh::default()
            }),
            mie: Some(Mie {
                scattering_per_m: Bands::Grey(MIE_SCATTERING_PER_M),
                absorption_per_m: Bands::Grey(0.1 * MIE_SCATTERING_PER_M),
                scale_height_m: 1_200.0,
                asymmetry: 0.76,
            }),
            ozone: None,
            ..Atmosphere::default()
        }),
        display: Display {
            exposure: Exposure::Pupil { gain: 1.0 },
            tone_curve: ToneCurve::Exponential,
            ..Display::default()
        },
        ..Scene::clear()
    }
}

/// Both draw a planet of 6400 km and clouds between the spheres of 6415 and 6435 km, and look up 35°.
fn in_the_shell(clouds: Clouds) -> Scene {
    Scene {
        camera: looking(0.0, 35.0),
        sun: sun(70.0, 40.0),
        planet: Planet {
            radius_m: 6_400_000.0,
            ..Planet::default()
        },
        clouds: Some(clouds),
        ..Scene::default()
    }
}

/// 128 steps, the light followed over four; both published programs share them.
fn shell(weather: ProceduralMap, shape: Shape) -> Clouds {
    Clouds {
        coverage: 0.6,
        layers: vec![Layer::Volume(volume(15_000.0, 35_000.0, 1.0))],
        weather_map: WeatherMap::Procedural(weather),
        shape: Shape {
            base_scale_m: 48_000.0,
            high_freq_modifier: 0.15,
            curl_distortion_m: 0.0,
            gradients: Gradients {
                cumulus: [0.0, 0.07, 0.2, 1.0],
                ..Gradients::default()
            },
            ..shape
        },
        // Light scattered once.
        octaves: 1,
        steps: 128,
        light_steps: 4,
        ..Clouds::default()
    }
}

/// An attenuation of 0.05 per kilometre at a density of 150.
fn bauman() -> Clouds {
    Clouds {
        extinction_per_m: 7.5e-3,
        phase: lobes(0.6, -0.6, 0.3),
        powder: 1.0,
        ..shell(
            ProceduralMap {
                extent_m: 480_000.0,
                ..ProceduralMap::default()
            },
            Shape {
                detail_scale_m: 48_000.0,
                ..Shape::default()
            },
        )
    }
}

/// Its two lobes both look along the light; the second, wide one comes nearest to a lobe without direction.
fn horizon() -> Clouds {
    Clouds {
        extinction_per_m: 0.01,
        phase: lobes(0.9, 0.0, 0.7),
        powder: 0.0,
        haze: 0.5,
        ..shell(
            // So wide that a single cloud may fill the view; over this one's origin they break up.
            ProceduralMap {
                extent_m: 4_096_000.0,
                seed: Some(3),
            },
            Shape {
                detail_scale_m: 4_800.0,
                ..Shape::default()
            },
        )
    }
}

fn lobes(forward: f64, backward: f64, blend: f64) -> Phase {
    Phase::DualHenyeyGreenstein(DualHenyeyGreenstein {
        forward,
        backward,
        blend,
    })
}
