//! Every control of the layers acts, in its sense.

use crate::scenes::{Seen, cloudiness, clouds, luma, merged, order, scene, seen, seen_as};
use serde_json::{Value, json};
use welkin_scene::{Quality, Scene, preset, renderer::Output};

/// Looking level from that height, at the usual layer with changes.
fn level(altitude_m: f64, layer: Value) -> [f64; 2] {
    let layer = merged(
        json!({"kind": "volume", "base_m": 1500, "top_m": 3500, "type": 0.8}),
        &layer,
    );
    let scene = scene(&json!({
        "camera": {"position_m": [0, 0, altitude_m], "direction": {"azimuth_deg": 180, "elevation_deg": 0},
                   "projection": {"kind": "perspective", "vertical_fov_deg": 30}},
        "clouds": {"layers": [layer], "coverage": 0.5, "shadows": false},
    }));
    let without = Scene {
        clouds: None,
        ..scene.clone()
    };
    seen(&scene).changed_above_and_below(&seen(&without))
}

#[test]
fn clouds_stand_between_base_and_top() {
    // A preview's pixels about the horizon hold both sides of it.
    let [above, below] = level(4000.0, json!({"base_m": 500, "top_m": 1500}));
    assert!(above < 0.1 && below > 0.2, "low: {above}, {below}");
    let [above, below] = level(4000.0, json!({"base_m": 6000, "top_m": 7000}));
    assert!(above > 0.2 && below < 0.1, "high: {above}, {below}");
    let [lower, _] = level(2500.0, json!({"base_m": 500, "top_m": 2000}));
    let [higher, _] = level(2500.0, json!({"base_m": 500, "top_m": 8000}));
    assert!(higher > lower + 0.1, "top: {higher}, {lower}");
}

/// By Schneider's gradients, in a layer from 500 to 6000 m: stratus up to a ninth of it, stratocumulus up to five eighths.
#[test]
fn types_have_their_heights() {
    let above = |altitude_m: f64, cloud_type: f64| {
        let scene = scene(&json!({
            "camera": {"position_m": [0, 0, altitude_m], "direction": {"azimuth_deg": 180, "elevation_deg": 0},
                       "projection": {"vertical_fov_deg": 30}},
            "clouds": {"layers": [{"kind": "volume", "base_m": 500, "top_m": 6000, "type": cloud_type}],
                       "shape": {"gradients": {"stratus": [0.02, 0.05, 0.09, 0.11], "stratocumulus": [0.02, 0.2, 0.48, 0.625],
                                               "cumulus": [0.01, 0.0625, 0.78, 1]}}},
        }));
        let without = Scene {
            clouds: None,
            ..scene.clone()
        };
        seen(&scene).changed_above_and_below(&seen(&without))[0]
    };
    for (altitude_m, cloud_type, there) in [
        (1300.0, 0.0, false),
        (1300.0, 0.5, true),
        (4200.0, 0.5, false),
        (4200.0, 1.0, true),
    ] {
        let found = above(altitude_m, cloud_type);
        assert!(
            if there { found > 0.2 } else { found < 0.1 },
            "{altitude_m} m, type {cloud_type}: {found}"
        );
    }
}

/// Seen from above.
#[test]
fn anvils_spread_under_the_top() {
    let of = |anvil: f64| {
        cloudiness(&scene(&json!({
            "camera": {"position_m": [0, 0, 30_000], "direction": {"azimuth_deg": 180, "elevation_deg": -60}},
            "clouds": {"layers": [{"kind": "volume", "base_m": 800, "top_m": 12_000, "type": 1, "anvil": anvil}], "coverage": 0.35},
        })))
    };
    let (without, with) = (of(0.0), of(1.0));
    println!("anvil: {without} to {with}");
    assert!(with > without + 0.03, "{with}, {without}");
}

#[test]
fn a_layers_own_coverage_and_density_count() {
    let of = |layer: Value| clouds(json!({"layers": [layer]}));
    let base = cloudiness(&of(json!({"kind": "volume"})));
    let more = cloudiness(&of(json!({"kind": "volume", "coverage": 0.9})));
    let less = cloudiness(&of(json!({"kind": "volume", "coverage": 0.2})));
    assert!(less < base - 0.05 && base < more - 0.05, "{less} {base} {more}");
    let same = |a: &Seen, b: &Seen| a.apart(b) < 1e-6;
    let layer = seen(&of(json!({"kind": "volume", "density": 0.1})));
    let all = seen(&clouds(json!({"layers": [{"kind": "volume"}], "density": 0.1})));
    assert!(
        same(&layer, &all),
        "a density of 0.1 of the one layer is that of all"
    );
}

fn sheet(changes: Value) -> Seen {
    let layer = merged(
        json!({"kind": "sheet", "height_m": 8000, "genus": "cirrus", "coverage": 0.5}),
        &changes,
    );
    seen(&clouds(json!({"layers": [layer]})))
}

#[test]
fn every_control_of_a_sheet_acts() {
    let clear = seen(&crate::scenes::clear());
    let base = sheet(json!({}));
    assert!(base.apart(&clear) > 0.01);
    for genus in ["cirrocumulus", "cirrostratus", "altocumulus", "altostratus"] {
        let found = sheet(json!({ "genus": genus })).apart(&base);
        println!("{genus}: {found}");
        assert!(found > 0.01, "{genus}: {found}");
    }
    let [thin, thick] = [0.1, 3.0].map(|d| sheet(json!({"optical_depth": d})).apart(&clear));
    assert!(thick > 1.5 * thin, "optical depth: {thick}, {thin}");
    let [few, many] = [0.2, 0.9].map(|c| sheet(json!({"coverage": c})).changed(&clear));
    assert!(many > few + 0.1, "coverage: {many}, {few}");
    let lower = sheet(json!({"height_m": 5000})).apart(&base);
    assert!(lower > 0.005, "height: {lower}");
}

/// Where the observer stands between a low and a high layer, one is below, the other above.
#[test]
fn layers_stand_over_one_another() {
    let scene = |layers: Value| {
        scene(&json!({
            "camera": {"position_m": [0, 0, 4000], "direction": {"azimuth_deg": 180, "elevation_deg": 0},
                       "projection": {"kind": "perspective", "vertical_fov_deg": 40}},
            "clouds": {"layers": layers, "coverage": 0.8},
        }))
    };
    let low = json!({"kind": "volume", "base_m": 800, "top_m": 1800, "type": 0.5});
    let high = json!({"kind": "sheet", "height_m": 9000, "genus": "altocumulus"});
    let both = seen(&scene(json!([low, high])));
    let [above, below] = both.changed_above_and_below(&seen(&Scene {
        clouds: None,
        ..scene(json!([]))
    }));
    assert!(above > 0.2 && below > 0.2, "{above}, {below}");
    // In any order.
    assert!(both == seen(&scene(json!([high, low]))));
}

/// What is seen of a bright cloud past the edge of a dark one grows with the gap: it must not jump from one to the other
/// where a ray's places for clouds run out.
#[test]
fn a_dark_deck_dissolves_before_a_bright_cloud() {
    let camera = json!({"direction": {"azimuth_deg": 87.2, "elevation_deg": 45.3},
                        "projection": {"kind": "perspective", "vertical_fov_deg": 16}});
    let storm = serde_json::to_value(&preset("storm").unwrap().scene).unwrap();
    let scene = Scene::from_value(&merged(storm, &json!({ "camera": camera }))).unwrap();
    let picture = seen_as(order(&scene, (160, 120), Quality::Final, Output::Linear));
    let at = |x: usize, y: usize| luma(picture.values[y * picture.width + x]);
    let mut jumps = 0;
    for y in 1..picture.height {
        for x in 1..picture.width {
            let jump = |other: f64| (at(x, y) / other).ln().abs() > 2_f64.ln();
            jumps += u32::from(jump(at(x - 1, y))) + u32::from(jump(at(x, y - 1)));
        }
    }
    let share = f64::from(jumps) / (2 * picture.values.len()) as f64;
    println!("{share}");
    // It was 0.004 when a near fringe took all places, and is 0.00005.
    assert!(share < 0.001, "{share}");
}
