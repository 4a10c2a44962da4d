//! Clouds by night, and what they do to the discs and the stars.

use crate::scenes::{luma, order, pixels, scene, seen, seen_as};
use serde_json::{Value, json};
use welkin_scene::{
    Quality, Scene,
    renderer::{Output, Pixels},
};

/// An even deck over all of the sky, of that extinction.
fn deck(extinction_per_m: f64) -> Value {
    json!({"coverage": 1, "extinction_per_m": extinction_per_m,
           "layers": [{"kind": "volume", "base_m": 1000, "top_m": 2000, "type": 0.5}],
           "weather_map": {"kind": "uniform", "coverage": 1, "type": 0.5}})
}

/// What a deck leaves of what is added to the sky by `field`.
fn left(changes: &Value, with: &Value, extinction_per_m: f64) -> f64 {
    let of = |on: bool, clouds: Value| {
        let mut changes = changes.clone();
        if on {
            changes = crate::scenes::merged(changes, with);
        }
        changes["clouds"] = clouds;
        seen_as(order(&scene(&changes), (96, 54), Quality::Final, Output::Linear)).light()
    };
    let clear = of(true, Value::Null) - of(false, Value::Null);
    assert!(clear > 0.0, "nothing is added");
    (of(true, deck(extinction_per_m)) - of(false, deck(extinction_per_m))) / clear
}

#[test]
fn the_suns_disc_is_dimmed_and_hidden() {
    let camera = json!({"camera": {"direction": {"azimuth_deg": 200, "elevation_deg": 40}, "projection": {"vertical_fov_deg": 4}}});
    let disc = json!({"sun": {"disc": true}});
    let [clear, thin, thick] = [1e-7, 5e-4, 0.04].map(|sigma| left(&camera, &disc, sigma));
    println!("sun left: {clear}, {thin}, {thick}");
    assert!((clear - 1.0).abs() < 1e-3, "{clear}");
    assert!(thin > 0.3 && thin < 0.95, "{thin}");
    assert!(thick < 1e-3, "{thick}");
}

#[test]
fn stars_are_dimmed_and_hidden() {
    let dark = json!({"sun": {"position": {"azimuth_deg": 0, "elevation_deg": -50}},
                      "camera": {"direction": {"azimuth_deg": 180, "elevation_deg": 40}, "projection": {"vertical_fov_deg": 40}}});
    let stars = json!({"stars": {}});
    let [thin, thick] = [5e-4, 0.04].map(|sigma| left(&dark, &stars, sigma));
    println!("stars left: {thin}, {thick}");
    assert!(thin > 0.3 && thin < 0.95, "{thin}");
    // What starlight there is comes down through the clouds in all directions.
    assert!(thick < 0.3, "{thick}");
}

#[test]
fn the_moon_lights_clouds_at_night() {
    let night = |moon: Value, clouds: Value| {
        let scene = scene(&json!({
            "sun": {"position": {"azimuth_deg": 0, "elevation_deg": -50}},
            "moon": moon,
            "atmosphere": {"airglow": null},
            "camera": {"direction": {"azimuth_deg": 0, "elevation_deg": 30}},
            "clouds": clouds,
        }));
        seen(&scene)
    };
    let moon = || json!({"position": {"azimuth_deg": 180, "elevation_deg": 45}});
    let clouds = || json!({"coverage": 0.6});
    let (clear, cloudy) = (night(moon(), Value::Null), night(moon(), clouds()));
    let brightest = cloudy.values.iter().map(|v| luma(*v)).fold(0.0, f64::max);
    println!("by the moon: {} over {}", brightest, clear.light());
    assert!(brightest > 1.5 * clear.light(), "{brightest}, {}", clear.light());
    // The sun from 50° below.
    assert!(night(Value::Null, clouds()).light() < 1e-15);
}

/// A veil of light about a sun that clouds hide would be a sun seen through them.
#[test]
fn the_lens_has_no_glare_of_a_hidden_sun() {
    let shown = |glare: f64, sigma: f64| {
        let scene: Scene = scene(&json!({
            "camera": {"direction": {"azimuth_deg": 200, "elevation_deg": 40}, "projection": {"vertical_fov_deg": 20}},
            "sun": {"disc": true},
            "display": {"glare": glare, "exposure": {"kind": "ev", "ev": 14}, "dither": false},
            "clouds": deck(sigma),
        }));
        let Pixels::Display(values) = pixels(order(&scene, (64, 36), Quality::Preview, Output::Display))
        else {
            panic!("not a picture")
        };
        values
    };
    assert!(shown(1.0, 1e-6) != shown(0.0, 1e-6), "the glare is seen");
    assert!(shown(1.0, 0.1) == shown(0.0, 0.1), "behind clouds it is not");
}
