//! Mountains before the sky: smooth, and the same in every part of a frame and after every way to it.

use super::{refined::refined, *};
use serde_json::json;

fn mountains() -> Scene {
    Scene::from_value(&json!({
        "camera": {"position_m": [0, 0, 1500], "direction": {"azimuth_deg": 160, "elevation_deg": 4}},
        "sun": {"position": {"azimuth_deg": 160, "elevation_deg": 25}},
        "clouds": null, "terrain": {"kind": "heightfield"},
    }))
    .unwrap()
}

fn order_of(size: [u32; 2], output: Output) -> FrameOrder {
    let mut order = order(mountains(), size[0], size[1], output);
    order.quality = Quality::Final;
    order
}

#[test]
fn parts_and_passes_have_the_silhouettes_of_the_whole() {
    let mut engine = engine();
    let order = order_of([120, 80], Output::Display);
    let (whole, _) = in_tiles(&mut engine, &order, 1 << 22);
    let (in_passes, _) = refined(&mut engine, &order, 1 << 6);
    assert!(in_passes.pixels == whole.pixels);
    let Pixels::Display(whole) = &whole.pixels else {
        unreachable!()
    };
    for [x_px, y_px, width_px, height_px] in
        [[0, 0, 40, 40], [37, 21, 50, 33], [90, 5, 30, 75], [60, 30, 1, 1]]
    {
        let window = Window {
            x_px,
            y_px,
            width_px,
            height_px,
        };
        let mut job = FrameJob::windowed(order.clone(), window, None);
        let part = loop {
            if let Some(frame) = job
                .step(&mut engine, &mut TileBudget { pixels: 1 << 10 })
                .unwrap()
            {
                break frame;
            }
        };
        assert_eq!((part.width_px, part.height_px), (width_px, height_px));
        let Pixels::Display(part) = &part.pixels else {
            unreachable!()
        };
        let rows = part.chunks_exact(3 * width_px as usize);
        assert_eq!(rows.len(), height_px as usize);
        for (row, y) in rows.zip(y_px..) {
            let first = 3 * (y * 120 + x_px) as usize;
            assert!(*row == whole[first..first + row.len()], "row {y} of {window:?}");
        }
    }
}

/// Against the mean of 7×7 rays a pixel. The middle one of these is what a frame would show that asked for no more: its
/// errors are those of silhouettes, and of textures finer than a pixel, which stay. The sky between and above is the same
/// for both.
#[test]
fn a_frame_is_closer_to_many_rays_than_one_ray_is() {
    const FINER: usize = 7;
    let mut engine = engine();
    let (width, height) = (120, 80);
    let light = |engine: &mut Engine, size: [u32; 2]| {
        let (frame, _) = in_tiles(engine, &order_of(size, Output::Linear), 1 << 22);
        match &frame.pixels {
            Pixels::Linear(values) => values.clone(),
            Pixels::Display(_) => unreachable!(),
        }
    };
    let frame = light(&mut engine, [width, height]);
    let finer = light(&mut engine, [width, height].map(|side| side * 7));
    let (width, height) = (width as usize, height as usize);
    let ray = |x: usize, y: usize| f64::from(finer[3 * (y * width * FINER + x) + 1]);
    let (mut smoothed, mut one) = (0.0, 0.0);
    for y in 0..height {
        for x in 0..width {
            let rays = (0..FINER * FINER).map(|k| ray(x * FINER + k % FINER, y * FINER + k / FINER));
            let truth = rays.sum::<f64>() / 49.0;
            let middle = ray(x * FINER + FINER / 2, y * FINER + FINER / 2);
            smoothed += (f64::from(frame[3 * (y * width + x) + 1]) - truth).powi(2);
            one += (middle - truth).powi(2);
        }
    }
    assert!(smoothed < 0.5 * one, "{smoothed} {one}");
}
