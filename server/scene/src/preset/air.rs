//! Clear skies by day and night.

use super::{Preset, looking, sun};
use crate::{
    camera::{Camera, Projection},
    direction::Direction,
    display::Display,
    document::Scene,
    moon::Moon,
};

pub(super) fn presets() -> Vec<Preset> {
    vec![
        Preset {
            name: "clear-noon",
            title: "Clear noon",
            description: "A high sun behind the observer's right shoulder; deep blue above, pale at the horizon.",
            scene: Scene {
                camera: looking(20.0, 20.0),
                sun: sun(180.0, 60.0),
                ..Scene::clear()
            },
        },
        Preset {
            name: "golden-hour",
            title: "Golden hour",
            description: "The sun 6° over the horizon in the west-south-west, at the picture's left.",
            scene: Scene {
                camera: looking(275.0, 12.0),
                sun: sun(250.0, 6.0),
                ..Scene::clear()
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
                ..Scene::clear()
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
    ]
}

/// As photographers set the white of a night.
fn night(white_balance_k: f64) -> Scene {
    Scene {
        display: Display {
            white_balance_k,
            ..Display::default()
        },
        ..Scene::clear()
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
        ..Scene::clear()
    }
}
