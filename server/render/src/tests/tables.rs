//! Mappings of tables and their inverses by round trip at texel centres; the transmittance table against quadrature.

use super::{engine, evaluate};
use crate::{
    cpu::air::optical_depth_to_space,
    gpu::Gpu,
    kernel::Recorder,
    passes::transmittance::Transmittance,
    shader,
    uniforms::{AirUniform, Part},
};
use welkin_scene::{Haze, Scene};

const RADIUS_M: f32 = 6.36e6;
const TOP_M: f32 = 1e5;

#[test]
fn transmittance_texels_come_back() {
    let engine = engine();
    let (width, height) = (256_u32, 128_u32);
    let unit = |i: u32, n: u32| i as f32 / (n - 1) as f32;
    let rows: Vec<[f32; 8]> = (0..height)
        .flat_map(|y| {
            (0..width).map(move |x| [unit(x, width), unit(y, height), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
        })
        .collect();
    let there = "let p = transmittance_point(6.36e6, 1e5, a.xy); x = vec4f(p.altitude_m, p.mu, 0.0, 0.0);";
    let back = "x = vec4f(transmittance_unit(6.36e6, 1e5, HeightCosine(a.x, a.y)), 0.0, 0.0);";
    let points = evaluate(&engine.gpu, &shader::TRANSMITTANCE, there, &rows, &[]);
    let units = evaluate(&engine.gpu, &shader::PROBE, back, &points, &[]);
    for ((row, point), unit) in rows.iter().zip(&points).zip(&units) {
        // Just under the top, all directions that rise are within d_max - d_min = √(2 R top) of each other and mu
        // rounds at 6e-8: 6e-8 · 6.36e6 m of 1.1e6 m, and more where mu falls steeply with d.
        let allowed = 0.02 / 255.0;
        assert!(
            (unit[0] - row[0]).abs() < allowed || point[0] > 0.999 * TOP_M,
            "{row:?} {point:?} {unit:?}"
        );
        assert!((unit[1] - row[1]).abs() < 1e-5, "{row:?} {point:?} {unit:?}");
    }
}

#[test]
fn multi_scattering_texels_come_back() {
    let engine = engine();
    let (width, height) = (64_u32, 32_u32);
    let rows: Vec<[f32; 8]> = (0..height)
        .flat_map(|y| (0..width).map(move |x| [x as f32, y as f32, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]))
        .collect();
    let round = "let p = multi_scattering_point(air, vec2u(a.xy), vec2u(64u, 32u));
        x = vec4f(multi_scattering_unit(air, HeightCosine(p.altitude_m, p.mu_s), p.in_haze, 32u), p.altitude_m, p.mu_s);
        y.x = f32(p.in_haze);";
    for haze in [None, Some(Haze::default())] {
        let scene = Scene {
            haze: haze.clone(),
            ..Scene::clear()
        };
        let uniform = Part::new(&AirUniform::new(&scene)).upload(&engine.gpu, "air");
        let binds = [(0, uniform.as_entire_binding())];
        for (row, found) in rows.iter().zip(evaluate(
            &engine.gpu,
            &shader::MULTI_SCATTERING,
            round,
            &rows,
            &binds,
        )) {
            // Roundings of a square and its root.
            let (x, y) = (row[0] / 63.0, (row[1] + 0.5) / 32.0);
            assert!(
                (found[0] - x).abs() < 1e-6 && (found[1] - y).abs() < 1e-6,
                "{row:?} {found:?}"
            );
            // The ends of both axes are stored exactly: ground, the haze's top on both sides, the air's top, sun at the
            // nadir and at the zenith.
            let haze_top_m = haze.as_ref().map_or(0.0, |haze| haze.top_m as f32);
            let exact = match (row[1] as u32, &haze) {
                (0, _) => Some(0.0),
                (15 | 16, Some(_)) => Some(haze_top_m),
                (31, _) => Some(TOP_M),
                _ => None,
            };
            if let Some(altitude_m) = exact {
                assert_eq!(found[2], altitude_m, "{row:?}");
            }
            assert_eq!(found[4] > 0.0, haze.is_some() && row[1] < 16.0, "{row:?}");
            if x == 0.0 || x == 1.0 {
                assert_eq!(found[3], 2.0 * x - 1.0);
            }
        }
    }
}

#[test]
fn sky_view_texels_come_back() {
    let engine = engine();
    let (width, height) = (64_u32, 256_u32);
    for altitude_m in [0.0_f32, 2.0, 100.0, 1e4, 99_999.0, 1e5, 100_001.0, 4e5, 4e7] {
        let rows: Vec<[f32; 8]> = (0..height)
            .flat_map(|y| (0..width).map(move |x| [x as f32, y as f32, altitude_m, 0.0, 0.0, 0.0, 0.0, 0.0]))
            .collect();
        let there = "let r = sky_view_ray(6.36e6, 1e5, a.z, vec2u(a.xy), vec2u(64u, 256u));
            x = vec4f(r.azimuth, r.zenith_angle, f32(r.ground), r.distance_m); y = vec4f(a.z, 0.0, 0.0, 0.0);";
        let back = "let r = SkyViewRay(a.x, a.y, a.z > 0.5, a.w);
            x = vec4f(sky_view_coordinate(6.36e6, 1e5, b.x, r, vec2u(64u, 256u)), 0.0, 0.0);";
        let rays = evaluate(&engine.gpu, &shader::SKY_VIEW, there, &rows, &[]);
        let places = evaluate(&engine.gpu, &shader::SKY, back, &rays, &[]);
        for ((row, ray), place) in rows.iter().zip(&rays).zip(&places) {
            let centre = [(row[0] + 0.5) / width as f32, (row[1] + 0.5) / height as f32];
            assert!((place[0] - centre[0]).abs() < 1e-6, "{row:?} {ray:?} {place:?}");
            // On the ground no ray below the horizon has a length: all its rows are one.
            if altitude_m == 0.0 && row[1] < 128.0 {
                continue;
            }
            let texels = f64::from((place[1] - centre[1]).abs()) * f64::from(height);
            // Zenith angles round at 2e-7 beyond π/2, twice on the way. Above the horizon their root is taken, over all the
            // sky, or from outside over the air's thickness: 0.13° from 40,000 km.
            let (radius, h) = (f64::from(RADIUS_M), f64::from(altitude_m));
            let outside = (f64::from(TOP_M) + radius) / (radius + h);
            let span = if outside < 1.0 {
                outside.asin() - (radius / (radius + h)).asin()
            } else {
                1.6
            };
            let y = (f64::from(row[1]) - 128.0) / 127.0;
            let rounding = if y < 0.0 {
                0.0
            } else {
                127.0 * ((y * y + 5e-7 / span).sqrt() - y)
            };
            assert!(
                texels < 0.05 + rounding,
                "{altitude_m} {row:?} {ray:?} {place:?}: {texels}"
            );
        }
    }
}

/// Optical depths to the top as the table gives them between its texels.
fn depths(gpu: &Gpu, scene: &Scene, rays: &[(f64, f64)]) -> Vec<[f32; 8]> {
    let part = Part::new(&AirUniform::new(scene));
    let mut recorder = Recorder::new(gpu);
    let table = Transmittance::new(gpu).run(&mut recorder, &part, 64);
    recorder.finish(&[], |_| ()).unwrap();
    let uniform = part.upload(gpu, "air");
    let binds = [
        (0, uniform.as_entire_binding()),
        (3, wgpu::BindingResource::TextureView(&table.view)),
        (4, wgpu::BindingResource::Sampler(&gpu.linear_clamp)),
    ];
    let rows: Vec<[f32; 8]> = rays
        .iter()
        .map(|(h, mu)| [*h as f32, *mu as f32, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
        .collect();
    let statement = "x = vec4f(optical_depth_to_top(air, transmittance_table, linear_clamp, a.x, a.y), 0.0);";
    evaluate(gpu, &shader::PROBE, statement, &rows, &binds)
}

#[test]
fn the_transmittance_table_is_the_quadrature_between_its_texels_too() {
    let engine = engine();
    let mut scenes = vec![
        Scene::clear(),
        welkin_scene::preset("complutense").unwrap().scene.clone(),
    ];
    for density_factor in [0.3, 5.0] {
        let mut scene = Scene::clear();
        scene.atmosphere.as_mut().unwrap().density_factor = density_factor;
        scenes.push(scene);
    }
    for scene in scenes {
        let planet = &scene.planet;
        let mut rays = Vec::new();
        for h in [0.0_f64, 2.0, 37.0, 500.0, 1000.0, 5e3, 1e4, 2.5e4, 6e4, 9.9e4] {
            let r = planet.radius_m + h;
            let dip_deg = (planet.radius_m / r).acos().to_degrees();
            for over_deg in [0.02, 0.05, 0.1, 0.3, 1.0, 2.0, 5.0, 10.0, 20.0, 45.0, 70.0, 90.0] {
                let elevation_deg: f64 = over_deg * (90.0 + dip_deg) / 90.0 - dip_deg;
                // f32 holds the cosine that both see.
                rays.push((h, f64::from(elevation_deg.to_radians().sin() as f32)));
            }
        }
        for ((h, mu), found) in rays.iter().zip(depths(&engine.gpu, &scene, &rays)) {
            let expected = optical_depth_to_space(&scene, *h, *mu).unwrap();
            for i in 0..3 {
                let off = ((-f64::from(found[i])).exp() - (-expected[i]).exp()).abs();
                // Measured: 5e-4 where people live, 4e-3 from 60 km and above for a sun under the local horizon, whose
                // light comes through the densest air. There the table has few rows.
                let allowed = if *h <= 1e4 { 1e-3 } else { 5e-3 };
                assert!(
                    off < allowed,
                    "h = {h}, mu = {mu}, band {i}: {} {}",
                    found[i],
                    expected[i]
                );
            }
        }
    }
}
