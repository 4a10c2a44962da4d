//! Devices that do not filter 32-bit floats get tables of half floats.

use crate::{
    engine::Engine,
    frame_job::{FrameJob, TileBudget},
    gpu::{AdapterChoice, Gpu},
};
use std::sync::Arc;
use welkin_scene::{
    Quality, Scene,
    renderer::{FrameOrder, Output, Pixels, Priority},
};

fn radiance(table_format: wgpu::TextureFormat) -> Vec<f32> {
    let mut gpu = Gpu::open(&AdapterChoice::default()).unwrap();
    gpu.table_format = table_format;
    let mut engine = Engine::on(gpu, None, 0).unwrap();
    let mut scene = Scene::clear();
    scene.sun.disc = false;
    let order = FrameOrder {
        scene: Arc::new(scene),
        assets: Arc::default(),
        width_px: 96,
        height_px: 54,
        quality: Quality::Final,
        output: Output::Linear,
        priority: Priority::Interactive,
    };
    let mut job = FrameJob::new(order, None);
    let mut budget = TileBudget::default();
    loop {
        if let Some(frame) = job.step(&mut engine, &mut budget).unwrap() {
            match &frame.pixels {
                Pixels::Linear(values) => return values.clone(),
                Pixels::Display(_) => unreachable!("radiance was ordered"),
            }
        }
    }
}

#[test]
fn half_float_tables_give_the_same_sky() {
    let exact = radiance(wgpu::TextureFormat::Rgba32Float);
    let half = radiance(wgpu::TextureFormat::Rgba16Float);
    assert_ne!(exact, half, "the format has no effect");
    let worst = exact
        .iter()
        .zip(&half)
        .map(|(e, h)| ((h - e) / e).abs())
        .fold(0.0, f32::max);
    // A half float resolves 2^-11 = 0.05 %; optical depths of 10 at the horizon make 0.5 % of that.
    assert!(worst < 0.01, "{worst}");
}
