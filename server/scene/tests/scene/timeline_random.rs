//! Random timelines: a valid scene at every time, and no leaps.

use crate::{
    strategies::valid_scene,
    timeline::{timeline, written},
};
use proptest::{collection::vec, prelude::*};
use serde_json::{Map, Value, json};
use welkin_scene::{Scene, Timeline, presets};

/// All numbers by their pointers. Directions are told as vectors, for azimuths turn fast near the zenith.
fn numbers(value: &Value, at: &str, found: &mut Map<String, Value>) {
    if let Some(azimuth) = value.get("azimuth_deg").and_then(Value::as_f64)
        && let Some(elevation) = value.get("elevation_deg").and_then(Value::as_f64)
    {
        let unit = welkin_scene::Direction::angles(azimuth, elevation).unit();
        found.extend((0..3).map(|i| (format!("{at}/{i}"), unit[i].into())));
        return;
    }
    if let Ok(vector) = serde_json::from_value::<[f64; 3]>(value.clone())
        && (at.ends_with("/direction") || at.ends_with("/position"))
    {
        let angles = json!(welkin_scene::Direction::Vector(vector).to_angles());
        return numbers(&angles, at, found);
    }
    match value {
        Value::Number(number) if number.is_f64() => drop(found.insert(at.into(), value.clone())),
        Value::Array(items) => items
            .iter()
            .enumerate()
            .for_each(|(i, v)| numbers(v, &format!("{at}/{i}"), found)),
        Value::Object(members) => {
            for (name, value) in members {
                let pointer = format!("{at}/{name}");
                // These begin anew after a turn.
                let is_turning =
                    ["azimuth_deg", "longitude_deg", "sidereal_time_deg"].contains(&name.as_str());
                match value.as_f64().filter(|_| is_turning) {
                    Some(angle) => {
                        let (sin, cos) = angle.to_radians().sin_cos();
                        numbers(&json!([sin, cos]), &pointer, found);
                    }
                    None => numbers(value, &pointer, found),
                }
            }
        }
        _ => {}
    }
}

fn keyframed(scenes: &[Scene], lengths: &[f64]) -> Timeline {
    let mut at_s = 0.0;
    let keys: Vec<_> = scenes
        .iter()
        .zip(lengths)
        .map(|(scene, length)| {
            at_s += length;
            let mut patch = serde_json::to_value(scene).unwrap();
            patch.as_object_mut().unwrap().remove("time_s");
            (at_s, patch)
        })
        .collect();
    timeline(&json!({}), &keys)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Whatever the keyframes, every scene between them is valid, and a little later it is a little different.
    #[test]
    fn between_valid_scenes_all_are_valid_and_near(
        scenes in vec(valid_scene(), 2..5), lengths in vec(0.1..100.0, 5), parts in vec(1e-6..0.999, 4),
    ) {
        // Leaps of a moon by hours and centuries are the sun's own; the sun here is where it is told.
        let scenes: Vec<_> = scenes.into_iter().map(|scene| Scene { time_s: 0.0, ..scene }).collect();
        let track = keyframed(&scenes, &lengths);
        let mut begin_s = lengths[0];
        for (i, part) in (1..scenes.len()).zip(parts) {
            let length_s = lengths[i];
            let at_s = begin_s + part * length_s;
            let scene = track.at(at_s).unwrap();
            prop_assert_eq!(Scene::from_value(&serde_json::to_value(&scene).unwrap()).unwrap(), scene);
            // Words change in the middle; layers that have no room change there too, weather at the thirds.
            let is_change = [1.0 / 3.0, 0.5, 2.0 / 3.0].iter().any(|change| f64::abs(change - part) < 1e-3);
            if !is_change {
                let (mut now, mut then) = (Map::new(), Map::new());
                numbers(&written(&track, at_s), "", &mut now);
                numbers(&written(&track, at_s + 1e-6 * length_s), "", &mut then);
                prop_assert_eq!(now.keys().collect::<Vec<_>>(), then.keys().collect::<Vec<_>>());
                let ends = [begin_s, begin_s + length_s].map(|end_s| {
                    let mut end = Map::new();
                    numbers(&written(&track, end_s), "", &mut end);
                    end
                });
                for (pointer, value) in &now {
                    let [a, b] = [value, &then[pointer]].map(|number| number.as_f64().unwrap());
                    let at_ends = ends.iter().map(|end| end.get(pointer).and_then(Value::as_f64).unwrap_or(1.0));
                    let span = at_ends.map(f64::abs).fold(a.abs().max(b.abs()), f64::max);
                    // A lift off a small planet swings the camera far; a drift makes up for speed times time.
                    let span = match pointer.as_str() {
                        "/camera/position_m/0" | "/camera/position_m/1" | "/camera/position_m/2" => 1e10,
                        drift if drift.contains("drift_m") => span + 1e6,
                        _ => span,
                    };
                    // A millionth of the way: a cubic is three times as steep as its secant at most, its ends lie two
                    // spans apart, and tops add to bases.
                    prop_assert!((a - b).abs() <= 3e-5 * span, "{pointer}: {a} {b} of {span}");
                }
            }
            // Just before the next keyframe all is nearly as it is there. Layers may stand in another order.
            let (mut near, mut there) = (Map::new(), Map::new());
            numbers(&written(&track, begin_s + (1.0 - 1e-7) * length_s), "", &mut near);
            numbers(&written(&track, begin_s + length_s), "", &mut there);
            for (pointer, value) in near.iter().filter(|(pointer, _)| !pointer.starts_with("/clouds/layers")) {
                let (a, b) = (value.as_f64().unwrap(), there.get(pointer).unwrap_or(value).as_f64().unwrap());
                let most = a.abs().max(b.abs()).max(if pointer.contains("position_m") { 1e8 } else { 1.0 });
                // Numbers end level or with three times their secant's slope, which may span far more than they are.
                let most = if pointer.contains("drift_m") { 1e13 } else { most * 1e3 };
                prop_assert!((a - b).abs() <= 1e-6 * most, "{pointer}: {a} {b}");
            }
            begin_s += length_s;
        }
    }

    #[test]
    fn keyframes_are_exact(scenes in vec(valid_scene(), 1..4), lengths in vec(0.1..100.0, 4)) {
        let track = keyframed(&scenes, &lengths);
        let mut at_s = 0.0;
        for (scene, length_s) in scenes.iter().zip(&lengths) {
            at_s += length_s;
            let mut found = track.at(at_s).unwrap();
            prop_assert_eq!(found.time_s, at_s);
            found.time_s = scene.time_s;
            // Seeds and the drift are those that keep clouds from jumping.
            if let (Some(found), Some(told)) = (&mut found.clouds, &scene.clouds) {
                found.wind.drift_m = told.wind.drift_m;
                found.seed = told.seed;
                found.shape.seed = told.shape.seed;
                if found.weather_map != told.weather_map {
                    let told = serde_json::to_value(&told.weather_map).unwrap();
                    prop_assert!(told.to_string().contains("\"seed\":null"), "{told}");
                    found.weather_map = serde_json::from_value(told).unwrap();
                }
            }
            prop_assert_eq!(&found, scene);
        }
    }

    #[test]
    fn any_document_is_answered(at_s in any::<f64>(), keys in vec((any::<f64>(), 0_usize..6), 0..4)) {
        const PATCHES: [&str; 6] = [
            r#"{"clouds": null}"#, r#"{"sun": null}"#, r#"{"clouds": {"layers": [{"kind": "sheet"}]}}"#,
            r#"{"a": {"b": [1]}}"#, r#"{"camera": {"projection": {"kind": "cubemap"}}}"#, r#"{"time_s": -1e9}"#,
        ];
        let keys: Vec<_> = keys
            .iter()
            .map(|(at_s, patch)| json!({"at_s": at_s, "patch": serde_json::from_str::<Value>(PATCHES[*patch]).unwrap()}))
            .collect();
        if let Ok(track) = Timeline::from_value(&json!({"keyframes": keys})) {
            drop(track.at(at_s));
        }
    }
}

/// From any preset to any other, half-way and a quarter of the way.
#[test]
fn every_preset_passes_into_every_other() {
    for from in presets() {
        for to in presets() {
            let track = keyframed(&[from.scene.clone(), to.scene.clone()], &[0.0, 60.0]);
            for at_s in [0.0, 15.0, 30.0, 59.0, 60.0] {
                assert!(track.at(at_s).is_ok(), "{} to {}", from.name, to.name);
            }
        }
    }
}
