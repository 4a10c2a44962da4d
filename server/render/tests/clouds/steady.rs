//! The same scene gives the same bytes, and every scene gives numbers.

use crate::scenes::{order, pixels, scene, seen_as};
use proptest::{
    prelude::*,
    test_runner::{Config, TestRunner},
};
use serde_json::{Value, json};
use welkin_scene::{
    Quality, Scene,
    renderer::{Output, Pixels},
};

fn bits(pixels: Pixels) -> Vec<u32> {
    match pixels {
        Pixels::Linear(values) => values.iter().map(|v| v.to_bits()).collect(),
        Pixels::Display(values) => values.iter().map(|v| u32::from(*v)).collect(),
    }
}

/// Again after others, so that nothing that is kept between frames shows.
#[test]
fn the_same_scene_gives_the_same_bytes() {
    let here = scene(&json!({"time_s": 77}));
    let others = [
        json!({"clouds": {"seed": 5}}),
        json!({"clouds": null}),
        json!({"time_s": 78}),
    ];
    for (quality, output) in [
        (Quality::Preview, Output::Display),
        (Quality::Preview, Output::Linear),
        (Quality::Final, Output::Display),
        (Quality::Final, Output::Linear),
    ] {
        let of = |scene: &Scene| bits(pixels(order(scene, (64, 36), quality, output)));
        let first = of(&here);
        for other in &others {
            let other = of(&scene(other));
            assert!(other != first);
        }
        assert!(of(&here) == first, "{quality:?} {output:?}");
    }
}

fn layer() -> impl Strategy<Value = Value> {
    let volume = (
        0.0..12e3_f64,
        1.0..15e3_f64,
        0.0..1.0_f64,
        0.0..1.0_f64,
        0.0..1.0_f64,
    )
        .prop_map(|(base_m, thickness_m, cloud_type, coverage, anvil)| {
            json!({"kind": "volume", "base_m": base_m, "top_m": base_m + thickness_m, "type": cloud_type,
                   "coverage": coverage, "anvil": anvil})
        });
    let genera = [
        "cirrus",
        "cirrocumulus",
        "cirrostratus",
        "altocumulus",
        "altostratus",
    ];
    let sheet = (0.0..15e3_f64, 0..5_usize, 0.0..1.0_f64, 0.0..20.0_f64).prop_map(move |(height_m, genus, coverage, depth)| {
        json!({"kind": "sheet", "height_m": height_m, "genus": genera[genus], "coverage": coverage, "optical_depth": depth})
    });
    prop_oneof![3 => volume, 1 => sheet]
}

fn phase() -> impl Strategy<Value = Value> {
    let lobes = (0.0..0.99_f64, -0.99..0.0_f64, 0.0..1.0_f64).prop_map(|(forward, backward, blend)| {
        json!({"kind": "dual-henyey-greenstein", "forward": forward, "backward": backward, "blend": blend})
    });
    let droplets = (5e-6..5e-5_f64).prop_map(|d| json!({"kind": "droplets", "diameter_m": d}));
    prop_oneof![lobes, droplets]
}

fn any_clouds() -> impl Strategy<Value = Value> {
    let numbers = (
        0.0..10.0_f64,
        0.0..1.0_f64,
        0.0..1.0_f64,
        0.0..1.0_f64,
        1..9_u32,
        1..12_u32,
    );
    let kinds = (
        proptest::collection::vec(layer(), 0..5),
        phase(),
        any::<bool>(),
        16..128_u32,
    );
    (numbers, kinds).prop_map(|((density, extinction, albedo, powder, octaves, light_steps), (layers, phase, shadows, steps))| {
        json!({"density": density, "extinction_per_m": extinction, "albedo": albedo, "powder": powder, "octaves": octaves,
               "light_steps": light_steps, "layers": layers, "phase": phase, "shadows": shadows, "steps": steps,
               "precipitation": 1 - u8::from(shadows)})
    })
}

/// From the ground, in the clouds, over them and from orbit; at any hour, in air and in none.
fn any_scene() -> impl Strategy<Value = Value> {
    let height = prop_oneof![Just(0.0), 0.0..4e3_f64, 0.0..20e3_f64, 2e5..2e7_f64];
    let view = (
        height,
        0.0..360.0_f64,
        -90.0..90.0_f64,
        -30.0..90.0_f64,
        any::<bool>(),
    );
    (view, any_clouds()).prop_map(|((height_m, azimuth, elevation, sun, air), clouds)| {
        let mut scene = json!({
            "camera": {"position_m": [0, 0, height_m], "direction": {"azimuth_deg": azimuth, "elevation_deg": elevation},
                       "projection": {"kind": "perspective", "vertical_fov_deg": 100}},
            "sun": {"position": {"azimuth_deg": 170, "elevation_deg": sun}, "disc": true},
            "clouds": clouds,
        });
        if !air {
            scene["atmosphere"] = Value::Null;
        }
        scene
    })
}

/// `seen_as` asks for numbers that are finite and not negative.
#[test]
fn every_scene_gives_numbers() {
    let config = Config {
        cases: 20,
        failure_persistence: None,
        max_shrink_iters: 8,
        rng_seed: proptest::test_runner::RngSeed::Fixed(4),
        ..Config::default()
    };
    let mut cases = TestRunner::new(config);
    let found = cases.run(&any_scene(), |changes| {
        let scene = scene(&changes);
        for quality in [Quality::Preview, Quality::Final] {
            let seen = seen_as(order(&scene, (16, 9), quality, Output::Linear));
            prop_assert_eq!(seen.values.len(), 144);
        }
        Ok(())
    });
    found.unwrap();
}
