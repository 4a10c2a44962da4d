//! Vertical optical depth against the closed form, read as the probe's transmittance at the zenith.

use super::engine;
use crate::passes::probe::Sight;
use glam::DVec3;
use welkin_scene::{Atmosphere, Ozone, Scene, assets::SceneAssets, preset};

/// ∫ of the tent max(0, 1 - |h - c|/w) from h = 0 up: zero under the layer, parabolas inside it.
fn tent(ozone: &Ozone, h: f64) -> f64 {
    let x = ((h - ozone.centre_m) / ozone.half_width_m).clamp(-1.0, 1.0);
    let from_edge = |x: f64| {
        if x < 0.0 {
            0.5 * (1.0 + x).powi(2)
        } else {
            1.0 - 0.5 * (1.0 - x).powi(2)
        }
    };
    let ground = (-ozone.centre_m / ozone.half_width_m).clamp(-1.0, 1.0);
    ozone.half_width_m * (from_edge(x) - from_edge(ground))
}

fn closed_form(air: &Atmosphere) -> [f64; 3] {
    let exponential = |scale_m: f64| scale_m * (1.0 - (-air.top_m / scale_m).exp());
    [0, 1, 2].map(|i| {
        let rayleigh = air.rayleigh.as_ref().map_or(0.0, |r| {
            (r.scattering_per_m[i] + r.absorption_per_m[i]) * exponential(r.scale_height_m)
        });
        let mie = air.mie.as_ref().map_or(0.0, |m| {
            (m.scattering_per_m.rgb()[i] + m.absorption_per_m.rgb()[i]) * exponential(m.scale_height_m)
        });
        let ozone = air
            .ozone
            .as_ref()
            .map_or(0.0, |o| o.absorption_per_m[i] * tent(o, air.top_m));
        air.density_factor * (rayleigh + mie + ozone)
    })
}

#[test]
fn the_vertical_optical_depth_is_the_closed_form() {
    let layer = |centre_m: f64, half_width_m: f64| Atmosphere {
        rayleigh: None,
        mie: None,
        // Deep enough to be measured to 0.1 % in f32.
        ozone: Some(Ozone {
            absorption_per_m: [1e-5, 2e-5, 5e-6],
            centre_m,
            half_width_m,
        }),
        ..Atmosphere::default()
    };
    let airs = [
        Atmosphere::default(),
        preset("complutense").unwrap().scene.atmosphere.clone().unwrap(),
        Atmosphere {
            density_factor: 0.3,
            ..Atmosphere::default()
        },
        Atmosphere {
            mie: None,
            ozone: None,
            ..Atmosphere::default()
        },
        Atmosphere {
            rayleigh: None,
            ozone: None,
            ..Atmosphere::default()
        },
        // The top cuts two thirds of the molecules off.
        Atmosphere {
            top_m: 3e3,
            ..Atmosphere::default()
        },
        layer(25e3, 15e3),
        // Cut by the ground, by the top, by both, and a thin one.
        layer(5e3, 15e3),
        layer(95e3, 15e3),
        layer(50e3, 200e3),
        layer(60e3, 5e3),
    ];
    let mut engine = engine();
    for air in airs {
        let mut scene = Scene {
            atmosphere: Some(air.clone()),
            ..Scene::clear()
        };
        scene.camera.position_m = [0.0; 3];
        let zenith = Sight {
            direction: DVec3::Z,
            disc: false,
        };
        let seen = engine
            .probe(&scene, &SceneAssets::default(), &[zenith])
            .unwrap()
            .0;
        let expected = closed_form(&air);
        for i in 0..3 {
            let depth = -seen[0].transmittance[i].ln();
            // What the product promises.
            assert!(
                (depth / expected[i] - 1.0).abs() < 1e-3,
                "{air:?}: {depth} for {}",
                expected[i]
            );
        }
    }
}
