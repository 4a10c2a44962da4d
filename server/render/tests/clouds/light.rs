//! Every control of the clouds' light acts, in its sense.

use crate::scenes::{Seen, clear, clouds, luma, order, scene, seen, seen_as};
use serde_json::{Value, json};
use welkin_scene::{Quality, renderer::Output};

/// A closed deck, seen from below.
fn deck(changes: Value) -> Seen {
    // The air under it lies in its shadow, or its light would be most of what is seen.
    let base = json!({"coverage": 1.0, "shadows": true, "weather_map": {"kind": "uniform", "coverage": 1, "type": 0.5, "rain": 1},
                      "layers": [{"kind": "volume", "base_m": 800, "top_m": 1600}]});
    seen(&clouds(crate::scenes::merged(base, &changes)))
}

fn heaps(changes: Value) -> Seen {
    seen(&clouds(changes))
}

/// Thin clouds below, with the sun behind the observer.
fn from_sun(changes: Value) -> Seen {
    let base = json!({
        "camera": {"position_m": [0, 0, 6000], "direction": {"azimuth_deg": 20, "elevation_deg": -40},
                   "projection": {"vertical_fov_deg": 30}},
        "planet": {"ground_albedo": [0, 0, 0]},
        "atmosphere": null,
        "clouds": {"density": 0.1},
    });
    seen(&scene(&crate::scenes::merged(
        base,
        &json!({ "clouds": changes }),
    )))
}

fn lobes(forward: f64, backward: f64, blend: f64) -> Value {
    json!({"phase": {"kind": "dual-henyey-greenstein", "forward": forward, "backward": backward, "blend": blend}})
}

/// Controls that change how much light there is: by at least that factor, downwards where it is below 1.
#[test]
fn controls_of_brightness_act() {
    type Picture = fn(Value) -> Seen;
    let cases: [(&str, Picture, Value, Value, f64); 14] = [
        ("precipitation", deck, json!({}), json!({"precipitation": 1}), 0.8),
        (
            "density",
            deck,
            json!({"density": 0.3}),
            json!({"density": 3}),
            0.7,
        ),
        (
            "extinction",
            deck,
            json!({"extinction_per_m": 0.01}),
            json!({"extinction_per_m": 0.1}),
            0.7,
        ),
        ("albedo", deck, json!({}), json!({"albedo": 0.9}), 0.9),
        ("sun_factor", heaps, json!({}), json!({"sun_factor": 0}), 0.8),
        ("sun_factor up", heaps, json!({}), json!({"sun_factor": 2}), 1.2),
        (
            "ambient_factor",
            heaps,
            json!({}),
            json!({"ambient_factor": 0}),
            0.95,
        ),
        (
            "ambient_factor up",
            heaps,
            json!({}),
            json!({"ambient_factor": 3}),
            1.1,
        ),
        (
            "sun_colour",
            heaps,
            json!({}),
            json!({"sun_colour": [0.3, 0.3, 0.3]}),
            0.9,
        ),
        (
            "base_colour",
            heaps,
            json!({}),
            json!({"base_colour": [0.5, 0.5, 0.5]}),
            0.9,
        ),
        (
            "powder",
            from_sun,
            json!({"powder": 0}),
            json!({"powder": 1}),
            0.99,
        ),
        (
            "backward",
            from_sun,
            lobes(0.8, 0.0, 0.5),
            lobes(0.8, -0.8, 0.5),
            1.05,
        ),
        (
            "octaves",
            heaps,
            json!({"octaves": 1, "density": 0.3}),
            json!({"octaves": 8, "density": 0.3}),
            1.01,
        ),
        (
            "forward",
            heaps,
            json!({"phase": {"kind": "dual-henyey-greenstein", "forward": 0.2, "blend": 0}, "density": 0.02}),
            json!({"phase": {"kind": "dual-henyey-greenstein", "forward": 0.8, "blend": 0}, "density": 0.02}),
            1.05,
        ),
    ];
    let mut faults = Vec::new();
    for (name, picture, before, after, factor) in cases {
        let found = picture(after).light() / picture(before).light();
        println!("{name}: {found:.3}, at least {factor}");
        if (factor > 1.0 && found < factor) || (factor < 1.0 && found > factor) {
            faults.push(format!("{name}: {found}"));
        }
    }
    assert!(faults.is_empty(), "{faults:?}");
}

/// Colours tint what they say and nothing else.
#[test]
fn colours_tint() {
    let white = heaps(json!({}));
    for field in ["sun_colour", "base_colour"] {
        let red = heaps(json!({ field: [1, 0.5, 0.2] }));
        let left = [0, 1, 2].map(|c| red.mean()[c] / white.mean()[c]);
        println!("{field}: {left:?}");
        assert!((left[0] - 1.0).abs() < 0.02, "{field}: {left:?}");
        // More of the blue comes from the sky, which the sun's colour leaves alone.
        assert!(left[1] < 0.95 && left[2] < 0.95, "{field}: {left:?}");
    }
}

fn around_sun(sun_azimuth_deg: f64, phase: Value) -> f64 {
    let scene = scene(&json!({
        "camera": {"direction": {"azimuth_deg": 180, "elevation_deg": 40}, "projection": {"vertical_fov_deg": 15}},
        "sun": {"position": {"azimuth_deg": sun_azimuth_deg, "elevation_deg": 40}},
        "clouds": {"phase": phase, "density": 0.05, "coverage": 0.8, "powder": 0},
    }));
    let clear = seen(&scene_without(&scene));
    let cloudy = seen(&scene);
    luma([0, 1, 2].map(|c| cloudy.mean()[c] - clear.mean()[c]))
}

fn scene_without(scene: &welkin_scene::Scene) -> welkin_scene::Scene {
    welkin_scene::Scene {
        clouds: None,
        ..scene.clone()
    }
}

#[test]
fn the_phase_function_sends_light_where_it_says() {
    let lobes = |forward: f64, backward: f64, blend: f64| json!({"kind": "dual-henyey-greenstein", "forward": forward, "backward": backward, "blend": blend});
    let towards = 180.0;
    // The share of the lobe against the light: less light ahead.
    let [most, some] = [0.0, 0.6].map(|share| around_sun(towards, lobes(0.8, -0.3, share)));
    assert!(some < 0.9 * most, "blend: {some}, {most}");
    // Droplets: sharper ahead than two wide lobes, and sharper the larger they are.
    let droplets = |d: f64| json!({"kind": "droplets", "diameter_m": d});
    let [small, large] = [6e-6, 4e-5].map(|d| around_sun(towards, droplets(d)));
    assert!((large / small - 1.0).abs() > 0.02, "droplets: {large}, {small}");
    let wide = around_sun(towards, lobes(0.3, -0.3, 0.5));
    let sharp = around_sun(towards, droplets(2e-5));
    assert!(sharp > 1.2 * wide, "droplets: {sharp}, {wide}");
}

/// More steps change little, and something.
#[test]
fn steps_refine() {
    for field in ["steps", "light_steps"] {
        let [few, many] = [("steps", [128, 512]), ("light_steps", [6, 24])]
            .into_iter()
            .find(|(name, _)| *name == field)
            .unwrap()
            .1
            .map(|count: u32| {
                let scene = clouds(json!({ field: count }));
                // Previews do not follow the light's way.
                seen_as(order(&scene, (96, 54), Quality::Final, Output::Linear))
            });
        let apart = few.apart(&many);
        println!("{field}: {apart}");
        // Within what the brute force finds for a final frame's pixels, and more than roundings.
        assert!(apart > 1e-5 && apart < 0.1, "{field}: {apart}");
    }
}

/// Seen from over them, clouds darken the ground.
#[test]
fn shadows_fall_on_the_ground() {
    let over = |shadows: bool| {
        seen(&scene(&json!({
            "camera": {"position_m": [0, 0, 8000], "direction": {"azimuth_deg": 180, "elevation_deg": -40}},
            "planet": {"ground_albedo": [0.4, 0.4, 0.4]},
            "clouds": {"shadows": shadows},
        })))
    };
    let (with, without) = (over(true), over(false));
    let found = with.light() / without.light();
    println!("shadows: {found}");
    assert!(found < 0.97, "{found}");
}

/// Far clouds fade into the sky behind them.
#[test]
fn haze_takes_the_contrast_of_far_clouds() {
    let low = |haze: f64| {
        let changes = json!({"camera": {"direction": {"azimuth_deg": 180, "elevation_deg": 6},
                                        "projection": {"kind": "perspective", "vertical_fov_deg": 10}},
                             "clouds": {"haze": haze}});
        seen(&scene(&changes)).apart(&seen(&scene(&crate::scenes::merged(
            changes.clone(),
            &json!({"clouds": null}),
        ))))
    };
    let (none, full) = (low(0.0), low(1.0));
    println!("haze: {none} to {full}");
    assert!(full < 0.7 * none, "{full}, {none}");
}

#[test]
fn a_sunlit_cloud_is_brighter_than_the_sky_and_an_overcast_darker_than_the_sun() {
    let (sky, cloudy) = (seen(&clear()), heaps(json!({})));
    let brightest = cloudy.values.iter().map(|v| luma(*v)).fold(0.0, f64::max);
    println!("brightest over mean sky {}", brightest / sky.light());
    assert!(brightest > 2.0 * sky.light(), "{brightest}, {}", sky.light());
}
