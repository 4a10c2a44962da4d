//! The night's functions on the device against their f64 twins, and its uniforms as the shaders read them.

use super::{engine, evaluate};
use crate::{
    cpu::{airglow::length_from_the_ground, geometry::Ray, moon::on_disc},
    moon_face,
    moonlight::{Moonlight, Uncovered},
    shader,
    uniforms::{Part, night::MoonUniform},
};
use glam::DVec3;
use serde_json::json;
use welkin_scene::{Airglow, Scene};

#[test]
fn lengths_in_the_shell_are_their_twins() {
    const RADIUS_M: f64 = 6.36e6;
    let glow = Airglow::default();
    let mut rows = Vec::new();
    for altitude_m in [0.0, 2.0, 1e4, 8.4e4, 9e4, 1e5, 4e5, 3.6e7] {
        for k in 0..=200 {
            let mu = -1.0 + f64::from(k) / 100.0;
            rows.push([altitude_m as f32, mu as f32, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        }
    }
    let statement = "let ground_m = distance_to_sphere(6.36e6, a.x, a.y);
        let length_m = select(1e12, ground_m, ground_m >= 0.0);
        x = vec4f(lengths_in_shell(6.36e6, 85000.0, 97000.0, a.x, a.y, length_m), 0.0, 0.0);";
    let engine = engine();
    for (row, found) in rows
        .iter()
        .zip(evaluate(&engine.gpu, &shader::SKY, statement, &rows, &[]))
    {
        let (altitude_m, mu) = (f64::from(row[0]), f64::from(row[1]));
        let ray = Ray::new(
            RADIUS_M,
            altitude_m,
            DVec3::new((1.0 - mu * mu).max(0.0).sqrt(), 0.0, mu),
        );
        let end = ray.ground(RADIUS_M).unwrap_or(1e12);
        let inside = |sphere_m: f64| {
            ray.crossing(RADIUS_M + sphere_m)
                .map_or([0.0; 2], |(a, b)| [a.clamp(0.0, end), b.clamp(0.0, end)])
        };
        let ([enters, leaves], [dips, rises]) = (inside(glow.top_m), inside(glow.base_m));
        let whole = (leaves - enters) - (rises - dips);
        // f32: from 36 000 km the ray's distance to the centre is known to some metres, of a chord of up to 800 km.
        let allowed = 30.0 + 2e-6 * altitude_m + 1e-3 * whole;
        let sum = f64::from(found[0] + found[1]);
        assert!(
            (sum - whole).abs() < allowed,
            "{altitude_m} {mu}: {found:?} {whole}"
        );
        // From below everything lies behind the air, from above before it if the ray falls to the ground.
        assert!(
            altitude_m > glow.base_m || found[0] == 0.0,
            "{altitude_m} {mu}: {found:?}"
        );
        assert!(
            end > 1e11 || altitude_m < glow.top_m || found[1] == 0.0,
            "{altitude_m} {mu}: {found:?}"
        );
        if altitude_m == 0.0 && mu >= 0.0 {
            assert!((whole - length_from_the_ground(RADIUS_M, &glow, mu)).abs() < 1e-3);
        }
    }
}

#[test]
fn the_moons_face_is_its_twin() {
    let engine = engine();
    let gpu = &engine.gpu;
    let face = gpu.picture("face", moon_face::SIDE as u32, moon_face::face());
    for phase_angle_deg in [0.0, 60.0, 120.0, 175.0] {
        let moon = json!({"position": {"azimuth_deg": 130, "elevation_deg": 50}, "phase_angle_deg": phase_angle_deg});
        let scene = Scene::from_value(&json!({"moon": moon})).unwrap();
        let seen = scene.moon_seen().unwrap();
        let light = Moonlight::new(scene.moon.as_ref().unwrap(), &seen, &scene.sun);
        let uniform = MoonUniform::new(true, false, &seen, &light, Uncovered { disc: 1.0, sky: 1.0 });
        let uniform = Part::new(&uniform).upload(gpu, "moon");
        let mut rows = Vec::new();
        for k in 0..2000_u32 {
            let (r, turn) = ((f64::from(k) / 2000.0).sqrt() * 1.05, f64::from(k) * 2.399_963);
            rows.push([
                (r * turn.cos()) as f32,
                (r * turn.sin()) as f32,
                0.0,
                0.0,
                0.0,
                0.0,
                0.0,
                0.0,
            ]);
        }
        // The direction of a place on the disc, so that the way back is tested too.
        let statement = "let s = sin(0.5 * moon.angular_radius) * length(a.xy);
            let sine = 2.0 * s * sqrt(1.0 - s * s);
            let across = sine * normalize(a.xy + vec2f(1e-9, 0.0));
            let direction = (1.0 - 2.0 * s * s) * moon.direction + across.x * moon.east + across.y * moon.north;
            let place = place_on_moon(moon, moon.angular_radius, direction);
            x = vec4f(moon_radiance(moon, moon_face, linear_clamp, a.xy), 0.0);
            y = vec4f(place, 0.0, 0.0);";
        let binds = [
            (6, wgpu::BindingResource::Sampler(&gpu.linear_clamp)),
            (12, uniform.as_entire_binding()),
            (15, wgpu::BindingResource::TextureView(&face)),
        ];
        let brightest = (light.radiance_w_m2_sr + light.earthshine_w_m2_sr).max_element();
        for (row, found) in rows
            .iter()
            .zip(evaluate(gpu, &shader::SKY, statement, &rows, &binds))
        {
            let (x, y) = (f64::from(row[0]), f64::from(row[1]));
            let expected = on_disc(&light, x, y);
            for c in 0..3 {
                let off = (f64::from(found[c]) - expected[c]).abs();
                // Samplers place a texel in 256 steps; at the very limb the law's slope has no end.
                let rim = (1.0 - x.hypot(y)).abs() < 2e-3;
                assert!(
                    rim || off < 0.01 * brightest,
                    "{phase_angle_deg} {row:?}: {found:?} {expected}"
                );
            }
            // A disc of a quarter of a degree in directions of f32: 6e-8 / 0.0045.
            assert!(
                (f64::from(found[4]) - x).abs() < 1e-4 && (f64::from(found[5]) - y).abs() < 1e-4,
                "{row:?} {found:?}"
            );
        }
    }
}
