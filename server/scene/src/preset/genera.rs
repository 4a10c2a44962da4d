//! The ten genera of cloud (WMO International Cloud Atlas), each at its usual heights in temperate latitudes.

use super::{Preset, clouds, everywhere, looking, sheet, sun, volume, wide};
use crate::{
    clouds::{Clouds, Genus, Layer, ProceduralMap, Shape, SheetLayer, VolumeLayer, WeatherMap},
    document::Scene,
};

pub(super) fn presets() -> Vec<Preset> {
    [low(), high()].concat()
}

fn low() -> Vec<Preset> {
    vec![
        Preset {
            name: "cumulus",
            title: "Cumulus",
            description: "Heaps with flat bases at 1200 m and bright tops, the sun at the left.",
            scene: Scene {
                camera: looking(20.0, 14.0),
                sun: sun(290.0, 40.0),
                clouds: Some(Clouds {
                    weather_map: spread(24_000.0),
                    ..clouds(0.35, vec![Layer::Volume(volume(1_200.0, 2_700.0, 1.0))])
                }),
                ..Scene::default()
            },
        },
        Preset {
            name: "stratus",
            title: "Stratus",
            description: "A low grey sheet from 250 m, thin enough that the day comes through.",
            scene: Scene {
                camera: looking(30.0, 12.0),
                sun: sun(140.0, 30.0),
                clouds: Some(Clouds {
                    weather_map: everywhere(0.0, 0.0).into(),
                    ..clouds(1.0, vec![Layer::Volume(volume(250.0, 600.0, 0.0))])
                }),
                ..Scene::default()
            },
        },
        Preset {
            name: "stratocumulus",
            title: "Stratocumulus",
            description: "Rolls and lumps at 1000 m with gaps of blue between them.",
            scene: Scene {
                camera: looking(330.0, 15.0),
                sun: sun(240.0, 35.0),
                clouds: Some(stratocumulus()),
                ..Scene::default()
            },
        },
        Preset {
            name: "cumulonimbus",
            title: "Cumulonimbus",
            description: "Towers from 900 m to the tropopause at 11 km with their anvils, lit from the right.",
            scene: Scene {
                camera: wide(60.0, 22.0),
                sun: sun(160.0, 25.0),
                clouds: Some(cumulonimbus()),
                ..Scene::default()
            },
        },
        Preset {
            name: "nimbostratus",
            title: "Nimbostratus",
            description: "A dark layer without end from 500 to 4500 m that rains steadily.",
            scene: Scene {
                camera: looking(0.0, 12.0),
                sun: sun(110.0, 35.0),
                clouds: Some(Clouds {
                    precipitation: 0.8,
                    weather_map: everywhere(0.3, 1.0).into(),
                    ..clouds(1.0, vec![Layer::Volume(volume(500.0, 4_500.0, 0.3))])
                }),
                ..Scene::default()
            },
        },
    ]
}

/// Lumps of two or three kilometres.
fn stratocumulus() -> Clouds {
    let usual = clouds(0.7, vec![Layer::Volume(volume(1_000.0, 1_700.0, 0.5))]);
    Clouds {
        weather_map: spread(20_000.0),
        shape: Shape {
            base_scale_m: 4_000.0,
            ..usual.shape
        },
        ..usual
    }
}

/// As wide as they are high, with towers of a kilometre and more.
fn cumulonimbus() -> Clouds {
    let towers = VolumeLayer {
        anvil: 1.0,
        ..volume(900.0, 11_000.0, 1.0)
    };
    let usual = clouds(0.25, vec![Layer::Volume(towers)]);
    Clouds {
        precipitation: 0.6,
        weather_map: spread(90_000.0),
        shape: Shape {
            base_scale_m: 14_000.0,
            detail_scale_m: 1_800.0,
            high_freq_modifier: 0.25,
            ..usual.shape
        },
        ..usual
    }
}

/// Weather by noise. The smaller its square, the smaller the clouds.
fn spread(extent_m: f64) -> WeatherMap {
    WeatherMap::Procedural(ProceduralMap {
        extent_m,
        ..ProceduralMap::default()
    })
}

fn high() -> Vec<Preset> {
    vec![
        Preset {
            name: "altocumulus",
            title: "Altocumulus",
            description: "Cloudlets in rows at 4000 m, shaded on their undersides.",
            scene: high_scene(24.0, 100.0, 35.0, (4_000.0, Some(2.0)), Genus::Altocumulus, 0.55),
        },
        Preset {
            name: "altostratus",
            title: "Altostratus",
            description: "A grey veil at 4500 m over all the sky, so thick that the sun before the camera is not made out.",
            scene: high_scene(25.0, 15.0, 35.0, (4_500.0, Some(12.0)), Genus::Altostratus, 1.0),
        },
        Preset {
            name: "cirrus",
            title: "Cirrus",
            description: "White fibres and hooks of ice at 9 km on deep blue.",
            scene: high_scene(35.0, 80.0, 40.0, (9_000.0, None), Genus::Cirrus, 0.5),
        },
        Preset {
            name: "cirrocumulus",
            title: "Cirrocumulus",
            description: "Ripples and grains of ice at 8 km, white and without shades.",
            scene: high_scene(30.0, 95.0, 30.0, (8_000.0, None), Genus::Cirrocumulus, 0.6),
        },
        Preset {
            name: "cirrostratus",
            title: "Cirrostratus",
            description: "A smooth milky veil at 8500 m, through which the sun still casts shadows.",
            scene: high_scene(25.0, 65.0, 30.0, (8_500.0, Some(0.4)), Genus::Cirrostratus, 1.0),
        },
    ]
}

/// One sheet over the south, seen with a wide lens; the sun stands `beside_deg` to the left.
fn high_scene(
    up_deg: f64,
    beside_deg: f64,
    sun_deg: f64,
    (height_m, optical_depth): (f64, Option<f64>),
    genus: Genus,
    coverage: f64,
) -> Scene {
    let layer = SheetLayer {
        height_m,
        genus,
        optical_depth,
        ..SheetLayer::default()
    };
    Scene {
        camera: wide(200.0, up_deg),
        sun: sun(200.0 - beside_deg, sun_deg),
        clouds: Some(clouds(coverage, vec![sheet(layer)])),
        ..Scene::default()
    }
}
