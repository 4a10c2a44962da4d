//! What half-lit air loses, against the integral by hand.

use crate::{
    shader,
    tests::{engine, evaluate},
    uniforms::{
        AirUniform, Part, Standpoint, ViewUniform,
        clouds::{CloudFrameUniform, ShadeUniform},
        ground::{GroundShadowUniform, GroundUniform, ShaftsUniform},
    },
};
use glam::{DVec3, Vec3};
use std::f64::consts::PI;
use welkin_scene::Scene;
use wgpu::{BindingResource, BufferUsages};

/// Even haze, the sun in the zenith, and a shadow that fills all on one side of an upright plane. From its dark side a level
/// ray comes out into the light after a way L. Lost is E e^{-σ(H-h)} p σ_s (1 - e^{-σL})/σ: over some kilometres the planet
/// falls by a metre, of which the haze notices a thousandth.
#[test]
fn half_lit_air_loses_what_the_integral_says() {
    const EXTINCTION: f64 = 1.2e-4;
    let engine = engine();
    let gpu = &engine.gpu;
    let scene: Scene = serde_json::from_value(serde_json::json!({
        "camera": {"position_m": [0, 0, 500]},
        "sun": {"position": {"azimuth_deg": 90, "elevation_deg": 90}},
        "atmosphere": {"density_factor": 1e-9},
        "haze": {"extinction_per_m": EXTINCTION, "top_m": 1000, "albedo": 0.9},
    }))
    .unwrap();
    let air = AirUniform::new(&scene);
    let asymmetry = f64::from(air.mie_asymmetry);
    let stand = Standpoint::new(&scene);
    let shadow = GroundShadowUniform {
        right: Vec3::X,
        size_px: 64,
        up: Vec3::Y,
        lift_px: 1.0,
        light: Vec3::Z,
        middle_m: Vec3::ZERO,
        half_m: Vec3::new(16_000.0, 16_000.0, 2_000.0),
    };
    // West of the middle everything is dark: what hides the sun lies as high as the map reaches.
    let words: Vec<u32> = (0..64 * 32)
        .map(|i| if i % 32 < 16 { u32::MAX } else { 0 })
        .collect();
    let map = gpu.filled("map", bytemuck::cast_slice(&words), BufferUsages::STORAGE);
    // No optical depth but the haze's.
    let (table, maps) = (gpu.table("none", 16, 16, 1), gpu.table("none", 16, 16, 2));
    let mut rows = Vec::new();
    for way_m in [1_000.0_f32, 3_000.0, 8_000.0] {
        for k in 0..16 {
            rows.push([1.0, 0.0, 0.0, way_m, (k as f32 + 0.5) / 16.0, 0.0, 0.0, 0.0]);
        }
    }
    let observer_at = |way_m: f64| GroundUniform {
        east: Vec3::X,
        north: Vec3::Y,
        up: Vec3::Z,
        radius_m: 6.36e6,
        place_m: DVec3::new(-way_m, 0.0, 500.0).as_vec3(),
        ..GroundUniform::default()
    };
    for chunk in rows.chunks_exact(16) {
        let way_m = f64::from(chunk[0][3]);
        let parts = [
            Part::new(&observer_at(way_m)),
            Part::new(&shadow),
            Part::new(&air),
            Part::new(&ViewUniform::new(&scene.sun, &stand)),
            Part::new(&CloudFrameUniform {
                place_m: Vec3::new(0.0, 0.0, 500.0),
                light: Vec3::Z,
            }),
            Part::new(&ShaftsUniform {
                steps: 64,
                ..ShaftsUniform::default()
            }),
            Part::new(&ShadeUniform::default()),
        ]
        .map(|part| part.upload(gpu, "part"));
        let binds = [
            (0, parts[0].as_entire_binding()),
            (1, parts[1].as_entire_binding()),
            (2, map.as_entire_binding()),
            (3, parts[2].as_entire_binding()),
            (4, parts[3].as_entire_binding()),
            (7, BindingResource::TextureView(&table)),
            (8, BindingResource::Sampler(&gpu.linear_clamp)),
            (9, parts[6].as_entire_binding()),
            (10, BindingResource::TextureView(&maps)),
            (11, parts[4].as_entire_binding()),
            (12, parts[5].as_entire_binding()),
        ];
        let statements = "x = vec4f(lost_along(a.xyz, 1.4e4, b.x, 0.0).light, 0.0);";
        let found = evaluate(gpu, &shader::SHAFTS, statements, chunk, &binds);
        // The mean over all jitters, as neighbouring pixels have them.
        let mean = found.iter().map(|f| f64::from(f[1])).sum::<f64>() / found.len() as f64;
        let g = asymmetry;
        let phase = 3.0 / (8.0 * PI) * (1.0 - g * g) / ((2.0 + g * g) * (1.0 + g * g).powf(1.5));
        let sun = scene.sun.irradiance_w_m2[1] * (-EXTINCTION * 500.0).exp();
        let expected = sun * phase * 0.9 * (1.0 - (-EXTINCTION * way_m).exp());
        assert!(
            (mean / expected - 1.0).abs() < 0.01,
            "{way_m} m: {mean} {expected}"
        );
    }
}
