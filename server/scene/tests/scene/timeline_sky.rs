//! Clouds, weather and air between keyframes.

use crate::timeline::{number, timeline};
use serde_json::{Value, json};
use welkin_scene::{
    Clouds, Timeline,
    clouds::{Layer, WeatherMap},
};

#[test]
fn the_wind_turns_the_short_way() {
    let from = |azimuth: f64| json!({"clouds": {"wind": {"azimuth_deg": azimuth}}});
    let track = timeline(&json!({}), &[(0.0, from(350.0)), (10.0, from(20.0))]);
    assert!((number(&track, 5.0, "/clouds/wind/azimuth_deg") - 5.0).abs() < 1e-9);
}

#[test]
fn clouds_come_and_go_by_coverage_and_density() {
    let track = timeline(
        &json!({}),
        &[
            (0.0, json!({"clouds": null})),
            (10.0, json!({"clouds": {"coverage": 0.8, "density": 2}})),
        ],
    );
    assert_eq!(track.at(0.0).unwrap().clouds, None);
    let first = track.at(1e-3).unwrap().clouds.unwrap();
    assert!(first.coverage < 1e-6 && first.density < 1e-6, "{first:?}");
    assert!(first.layers.iter().all(|layer| layer.coverage() < Some(1e-6)));
    let middle = track.at(5.0).unwrap().clouds.unwrap();
    assert!((middle.coverage - 0.4).abs() < 1e-12 && (middle.density - 1.0).abs() < 1e-12);
    let last = track.at(10.0).unwrap().clouds.unwrap();
    assert_eq!(
        (last.coverage, last.density, last.layers),
        (0.8, 2.0, Clouds::default().layers)
    );
}

#[test]
fn haze_air_and_stars_fade() {
    let track = timeline(
        &json!({}),
        &[
            (
                0.0,
                json!({"haze": {"visibility_m": 1000}, "atmosphere": {"ozone": null}, "stars": null}),
            ),
            (10.0, json!({"haze": null})),
            (20.0, json!({"atmosphere": null})),
        ],
    );
    let middle = track.at(5.0).unwrap();
    assert!((middle.haze.unwrap().extinction() - 3.912e-3 / 2.0).abs() < 1e-9);
    let air = middle.atmosphere.unwrap();
    let ozone = air.ozone.unwrap().absorption_per_m[1];
    assert!(0.0 < ozone && ozone < 1.66e-6, "{ozone}");
    assert!(number(&track, 5.0, "/stars/intensity") < 1.0);
    assert!((number(&track, 15.0, "/atmosphere/density_factor") - 0.5).abs() < 1e-12);
    assert_eq!(track.at(20.0).unwrap().atmosphere, None);
}

#[test]
fn layers_meet_their_partners_and_others_fade() {
    let volume = |top: f64| json!({"kind": "volume", "base_m": 1000, "top_m": top, "coverage": 0.5});
    let sheet = |genus: &str| json!({"kind": "sheet", "genus": genus, "coverage": 0.4});
    let of = |layers: Value| json!({"clouds": {"layers": layers}});
    let track = timeline(
        &json!({}),
        &[
            (0.0, of(json!([volume(2000.0), sheet("cirrus")]))),
            (
                10.0,
                of(json!([volume(4000.0), sheet("altocumulus"), sheet("cirrus")])),
            ),
        ],
    );
    let layers = track.at(5.0).unwrap().clouds.unwrap().layers;
    assert!(
        matches!(&layers[0], Layer::Volume(volume) if (volume.top_m - 3000.0).abs() < 1e-9),
        "{layers:?}"
    );
    // Cirrus leaves its place, altocumulus comes there, and cirrus comes to another.
    let coverages: Vec<_> = layers.iter().map(|layer| layer.coverage().unwrap()).collect();
    assert_eq!(coverages, [0.5, 0.2, 0.2, 0.2]);
    // Eight that leave and eight that come have no room beside one another.
    let track = timeline(
        &json!({}),
        &[
            (0.0, of(vec![sheet("cirrus"); 8].into())),
            (10.0, of(vec![volume(3000.0); 8].into())),
        ],
    );
    for (at_s, is_sheet) in [(1.0, true), (4.9, true), (5.1, false), (9.0, false)] {
        let layers = track.at(at_s).unwrap().clouds.unwrap().layers;
        assert!(
            layers.len() == 8
                && layers
                    .iter()
                    .all(|layer| matches!(layer, Layer::Sheet(_)) == is_sheet)
        );
    }
}

#[test]
fn weather_fades_from_map_to_map() {
    let map = |map: Value| json!({"clouds": {"weather_map": map}});
    let asset = |name: &str| json!({"kind": "asset", "name": name});
    let track = timeline(
        &json!({}),
        &[
            (0.0, map(asset("a"))),
            (10.0, map(asset("b"))),
            (20.0, map(asset("a"))),
        ],
    );
    let blend = |track: &Timeline, at_s: f64| match track.at(at_s).unwrap().clouds.unwrap().weather_map {
        WeatherMap::Blend(blend) => serde_json::to_value(blend).unwrap(),
        other => panic!("{other:?}"),
    };
    assert_eq!(blend(&track, 5.0)["share"], 0.5);
    assert_eq!(
        (
            &blend(&track, 15.0)["from"]["name"],
            &blend(&track, 15.0)["to"]["name"]
        ),
        (&json!("b"), &json!("a"))
    );
    assert!(blend(&track, 0.01)["share"].as_f64().unwrap() < 1e-6);
    // A blend has no blends: the first goes to its nearer end, that to the other's, and that to the other.
    let mix = |from: &str, to: &str, share: f64| json!({"kind": "blend", "from": asset(from), "to": asset(to), "share": share});
    let track = timeline(
        &json!({}),
        &[(0.0, map(mix("a", "b", 0.8))), (9.0, map(mix("c", "d", 0.3)))],
    );
    for (at_s, from, to, share) in [(1.5, "a", "b", 0.9), (4.5, "b", "c", 0.5), (7.5, "c", "d", 0.15)] {
        let blend = blend(&track, at_s);
        assert_eq!(
            (&blend["from"]["name"], &blend["to"]["name"]),
            (&json!(from), &json!(to))
        );
        assert!((blend["share"].as_f64().unwrap() - share).abs() < 1e-9, "{blend}");
    }
    let track = timeline(
        &json!({}),
        &[(0.0, map(mix("a", "b", 0.2))), (10.0, map(mix("a", "b", 0.6)))],
    );
    assert!((blend(&track, 5.0)["share"].as_f64().unwrap() - 0.4).abs() < 1e-9);
}

/// New noise would make all clouds jump; new weather fades in.
#[test]
fn seeds_are_those_of_the_first_keyframe() {
    let seed = |seed: u32| json!({"clouds": {"seed": seed}});
    let track = timeline(&json!({}), &[(0.0, seed(3)), (10.0, seed(9))]);
    for at_s in [0.0, 5.0, 10.0] {
        assert_eq!(number(&track, at_s, "/clouds/seed"), 3.0);
    }
    assert_eq!(number(&track, 5.0, "/clouds/weather_map/from/seed"), 3.0);
    assert_eq!(number(&track, 5.0, "/clouds/weather_map/to/seed"), 9.0);
    assert_eq!(number(&track, 10.0, "/clouds/weather_map/seed"), 9.0);
}

/// Clouds go as fast as the wind blows by then, however long the scene has lasted.
#[test]
fn a_wind_that_changes_carries_the_clouds_on() {
    let wind =
        |speed: f64, azimuth: f64| json!({"clouds": {"wind": {"speed_m_s": speed, "azimuth_deg": azimuth}}});
    let track = timeline(
        &json!({}),
        &[
            (3600.0, wind(5.0, 270.0)),
            (3700.0, wind(20.0, 180.0)),
            (3800.0, json!({"clouds": null})),
            (3900.0, wind(10.0, 200.0)),
        ],
    );
    let displacement = |at_s: f64| {
        let scene = track.at(at_s).unwrap();
        let wind = scene.clouds.unwrap().wind;
        (wind.displacement_m(scene.time_s), wind.velocity_m_s())
    };
    // Before the first keyframe the wind is even; a rounding of the way there.
    let drift_m = track.at(100.0).unwrap().clouds.unwrap().wind.drift_m;
    assert!(drift_m.iter().all(|axis| axis.abs() < 1e-9), "{drift_m:?}");
    for at_s in [
        3600.0, 3620.0, 3650.0, 3699.0, 3700.0, 3750.0, 3850.0, 3900.0, 5000.0,
    ] {
        let (before, _) = displacement(at_s - 0.01);
        let (after, _) = displacement(at_s + 0.01);
        let (_, velocity) = displacement(at_s);
        for i in 0..3 {
            // The wind changes by 0.5 m/s in a second at most, the integral is right to 1e-4 of it.
            let speed = (after[i] - before[i]) / 0.02;
            assert!(
                (speed - velocity[i]).abs() < 0.02,
                "{at_s}, {i}: {speed}, {velocity:?}"
            );
        }
    }
}
