//! Every kind of fault, each with the pointer to its field and the sentence that a person reads.

use serde_json::{Value, json};
use welkin_scene::{FrameRequest, ProbeRequest, Problem, Scene, SceneError};

pub(crate) fn problems<T: std::fmt::Debug>(read: Result<T, SceneError>) -> Vec<Problem> {
    match read {
        Err(SceneError::Invalid(problems)) => problems,
        other => panic!("{other:?}"),
    }
}

/// The only problem of a scene.
fn problem(scene: &Value) -> Problem {
    let mut all = problems(Scene::from_value(scene));
    assert_eq!(all.len(), 1, "{all:?}");
    all.remove(0)
}

fn check(scene: Value, pointer: &str, message: &str) {
    let problem = problem(&scene);
    assert_eq!(
        (problem.pointer.as_str(), problem.message.as_str()),
        (pointer, message),
        "{scene}"
    );
}

#[test]
fn unknown_field() {
    check(
        json!({"sun": {"position": {"azimuth_deg": 1, "elevaton_deg": 2}}}),
        "/sun/position/elevaton_deg",
        "unknown field `elevaton_deg`; did you mean `elevation_deg`? `position` has the fields `azimuth_deg`, `elevation_deg`",
    );
    check(
        json!({"camera": {"projection": {"kind": "perspective", "fov_deg": 60}}}),
        "/camera/projection/fov_deg",
        "unknown field `fov_deg`; did you mean `vertical_fov_deg`? `projection` has the fields `kind`, `vertical_fov_deg`",
    );
    check(
        json!({"rainbow": {"order": 2}}),
        "/rainbow",
        "unknown field `rainbow`; the document has the fields `atmosphere`, `camera`, `clouds`, `display`, `haze`, `moon`, `planet`, `shafts`, `stars`, `sun`, `terrain`, `time_s`",
    );
    let odd = problem(&json!({"planet": {"a/b~c": 1}}));
    assert_eq!((odd.pointer.as_str(), odd.value), ("/planet/a~1b~0c", json!(1)));
}

#[test]
fn wrong_type() {
    let roll = |message| {
        (
            json!({"camera": {"roll_deg": "north"}}),
            "/camera/roll_deg",
            message,
        )
    };
    let (scene, pointer, message) =
        roll("`roll_deg` must be a number from -360 to 360 degrees, but is the text \"north\"");
    check(scene, pointer, message);
    check(
        json!({"display": {"dither": 1}}),
        "/display/dither",
        "`dither` must be true or false, but is 1",
    );
    check(
        json!({"camera": {"projection": "fisheye"}}),
        "/camera/projection",
        "`projection` must be an object whose `kind` is one of `perspective`, `fisheye`, `equirectangular`, `cubemap`, but is the text \"fisheye\"",
    );
    check(
        json!({"atmosphere": {"ozone": 0}}),
        "/atmosphere/ozone",
        "`ozone` must be an object with the fields `absorption_per_m`, `centre_m`, `half_width_m`, or null, but is 0",
    );
    check(
        json!({"camera": {"direction": true}}),
        "/camera/direction",
        "`direction` must be an object with the fields `azimuth_deg`, `elevation_deg`, or an array of 3, each a number from -1e12 to 1e12, but is true",
    );
    check(
        json!([]),
        "",
        "the document must be an object with the fields `atmosphere`, `camera`, `clouds`, `display`, `haze`, `moon`, `planet`, `shafts`, `stars`, `sun`, `terrain`, `time_s`, but is []",
    );
    assert_eq!(problem(&json!({"camera": null})).pointer, "/camera");
}

#[test]
fn out_of_range() {
    check(
        json!({"atmosphere": {"top_m": 10}}),
        "/atmosphere/top_m",
        "`top_m` must be a number from 1000 to 1e6 metres, but is 10",
    );
    check(
        json!({"planet": {"ground_albedo": [0.1, 1.5, 0.1]}}),
        "/planet/ground_albedo/1",
        "`ground_albedo[1]` must be a number from 0 to 1, but is 1.5",
    );
    check(
        json!({"sun": {"position": {"azimuth_deg": 0, "elevation_deg": 91}}}),
        "/sun/position/elevation_deg",
        "`elevation_deg` must be a number from -90 to 90 degrees, but is 91",
    );
    check(
        json!({"camera": {"position_m": [0, 2]}}),
        "/camera/position_m",
        "`position_m` must be an array of 3, each a number from -1e8 to 1e8 metres, but is [0,2]",
    );
    let frame = problems(FrameRequest::from_value(&json!({"height_px": 16385})));
    assert_eq!(frame[0].pointer, "/height_px");
    assert_eq!(
        frame[0].message,
        "`height_px` must be a whole number from 1 to 16384 pixels, but is 16385"
    );
    for width in [json!(0), json!(0.5), json!(-1), json!(1e300)] {
        assert_eq!(
            problems(FrameRequest::from_value(&json!({"width_px": width})))[0].pointer,
            "/width_px"
        );
    }
}

#[test]
fn wrong_word() {
    check(
        json!({"display": {"tone_curve": "filmic"}}),
        "/display/tone_curve",
        "`tone_curve` must be one of `reinhard`, `exponential`, `aces`, `agx`, but is the text \"filmic\"",
    );
    check(
        json!({"camera": {"projection": {"kind": "perspectiv"}}}),
        "/camera/projection/kind",
        "`kind` must be one of `perspective`, `fisheye`, `equirectangular`, `cubemap`, but is the text \"perspectiv\"; did you mean `perspective`?",
    );
    let frame = problems(FrameRequest::from_value(&json!({"format": "jpg"})));
    assert_eq!(frame[0].pointer, "/format");
    assert!(
        frame[0].message.ends_with("did you mean `jpeg`?"),
        "{}",
        frame[0].message
    );
}

#[test]
fn missing_field() {
    check(
        json!({"sun": {"position": {"time": "2026-06-21T05:00:00Z", "longitude_deg": 30}}}),
        "/sun/position/latitude_deg",
        "`position` lacks the field `latitude_deg`, which must be a number from -90 to 90 degrees",
    );
    check(
        json!({"display": {"exposure": {}}}),
        "/display/exposure/kind",
        "`exposure` lacks the field `kind`, which must be one of `ev`, `auto`, `pupil`",
    );
    check(
        json!({"display": {"exposure": {"kind": "ev"}}}),
        "/display/exposure/ev",
        "`exposure` lacks the field `ev`, which must be a number from -30 to 30 EV",
    );
    // Neither of the two shapes is meant more than the other.
    assert_eq!(
        problem(&json!({"sun": {"position": {}}})).pointer,
        "/sun/position"
    );
}

#[test]
fn zero_direction() {
    let zero = "must be a vector of any length but zero, but is [0,0,0]";
    check(
        json!({"camera": {"direction": [0, 0, 0]}}),
        "/camera/direction",
        &format!("`direction` {zero}"),
    );
    check(
        json!({"sun": {"position": [0, 0, -0.0]}}),
        "/sun/position",
        "`position` must be a vector of any length but zero, but is [0,0,-0]",
    );
    let probe = json!({"directions": [[0, 0, 1], [0, 0, 0], {"azimuth_deg": 0, "elevation_deg": 100}]});
    let range = problems(ProbeRequest::from_value(&probe));
    assert_eq!(range[0].pointer, "/directions/2/elevation_deg");
    let probe = json!({"directions": [[0, 0, 1], [0, 0, 0]]});
    assert_eq!(
        problems(ProbeRequest::from_value(&probe))[0].pointer,
        "/directions/1"
    );
    // The shortest and the longest vectors are directions.
    for v in [json!([0, 0, 5e-324]), json!([1e12, -1e12, 1e12])] {
        let scene = Scene::from_value(&json!({"sun": {"position": v}})).unwrap();
        let length = scene.sun_direction().iter().map(|c| c * c).sum::<f64>().sqrt();
        // Three roundings of a 53-bit fraction.
        assert!((length - 1.0).abs() < 1e-15, "{length}");
    }
}

#[test]
fn camera_beyond_its_place() {
    check(
        json!({"camera": {"position_m": [0, 0, -3]}}),
        "/camera/position_m",
        "`position_m` must be on the ground or above it, up to 1e8 metres, but is [0,0,-3], which is 3 m below the ground",
    );
    assert_eq!(
        problem(&json!({"camera": {"position_m": [0, 0, -1e-6]}})).pointer,
        "/camera/position_m"
    );
    // 100 km away the sphere lies 786 m lower.
    assert_eq!(
        problem(&json!({"camera": {"position_m": [1e5, 0, -800]}})).pointer,
        "/camera/position_m"
    );
    Scene::from_value(&json!({"camera": {"position_m": [1e5, 0, -780]}})).unwrap();
    Scene::from_value(&json!({"camera": {"position_m": [0, 0, 0]}})).unwrap();
    Scene::from_value(&json!({"camera": {"position_m": [3, -4, 0]}})).unwrap();
    Scene::from_value(&json!({"camera": {"position_m": [0, 0, 1e8]}})).unwrap();
    let far = problem(&json!({"camera": {"position_m": [1e8, 0, 1e8]}}));
    assert!(far.message.ends_with("m above the ground"), "{}", far.message);
}

#[test]
fn picture_that_cannot_be() {
    check(
        json!({"camera": {"projection": {"kind": "fisheye", "fov_deg": 301, "mapping": "stereographic"}}}),
        "/camera/projection/fov_deg",
        "`fov_deg` must be a number from 1 to 300 degrees where `mapping` is `stereographic`, but is 301",
    );
    Scene::from_value(&json!({"camera": {"projection": {"kind": "fisheye", "fov_deg": 301}}})).unwrap();
    let cube = json!({"projection": {"kind": "cubemap"}});
    let wide = problems(FrameRequest::from_value(
        &json!({"scene": {"camera": cube}, "height_px": 100}),
    ));
    assert_eq!(wide[0].pointer, "/width_px");
    assert_eq!(
        wide[0].message,
        "`width_px` must be 6 times `height_px` (100), for six square faces, but is 1280"
    );
    let strip = json!({"scene": {"camera": cube}, "width_px": 600, "height_px": 100.0});
    assert_eq!(FrameRequest::from_value(&strip).unwrap().height_px, 100);
}

#[test]
fn time_beyond_its_years() {
    let at = |time: &str, time_s: f64| json!({"time_s": time_s, "sun": {"position": {"time": time, "latitude_deg": 60, "longitude_deg": 30}}});
    check(
        at("yesterday", 0.0),
        "/sun/position/time",
        "`time` must be a date and time as in RFC 3339, like 2026-06-21T05:00:00Z, in the years from 1900 to 2100, but is the text \"yesterday\"",
    );
    for time in [
        "",
        "2026-06-21",
        "2026-06-21T05:00:00",
        "2026-02-30T05:00:00Z",
        "1899-12-31T23:59:59Z",
        "2101-01-01T00:00:00Z",
    ] {
        assert_eq!(problem(&at(time, 0.0)).pointer, "/sun/position/time", "{time}");
    }
    for (time, time_s) in [("2090-01-01T00:00:00Z", 1e9), ("1900-01-01T00:00:00Z", -1.0)] {
        assert_eq!(problem(&at(time, time_s)).pointer, "/time_s");
    }
    for time in [
        "1900-01-01T00:00:00Z",
        "2100-12-31T23:59:59.999+00:00",
        "2026-06-21T07:00:00+02:00",
    ] {
        Scene::from_value(&at(time, 0.0)).unwrap();
    }
}

#[test]
fn pointers_of_requests_lead_into_the_scene() {
    let scene = json!({"camera": {"position_m": [0, 0, -1]}});
    let frame = problems(FrameRequest::from_value(&json!({"scene": scene})));
    assert_eq!(frame[0].pointer, "/scene/camera/position_m");
    let probe = problems(ProbeRequest::from_value(&json!({"scene": {"time": 3}})));
    assert_eq!(probe[0].pointer, "/scene/time");
    assert!(
        probe[0].message.contains("did you mean `time_s`?"),
        "{}",
        probe[0].message
    );
}
