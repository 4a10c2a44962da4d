//! The volume of light in the air against the integral along the ray, cut where something stands.

use super::{engine, evaluate};
use crate::{
    cpu::phase::{cornette_shanks, rayleigh},
    gpu::Gpu,
    kernel::Recorder,
    method::Plan,
    passes::{
        aerial::{Aerial, AerialVolumes},
        multi_scattering::{MultiScatteringPass, Wanted},
        transmittance::Transmittance,
    },
    prepared::Tables,
    shader,
    uniforms::{AirUniform, Part, Standpoint},
};
use glam::DVec3;
use std::sync::Arc;
use welkin_scene::{Direction, Quality, Scene, SunPosition};
use wgpu::BindingResource;

/// The tables of a scene's air.
pub(super) fn tables(gpu: &Gpu, scene: &Scene, quality: Quality) -> Tables {
    let uniform = AirUniform::new(scene);
    let (asymmetry, plan) = (f64::from(uniform.mie_asymmetry), Plan::new(scene, &uniform));
    let air = Part::new(&uniform);
    let mut recorder = Recorder::new(gpu);
    let transmittance = Transmittance::new(gpu).run(&mut recorder, &air, plan.table_steps());
    let wanted = Wanted::new(scene, quality, uniform.multiple > 0.0);
    let multi_scattering =
        MultiScatteringPass::new().run(&mut recorder, &air, asymmetry, &transmittance, wanted);
    recorder.finish(&[], |_| ()).unwrap();
    Tables {
        plan,
        air,
        stand: Standpoint::new(scene),
        transmittance,
        multi_scattering,
    }
}

fn volumes(gpu: &Gpu, tables: &Tables, quality: Quality) -> Arc<AerialVolumes> {
    let mut recorder = Recorder::new(gpu);
    let reads = (&*tables.transmittance, &tables.multi_scattering.source);
    let volumes = Aerial::new().run(
        &mut recorder,
        &tables.air,
        &tables.stand,
        reads,
        tables.plan,
        quality,
    );
    recorder.finish(&[], |_| ()).unwrap();
    volumes
}

fn scene(altitude_m: f64, sun_deg: f64) -> Scene {
    let mut scene = Scene::clear();
    scene.camera.position_m = [0.0, 0.0, altitude_m];
    scene.sun.position = SunPosition::Direction(Direction::angles(0.0, sun_deg));
    scene
}

/// Ways into the air, metres; the last is all of it.
const WAYS_M: [f32; 5] = [300.0, 3e3, 2e4, 1e5, 1e9];

/// Cosines with zenith and sun, azimuth from the sun, a way; both phase functions.
fn rows(scene: &Scene, stand: &Standpoint) -> Vec<[f32; 8]> {
    let sun = DVec3::from_array(scene.sun_direction());
    let r = scene.planet.radius_m;
    let horizon = -(r / (r + stand.altitude_m)).acos().to_degrees();
    let asymmetry = scene.atmosphere.as_ref().unwrap().mie.as_ref().unwrap().asymmetry;
    let mut rows = Vec::new();
    for over in [-70.0, -25.0, -6.0, -1.0, 0.5, 1.7, 4.0, 12.0, 30.0, 70.0] {
        for azimuth in [2.0, 17.0, 45.0, 100.0, 140.0, 178.0_f64] {
            let view = DVec3::from_array(Direction::angles(azimuth, (horizon + over).min(89.0)).unit());
            let nu = view.dot(sun);
            for way_m in WAYS_M {
                rows.push([
                    view.z as f32,
                    nu as f32,
                    azimuth.to_radians() as f32,
                    way_m,
                    rayleigh(nu) as f32,
                    cornette_shanks(nu, asymmetry) as f32,
                    0.0,
                    0.0,
                ]);
            }
        }
    }
    rows
}

const RAY: &str = "
    let met_m = distance_to_sphere(air.radius_m, observer.altitude_m, a.x);
    let ground = met_m >= 0.0;
    var ray = enter_air(air, observer, a.x, a.y, ground, met_m);
    let whole_m = max(ray.length_m, 0.0);
    let way_m = min(a.w, whole_m);";

/// The worst errors of light, as a share of what is there and a floor, and of transmittance.
fn worst(altitude_m: f64, sun_deg: f64, quality: Quality) -> ((f64, String), (f64, String)) {
    let scene = scene(altitude_m, sun_deg);
    let engine = engine();
    let gpu = &engine.gpu;
    let air = tables(gpu, &scene, quality);
    let volumes = volumes(gpu, &air, quality);
    let rows = rows(&scene, &air.stand);
    let uniform = air.air.upload(gpu, "air");
    let observer = Part::new(&air.stand.observer(air.plan.pixel_steps())).upload(gpu, "observer");
    let exact = format!(
        "{RAY}
        if way_m > 0.0 {{
            ray.length_m = way_m;
            let march = March(true, true, false, false, 512u, 4u, 0u);
            let l = scatter_along(air, ray, transmittance_table, source_table, linear_clamp, march);
            x = vec4f(b.x * l.rayleigh + b.y * l.mie + l.multiple, way_m);
            y = vec4f(exp(-l.optical_depth), 0.0);
        }}"
    );
    let view = |view| BindingResource::TextureView(view);
    let clamp = BindingResource::Sampler(&gpu.linear_clamp);
    let binds = [
        (0, uniform.as_entire_binding()),
        (1, observer.as_entire_binding()),
        (2, view(&air.transmittance.view)),
        (3, clamp.clone()),
        (4, view(&air.multi_scattering.source.view)),
    ];
    let expected = evaluate(gpu, &shader::AERIAL, &exact, &rows, &binds);
    let tabled = format!(
        "{RAY}
        if way_m > 0.0 {{
            let sky_ray = SkyViewRay(a.z, angle_of_cosine(a.x), ground, select(1e12, met_m, ground));
            let l = aerial_to(air, aerial_rayleigh, aerial_mie, aerial_multiple, linear_clamp, observer.altitude_m,
                sky_ray, way_m, whole_m);
            x = vec4f(b.x * l.rayleigh + b.y * l.mie + l.multiple, way_m);
            y = vec4f(exp(-l.optical_depth), 0.0);
        }}"
    );
    let binds = [
        (8, uniform.as_entire_binding()),
        (11, clamp),
        (14, view(&volumes.rayleigh)),
        (15, view(&volumes.mie)),
        (16, view(&volumes.multiple)),
        (24, observer.as_entire_binding()),
    ];
    let found = evaluate(gpu, &shader::CLOUD_VIEW_LIGHT, &tabled, &rows, &binds);
    let (mut light, mut left) = ((0.0, String::new()), (0.0, String::new()));
    for ((row, expected), found) in rows.iter().zip(&expected).zip(&found) {
        for c in 0..3 {
            let [was, is] = [expected[c], found[c]].map(f64::from);
            let off = (is - was).abs() / was.max(FLOOR);
            let elevation = f64::from(row[0]).asin().to_degrees();
            let case = || {
                let azimuth = row[2].to_degrees();
                format!(
                    "{elevation:.2}° at {azimuth:.0}°, {} m, band {c}: {is:.3e} for {was:.3e}",
                    row[3]
                )
            };
            if off > light.0 {
                light = (off, case());
            }
            let off = f64::from((found[4 + c] - expected[4 + c]).abs());
            if off > left.0 {
                left = (off, case());
            }
        }
    }
    (light, left)
}

/// 1/sr: a fiftieth of a blue sky.
const FLOOR: f64 = 1e-3;

/// Every direction and way from that height, under suns and with the shares of light and of transmittance that may be off.
fn survey(quality: Quality, altitude_m: f64, suns: &[(f64, f64)], most_left: f64) {
    for (sun_deg, most_light) in suns {
        let ((light, at), (left, there)) = worst(altitude_m, *sun_deg, quality);
        assert!(
            light < *most_light,
            "{quality:?}, {altitude_m} m, sun {sun_deg}°: {light} at {at}"
        );
        assert!(
            left < most_left,
            "{quality:?}, {altitude_m} m, sun {sun_deg}°: {left} at {there}"
        );
    }
}

// Measured: half to four fifths of what is allowed here. With the sun down, the edge of the planet's shadow falls between
// the volume's rows, where the air is a hundred times darker than by day.

#[test]
fn the_final_volume_is_the_integral_up_to_every_distance() {
    for altitude_m in [2.0, 1e3, 1e4] {
        survey(
            Quality::Final,
            altitude_m,
            &[(60.0, 0.012), (15.0, 0.012), (2.0, 0.017), (-3.0, 0.25)],
            0.006,
        );
    }
}

#[test]
fn the_volume_of_a_preview_is_near_the_integral() {
    for altitude_m in [2.0, 1e4] {
        survey(
            Quality::Preview,
            altitude_m,
            &[(60.0, 0.02), (15.0, 0.025), (2.0, 0.03), (-3.0, 0.25)],
            0.008,
        );
    }
}

/// From above, the rows span air that is thin and then thick.
#[test]
fn the_volume_seen_from_space_is_the_integral() {
    survey(
        Quality::Final,
        4e5,
        &[(60.0, 0.03), (15.0, 0.03), (2.0, 0.06)],
        0.006,
    );
    survey(
        Quality::Preview,
        4e5,
        &[(60.0, 0.06), (15.0, 0.1), (2.0, 0.15)],
        0.02,
    );
}
