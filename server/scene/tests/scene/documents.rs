//! Reading what was written gives the same scene.

use serde_json::{Value, json};
use welkin_scene::{
    Direction, Exposure, FrameRequest, Orders, ProbeRequest, Scene, SunPosition, ToneCurve, preset, presets,
};

#[test]
fn nothing_is_a_scene() {
    assert_eq!(Scene::from_json("{}").unwrap(), Scene::default());
    assert_eq!(FrameRequest::from_json("{}").unwrap(), FrameRequest::default());
    assert_eq!(ProbeRequest::from_json("{}").unwrap(), ProbeRequest::default());
}

#[test]
fn null_stays_null() {
    let vacuum = Scene::from_value(&json!({"atmosphere": null})).unwrap();
    assert_eq!(vacuum.atmosphere, None);
    assert_eq!(serde_json::to_value(&vacuum).unwrap()["atmosphere"], Value::Null);
    for part in ["rayleigh", "mie", "ozone"] {
        let scene = Scene::from_value(&json!({"atmosphere": { part: null }})).unwrap();
        let written = serde_json::to_value(&scene).unwrap();
        assert_eq!(
            written.pointer(&format!("/atmosphere/{part}")),
            Some(&Value::Null)
        );
        assert_eq!(Scene::from_value(&written).unwrap(), scene);
    }
}

#[test]
fn shapes_of_a_direction() {
    let read = |position| {
        Scene::from_value(&json!({"sun": {"position": position}}))
            .unwrap()
            .sun
            .position
    };
    assert_eq!(
        read(json!([0, 3, 4])),
        SunPosition::Direction(Direction::Vector([0.0, 3.0, 4.0]))
    );
    assert_eq!(
        read(json!({"azimuth_deg": 90, "elevation_deg": 10})),
        SunPosition::Direction(Direction::angles(90.0, 10.0))
    );
    let time = json!({"time": "2026-06-21T05:00:00Z", "latitude_deg": 60, "longitude_deg": 30});
    assert!(matches!(read(time), SunPosition::TimeAndPlace(place) if !place.refraction));
}

#[test]
fn presets_are_valid_scenes() {
    let names: Vec<_> = presets().iter().map(|preset| preset.name).collect();
    assert_eq!(
        names,
        [
            "clear-noon",
            "golden-hour",
            "twilight",
            "moonlit-night",
            "starry-night",
            "from-orbit",
            "complutense"
        ]
    );
    for preset in presets() {
        let text = serde_json::to_string(&preset.scene).unwrap();
        assert_eq!(Scene::from_json(&text).unwrap(), preset.scene, "{}", preset.name);
    }
    assert_eq!(preset("no-such"), None);
}

#[test]
fn presets_show_what_they_say() {
    let elevation = |name| preset(name).unwrap().scene.sun_place().elevation_deg;
    assert!(elevation("clear-noon") > 50.0);
    // Elevations go through the unit vector and back: a few roundings at 90°.
    assert!((elevation("golden-hour") - 6.0).abs() < 1e-12);
    assert!((elevation("twilight") + 4.0).abs() < 1e-12);
    let orbit = &preset("from-orbit").unwrap().scene;
    assert!((orbit.observer().altitude_m - 4e5).abs() < 1e-6);
    let thesis = &preset("complutense").unwrap().scene;
    let air = thesis.atmosphere.as_ref().unwrap();
    assert_eq!((air.orders, &air.ozone), (Orders::Single, &None));
    assert_eq!(thesis.display.exposure, Exposure::Pupil { gain: 1.0 });
    assert_eq!(thesis.display.tone_curve, ToneCurve::Exponential);
}
