//! Short ways to scenes, frames and probes.

use serde_json::{Value, json};
use std::sync::{Arc, LazyLock};
use welkin_render::{Renderer, RendererSettings};
use welkin_scene::{
    Direction, ProbeAnswer, ProbeRequest, Quality, Scene,
    renderer::{Frame, FrameOrder, Output, Pixels, Priority, Render},
};

pub(crate) type Rgb = [f64; 3];

/// One renderer for all tests of this binary.
pub(crate) fn renderer() -> &'static Renderer {
    static RENDERER: LazyLock<Renderer> =
        LazyLock::new(|| Renderer::start(RendererSettings::default()).unwrap());
    &RENDERER
}

/// The default scene with changes, as JSON has them, under a clear sky and lit by the sun alone unless these say otherwise.
pub(crate) fn scene(changes: Value) -> Scene {
    let mut scene = whole(changes.clone());
    if changes.get("stars").is_none() {
        scene.stars = None;
    }
    if let Some(air) = scene.atmosphere.as_mut()
        && changes.pointer("/atmosphere/airglow").is_none()
    {
        air.airglow = None;
    }
    scene
}

/// The default scene with changes, the night's lights among them, under a clear sky unless these say otherwise.
pub(crate) fn whole(changes: Value) -> Scene {
    let is_cloudy = changes.get("clouds").is_some();
    let mut scene: Scene = serde_json::from_value(changes).unwrap();
    if !is_cloudy {
        scene.clouds = None;
    }
    scene
}

/// A planet without air.
pub(crate) fn vacuum(changes: Value) -> Scene {
    Scene {
        atmosphere: None,
        ..scene(changes)
    }
}

/// Nothing but a sun: the planet is a point below, and black.
pub(crate) fn empty_space(changes: Value) -> Scene {
    let mut scene = vacuum(changes);
    scene.planet = serde_json::from_value(json!({"radius_m": 1e5, "ground_albedo": [0, 0, 0]})).unwrap();
    scene.camera.position_m = [0.0, 0.0, 1e8];
    scene
}

pub(crate) fn order(
    scene: Scene,
    width_px: u32,
    height_px: u32,
    quality: Quality,
    output: Output,
) -> FrameOrder {
    FrameOrder {
        scene: Arc::new(scene),
        assets: Arc::default(),
        width_px,
        height_px,
        quality,
        output,
        priority: Priority::Interactive,
    }
}

pub(crate) fn frame(order: FrameOrder) -> Arc<Frame> {
    pollster::block_on(renderer().frame(order)).unwrap()
}

/// Radiance, rows from the top.
pub(crate) struct Radiance {
    pub(crate) width: usize,
    pub(crate) height: usize,
    values: Vec<f32>,
}

impl Radiance {
    pub(crate) fn at(&self, x: usize, y: usize) -> Rgb {
        let i = 3 * (y * self.width + x);
        [0, 1, 2].map(|c| f64::from(self.values[i + c]))
    }

    /// Every pixel with its place.
    pub(crate) fn pixels(&self) -> impl Iterator<Item = (usize, usize, Rgb)> {
        (0..self.height).flat_map(move |y| (0..self.width).map(move |x| (x, y, self.at(x, y))))
    }
}

pub(crate) fn radiance(scene: &Scene, width_px: u32, height_px: u32, quality: Quality) -> Radiance {
    let frame = frame(order(scene.clone(), width_px, height_px, quality, Output::Linear));
    let Pixels::Linear(values) = &frame.pixels else {
        panic!("not radiance")
    };
    assert!(
        values.iter().all(|v| v.is_finite() && *v >= 0.0),
        "not finite, or negative"
    );
    Radiance {
        width: width_px as usize,
        height: height_px as usize,
        values: values.clone(),
    }
}

/// The picture's bytes, and the EV that it was taken with.
pub(crate) fn picture(scene: &Scene, width_px: u32, height_px: u32) -> (Vec<[u8; 3]>, Option<f64>) {
    let frame = frame(order(
        scene.clone(),
        width_px,
        height_px,
        Quality::Preview,
        Output::Display,
    ));
    let Pixels::Display(values) = &frame.pixels else {
        panic!("not a picture")
    };
    (
        values.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect(),
        frame.facts.ev100,
    )
}

pub(crate) fn probe(scene: &Scene, directions: &[Direction]) -> ProbeAnswer {
    let request = ProbeRequest {
        scene: scene.clone(),
        directions: directions.to_vec(),
    };
    pollster::block_on(renderer().probe(request.into())).unwrap()
}

/// Radiance in one direction.
pub(crate) fn seen(scene: &Scene, azimuth_deg: f64, elevation_deg: f64) -> Rgb {
    probe(scene, &[Direction::angles(azimuth_deg, elevation_deg)]).radiance_w_m2_sr[0]
}

/// Transmittance in one direction.
pub(crate) fn left(scene: &Scene, azimuth_deg: f64, elevation_deg: f64) -> Rgb {
    probe(scene, &[Direction::angles(azimuth_deg, elevation_deg)]).transmittance[0]
}

/// Luminance by the weights of Rec. 709.
pub(crate) fn luma(c: Rgb) -> f64 {
    0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]
}
