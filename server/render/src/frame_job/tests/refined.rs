//! Frames in the passes of a refinement: bit for bit those that are made at once.

use super::*;
use serde_json::json;
use std::sync::Mutex;
use welkin_scene::refinement::{PASSES, pass_of};

/// The frame, and what was seen of it on the way.
pub(super) fn refined(engine: &mut Engine, order: &FrameOrder, pixels: u32) -> (Arc<Frame>, Vec<Refined>) {
    let all = Arc::new(Mutex::new(Vec::new()));
    let seen = Arc::clone(&all);
    let seen: OnPass = Box::new(move |refined| seen.lock().unwrap().push(refined));
    let mut job = FrameJob::new(order.clone(), Some(seen));
    loop {
        if let Some(frame) = job.step(engine, &mut TileBudget { pixels }).unwrap() {
            return (frame, std::mem::take(&mut all.lock().unwrap()));
        }
    }
}

fn values(frame: &Frame) -> &[u8] {
    match &frame.pixels {
        Pixels::Display(values) => values,
        Pixels::Linear(_) => panic!("not a picture"),
    }
}

/// Runs of pixels that share light, rays through clouds, stars that are added to radiance, moonlight, and a projection
/// with places that see nothing.
#[test]
fn passes_leave_no_trace() {
    let mut engine = engine();
    let view = json!({"direction": {"azimuth_deg": 180, "elevation_deg": 20}, "projection": {"kind": "perspective", "vertical_fov_deg": 80}});
    let night = json!({"time": "2026-01-03T00:00:00Z", "latitude_deg": 50, "longitude_deg": 10});
    let scenes = [
        ("clear", json!({"camera": view, "clouds": null})),
        ("clouds", json!({"camera": view, "clouds": {}})),
        (
            "night",
            json!({"camera": view, "clouds": null, "sun": {"position": night}}),
        ),
        (
            "clouds at night",
            json!({"camera": view, "clouds": {}, "sun": {"position": night}}),
        ),
        (
            "fisheye",
            json!({"clouds": null, "camera": {"projection": {"kind": "fisheye", "fov_deg": 180}}}),
        ),
    ];
    for (name, scene) in scenes {
        let scene = Scene::from_value(&scene).unwrap();
        let mut order = order(scene, 75, 45, Output::Display);
        order.quality = Quality::Final;
        let (whole, _) = in_tiles(&mut engine, &order, 1 << 22);
        // More than five tiles of this budget, and several tiles to a pass.
        let (frame, seen) = refined(&mut engine, &order, 1 << 6);
        assert!(frame.pixels == whole.pixels, "{name}");
        assert_eq!(frame.facts, whole.facts, "{name}");
        let passes: Vec<u16> = seen.iter().map(|refined| refined.pass).collect();
        assert_eq!(passes, (1..PASSES).collect::<Vec<_>>(), "{name}");
        for Refined { pass, frame } in seen {
            let of_final = values(&whole).chunks_exact(3).zip(values(&frame).chunks_exact(3));
            for (i, (last, now)) in (0..).zip(of_final) {
                let is_done = pass_of(i % 75, i / 75) <= pass;
                assert_eq!(
                    now,
                    if is_done { last } else { &[0; 3] },
                    "{name}: pixel {i} after pass {pass}"
                );
            }
        }
    }
}

#[test]
fn what_is_quickly_done_is_done_at_once() {
    let mut engine = engine();
    let mut order = order(Scene::clear(), 75, 45, Output::Display);
    for (quality, pixels, in_passes) in [
        (Quality::Final, 75 * 45 / 5, false),
        (Quality::Final, 75 * 45 / 5 - 1, true),
        // A preview has no passes, however long it takes.
        (Quality::Preview, 1 << 6, false),
    ] {
        order.quality = quality;
        let (_, seen) = refined(&mut engine, &order, pixels);
        assert_eq!(!seen.is_empty(), in_passes, "{quality:?} in tiles of {pixels}");
    }
}
