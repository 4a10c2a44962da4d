//! Light scattered once: the probe against the brute-force twin, at suns, heights and airs that no oracle file has.

use super::engine;
use crate::{cpu::scattering::seen, passes::probe::Sight};
use glam::DVec3;
use welkin_scene::{Atmosphere, Direction, Orders, Planet, Scene, SunPosition, assets::SceneAssets};

/// Directions from an altitude: up, along the horizon on both sides of it, down; towards the sun, across and away.
fn directions(planet: &Planet, top_m: f64, altitude_m: f64) -> Vec<DVec3> {
    let edge_deg = |radius_m: f64| {
        -(radius_m / (planet.radius_m + altitude_m))
            .min(1.0)
            .acos()
            .to_degrees()
    };
    let horizon = edge_deg(planet.radius_m);
    let mut elevations = vec![horizon + 0.05, horizon - 0.5, horizon - 8.0, -89.9];
    if altitude_m > top_m {
        // Through the air over the limb.
        let rim = edge_deg(planet.radius_m + top_m);
        elevations.extend([0.1, 0.5, 0.9].map(|x| horizon + x * (rim - horizon)));
    } else {
        elevations.extend([horizon + 2.0, 10.0, 45.0, 89.9]);
    }
    let azimuths = [3.0, 75.0, 178.0];
    let all = elevations
        .iter()
        .flat_map(|e| azimuths.map(|a| Direction::angles(a, *e)));
    // A direction is f32 on the device; both sides shall see the same one.
    all.map(|d| DVec3::from_array(d.unit()).as_vec3().as_dvec3().normalize())
        .collect()
}

/// The worst relative error of the probe against the twin, with the case it stands in.
fn worst(air: &Atmosphere, altitudes_m: &[f64], suns_deg: &[f64]) -> (f64, String) {
    let mut worst = (0.0, String::new());
    for altitude_m in altitudes_m {
        for sun_deg in suns_deg {
            let mut scene = Scene {
                atmosphere: Some(Atmosphere {
                    orders: Orders::Single,
                    airglow: None,
                    ..air.clone()
                }),
                stars: None,
                ..Scene::clear()
            };
            scene.camera.position_m = [0.0, 0.0, *altitude_m];
            scene.planet.ground_albedo = [0.3, 0.2, 0.1];
            scene.sun.irradiance_w_m2 = [1.0; 3];
            scene.sun.position = SunPosition::Direction(Direction::angles(0.0, *sun_deg));
            let sun = DVec3::from_array(scene.sun_direction());
            let views = directions(&scene.planet, air.top_m, *altitude_m);
            let sights: Vec<_> = views
                .iter()
                .map(|v| Sight {
                    direction: *v,
                    disc: false,
                })
                .collect();
            let found = engine()
                .probe(&scene, &SceneAssets::default(), &sights)
                .unwrap()
                .0;
            for (view, found) in views.iter().zip(found) {
                let expected = seen(&scene, *altitude_m, *view, sun);
                for i in 0..3 {
                    // The product promises 1e-6 /sr besides the share; a tenth of it is a tenth of the darkest twilight
                    // that an 8-bit picture shows beside its brightest part.
                    let off = ((found.radiance[i] - expected.radiance[i]).abs() - 1e-7)
                        / expected.radiance[i].max(1e-12);
                    if off > worst.0 {
                        let elevation_deg = view.z.asin().to_degrees();
                        let case = format!(
                            "h = {altitude_m}, sun {sun_deg}°, view {elevation_deg:.2}° at {:.0}°, band {i}: {} for {}",
                            view.x.atan2(view.y).to_degrees(),
                            found.radiance[i],
                            expected.radiance[i]
                        );
                        worst = (off, case);
                    }
                    // Midpoints of 256 steps; from 40,000 km also a direction whose f32 is worth some metres at the limb.
                    let allowed = if *altitude_m > 1e7 { 1e-3 } else { 5e-5 };
                    let off = (found.transmittance[i] - expected.transmittance[i]).abs();
                    assert!(
                        off < allowed,
                        "transmittance from {altitude_m} m along {view}: {off}"
                    );
                }
            }
        }
    }
    println!("worst {:.2e}: {}", worst.0, worst.1);
    worst
}

const HEIGHTS_M: [f64; 5] = [2.0, 3e3, 35e3, 4e5, 4e7];

// The product promises 1 % with the sun above the horizon, 3 % below it.

#[test]
fn the_default_air_by_day() {
    let (off, case) = worst(&Atmosphere::default(), &HEIGHTS_M, &[90.0, 52.0, 20.0, 3.0, 0.5]);
    assert!(off < 0.01, "{case}");
}

#[test]
fn the_default_air_at_dusk() {
    let (off, case) = worst(&Atmosphere::default(), &HEIGHTS_M, &[-0.5, -4.0, -9.0, -15.0]);
    assert!(off < 0.03, "{case}");
}

#[test]
fn thin_and_thick_air() {
    for density_factor in [0.3, 5.0] {
        let air = Atmosphere {
            density_factor,
            ..Atmosphere::default()
        };
        let (off, case) = worst(&air, &[2.0, 1e4, 4e5], &[60.0, 10.0, 1.0]);
        assert!(off < 0.01, "density {density_factor}: {case}");
    }
}

#[test]
fn aerosols_that_scatter_forward_and_backward() {
    for asymmetry in [0.999, -0.7] {
        let mut air = Atmosphere::default();
        air.mie.as_mut().unwrap().asymmetry = asymmetry;
        let (off, case) = worst(&air, &[2.0, 1e4, 4e5], &[60.0, 10.0, 1.0]);
        assert!(off < 0.01, "g = {asymmetry}: {case}");
    }
}
