//! Short ways to skies with clouds.

use serde_json::{Value, json};
use std::sync::{Arc, LazyLock};
use welkin_render::{DiskCache, Renderer, RendererSettings};
use welkin_scene::{
    Quality, Scene,
    assets::SceneAssets,
    renderer::{FrameOrder, Output, Pixels, Priority, Render},
};

pub(crate) type Rgb = [f64; 3];

/// One renderer for all tests of this binary. Noise outlasts the test, since each runs in a process of its own.
pub(crate) fn renderer() -> &'static Renderer {
    static RENDERER: LazyLock<Renderer> = LazyLock::new(|| {
        let settings = RendererSettings {
            disk_cache: Some(DiskCache {
                folder: concat!(env!("CARGO_TARGET_TMPDIR"), "/noise").into(),
                most_bytes: 1 << 28,
            }),
            ..RendererSettings::default()
        };
        Renderer::start(settings).unwrap()
    });
    &RENDERER
}

/// JSON merge patch (RFC 7396).
pub(crate) fn merged(mut base: Value, patch: &Value) -> Value {
    let Value::Object(fields) = patch else {
        return patch.clone();
    };
    if !base.is_object() {
        base = json!({});
    }
    for (name, value) in fields {
        let held = base[name].take();
        base[name] = merged(held, value);
    }
    base
}

/// Heaps from 1500 to 3500 m that fill their layer, the sun in the picture, lit by it alone. Without shadows, so that
/// where there is no cloud the sky is the clear one.
pub(crate) fn usual() -> Value {
    json!({
        "camera": {"position_m": [0, 0, 2], "direction": {"azimuth_deg": 180, "elevation_deg": 30},
                   "projection": {"kind": "perspective", "vertical_fov_deg": 80}},
        "sun": {"position": {"azimuth_deg": 200, "elevation_deg": 40}, "disc": false},
        "moon": null,
        "stars": null,
        "clouds": {
            "coverage": 0.5,
            "shadows": false,
            "layers": [{"kind": "volume", "base_m": 1500, "top_m": 3500, "type": 0.8}],
            "shape": {"gradients": {"stratus": [0, 0.1, 0.85, 1], "stratocumulus": [0, 0.15, 0.6, 1],
                                    "cumulus": [0, 0.0625, 0.78, 1]}},
        },
    })
}

pub(crate) fn scene(changes: &Value) -> Scene {
    Scene::from_value(&merged(usual(), changes)).unwrap()
}

/// The usual scene with other clouds.
pub(crate) fn clouds(changes: Value) -> Scene {
    scene(&json!({ "clouds": changes }))
}

/// The usual scene without any.
pub(crate) fn clear() -> Scene {
    scene(&json!({"clouds": null}))
}

pub(crate) fn order(
    scene: &Scene,
    (width_px, height_px): (u32, u32),
    quality: Quality,
    output: Output,
) -> FrameOrder {
    FrameOrder {
        scene: Arc::new(scene.clone()),
        assets: Arc::default(),
        width_px,
        height_px,
        quality,
        output,
        priority: Priority::Interactive,
    }
}

pub(crate) fn pixels(order: FrameOrder) -> Pixels {
    pollster::block_on(renderer().frame(order))
        .unwrap()
        .pixels
        .clone()
}

/// Radiance, rows from the top.
#[derive(PartialEq)]
pub(crate) struct Seen {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) values: Vec<Rgb>,
}

pub(crate) fn seen_as(order: FrameOrder) -> Seen {
    let (width, height) = (order.width_px as usize, order.height_px as usize);
    let Pixels::Linear(values) = pixels(order) else {
        panic!("not radiance")
    };
    assert!(
        values.iter().all(|v| v.is_finite() && *v >= 0.0),
        "not finite, or negative"
    );
    let values = values.chunks_exact(3).map(|p| [p[0], p[1], p[2]].map(f64::from));
    Seen {
        width,
        height,
        values: values.collect(),
    }
}

/// A small preview: 32 × 18 rays through the clouds.
pub(crate) fn seen(scene: &Scene) -> Seen {
    seen_as(order(scene, (128, 72), Quality::Preview, Output::Linear))
}

pub(crate) fn seen_with(scene: &Scene, assets: SceneAssets) -> Seen {
    let mut order = order(scene, (128, 72), Quality::Preview, Output::Linear);
    order.assets = Arc::new(assets);
    seen_as(order)
}

/// Luminance by the weights of Rec. 709.
pub(crate) fn luma(c: Rgb) -> f64 {
    0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]
}

impl Seen {
    fn rows(&self, rows: std::ops::Range<usize>) -> &[Rgb] {
        &self.values[rows.start * self.width..rows.end * self.width]
    }

    fn mean_of(values: &[Rgb]) -> Rgb {
        [0, 1, 2].map(|c| values.iter().map(|v| v[c]).sum::<f64>() / values.len() as f64)
    }

    pub(crate) fn mean(&self) -> Rgb {
        Self::mean_of(&self.values)
    }

    /// Mean luminance.
    pub(crate) fn light(&self) -> f64 {
        luma(self.mean())
    }

    /// Mean relative difference of two pictures.
    pub(crate) fn apart(&self, other: &Self) -> f64 {
        share_apart(&self.values, &other.values, |off| off)
    }

    /// Share of pixels that differ by more than a twentieth.
    pub(crate) fn changed(&self, other: &Self) -> f64 {
        share_apart(&self.values, &other.values, |off| f64::from(u8::from(off > 0.05)))
    }

    /// The same of the rows above the middle, and of those below.
    pub(crate) fn changed_above_and_below(&self, other: &Self) -> [f64; 2] {
        let half = self.height / 2;
        [0..half, half..self.height].map(|rows| {
            share_apart(self.rows(rows.clone()), other.rows(rows), |off| {
                f64::from(u8::from(off > 0.05))
            })
        })
    }
}

fn share_apart(a: &[Rgb], b: &[Rgb], count: impl Fn(f64) -> f64) -> f64 {
    let all = a.iter().zip(b).map(|(a, b)| {
        let (a, b) = (luma(*a), luma(*b));
        count((a - b).abs() / a.max(b).max(1e-9))
    });
    all.sum::<f64>() / a.len() as f64
}

/// Share of the picture in which clouds are seen.
pub(crate) fn cloudiness(scene: &Scene) -> f64 {
    let mut without = scene.clone();
    without.clouds = None;
    seen(scene).changed(&seen(&without))
}
