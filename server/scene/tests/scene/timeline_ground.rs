//! Terrain and shafts through keyframes.

use crate::timeline::timeline;
use serde_json::{Value, json};
use welkin_scene::Scene;

fn at(patches: [Value; 2], at_s: f64) -> Value {
    let [from, to] = patches;
    let track = timeline(&json!({}), &[(0.0, from), (10.0, to)]);
    let scene: Scene = track.at(at_s).unwrap();
    serde_json::to_value(scene).unwrap()
}

#[test]
fn numbers_pass_and_what_is_no_number_changes_half_way() {
    let terrain = |seed: u32, extent_m: f64, size_px: u32| {
        json!({"terrain": {"kind": "heightfield", "mountains": {"seed": seed, "warp": extent_m / 1e5},
            "extent_m": extent_m, "shadow": {"kind": "map", "size_px": size_px}}})
    };
    let patches = || [terrain(3, 20_000.0, 512), terrain(9, 40_000.0, 8192)];
    for (at_s, seed, size_px) in [(2.5, 3, 512), (7.5, 9, 8192)] {
        let found = at(patches(), at_s);
        let terrain = &found["terrain"];
        assert_eq!(terrain["mountains"]["seed"], seed);
        assert_eq!(terrain["shadow"]["size_px"], size_px);
        let extent_m = terrain["extent_m"].as_f64().unwrap();
        let warp = terrain["mountains"]["warp"].as_f64().unwrap();
        assert!(extent_m > 20_000.0 && extent_m < 40_000.0, "{extent_m}");
        // The same curve between the same keyframes, rounded.
        assert!((warp * 1e5 / extent_m - 1.0).abs() < 1e-12, "{warp}");
    }
    let middle = at(patches(), 5.0);
    assert!((middle["terrain"]["extent_m"].as_f64().unwrap() - 30_000.0).abs() < 1e-6);
}

#[test]
fn kinds_and_sources_are_exchanged_as_a_whole() {
    let kinds = [
        json!({"terrain": null}),
        json!({"terrain": {"kind": "heightfield"}}),
        json!({"terrain": {"kind": "heightfield", "name": "alps"}}),
        json!({"terrain": {"kind": "heightfield", "mountains": {"seed": 4}, "shadow": {"kind": "rays"}}}),
        json!({"terrain": {"kind": "mesh", "name": "town"}, "shafts": {"kind": "radial"}}),
        json!({"terrain": {"kind": "mesh", "name": "town", "shadow": null}, "shafts": null}),
        json!({"planet": {"surface": {"kind": "water", "wind_m_s": 9}}}),
    ];
    for from in &kinds {
        for to in &kinds {
            for (at_s, end) in [(4.9, from), (5.1, to)] {
                let found = at([from.clone(), to.clone()], at_s);
                let scene = serde_json::to_value(Scene::from_value(end).unwrap()).unwrap();
                for part in ["terrain", "shafts"] {
                    assert_eq!(found[part], scene[part], "{from} to {to} at {at_s}");
                }
                assert_eq!(
                    found["planet"]["surface"], scene["planet"]["surface"],
                    "{from} to {to} at {at_s}"
                );
            }
        }
    }
}

#[test]
fn the_wind_over_water_freshens() {
    let wind = |wind_m_s: f64| json!({"planet": {"surface": {"kind": "water", "wind_m_s": wind_m_s}}});
    let found = at([wind(2.0), wind(8.0)], 5.0);
    assert!((found["planet"]["surface"]["wind_m_s"].as_f64().unwrap() - 5.0).abs() < 1e-12);
}
