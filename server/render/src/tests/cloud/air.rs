//! The air under clouds: its light, and the table of what it loses.

use crate::{
    shader,
    tests::{aerial::tables, engine, evaluate},
    uniforms::{Part, ViewUniform, clouds::ShadeUniform},
};
use serde_json::json;
use std::f64::consts::PI;
use welkin_scene::{Quality, Scene};
use wgpu::BindingResource;

/// A furnace: between two decks that each send E/π, air that absorbs nothing is not seen.
#[test]
fn air_between_two_decks_is_not_seen() {
    let scene: Scene = serde_json::from_value(json!({
        "atmosphere": {"ozone": null, "mie": {"absorption_per_m": 0}},
        "sun": {"position": {"azimuth_deg": 0, "elevation_deg": 50}},
    }))
    .unwrap();
    let engine = engine();
    let gpu = &engine.gpu;
    let air = tables(gpu, &scene, Quality::Final);
    let (base_m, spread) = (800.0, 0.4);
    let parts = [
        air.air.clone(),
        Part::new(&ViewUniform::new(&scene.sun, &air.stand)),
        Part::new(&ShadeUniform {
            base_m,
            spread_left: spread,
            ..ShadeUniform::default()
        }),
    ]
    .map(|part| part.upload(gpu, "part"));
    let binds = [
        (8, parts[0].as_entire_binding()),
        (9, parts[1].as_entire_binding()),
        (10, parts[2].as_entire_binding()),
        (11, BindingResource::Sampler(&gpu.linear_clamp)),
        (12, BindingResource::TextureView(&air.transmittance.view)),
    ];
    let rows: Vec<_> = [1.0, 0.9, 0.5, 0.05, 0.0]
        .map(|left: f32| [left, left * left, left.powi(4), 0.0, 0.0, 0.0, 0.0, 0.0])
        .to_vec();
    let statements = "
        x = vec4f(scattered_under_clouds(air, view, shade, transmittance_table, linear_clamp, a.xyz), 0.0);
        y = vec4f(transmittance_to_space(air, transmittance_table, linear_clamp, shade.base_m, view.mu_s), 0.0);";
    let found = evaluate(gpu, &shader::CLOUD_VIEW_LIGHT, statements, &rows, &binds);
    for (row, found) in rows.iter().zip(found) {
        for c in 0..3 {
            let falling =
                scene.sun.irradiance_w_m2[c] * air.stand.up.dot(air.stand.sun) * f64::from(found[4 + c]);
            let sent = f64::from(spread) * falling / PI;
            let seen = 2.0 * f64::from(found[c]) + f64::from(row[c]) * sent;
            // A few roundings of f32.
            assert!(
                (seen / sent - 1.0).abs() < 1e-5,
                "{row:?}, band {c}: {seen} {sent}"
            );
        }
    }
}

/// Where a direction is looked up, and which one stands there.
#[test]
fn the_tables_directions_stand_where_they_are_looked_up() {
    let (width, height) = (37, 24);
    let engine = engine();
    for (up, horizon) in [
        ([0.0, 0.0, 1.0], -0.0008_f32),
        ([0.6, 0.0, -0.8], -0.3),
        ([0.36, 0.48, 0.8], -0.95),
    ] {
        let mut rows = Vec::new();
        for y in 0..height {
            for x in 0..width - 1 {
                rows.push([x as f32, y as f32, up[0], up[1], up[2], horizon, 0.0, 0.0]);
            }
        }
        let size = format!("vec2u({width}u, {height}u)");
        let statements =
            format!("x = vec4f(cloud_air_direction(vec2u(a.xy), {size}, vec3f(a.zw, b.x), b.y), 0.0);");
        let looks = evaluate(&engine.gpu, &shader::CLOUD_AIR, &statements, &rows, &[]);
        let towards: Vec<_> = looks
            .iter()
            .map(|d| [d[0], d[1], d[2], horizon, up[0], up[1], up[2], 0.0])
            .collect();
        let statements = format!(
            "x = vec4f(cloud_air_coordinate(a.xyz, {size}, b.xyz, a.w) * vec2f({size}) - 0.5, length(a.xyz), dot(a.xyz, b.xyz));"
        );
        let found = evaluate(&engine.gpu, &shader::CLOUD_VIEW_LIGHT, &statements, &towards, &[]);
        for (row, found) in rows.iter().zip(found) {
            assert!((found[2] - 1.0).abs() < 1e-5, "{row:?}: {found:?}");
            // Upper rows look at the sky, lower ones at the ground.
            assert_eq!(found[3] > horizon, row[1] < 12.0, "{row:?}: {found:?}");
            // The first rows look past the horizon by 1e-5 of a cosine, and f32 rounds by 1e-7: the root of that share of all that
            // is on this side. At zenith and nadir every azimuth is the same.
            let side = if row[1] < 12.0 {
                1.0 - horizon
            } else {
                1.0 + horizon
            };
            let lifted = 11.0 * (1.1e-5 / side).sqrt();
            let pole = row[1] == 11.0 || row[1] == 23.0;
            assert!((found[1] - row[1]).abs() < lifted, "{row:?}: {found:?}");
            let off = (found[0] - row[0] + 18.0).rem_euclid(36.0) - 18.0;
            assert!(pole || off.abs() < 0.01, "{row:?}: {found:?}");
        }
    }
}
