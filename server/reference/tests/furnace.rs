//! Nothing is lost and nothing is made: where no light is absorbed and radiance 1 comes from everywhere, all that is
//! seen is 1.
#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use serde_json::{Value, json};
use welkin_reference::{DVec3, Effort, Medium, View, diffuse_irradiance, furnace, radiance};

const EFFORT: Effort = Effort {
    batch: 100,
    relative_error: 0.0,
    most_batches: 60,
    seed: 7,
};

fn air(scene: &Value) -> Medium {
    Medium::from_scene(&serde_json::from_value(scene.clone()).unwrap()).unwrap()
}

fn view(altitude_m: f64, view_zenith_deg: f64) -> View {
    View {
        altitude_m,
        sun_zenith_deg: 40.0,
        view_zenith_deg,
        view_azimuth_deg: 70.0,
    }
}

#[test]
fn a_white_furnace_is_white() {
    let clear = json!({"atmosphere": {"mie": {"absorption_per_m": 0}, "ozone": null}});
    let mut foggy = clear.clone();
    foggy["haze"] = json!({"visibility_m": 2000, "top_m": 500, "albedo": 1});
    let mut peaked = clear.clone();
    peaked["atmosphere"]["mie"] = json!({"scattering_per_m": 1e-4, "absorption_per_m": 0, "asymmetry": 0.95});
    for scene in [clear, foggy, peaked] {
        let air = air(&scene);
        for (altitude_m, zenith_deg) in [
            (0.0, 20.0),
            (100.0, 90.0),
            (1e4, 93.0),
            (1e4, 150.0),
            (4e5, 109.0),
            (4e5, 170.0),
        ] {
            let found = furnace(&air, &view(altitude_m, zenith_deg), 1.0, &EFFORT).unwrap();
            let off = (found.mean - DVec3::ONE).abs();
            // Four standard errors, and these small enough to mean something: a loss of 1 % at each of the ten events
            // of a walk through fog would show.
            assert!(found.stderr.max_element() < 0.02, "{found:?}");
            assert!(
                off.cmple(found.stderr * 4.0 + 1e-6).all(),
                "{found:?} at {altitude_m} m, {zenith_deg}° in {scene}"
            );
        }
    }
}

#[test]
fn the_albedo_s_powers_add_up_to_the_totals() {
    let air = air(&json!({}));
    let found = radiance(&air, &view(0.0, 60.0), &[0.0, 0.5], &EFFORT).unwrap();
    for (albedo, total) in [0.0_f64, 0.5].into_iter().zip(&found.totals) {
        let powers = (0..).map(|k| albedo.powi(k));
        let sum: DVec3 = powers
            .zip(&found.bounces)
            .map(|(power, term)| *term * power)
            .sum();
        let off = ((found.single + sum) / total.mean - 1.0).abs().max_element();
        // The last term holds all powers from the fifth on at an albedo of 1, which is a little much at 0.5.
        assert!(off < 1e-4, "{off} at {albedo}");
    }
    assert!(found.totals[1].mean.cmpgt(found.totals[0].mean).all());
}

#[test]
fn a_plane_s_irradiance_is_the_sky_s_radiance_summed_over_the_hemisphere() {
    let air = air(&json!({}));
    let sun = view(0.0, 0.0);
    let found = diffuse_irradiance(&air, &sun, &[0.3], &EFFORT)[0];
    // Rings of equal cos², each with a fan of azimuths: a midpoint rule whose own error is 1 % at the aureole.
    let (rings, azimuths) = (40_u32, 24_u32);
    let mut sum = DVec3::ZERO;
    for ring in 0..rings {
        let cosine = ((f64::from(ring) + 0.5) / f64::from(rings)).sqrt();
        for azimuth in 0..azimuths {
            let view = View {
                view_zenith_deg: cosine.acos().to_degrees(),
                view_azimuth_deg: (f64::from(azimuth) + 0.5) * 360.0 / f64::from(azimuths),
                ..sun
            };
            let effort = Effort {
                batch: 7,
                most_batches: 2,
                seed: u64::from(ring * azimuths + azimuth),
                ..EFFORT
            };
            sum += radiance(&air, &view, &[0.3], &effort).unwrap().totals[0].mean;
        }
    }
    let sum = sum * (std::f64::consts::PI / f64::from(rings * azimuths));
    let off = (found.mean / sum - 1.0).abs().max_element();
    assert!(off < 0.02, "{} for {sum}", found.mean);
}
