//! Frames in tiles of any size, and orders that cost nothing because nothing changed.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use super::*;

mod lattices;
mod refined;
mod silhouettes;
use crate::tests::engine;
use welkin_scene::{Direction, Exposure, Projection, Quality, Scene, renderer::Priority, sun::SunPosition};

fn order(scene: Scene, width_px: u32, height_px: u32, output: Output) -> FrameOrder {
    FrameOrder {
        scene: Arc::new(scene),
        assets: Arc::default(),
        width_px,
        height_px,
        quality: Quality::Preview,
        output,
        priority: Priority::Batch,
    }
}

/// The frame in tiles of at most that many pixels, and how many pieces of work it took.
fn in_tiles(engine: &mut Engine, order: &FrameOrder, pixels: u32) -> (Arc<Frame>, u32) {
    let mut job = FrameJob::new(order.clone(), None);
    for step in 1.. {
        // A new budget each time: it learns from the device's speed, and tests may not depend on that.
        if let Some(frame) = job.step(engine, &mut TileBudget { pixels }).unwrap() {
            return (frame, step);
        }
    }
    unreachable!("the loop has no end but the frame")
}

fn passes(frame: &Frame) -> Vec<&'static str> {
    frame.passes.iter().map(|time| time.pass).collect()
}

#[test]
fn tiles_leave_no_trace() {
    let mut engine = engine();
    let mut scene = Scene::clear();
    // The sun in the picture, the horizon across it: everything that a tile's place could disturb.
    scene.camera.direction = Direction::angles(180.0, 20.0);
    scene.camera.projection = Projection::Perspective {
        vertical_fov_deg: 80.0,
    };
    for output in [Output::Display, Output::Linear] {
        for (width_px, height_px) in [(97, 61), (1, 1), (64, 64), (640, 3), (3, 640)] {
            let order = order(scene.clone(), width_px, height_px, output);
            let (whole, steps) = in_tiles(&mut engine, &order, 1 << 20);
            assert_eq!(steps, 2, "the tables and one tile");
            for pixels in [1 << 9, 777, 100, 40, 7] {
                // A few pixels a tile would take thousands of tiles.
                if width_px * height_px / pixels > 300 {
                    continue;
                }
                let (tiled, steps) = in_tiles(&mut engine, &order, pixels);
                assert!(
                    steps > width_px * height_px / pixels,
                    "{width_px} × {height_px} in {pixels}: {steps}"
                );
                assert!(
                    tiled.pixels == whole.pixels,
                    "{width_px} × {height_px} {output:?} in tiles of {pixels}"
                );
                assert_eq!(tiled.facts, whole.facts);
            }
        }
    }
}

/// A preview's clouds are those of the whole frame; a final frame's before a tile are a table of their own.
#[test]
fn tiles_leave_no_trace_in_clouds() {
    let mut engine = engine();
    let mut scene = Scene::default();
    scene.camera.direction = Direction::angles(180.0, 15.0);
    let mut traces = Vec::new();
    for quality in [Quality::Preview, Quality::Final] {
        let mut order = order(scene.clone(), 64, 36, Output::Linear);
        order.quality = quality;
        let (whole, steps) = in_tiles(&mut engine, &order, 1 << 22);
        assert_eq!(steps, 2, "the tables and one tile");
        for pixels in [1 << 10, 1 << 9] {
            let (tiled, steps) = in_tiles(&mut engine, &order, pixels);
            assert!(steps > 2, "{steps}");
            if tiled.pixels != whole.pixels {
                traces.push(format!("{quality:?} in {steps} pieces"));
            }
        }
    }
    assert!(traces.is_empty(), "{traces:?}");
}

#[test]
fn long_and_odd_frames_are_whole() {
    let mut engine = engine();
    for (width_px, height_px) in [(16_384, 1), (1, 16_384), (3000, 2001)] {
        let order = order(Scene::clear(), width_px, height_px, Output::Display);
        let (frame, _) = in_tiles(&mut engine, &order, 1 << 18);
        assert_eq!((frame.width_px, frame.height_px), (width_px, height_px));
        let Pixels::Display(values) = &frame.pixels else {
            panic!("not a picture")
        };
        assert_eq!(values.len(), 3 * width_px as usize * height_px as usize);
        // A tile that nobody wrote would be black; its darkest part is lit ground.
        assert!(
            values.chunks_exact(3).all(|p| p.iter().any(|v| *v > 20)),
            "{width_px} × {height_px}"
        );
    }
}

#[test]
fn the_largest_side_in_both_directions_would_be_cut_into_small_tiles() {
    let budget = TileBudget { pixels: 1 << 18 };
    let frame = UVec2::splat(16_384);
    let tile = budget.next(UVec2::ZERO, frame, 1);
    assert_eq!(tile, UVec2::new(16_384, 16));
    // Narrow tiles where one row is more than the budget.
    let budget = TileBudget { pixels: 1 << 13 };
    let tile = budget.next(UVec2::new(8192, 5), frame, 1);
    assert_eq!(tile, UVec2::new(8192, 1));
}

#[test]
fn the_budget_follows_the_device() {
    let mut budget = TileBudget { pixels: 1 << 16 };
    let full = budget.next(UVec2::ZERO, UVec2::splat(4096), 1);
    budget.learn(full, 1, 100.0);
    let halved = budget.next(UVec2::ZERO, UVec2::splat(4096), 1);
    assert_eq!(2 * halved.y, full.y);
    budget.learn(halved, 1, 1.0);
    assert_eq!(budget.next(UVec2::ZERO, UVec2::splat(4096), 1), full);
    // A cut tile that was quick says nothing.
    let cut = budget.next(UVec2::ZERO, UVec2::new(4096, 1), 1);
    budget.learn(cut, 1, 0.1);
    assert_eq!(budget.next(UVec2::ZERO, UVec2::splat(4096), 1), full);
    // However slow the device, a tile has pixels; however fast, it keeps to the memory that it may have.
    for _ in 0..40 {
        let tile = budget.next(UVec2::ZERO, UVec2::splat(4096), 1);
        budget.learn(tile, 1, 1e4);
    }
    let least = budget.next(UVec2::ZERO, UVec2::splat(4096), 1);
    assert!(least.x * least.y >= 4096, "{least}");
    for _ in 0..40 {
        let tile = budget.next(UVec2::ZERO, UVec2::splat(4096), 1);
        budget.learn(tile, 1, 0.1);
    }
    let most = budget.next(UVec2::ZERO, UVec2::splat(4096), 1);
    assert!(most.x * most.y <= 3 << 18, "{most}");
}

/// The sky pass writes the picture itself, or leaves that to the tone pass: nobody can tell which.
#[test]
fn both_ways_to_the_picture_are_one() {
    let mut engine = engine();
    let mut order = order(Scene::clear(), 256, 144, Output::Display);
    order.quality = Quality::Final;
    let (at_once, _) = in_tiles(&mut engine, &order, 1 << 18);
    let (by_radiance, _) = in_tiles(&mut engine, &order, 1 << 18);
    assert!(!passes(&at_once).contains(&"tone") && passes(&by_radiance).contains(&"tone"));
    assert!(at_once.pixels == by_radiance.pixels, "the bytes differ");
}

/// Each change runs the passes that see it and no other.
#[test]
fn a_change_runs_only_the_passes_that_see_it() {
    let mut engine = engine();
    let mut run = |scene: &Scene| {
        let mut order = order(scene.clone(), 64, 40, Output::Display);
        order.quality = Quality::Final;
        passes(&in_tiles(&mut engine, &order, 1 << 18).0)
    };
    // A sky that no other test renders.
    let mut scene = Scene::clear();
    scene.planet.radius_m = 6_361_234.0;
    let all = ["transmittance", "multi_scattering", "sky_view", "sky", "exposure"];
    assert_eq!(run(&scene), all);
    // Whoever comes twice may come again: now the radiance stays on the device, and the tone pass has to write the
    // picture again.
    assert_eq!(run(&scene), ["sky", "tone"], "nothing changed");
    assert_eq!(run(&scene), ["tone"], "nothing changed again");
    scene.camera.direction = Direction::angles(90.0, 12.0);
    assert_eq!(run(&scene), ["sky", "exposure"], "the camera turned");
    scene.sun.position = SunPosition::Direction(Direction::angles(170.0, 33.0));
    assert_eq!(run(&scene), ["sky_view", "sky", "exposure"], "the sun moved");
    scene.display.exposure = Exposure::Auto { compensation_ev: 1.0 };
    let exposed = run(&scene);
    assert!(
        !exposed.iter().any(|p| all[..3].contains(p)),
        "the exposure changed: {exposed:?}"
    );
    scene.display.exposure = Exposure::Ev { ev: 14.0 };
    assert!(
        run(&scene).iter().all(|p| ["sky", "tone"].contains(p)),
        "fixed exposure"
    );
    scene.display.exposure = Exposure::Ev { ev: 13.0 };
    assert_eq!(run(&scene), ["tone"], "the exposure changed");
    scene.display.white_balance_k = 5000.0;
    assert_eq!(run(&scene), ["tone"], "white balance");
    scene.camera.position_m[2] = 500.0;
    assert_eq!(run(&scene), ["sky_view", "sky"], "the camera rose");
    scene.sun.irradiance_w_m2 = [1.0; 3];
    assert_eq!(run(&scene), ["sky"], "a dimmer sun");
    scene.planet.ground_albedo = [0.5; 3];
    assert_eq!(
        run(&scene),
        ["transmittance", "multi_scattering", "sky_view", "sky"],
        "another ground"
    );
}

/// A preview's picture by lattices costs less than toning its radiance would: nothing is kept of it, so that the same
/// order always gives the same bytes.
#[test]
fn a_preview_runs_no_tone_pass() {
    let mut engine = engine();
    let mut scene = Scene::clear();
    scene.planet.radius_m = 6_361_235.0;
    let first = in_tiles(
        &mut engine,
        &order(scene.clone(), 64, 40, Output::Display),
        1 << 18,
    )
    .0;
    for output in [Output::Display, Output::Linear, Output::Display] {
        let (frame, _) = in_tiles(&mut engine, &order(scene.clone(), 64, 40, output), 1 << 18);
        assert!(
            !passes(&frame).contains(&"tone"),
            "{output:?}: {:?}",
            passes(&frame)
        );
        assert_eq!(frame.pixels == first.pixels, output == Output::Display);
    }
}
