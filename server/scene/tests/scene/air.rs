//! The air's numbers: one or three, whole or null, and haze given one way alone.

use serde_json::{Value, json};
use welkin_scene::{Bands, Scene, SceneError};

fn first_problem(document: Value) -> (String, String) {
    match Scene::from_value(&document) {
        Err(SceneError::Invalid(problems)) => (problems[0].pointer.clone(), problems[0].message.clone()),
        other => panic!("{document} gave {other:?}"),
    }
}

#[test]
fn a_band_quantity_is_one_number_or_three() {
    let scene = |mie: Value| Scene::from_value(&json!({"atmosphere": {"mie": mie}}));
    let of = |mie: Value| scene(mie).unwrap().atmosphere.unwrap().mie.unwrap();
    assert_eq!(
        of(json!({"scattering_per_m": 2e-5})).scattering_per_m,
        Bands::Grey(2e-5)
    );
    let dust = of(json!({"absorption_per_m": [1e-6, 2e-6, 4e-6]}));
    assert_eq!(dust.absorption_per_m.rgb(), [1e-6, 2e-6, 4e-6]);
    for (held, at) in [(json!(0.2), ""), (json!([0.01, -0.01, 0]), "/1")] {
        let (pointer, message) = first_problem(json!({"atmosphere": {"mie": {"scattering_per_m": held}}}));
        assert_eq!(pointer, format!("/atmosphere/mie/scattering_per_m{at}"));
        assert!(message.contains("from 0 to 0.1 per metre"), "{message}");
    }
    let (pointer, message) = first_problem(json!({"haze": {"albedo": [1, 1]}}));
    assert_eq!(pointer, "/haze/albedo");
    assert!(message.contains("an array of 3"), "{message}");
}

#[test]
fn steps_are_whole_numbers_or_null() {
    let steps = |held: Value| {
        let scene = Scene::from_value(&json!({"atmosphere": {"view_steps": held}})).unwrap();
        scene.atmosphere.unwrap().view_steps
    };
    assert_eq!(steps(json!(30)), Some(30));
    assert_eq!(steps(json!(3e1)), Some(30));
    assert_eq!(steps(Value::Null), None);
    for held in [json!(3), json!(30.5), json!(257), json!("30")] {
        let (pointer, message) = first_problem(json!({"atmosphere": {"sun_steps": held}}));
        assert_eq!(pointer, "/atmosphere/sun_steps");
        assert!(
            message.contains("a whole number from 4 to 256, or null"),
            "{message}"
        );
    }
}

#[test]
fn haze_is_as_dense_as_its_visibility_or_its_extinction_says() {
    let of = |haze: Value| {
        let scene = Scene::from_value(&json!({"haze": haze})).unwrap();
        scene.haze.unwrap().extinction()
    };
    assert!((of(json!({"visibility_m": 200})) - 3.912 / 200.0).abs() < 1e-12);
    assert!((of(json!({"extinction_per_m": 1e-5})) - 1e-5).abs() < 1e-12);
    assert!((of(json!({})) - 3.912 / 20_000.0).abs() < 1e-12);
    assert!(Scene::from_value(&json!({"haze": null})).unwrap().haze.is_none());
    let both = json!({"haze": {"visibility_m": 200, "extinction_per_m": 0.01}});
    let (pointer, message) = first_problem(both);
    assert_eq!(pointer, "/haze/extinction_per_m");
    assert!(message.contains("visibility_m"), "{message}");
    let (pointer, message) = first_problem(json!({"haze": {"top_m": 2000}, "atmosphere": {"top_m": 1500}}));
    assert_eq!(pointer, "/haze/top_m");
    assert!(message.contains("1500"), "{message}");
}
