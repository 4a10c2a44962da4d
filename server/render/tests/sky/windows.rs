//! Parts of frames, from which large pictures are put together.

use crate::scenes::renderer;
use pollster::block_on;
use serde_json::json;
use std::sync::Arc;
use welkin_scene::{
    Quality, Scene,
    job::Window,
    renderer::{FrameOrder, Output, Pixels, Priority, Render, RenderError},
};

fn order(width_px: u32, height_px: u32, clouds: bool) -> FrameOrder {
    let mut scene =
        Scene::from_value(&json!({"camera": {"projection": {"kind": "equirectangular"}}})).unwrap();
    if !clouds {
        scene.clouds = None;
    }
    FrameOrder {
        scene: Arc::new(scene),
        assets: Arc::default(),
        width_px,
        height_px,
        quality: Quality::Final,
        output: Output::Linear,
        priority: Priority::Batch,
    }
}

fn values(pixels: &Pixels) -> &[f32] {
    match pixels {
        Pixels::Linear(values) => values,
        Pixels::Display(_) => unreachable!("radiance was asked for"),
    }
}

#[test]
fn tiles_together_are_the_frame() {
    for clouds in [false, true] {
        let (width, height, tile) = (96, 48, 32);
        let whole = block_on(renderer().frame(order(width, height, clouds))).unwrap();
        for (x_px, y_px) in (0..height)
            .step_by(tile)
            .flat_map(|y| (0..width).step_by(tile).map(move |x| (x, y)))
        {
            let window = Window {
                x_px,
                y_px,
                width_px: 32.min(width - x_px),
                height_px: 32.min(height - y_px),
            };
            let part = block_on(renderer().window(order(width, height, clouds), window)).unwrap();
            assert_eq!(
                (part.width_px, part.height_px),
                (window.width_px, window.height_px)
            );
            let part = values(&part.pixels);
            for y in 0..window.height_px {
                let (row, from) = (
                    3 * window.width_px as usize,
                    3 * ((y_px + y) * width + x_px) as usize,
                );
                let expected = &values(&whole.pixels)[from..from + row];
                assert_eq!(
                    &part[row * y as usize..][..row],
                    expected,
                    "row {y} of {window:?}, clouds: {clouds}"
                );
            }
        }
    }
}

#[test]
fn what_lies_beyond_a_frame_is_refused() {
    for (width, window) in [
        (64, [60, 0, 8, 8]),
        (64, [0, 60, 8, 8]),
        (64, [0, 0, 0, 8]),
        (40_000, [0, 0, 8, 8]),
        (64, [u32::MAX, 0, 2, 8]),
    ] {
        let [x_px, y_px, width_px, height_px] = window;
        let window = Window {
            x_px,
            y_px,
            width_px,
            height_px,
        };
        let refused = block_on(renderer().window(order(width, 64, false), window));
        assert!(matches!(refused, Err(RenderError::Size { .. })), "{window:?}");
    }
}
