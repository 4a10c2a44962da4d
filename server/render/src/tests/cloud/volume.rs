//! The volume in which the light's way is followed holds the clouds that are marched through.

use super::{Ready, VOLUME, cloudy, passes};
use crate::{
    cloud_sky::CloudSky,
    kernel::Recorder,
    passes::{Table, cloud_volume::CloudVolume},
    shader,
    tests::{engine, evaluate},
    uniforms::Part,
};
use serde_json::{Value, json};
use std::sync::Arc;
use welkin_scene::{Quality, Scene};
use wgpu::BindingResource;

/// A thick layer and a thin one within its height.
fn scene(place_m: [f64; 3]) -> Scene {
    let mut scene = cloudy(json!({
        "precipitation": 0.5,
        "layers": [
            {"kind": "volume", "base_m": 800, "top_m": 9000, "type": 1.0, "coverage": 0.6},
            {"kind": "volume", "base_m": 1200, "top_m": 1900, "type": 0.4, "coverage": 0.7},
        ],
    }));
    scene.camera.position_m = place_m;
    scene
}

/// What is found in the volume, and without it, at places along the ground and shares of one layer's height.
fn both(scene: &Scene, rows: impl Fn(&Table) -> Vec<[f32; 8]>) -> Vec<[f64; 2]> {
    let engine = engine();
    let gpu = &engine.gpu;
    let ready = Ready::new(gpu, &mut passes(), scene);
    let sky = CloudSky::new(scene).unwrap();
    let clouds = Part::new(&sky.uniform(1.0));
    let mut recorder = Recorder::new(gpu);
    let volume: Arc<Table> = CloudVolume::new().run(
        &mut recorder,
        &ready.textures,
        &clouds,
        (2, sky.one_layer()),
        Quality::Final,
    );
    recorder.finish(&[], |_| ()).unwrap();
    let mut binds = ready.binds(gpu, &VOLUME);
    binds.push((11, BindingResource::Sampler(&gpu.linear_clamp)));
    binds.push((21, BindingResource::TextureView(&volume.view)));
    // `a` is the way along the ground, the share of the layer's height, and which layer.
    let statement = "
        let index = u32(a.w);
        let layer = clouds.layers[index];
        let altitude_m = layer.base_m + a.z / layer.inverse_thickness_per_m;
        let levels = f32(textureDimensions(cloud_volume).z / 2u);
        x.x = textureSampleLevel(cloud_volume, linear_clamp, volume_coordinate(index, 2u, a.xy, a.z, levels), 0.0).r;
        let weather = weather_at(a.xy);
        x.y = densest_per_m(layer, weather) * layer_density(layer, weather, a.xy, altitude_m, COARSE).value;";
    let found = evaluate(gpu, &shader::CLOUD_VIEW_LIGHT, statement, &rows(&volume), &binds);
    found.iter().map(|row| [row[0], row[1]].map(f64::from)).collect()
}

const PLACE_M: [f64; 3] = [3000.0, -7000.0, 2.0];

/// `VOLUME_REACH_M` of `lib/cloud_volume.wgsl`.
const REACH_M: f64 = 120_000.0;

#[test]
fn texels_are_the_clouds() {
    let found = both(&scene(PLACE_M), |volume| {
        let texture = volume.view.texture();
        let (side, levels) = (f64::from(texture.width()), texture.depth_or_array_layers() / 2);
        let along = |texel: u32, axis: usize| {
            let u = 2.0 * (f64::from(texel) + 0.5) / side - 1.0;
            PLACE_M[axis] + REACH_M * u * u.abs()
        };
        (0..4000_u32)
            .map(|k| {
                let texel = [k * 37 % texture.width(), k * 101 % texture.width()];
                let share = (f64::from(k * 7 % levels) + 0.5) / f64::from(levels);
                let [x, y] = [along(texel[0], 0), along(texel[1], 1)];
                [x, y, share, f64::from(k % 2), 0.0, 0.0, 0.0, 0.0].map(|v| v as f32)
            })
            .collect()
    });
    let most = found.iter().map(|[_, exact]| *exact).fold(0.0, f64::max);
    let cloudy = found.iter().filter(|[_, exact]| *exact > 0.0).count();
    assert!(cloudy > 400, "few of the places have cloud: {cloudy}");
    let worst = found
        .iter()
        .map(|[kept, exact]| (kept - exact).abs())
        .fold(0.0, f64::max);
    println!("worst of {cloudy}: {} of {most}", worst / most);
    // Devices place a sample to 1/256 of a texel, between neighbours of which one may be clear.
    assert!(worst < 0.01 * most, "{worst} of {most}");
}

/// Between texels, near the observer and far away: no cloud is won or lost.
#[test]
fn the_mean_is_that_of_the_clouds() {
    for far_m in [2e4, 1e5] {
        let found = both(&scene(PLACE_M), |_| {
            (0..40_000_u32)
                .map(|k| {
                    let even = |a: f64| (f64::from(k) * a).fract();
                    let [x, y] = [(0.819_172_5, 0), (0.671_043_6, 1)]
                        .map(|(a, axis)| PLACE_M[axis] + far_m * (2.0 * even(a) - 1.0));
                    [x, y, even(0.549_700_5), f64::from(k % 2), 0.0, 0.0, 0.0, 0.0].map(|v| v as f32)
                })
                .collect()
        });
        let sums = found
            .iter()
            .fold([0.0; 2], |sum, row| [sum[0] + row[0], sum[1] + row[1]]);
        println!("within {far_m} m: {}", sums[0] / sums[1]);
        // 40 000 places of which a seventh has cloud leave a percent of chance.
        assert!((sums[0] / sums[1] - 1.0).abs() < 0.03, "{far_m} m: {sums:?}");
    }
}

/// Whose light is followed to its ends gets it exact: what others read of the volume is within a few percent of that.
#[test]
fn light_read_in_the_volume_is_that_of_the_clouds() {
    use crate::{
        engine::Engine,
        frame_job::{FrameJob, TileBudget},
    };
    use welkin_scene::renderer::{FrameOrder, Output, Pixels, Priority};
    let seen = |clouds: Value| {
        let mut engine: std::sync::MutexGuard<'_, Engine> = engine();
        let mut scene = cloudy(clouds);
        scene.sun.disc = false;
        let order = FrameOrder {
            scene: Arc::new(scene),
            assets: Arc::default(),
            width_px: 96,
            height_px: 64,
            quality: Quality::Final,
            output: Output::Linear,
            priority: Priority::Interactive,
        };
        let mut job = FrameJob::new(order, None);
        let mut budget = TileBudget::default();
        loop {
            if let Some(frame) = job.step(&mut engine, &mut budget).unwrap() {
                match &frame.pixels {
                    Pixels::Linear(values) => return values.clone(),
                    Pixels::Display(_) => unreachable!("radiance was ordered"),
                }
            }
        }
    };
    let [read, exact] = [63, 64].map(|steps| seen(json!({"light_steps": steps})));
    let apart: f64 = read
        .iter()
        .zip(&exact)
        .map(|(a, b)| f64::from(a - b).powi(2))
        .sum();
    let whole: f64 = exact.iter().map(|v| f64::from(*v).powi(2)).sum();
    let error = (apart / whole).sqrt();
    println!("{error}");
    // Texels are 200 m apart where the clouds are seen: rims are blurred by as much, which is 2 % here and may be more on
    // a device that samples otherwise. Zero would mean that none was read.
    assert!(error > 1e-5 && error < 0.03, "{error}");
}
