//! What comes through whole skies of cloud.

use super::{cloudy, passes};
use crate::{
    camera::CameraUniform,
    cloud_light::CloudLight,
    cloud_sky::CloudSky,
    gpu::Gpu,
    kernel::Recorder,
    passes::{cloud_view::CloudView, cloud_view_light::CloudViewLight},
    tests::{aerial::tables, engine, read_table},
    uniforms::{Part, TileUniform, ViewUniform},
};
use glam::UVec2;
use serde_json::{Value, json};
use welkin_scene::{Quality, Scene, assets::SceneAssets};

/// The clouds before every pixel: what they add, and what they let through.
pub(super) fn look(gpu: &Gpu, scene: &Scene, assets: &SceneAssets, size_px: UVec2) -> Vec<[f32; 4]> {
    let tables = tables(gpu, scene, Quality::Final);
    let sky = CloudSky::new(scene).unwrap();
    let mut passes = passes();
    let textures = passes.textures(gpu, sky.clouds, assets).unwrap();
    let view = Part::new(&ViewUniform::new(&scene.sun, &tables.stand));
    let light = CloudLight {
        stand: tables.stand,
        view: &view,
        clouded: true,
        shafted: false,
    };
    let mut recorder = Recorder::new(gpu);
    let scape = passes.scape(
        &mut recorder,
        &tables,
        (&sky, textures),
        (light, None),
        Quality::Final,
    );
    let camera = Part::new(&CameraUniform::new(&scene.camera, size_px));
    let tile = TileUniform {
        origin_px: UVec2::ZERO,
        size_px,
        stride_px: 1,
    };
    let camera = (&camera, tables.plan.projection);
    let tile = (tile, size_px);
    let nodes = CloudView::new().run(&mut recorder, &scape, camera, tile, None);
    let seen = CloudViewLight::new().run(&mut recorder, &scape, camera, tile, (&nodes, None));
    recorder.finish(&[], |_| ()).unwrap();
    read_table(gpu, &seen.view, 0)
}

/// A slab of even density: weather that is the same everywhere, gradients that are full over the whole height, and a
/// coarse noise that counts as 1 from a thousandth on. Not of
/// heaped type, since heaps narrow upwards.
fn slab(extinction_per_m: f64, camera: Value) -> Scene {
    let full = json!([0, 1e-9, 1.0 - 1e-9, 1]);
    let mut scene = cloudy(json!({
        "coverage": 1,
        "extinction_per_m": extinction_per_m,
        "layers": [{"kind": "volume", "base_m": 1000, "top_m": 2000, "type": 0.5}],
        "weather_map": {"kind": "uniform", "coverage": 1, "type": 0.5},
        "shape": {"low_freq_min": 0, "low_freq_max": 1e-3, "high_freq_modifier": 0,
                  "gradients": {"stratus": full, "stratocumulus": full, "cumulus": full}},
    }));
    scene.camera = serde_json::from_value(camera).unwrap();
    scene
}

/// Looking straight up or down, and level from its middle.
#[test]
fn an_even_slab_transmits_by_beers_law() {
    let engine = engine();
    let size = UVec2::new(16, 16);
    let straight = |z: f64, elevation_deg: f64| {
        json!({"position_m": [0, 0, z], "direction": {"azimuth_deg": 0, "elevation_deg": elevation_deg},
               "projection": {"kind": "perspective", "vertical_fov_deg": 0.1}})
    };
    let mut faults = Vec::new();
    for (camera, way_m) in [
        (straight(2.0, 90.0), 1000.0),
        (straight(1400.0, 90.0), 600.0),
        (straight(5000.0, -90.0), 1000.0),
        // On a planet of 6360 km the way to the top at an angle, from the law of cosines.
        (straight(2.0, 30.0), slant(30.0, 1000.0, 2000.0)),
    ] {
        for extinction_per_m in [1e-4, 1e-3, 3e-3] {
            let scene = slab(extinction_per_m, camera.clone());
            let expected = (-extinction_per_m * way_m).exp();
            let found = look(&engine.gpu, &scene, &SceneAssets::default(), size);
            let worst = found
                .iter()
                .map(|texel| (f64::from(texel[3]) / expected - 1.0).abs())
                .fold(0.0, f64::max);
            println!(
                "{camera} {extinction_per_m}: {worst:.2e}, {} for {expected}",
                found[0][3]
            );
            // What the product promises; a tenth of a degree of view changes the slanting way by 0.2 %.
            let allowed = if way_m > 1500.0 {
                1e-3 + 2e-3 * extinction_per_m * way_m
            } else {
                1e-3
            };
            if worst > allowed {
                faults.push(format!("{camera}, {extinction_per_m}: {worst:.2e}"));
            }
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}

/// Way between two heights along a ray from 2 m.
fn slant(elevation_deg: f64, from_m: f64, to_m: f64) -> f64 {
    let (r, sin) = (6.36e6 + 2.0, elevation_deg.to_radians().sin());
    let to = |h: f64| {
        let top = 6.36e6 + h;
        -r * sin + (r * r * (sin * sin - 1.0) + top * top).sqrt()
    };
    to(to_m) - to(from_m)
}

/// The first seed's first test: from the ground no pixel above the horizon shows the sky.
#[test]
fn full_coverage_covers_the_whole_sky() {
    let engine = engine();
    for (seed, layer) in [
        (
            1,
            json!({"kind": "volume", "base_m": 1500, "top_m": 4000, "type": 0.8}),
        ),
        (
            2,
            json!({"kind": "volume", "base_m": 700, "top_m": 1900, "type": 0.4}),
        ),
        (3, json!({"kind": "volume", "base_m": 1500, "top_m": 4000})),
    ] {
        let mut scene = cloudy(json!({"coverage": 1, "seed": seed, "layers": [layer]}));
        scene.camera = serde_json::from_value(json!({
            "position_m": [0, 0, 2], "direction": {"azimuth_deg": 0, "elevation_deg": 90},
            "projection": {"kind": "fisheye", "fov_deg": 178}}))
        .unwrap();
        let size = UVec2::new(48, 48);
        let found = look(&engine.gpu, &scene, &SceneAssets::default(), size);
        let mut most: f32 = 0.0;
        let (mut pixels, mut open) = (0, 0);
        for (k, texel) in (0_u32..).zip(&found) {
            let from_middle = (glam::Vec2::new((k % 48) as f32, (k / 48) as f32) - 23.5).length();
            if from_middle < 23.5 {
                pixels += 1;
                open += u32::from(texel[3] >= 0.5);
                most = most.max(texel[3]);
            }
        }
        println!("seed {seed}: most {most}, {open} of {pixels} pixels open");
        // What the product promises.
        assert!(most < 0.5, "seed {seed}: {most}, {open} of {pixels} pixels");
    }
}
