//! Jobs: which frames a document stands for, and what is refused before any is rendered.

use proptest::prelude::*;
use serde_json::{Value, json};
use std::collections::HashSet;
use welkin_scene::{
    JobPlan, JobRequest,
    problem::{Problem, SceneError},
};

fn plan(document: &Value) -> JobPlan {
    JobPlan::new(JobRequest::from_value(document).unwrap()).unwrap()
}

fn refused(document: &Value) -> Vec<Problem> {
    match JobRequest::from_value(document) {
        Err(SceneError::Invalid(problems)) => problems,
        other => panic!("{other:?}"),
    }
}

/// The pointer of the first fault.
fn at(document: &Value) -> String {
    refused(document)[0].pointer.clone()
}

#[test]
fn the_shortest_job_is_one_frame() {
    let plan = plan(&json!({"frames": {"kind": "list", "scenes": [{}]}}));
    assert_eq!(plan.count(), 1);
    assert_eq!(*plan.frame(0).unwrap().scene, welkin_scene::Scene::default());
    assert!(plan.frame(1).is_err());
}

#[test]
fn a_job_is_the_same_after_it_was_written() {
    let request = JobRequest::from_value(
        &json!({"name": "x", "frames": {"kind": "random", "count": 3, "seed": 9,
        "ranges": [{"field": "/time_s", "from": 0, "to": 1e9}]}, "probe": [[0, 0, 1]]}),
    )
    .unwrap();
    let again = JobRequest::from_value(&json!(request)).unwrap();
    assert_eq!(request, again);
    let (one, other) = (JobPlan::new(request).unwrap(), JobPlan::new(again).unwrap());
    for n in 0..3 {
        assert_eq!(one.frame(n).unwrap(), other.frame(n).unwrap());
    }
}

#[test]
fn a_grid_has_every_combination_once_the_last_axis_first() {
    let plan = plan(&json!({"frames": {"kind": "grid", "axes": [
        {"field": "/sun/position/elevation_deg", "from": -10, "to": 80, "steps": 4},
        {"field": "/display/tone_curve", "values": ["agx", "aces"]},
        {"field": "/clouds", "values": [null]}]}}));
    assert_eq!(plan.count(), 8);
    let seen: Vec<_> = (0..8).map(|n| plan.frame(n).unwrap().parameters).collect();
    assert_eq!(
        seen.iter()
            .map(|p| json!(p).to_string())
            .collect::<HashSet<_>>()
            .len(),
        8
    );
    assert_eq!(seen[0]["/sun/position/elevation_deg"], json!(-10.0));
    assert_eq!(seen[7]["/sun/position/elevation_deg"], json!(80.0));
    assert_eq!(
        (&seen[0]["/display/tone_curve"], &seen[1]["/display/tone_curve"]),
        (&json!("agx"), &json!("aces"))
    );
    assert_eq!(plan.frame(3).unwrap().scene.clouds, None);
}

#[test]
fn a_time_lapse_reaches_both_ends() {
    let document = json!({"frames": {"kind": "timeline", "from_s": 10, "to_s": 40, "count": 4,
        "timeline": {"scene": {"clouds": null}}}});
    let plan = plan(&document);
    let times: Vec<_> = (0..4).map(|n| plan.frame(n).unwrap().scene.time_s).collect();
    // The shares 1/3 and 2/3 are not exact.
    for (time, expected) in times.iter().zip([10.0, 20.0, 30.0, 40.0]) {
        assert!((time - expected).abs() < 1e-12 * expected, "{times:?}");
    }
    assert_eq!((times[0], times[3]), (10.0, 40.0));
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    let random = |ranges: Value| json!({"frames": {"kind": "random", "count": 9, "ranges": ranges}});
    let lapse = |more: Value| {
        let mut frames = json!({"kind": "timeline", "timeline": {}, "to_s": 1, "count": 2});
        frames
            .as_object_mut()
            .unwrap()
            .extend(more.as_object().unwrap().clone());
        json!({ "frames": frames })
    };
    for (document, place) in [
        (json!({}), "/frames"),
        (json!({"frames": {"kind": "lst", "scenes": [{}]}}), "/frames/kind"),
        (
            json!({"frames": {"kind": "list", "scenes": []}}),
            "/frames/scenes",
        ),
        (
            json!({"frames": {"kind": "list", "scenes": [{}, {"sun": {"disk": 1}}]}}),
            "/frames/scenes/1/sun/disk",
        ),
        (
            json!({"frames": {"kind": "list", "scenes": [{}]}, "width_px": 16_385}),
            "/width_px",
        ),
        (
            json!({"frames": {"kind": "list", "scenes": [{}]}, "format": "tiff"}),
            "/format",
        ),
        (
            json!({"frames": {"kind": "list", "scenes": [{}]}, "attempts": 0}),
            "/attempts",
        ),
        (
            json!({"frames": {"kind": "list", "scenes": [{}]}, "probe": [[0, 0, 0]]}),
            "/probe/0",
        ),
        (
            json!({"frames": {"kind": "list", "scenes": [{"camera": {"projection": {"kind": "cubemap"}}}]}}),
            "/width_px",
        ),
        (
            json!({"frames": {"kind": "grid", "axes": [{"field": "/sun/heigt", "values": [1]}]}}),
            "/frames/axes/0/field",
        ),
        (
            json!({"frames": {"kind": "grid", "axes": [
                {"field": "/sun", "values": [{}]}, {"field": "/sun/disc", "values": [true]}]}}),
            "/frames/axes/1/field",
        ),
        (
            json!({"frames": {"kind": "grid", "axes": [{"field": "/clouds/coverage", "values": [0.5, 2]}]}}),
            "/frames/axes",
        ),
        (
            random(json!([{"field": "/clouds/coverage", "from": 0, "to": 1.5}])),
            "/frames/ranges",
        ),
        (
            random(json!([{"field": "/clouds/coverage", "from": 1, "to": 0}])),
            "/frames/ranges/0/to",
        ),
        (
            random(json!([{"field": "/clouds/seed", "from": 1.2, "to": 1.8, "whole": true}])),
            "/frames/ranges/0/to",
        ),
        (lapse(json!({"from_s": 2})), "/frames/to_s"),
        (lapse(json!({"films": ["gif", "gif"]})), "/frames/films/1"),
        (
            lapse(json!({"timeline": {"scene": {"time": 1}}})),
            "/frames/timeline/scene/time",
        ),
        (
            json!({"frames": {"kind": "panorama"}, "width_px": 64, "height_px": 32, "format": "png"}),
            "/format",
        ),
        (
            json!({"frames": {"kind": "panorama", "tile_px": 100}}),
            "/frames/tile_px",
        ),
        (
            json!({"frames": {"kind": "panorama", "tile_px": 16}, "width_px": 32_768, "height_px": 16_384}),
            "/frames",
        ),
    ] {
        assert_eq!(at(&document), place, "{document}");
    }
    let mut linear = lapse(json!({"films": ["gif"]}));
    linear["format"] = json!("exr");
    assert_eq!(at(&linear), "/frames/films/0");
    let told = &refused(
        &json!({"frames": {"kind": "grid", "axes": [{"field": "/clouds/coverage", "values": [0.5, 2]}]}}),
    )[0];
    assert!(
        told.message.contains("frame 1 of 2") && told.message.contains("coverage"),
        "{}",
        told.message
    );
    let too_many = json!({"frames": {"kind": "grid", "axes": [
        {"field": "/clouds/coverage", "from": 0, "to": 1, "steps": 10_000},
        {"field": "/clouds/density", "from": 0, "to": 1, "steps": 10_000}]}});
    assert_eq!(at(&too_many), "/frames");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_random_frame_does_not_depend_on_how_many_there_are(seed: u32, count in 1_u32..40, more in 0_u32..40) {
        let job = |count: u32| json!({"frames": {"kind": "random", "seed": seed, "count": count, "ranges": [
            {"field": "/sun/position/elevation_deg", "from": -90, "to": 90},
            {"field": "/clouds/seed", "from": 5, "to": 7, "whole": true},
            {"field": "/clouds/coverage", "from": 0.25, "to": 0.25}]}});
        let (few, many) = (plan(&job(count)), plan(&job(count + more)));
        for n in 0..count {
            let frame = few.frame(n).unwrap();
            prop_assert_eq!(&frame, &many.frame(n).unwrap());
            let clouds = frame.scene.clouds.clone().unwrap();
            prop_assert!((5..=7).contains(&clouds.seed));
            prop_assert_eq!(clouds.coverage, 0.25);
        }
    }

    #[test]
    fn tiles_cover_every_pixel_once(width in 1_u32..200, height in 1_u32..100, sixteenths in 1_u32..6) {
        let plan = plan(&json!({"frames": {"kind": "panorama", "tile_px": 16 * sixteenths},
            "width_px": width, "height_px": height}));
        let mut seen = vec![0; (width * height) as usize];
        for n in 0..plan.count() {
            let window = plan.frame(n).unwrap().window.unwrap();
            prop_assert!(window.width_px > 0 && window.height_px > 0);
            for y in window.y_px..window.y_px + window.height_px {
                for x in window.x_px..window.x_px + window.width_px {
                    seen[(y * width + x) as usize] += 1;
                }
            }
        }
        prop_assert!(seen.iter().all(|count| *count == 1));
    }
}
