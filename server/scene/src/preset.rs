//! Ready-made scenes.

use crate::{
    atmosphere::{Atmosphere, Mie, Orders, Rayleigh},
    bands::Bands,
    camera::{Camera, Projection},
    direction::Direction,
    display::{Display, Exposure, ToneCurve},
    document::Scene,
    moon::Moon,
    planet::Planet,
    sun::{Sun, SunPosition},
};
use serde::Serialize;
use std::sync::LazyLock;

/// A ready-made scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Preset {
    /// As requests name it.
    pub name: &'static str,
    /// As people read it.
    pub title: &'static str,
    /// What it shows.
    pub description: &'static str,
    /// The scene, complete.
    pub scene: Scene,
}

/// All of them.
#[must_use]
pub fn presets() -> &'static [Preset] {
    &*PRESETS
}

/// The one of that name.
#[must_use]
pub fn preset(name: &str) -> Option<&'static Preset> {
    presets().iter().find(|preset| preset.name == name)
}

static PRESETS: LazyLock<[Preset; 7]> = LazyLock::new(|| {
    [
        Preset {
            name: "clear-noon",
            title: "Clear noon",
            description: "A high sun behind the observer's right shoulder; deep blue above, pale at the horizon.",
            scene: Scene {
                camera: looking(20.0, 20.0),
                sun: sun(180.0, 60.0),
                ..Scene::default()
            },
        },
        Preset {
            name: "golden-hour",
            title: "Golden hour",
            description: "The sun 6° over the horizon in the west-south-west, at the picture's left.",
            scene: Scene {
                camera: looking(275.0, 12.0),
                sun: sun(250.0, 6.0),
                ..Scene::default()
            },
        },
        Preset {
            name: "twilight",
            title: "Twilight",
            description: "The sun 4° below the horizon; the last light over the place where it set.",
            scene: Scene {
                camera: looking(290.0, 14.0),
                sun: sun(290.0, -4.0),
                // As a photographer would set it for the blue hour.
                display: Display {
                    white_balance_k: 4500.0,
                    ..Display::default()
                },
                ..Scene::default()
            },
        },
        Preset {
            name: "moonlit-night",
            title: "Moonlit night",
            description: "A moon a day before full in the south-south-east, and the bright stars of winter about it.",
            scene: Scene {
                camera: looking(165.0, 17.0),
                sun: sun(330.0, -40.0),
                moon: Some(Moon {
                    position: Some(Direction::angles(150.0, 28.0)),
                    ..Moon::default()
                }),
                ..night(4_500.0)
            },
        },
        Preset {
            name: "starry-night",
            title: "Starry night",
            description: "No moon: the stars of a February evening over the south, Orion and Sirius before the airglow.",
            scene: Scene {
                camera: looking(180.0, 25.0),
                sun: sun(330.0, -40.0),
                moon: None,
                ..night(4_000.0)
            },
        },
        Preset {
            name: "from-orbit",
            title: "From orbit",
            description: "The limb from 400 km up with the sun low behind it: the air is a thin blue line.",
            scene: from_orbit(),
        },
        Preset {
            name: "complutense",
            title: "Complutense",
            description: "The air, the eye and the curve of a thesis of the Universidad Complutense de Madrid \
                          (Iniesta and Pérez 2015): light scattered once, no ozone.",
            scene: complutense(),
        },
    ]
});

/// As photographers set the white of a night.
fn night(white_balance_k: f64) -> Scene {
    Scene {
        display: Display {
            white_balance_k,
            ..Display::default()
        },
        ..Scene::default()
    }
}

fn looking(azimuth_deg: f64, elevation_deg: f64) -> Camera {
    Camera {
        direction: Direction::angles(azimuth_deg, elevation_deg),
        ..Camera::default()
    }
}

fn sun(azimuth_deg: f64, elevation_deg: f64) -> Sun {
    Sun {
        position: SunPosition::Direction(Direction::angles(azimuth_deg, elevation_deg)),
        ..Sun::default()
    }
}

/// From 400 km the horizon lies acos(6360 / 6760) = 19.8° down and the top of the air 17.1°; the sun stands between
/// the air and the picture's upper edge.
fn from_orbit() -> Scene {
    Scene {
        camera: Camera {
            position_m: [0.0, 0.0, 400_000.0],
            projection: Projection::Perspective {
                vertical_fov_deg: 50.0,
            },
            ..looking(75.0, -19.0)
        },
        sun: sun(90.0, -12.0),
        ..Scene::default()
    }
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
        ..Scene::default()
    }
}
