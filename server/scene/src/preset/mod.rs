//! Ready-made scenes.

mod air;
mod genera;
mod ground;
mod published;
mod weather;

use crate::{
    camera::{Camera, Projection},
    clouds::{Clouds, Gradients, Layer, PlainMap, Shape, SheetLayer, UniformMap, VolumeLayer},
    direction::Direction,
    document::Scene,
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
    &PRESETS
}

/// The one of that name.
#[must_use]
pub fn preset(name: &str) -> Option<&'static Preset> {
    presets().iter().find(|preset| preset.name == name)
}

static PRESETS: LazyLock<Vec<Preset>> = LazyLock::new(|| {
    let [air, weather, genera] = [air::presets(), weather::presets(), genera::presets()];
    [air, ground::presets(), weather, genera, published::presets()].concat()
});

fn looking(azimuth_deg: f64, elevation_deg: f64) -> Camera {
    Camera {
        direction: Direction::angles(azimuth_deg, elevation_deg),
        ..Camera::default()
    }
}

/// The same with a wide lens.
fn wide(azimuth_deg: f64, elevation_deg: f64) -> Camera {
    Camera {
        projection: Projection::Perspective {
            vertical_fov_deg: 75.0,
        },
        ..looking(azimuth_deg, elevation_deg)
    }
}

fn sun(azimuth_deg: f64, elevation_deg: f64) -> Sun {
    Sun {
        position: SunPosition::Direction(Direction::angles(azimuth_deg, elevation_deg)),
        ..Sun::default()
    }
}

/// Layers whose clouds fill the heights that they are given.
fn clouds(coverage: f64, layers: Vec<Layer>) -> Clouds {
    Clouds {
        coverage,
        layers,
        shape: Shape {
            gradients: Gradients::filling(),
            ..Shape::default()
        },
        ..Clouds::default()
    }
}

fn volume(base_m: f64, top_m: f64, cloud_type: f64) -> VolumeLayer {
    VolumeLayer {
        base_m,
        top_m,
        cloud_type: Some(cloud_type),
        ..VolumeLayer::default()
    }
}

fn sheet(layer: SheetLayer) -> Layer {
    Layer::Sheet(layer)
}

/// The same weather everywhere, all of it covered.
fn everywhere(cloud_type: f64, rain: f64) -> PlainMap {
    PlainMap::Uniform(UniformMap {
        coverage: 1.0,
        cloud_type,
        rain,
    })
}
