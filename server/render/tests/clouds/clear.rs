//! Skies without clouds, thin clouds and thick ones: what the first seed of this product asks to be tested.

use crate::scenes::{clear, cloudiness, clouds, merged, order, pixels, scene, seen, usual};
use serde_json::json;
use welkin_scene::{
    Quality, Scene,
    renderer::{Output, Pixels},
};

fn same(a: &Scene, b: &Scene) -> bool {
    [
        (Quality::Preview, Output::Linear),
        (Quality::Final, Output::Linear),
        (Quality::Preview, Output::Display),
    ]
    .into_iter()
    .all(|(quality, output)| {
        let of = |scene| pixels(order(scene, (64, 36), quality, output));
        match (of(a), of(b)) {
            (Pixels::Linear(a), Pixels::Linear(b)) => {
                a.iter().map(|v| v.to_bits()).eq(b.iter().map(|v| v.to_bits()))
            }
            (Pixels::Display(a), Pixels::Display(b)) => a == b,
            _ => panic!("one is a picture, the other is not"),
        }
    })
}

#[test]
fn no_coverage_and_no_density_are_the_clear_sky_to_the_byte() {
    let sky = clear();
    for none in [
        json!({"coverage": 0}),
        json!({"density": 0}),
        json!({"extinction_per_m": 0}),
        json!({"layers": []}),
        json!({"layers": [{"kind": "volume", "coverage": 0}, {"kind": "sheet", "coverage": 0}]}),
        json!({"layers": [{"kind": "volume", "density": 0}, {"kind": "sheet", "optical_depth": 0}]}),
    ] {
        assert!(same(&sky, &clouds(none.clone())), "{none}");
    }
    // The test can tell.
    assert!(!same(&sky, &clouds(json!({}))));
}

/// Light of an even deck's top over that of its base, red. It scatters evenly, and there is neither air nor light from the
/// ground: what differs is how deep in the cloud the light comes from.
fn lit_over_shaded(density: f64) -> f64 {
    let of = |height_m: f64, elevation_deg: f64| {
        let scene = scene(&json!({
            "camera": {"position_m": [0, 0, height_m], "direction": {"azimuth_deg": 90, "elevation_deg": elevation_deg},
                       "projection": {"vertical_fov_deg": 20}},
            "planet": {"ground_albedo": [0, 0, 0]},
            "atmosphere": null,
            "clouds": {
                "coverage": 1, "density": density,
                "layers": [{"kind": "volume", "base_m": 2000, "top_m": 3000, "type": 0.5}],
                "weather_map": {"kind": "uniform", "coverage": 1, "type": 0.5},
                // Even, so that both look at the same.
                "shape": {"low_freq_max": 1e-3, "high_freq_modifier": 0},
                "phase": {"kind": "dual-henyey-greenstein", "forward": 0, "backward": 0},
            },
        }));
        seen(&scene).mean()[0]
    };
    of(5000.0, -40.0) / of(2.0, 40.0)
}

#[test]
fn thin_clouds_have_almost_no_shadow_and_thick_ones_a_marked_one() {
    let [thin, usual, thick] = [0.005, 1.0, 10.0].map(lit_over_shaded);
    println!("lit over shaded: thin {thin}, usual {usual}, thick {thick}");
    // Almost none: a tenth. The diffusion limit gives a slab of optical depth T = (1 - g) τ about 1 + 3T/2.
    assert!((0.9..1.1).contains(&thin), "{thin}");
    assert!(usual > 3.0 && thick > 2.0 * usual, "{usual}, {thick}");
}

#[test]
fn vectors_without_length_are_refused() {
    for (changes, pointer) in [
        (json!({"sun": {"position": [0, 0, 0]}}), "/sun/position"),
        (json!({"camera": {"direction": [0, 0, 0]}}), "/camera/direction"),
    ] {
        let told = Scene::from_value(&merged(usual(), &changes))
            .unwrap_err()
            .to_string();
        assert!(told.contains(pointer) && told.contains("zero"), "{told}");
    }
}

#[test]
fn coverage_and_density_bring_clouds() {
    let mut before = 0.0;
    for coverage in [0.1, 0.3, 0.5, 1.0] {
        let found = cloudiness(&clouds(json!({"coverage": coverage})));
        assert!(found > before + 0.03, "{coverage}: {found}, {before}");
        before = found;
    }
    let mut before = 0.0;
    for density in [0.002, 0.02, 0.2] {
        let sky = clear();
        let found = seen(&clouds(json!({"density": density}))).apart(&seen(&sky));
        assert!(found > 1.1 * before, "{density}: {found}, {before}");
        before = found;
    }
}
