//! Timelines: exact at keyframes and smooth in between.

use crate::faults::problems;
use serde_json::{Value, json};
use welkin_scene::{FrameRequest, Scene, Timeline, clouds::WeatherMap, frame::Source};

pub(crate) fn timeline(scene: &Value, keyframes: &[(f64, Value)]) -> Timeline {
    let keyframes: Vec<_> = keyframes
        .iter()
        .map(|(at_s, patch)| json!({"at_s": at_s, "patch": patch}))
        .collect();
    Timeline::from_value(&json!({"scene": scene, "keyframes": keyframes})).unwrap()
}

pub(crate) fn written(timeline: &Timeline, at_s: f64) -> Value {
    let scene = timeline
        .at(at_s)
        .unwrap_or_else(|e| panic!("at {at_s}: {e}\n{timeline:?}"));
    serde_json::to_value(scene).unwrap()
}

pub(crate) fn number(timeline: &Timeline, at_s: f64, pointer: &str) -> f64 {
    let scene = written(timeline, at_s);
    let found = scene.pointer(pointer).and_then(Value::as_f64);
    found.unwrap_or_else(|| panic!("{pointer} at {at_s}: {scene}"))
}

#[test]
fn without_keyframes_only_time_passes() {
    let nothing = Timeline::from_json("{}").unwrap();
    let scene = Scene {
        time_s: 12.0,
        ..Scene::default()
    };
    assert_eq!(nothing.at(12.0).unwrap(), scene);
    let later = timeline(&json!({"time_s": 100, "planet": {"radius_m": 1e6}}), &[]);
    assert_eq!(number(&later, -40.0, "/time_s"), 60.0);
    assert_eq!(number(&later, -40.0, "/planet/radius_m"), 1e6);
}

#[test]
fn patches_change_the_scene_and_not_one_another() {
    let base = json!({"camera": {"roll_deg": 5}, "planet": {"radius_m": 1e6}});
    let track = timeline(
        &base,
        &[
            (10.0, json!({"planet": {"radius_m": 2e6}})),
            (20.0, json!({"camera": {"roll_deg": 15}})),
        ],
    );
    assert_eq!(number(&track, 10.0, "/camera/roll_deg"), 5.0);
    assert_eq!(number(&track, 20.0, "/planet/radius_m"), 1e6);
    // Beyond both ends nothing moves but time.
    for (at_s, end_s) in [(-5.0, 10.0), (99.0, 20.0)] {
        let mut end = written(&track, end_s);
        end["time_s"] = at_s.into();
        assert_eq!(written(&track, at_s), end);
    }
}

#[test]
fn null_switches_off_or_removes_and_another_kind_replaces() {
    let base = json!({
        "planet": {"radius_m": 1e6},
        "sun": {"position": {"azimuth_deg": 10, "elevation_deg": 20}},
        "clouds": {"weather_map": {"kind": "procedural", "seed": 4}, "coverage": 0.7},
    });
    let patch = json!({
        "atmosphere": null,
        "planet": {"radius_m": null},
        "sun": {"position": {"azimuth_deg": null, "elevation_deg": null,
            "time": "2026-06-21T05:00:00Z", "latitude_deg": 60, "longitude_deg": 30}},
        "clouds": {"weather_map": {"kind": "asset", "name": "front"}},
    });
    let scene = timeline(&base, &[(0.0, patch)]).at(0.0).unwrap();
    assert_eq!(scene.atmosphere, None);
    assert_eq!(scene.planet, Scene::default().planet);
    let clouds = scene.clouds.unwrap();
    assert_eq!(clouds.coverage, 0.7);
    assert!(matches!(clouds.weather_map, WeatherMap::Asset(map) if map.name == "front"));
}

/// Three keyframes in a row: the one in the middle is passed without a stop or a corner.
#[test]
fn numbers_go_through_keyframes_smoothly() {
    let roll = |at: &[(f64, f64)]| {
        let keys: Vec<_> = at
            .iter()
            .map(|(at_s, roll)| (*at_s, json!({"camera": {"roll_deg": roll}})))
            .collect();
        timeline(&json!({}), &keys)
    };
    let value = |track: &Timeline, at_s| number(track, at_s, "/camera/roll_deg");
    let speed = |track: &Timeline, at_s: f64| (value(track, at_s + 1e-4) - value(track, at_s - 1e-4)) / 2e-4;
    let even = roll(&[(0.0, 0.0), (10.0, 10.0), (20.0, 20.0)]);
    assert_eq!(
        (value(&even, 0.0), value(&even, 10.0), value(&even, 20.0)),
        (0.0, 10.0, 20.0)
    );
    // A second difference over 1e-4 s of a cubic with coefficients below 0.1.
    assert!((speed(&even, 10.0) - 1.0).abs() < 1e-4, "{}", speed(&even, 10.0));
    assert!(speed(&even, 0.0).abs() < 1e-4 && speed(&even, 20.0).abs() < 1e-4);
    let uneven = roll(&[(0.0, 0.0), (5.0, 40.0), (20.0, 50.0), (21.0, 20.0)]);
    for at_s in [5.0, 20.0] {
        let [left, right] = [-1e-4, 1e-4].map(|d| (value(&uneven, at_s + d) - value(&uneven, at_s)) / d);
        assert!((left - right).abs() < 0.01, "{at_s}: {left} {right}");
    }
    let mut before = 0.0;
    for step in 0..=200 {
        let now = value(&uneven, f64::from(step) / 10.0);
        assert!((before..=50.0).contains(&now), "no overshoot, no way back");
        before = now;
    }
}

#[test]
fn whole_numbers_stay_whole_and_words_change_half_way() {
    let track = timeline(
        &json!({"clouds": {}}),
        &[
            (
                0.0,
                json!({"clouds": {"steps": 100}, "display": {"tone_curve": "aces", "dither": true}}),
            ),
            (
                10.0,
                json!({"clouds": {"steps": 201}, "display": {"tone_curve": "agx", "dither": false}}),
            ),
        ],
    );
    assert_eq!(number(&track, 5.0, "/clouds/steps"), 151.0);
    for (at_s, curve, dither) in [(4.99, "aces", true), (5.01, "agx", false)] {
        let scene = written(&track, at_s);
        assert_eq!(
            (&scene["display"]["tone_curve"], &scene["display"]["dither"]),
            (&json!(curve), &json!(dither))
        );
    }
}

#[test]
fn directions_go_along_the_sphere() {
    let at = |azimuth: f64, elevation: f64| json!({"sun": {"position": {"azimuth_deg": azimuth, "elevation_deg": elevation}}});
    let sun = |track: &Timeline, at_s: f64| track.at(at_s).unwrap().sun_place();
    // Through north, not round by the south.
    let track = timeline(&json!({}), &[(0.0, at(350.0, 0.0)), (10.0, at(30.0, 0.0))]);
    let middle = sun(&track, 5.0);
    assert!(
        (middle.azimuth_deg - 10.0).abs() < 1e-9 && middle.elevation_deg.abs() < 1e-9,
        "{middle:?}"
    );
    // The opposite, and over the zenith.
    let track = timeline(&json!({}), &[(0.0, at(90.0, 0.0)), (10.0, at(270.0, 0.0))]);
    assert!((sun(&track, 5.0).elevation_deg - 90.0).abs() < 1e-6);
    // A keyframe on the way is passed at even speed.
    let keys = [
        (0.0, at(90.0, 0.0)),
        (10.0, at(120.0, 0.0)),
        (20.0, at(150.0, 0.0)),
    ];
    let track = timeline(&json!({}), &keys);
    let speed = (sun(&track, 10.001).azimuth_deg - sun(&track, 9.999).azimuth_deg) / 0.002;
    assert!((speed - 3.0).abs() < 1e-3, "{speed}");
    assert!((sun(&track, 10.0).azimuth_deg - 120.0).abs() < 1e-12);
}

#[test]
fn times_pass_into_one_another_as_times() {
    let at =
        |time: &str| json!({"sun": {"position": {"time": time, "latitude_deg": 50, "longitude_deg": 10}}});
    let base = at("2026-06-21T00:00:00Z");
    let track = timeline(
        &base,
        &[
            (0.0, at("2026-06-21T04:00:00+01:00")),
            (60.0, at("2026-06-21T21:00:00Z")),
        ],
    );
    let middle = written(&track, 30.0);
    assert_eq!(middle["sun"]["position"]["time"], "2026-06-21T12:00:00Z");
    // Then the scene's own half minute is added.
    assert_eq!(middle["time_s"], 30.0);
    // To a sun that stands still, it goes from where it is by then.
    let still = json!({"sun": {"position": [0, 0, 1]}});
    let track = timeline(&base, &[(0.0, json!({})), (60.0, still)]);
    let heights: Vec<f64> = (0..=60)
        .map(|s| track.at(f64::from(s)).unwrap().sun_place().elevation_deg)
        .collect();
    assert!(heights[0] < 0.0 && (heights[60] - 90.0).abs() < 1e-6);
    assert!(
        heights
            .windows(2)
            .all(|pair| pair[0] < pair[1] && pair[1] - pair[0] < 5.0),
        "{heights:?}"
    );
}

#[test]
fn time_may_be_told_by_the_keyframes() {
    let track = timeline(
        &json!({}),
        &[(0.0, json!({"time_s": 100})), (10.0, json!({"time_s": 500}))],
    );
    assert_eq!(
        [0.0, 5.0, 10.0, 20.0].map(|at_s| number(&track, at_s, "/time_s")),
        [100.0, 300.0, 500.0, 500.0]
    );
}

/// A straight way from one end of the world to the other would lead through it.
#[test]
fn the_camera_stays_above_the_ground() {
    let at = |x: f64, z: f64| json!({"camera": {"position_m": [x, 0, z]}});
    let track = timeline(
        &json!({}),
        &[
            (0.0, at(6.36e6, -6.36e6)),
            (10.0, at(0.0, 2.0)),
            (20.0, at(-6.36e6, -6.36e6 + 9.0)),
        ],
    );
    for step in 0..=200 {
        let altitude_m = track.at(f64::from(step) / 10.0).unwrap().observer().altitude_m;
        assert!((0.0..3e6).contains(&altitude_m), "{step}: {altitude_m}");
    }
}

#[test]
fn faults_name_their_keyframe() {
    let check = |document: Value, pointer: &str, part: &str| {
        let all = problems(Timeline::from_value(&document));
        assert_eq!(all[0].pointer, pointer, "{all:?}");
        assert!(all[0].message.contains(part), "{all:?}");
    };
    let key = |at_s: f64, patch: Value| json!({"at_s": at_s, "patch": patch});
    check(
        json!({"keyframes": [key(1.0, json!({})), key(1.0, json!({}))]}),
        "/keyframes/1/at_s",
        "later than the keyframe before, 1",
    );
    check(
        json!({"keyframes": [{"patch": {}}]}),
        "/keyframes/0/at_s",
        "lacks the field `at_s`",
    );
    check(
        json!({"keyframes": [key(0.0, json!([]))]}),
        "/keyframes/0/patch",
        "must be an object",
    );
    check(
        json!({"scene": {"planet": {"radius": 1}}}),
        "/scene/planet/radius",
        "did you mean `radius_m`",
    );
    check(
        json!({"scene": {"camera": {"direction": [0, 0, 0]}}}),
        "/scene/camera/direction",
        "any length but zero",
    );
    check(
        json!({"keyframes": [key(0.0, json!({"planet": {"radius_m": 1}}))]}),
        "/keyframes/0/patch/planet/radius_m",
        "`radius_m` must be",
    );
    check(
        json!({"keyframes": [key(0.0, json!({"planet": {"radius_m": 1}, "sun": {"size": 3}})), key(1.0, json!({"haze": {"top": 1}}))]}),
        "/keyframes/0/patch/planet/radius_m",
        "but is 1",
    );
    // What is wrong together is not in the patch alone.
    check(
        json!({"scene": {"clouds": {"shape": {"low_freq_min": 0.6}}}, "keyframes": [key(0.0, json!({"clouds": {"shape": {"low_freq_max": 0.5}}}))]}),
        "/keyframes/0/patch",
        "below `low_freq_max`",
    );
    let many: Vec<_> = (0..257).map(|i| key(f64::from(i), json!({}))).collect();
    check(json!({"keyframes": many}), "/keyframes", "at most 256");
}

#[test]
fn a_time_beyond_the_suns_years_is_refused() {
    let sun =
        json!({"sun": {"position": {"time": "2099-01-01T00:00:00Z", "latitude_deg": 0, "longitude_deg": 0}}});
    let track = timeline(&sun, &[]);
    assert_eq!(problems(track.at(9e8))[0].pointer, "/time_s");
    assert!(track.at(0.0).is_ok());
}

#[test]
fn a_frame_is_of_a_scene_or_of_a_timeline() {
    let radius = |radius: f64| json!({"planet": {"radius_m": radius}});
    let keys = json!([{"at_s": 0, "patch": radius(1e6)}, {"at_s": 10, "patch": radius(2e6)}]);
    let track = json!({ "keyframes": keys });
    let frame = FrameRequest::from_value(&json!({"timeline": track, "at_s": 5, "width_px": 64})).unwrap();
    let expected = Timeline::from_value(&track).unwrap().at(5.0).unwrap();
    assert_eq!((frame.scene, frame.width_px), (expected, 64));
    let begin = FrameRequest::from_value(&json!({"timeline": track})).unwrap();
    assert_eq!(begin.scene.planet.radius_m, 1e6);
    let same =
        FrameRequest::from_value(&json!({"scene": radius(1e6), "timeline": null, "at_s": null})).unwrap();
    assert_eq!(same.scene, begin.scene);
    // What is written is of a scene.
    let written = serde_json::to_value(&begin).unwrap();
    assert_eq!(FrameRequest::from_value(&written).unwrap(), same);
    assert_eq!((begin.source, same.source), (Source::Timeline, Source::Scene));

    let late = json!({"scene": {"sun": {"position": {"time": "2099-01-01T00:00:00Z", "latitude_deg": 0, "longitude_deg": 0}}}});
    let cube = json!({"scene": {"camera": {"projection": {"kind": "cubemap"}}}});
    for (request, pointer, part) in [
        (
            json!({"scene": {}, "timeline": {}}),
            "/scene",
            "left out where `timeline` is given",
        ),
        (
            json!({"at_s": 3}),
            "/at_s",
            "left out where there is no `timeline`, but is 3",
        ),
        (
            json!({"timeline": {"keyframes": [{"at_s": 0, "patch": radius(1.0)}]}}),
            "/timeline/keyframes/0/patch/planet/radius_m",
            "but is 1",
        ),
        (
            json!({"timeline": {"scene": radius(1.0)}}),
            "/timeline/scene/planet/radius_m",
            "but is 1",
        ),
        (json!({"timeline": late, "at_s": 9e8}), "/at_s", "2100"),
        (json!({"timeline": cube}), "/width_px", "6 times"),
        (
            json!({"timeline": {}, "at_s": "noon"}),
            "/at_s",
            "must be a number",
        ),
    ] {
        let all = problems(FrameRequest::from_value(&request));
        assert_eq!(all[0].pointer, pointer, "{all:?}");
        assert!(all[0].message.contains(part), "{all:?}");
    }
}
