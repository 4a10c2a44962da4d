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
            "alpine-dawn",
            "ridge-and-clouds",
            "sea-of-cloud",
            "coast",
            "orbit-terminator",
            "fair-weather",
            "overcast",
            "storm",
            "mackerel-sky",
            "cumulus",
            "stratus",
            "stratocumulus",
            "cumulonimbus",
            "nimbostratus",
            "altocumulus",
            "altostratus",
            "cirrus",
            "cirrocumulus",
            "cirrostratus",
            "complutense",
            "bauman",
            "horizon"
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

/// Heights in temperate latitudes: the WMO's étages reach from the ground to 2 km, from 2 to 7 km and from 5 to 13 km.
#[test]
fn each_genus_has_its_height_and_its_light() {
    use welkin_scene::clouds::{Genus, Layer};
    for (name, lowest, highest, genus) in [
        ("cumulus", 300.0, 3e3, None),
        ("stratus", 0.0, 2e3, None),
        ("stratocumulus", 300.0, 2e3, None),
        ("cumulonimbus", 300.0, 13e3, None),
        ("nimbostratus", 300.0, 7e3, None),
        ("altocumulus", 2e3, 7e3, Some(Genus::Altocumulus)),
        ("altostratus", 2e3, 7e3, Some(Genus::Altostratus)),
        ("cirrus", 5e3, 13e3, Some(Genus::Cirrus)),
        ("cirrocumulus", 5e3, 13e3, Some(Genus::Cirrocumulus)),
        ("cirrostratus", 5e3, 13e3, Some(Genus::Cirrostratus)),
    ] {
        let scene = &preset(name).unwrap().scene;
        let [layer] = &scene.clouds.as_ref().unwrap().layers[..] else {
            panic!("{name}")
        };
        let (base_m, top_m, held) = match layer {
            Layer::Volume(volume) => (volume.base_m, volume.top_m, None),
            Layer::Sheet(sheet) => (sheet.height_m, sheet.height_m, Some(sheet.genus)),
        };
        assert!(
            lowest <= base_m && top_m <= highest && held == genus,
            "{name}: {layer:?}"
        );
        let elevation = scene.sun_place().elevation_deg;
        assert!((20.0..=50.0).contains(&elevation), "{name}: {elevation}");
        let [sun, view] = [scene.sun_direction(), scene.camera.direction.unit()];
        let cosine: f64 = sun.iter().zip(view).map(|(a, b)| a * b).sum();
        // 16:9 and 75° from edge to edge reach 57° from the centre in a corner; the sun stands behind altostratus alone.
        assert_eq!(
            cosine > 57.0_f64.to_radians().cos(),
            name == "altostratus",
            "{name}"
        );
    }
}

#[test]
fn published_clouds_keep_their_geometry() {
    for (name, detail_m, extent_m) in [("bauman", 48e3, 480e3), ("horizon", 4.8e3, 4096e3)] {
        let scene = serde_json::to_value(&preset(name).unwrap().scene).unwrap();
        for (pointer, expected) in [
            ("/planet/radius_m", 6.4e6),
            ("/clouds/layers/0/base_m", 15e3),
            ("/clouds/layers/0/top_m", 35e3),
            ("/clouds/shape/base_scale_m", 48e3),
            ("/clouds/shape/detail_scale_m", detail_m),
            ("/clouds/weather_map/extent_m", extent_m),
            ("/clouds/steps", 128.0),
            ("/clouds/light_steps", 4.0),
        ] {
            assert_eq!(
                scene.pointer(pointer).and_then(Value::as_f64),
                Some(expected),
                "{name}{pointer}"
            );
        }
    }
}

/// Whatever a scene is by default, these are what their names say.
#[test]
fn clear_skies_have_no_clouds() {
    for name in [
        "clear-noon",
        "golden-hour",
        "twilight",
        "moonlit-night",
        "starry-night",
        "from-orbit",
        "complutense",
    ] {
        assert_eq!(preset(name).unwrap().scene.clouds, None, "{name}");
    }
}
