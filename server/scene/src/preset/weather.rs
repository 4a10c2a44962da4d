//! Skies with clouds as days bring them.

use super::{Preset, clouds, looking, sheet, sun, volume, wide};
use crate::{
    clouds::{Clouds, Genus, Layer, SheetLayer, VolumeLayer},
    document::Scene,
};

pub(super) fn presets() -> Vec<Preset> {
    vec![
        Preset {
            name: "fair-weather",
            title: "Fair weather",
            description: "Cumulus under thin cirrus, an afternoon's sun at the left.",
            scene: Scene {
                camera: looking(300.0, 14.0),
                sun: sun(225.0, 38.0),
                clouds: Some(Clouds::default()),
                ..Scene::default()
            },
        },
        Preset {
            name: "overcast",
            title: "Overcast",
            description: "A closed deck from 700 to 1900 m, lumpy below; light without direction.",
            scene: Scene {
                camera: looking(20.0, 14.0),
                sun: sun(130.0, 40.0),
                clouds: Some(clouds(1.0, vec![Layer::Volume(volume(700.0, 1_900.0, 0.4))])),
                ..Scene::default()
            },
        },
        Preset {
            name: "storm",
            title: "Storm",
            description: "Thunderclouds up to 12 km over ragged low cloud; rain, and a sun that still reaches in below.",
            scene: Scene {
                camera: wide(70.0, 18.0),
                sun: sun(170.0, 20.0),
                clouds: Some(storm()),
                ..Scene::default()
            },
        },
        Preset {
            name: "mackerel-sky",
            title: "Mackerel sky",
            description: "Ripples of cirrocumulus and altocumulus like the scales of a fish, in the light of evening.",
            scene: Scene {
                camera: wide(310.0, 35.0),
                sun: sun(235.0, 20.0),
                clouds: Some(mackerel_sky()),
                ..Scene::default()
            },
        },
    ]
}

fn storm() -> Clouds {
    let towers = VolumeLayer {
        anvil: 1.0,
        coverage: Some(0.45),
        ..volume(800.0, 12_000.0, 1.0)
    };
    let scud = VolumeLayer {
        coverage: Some(0.6),
        ..volume(500.0, 1_100.0, 0.5)
    };
    Clouds {
        precipitation: 1.0,
        ..clouds(0.6, vec![Layer::Volume(towers), Layer::Volume(scud)])
    }
}

fn mackerel_sky() -> Clouds {
    let scales = SheetLayer {
        height_m: 7_500.0,
        genus: Genus::Cirrocumulus,
        ..SheetLayer::default()
    };
    let rows = SheetLayer {
        height_m: 5_000.0,
        genus: Genus::Altocumulus,
        coverage: Some(0.4),
        optical_depth: Some(2.0),
    };
    clouds(0.75, vec![sheet(scales), sheet(rows)])
}
