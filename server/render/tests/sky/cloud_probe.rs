//! The probe under clouds: against final frames, which march through them with a jitter; and against clear air.

use crate::{
    lens::{dot, sight},
    scenes::{frame, luma, order, probe, radiance, scene, whole},
    sums::sums,
};
use serde_json::{Value, json};
use welkin_scene::{Direction, Quality, Scene, renderer::Output};

/// A whole sky of clouds under a sun that shows no disc.
fn cloudy(clouds: Value, z: f64, sun_deg: f64) -> Scene {
    scene(json!({
        "camera": {"position_m": [0, 0, z], "projection": {"kind": "equirectangular"}},
        "sun": {"position": {"azimuth_deg": 100, "elevation_deg": sun_deg}, "disc": false},
        "clouds": clouds,
    }))
}

/// The same by moonlight.
fn moonlit(clouds: Value) -> Scene {
    whole(json!({
        "camera": {"projection": {"kind": "equirectangular"}},
        "stars": null,
        // Found at every second pixel, 15° apart here.
        "shafts": null,
        "sun": {"position": {"azimuth_deg": 280, "elevation_deg": -40}},
        "moon": {"position": {"azimuth_deg": 100, "elevation_deg": 40}, "disc": false},
        "clouds": clouds,
    }))
}

fn scattered() -> Value {
    json!({"coverage": 0.5})
}

fn cirrus() -> Value {
    json!({"layers": [{"kind": "sheet", "height_m": 8000, "genus": "cirrus", "coverage": 0.6}]})
}

fn cumulus() -> Value {
    json!({"coverage": 0.3, "layers": [{"kind": "volume", "base_m": 1500, "top_m": 4000, "type": 0.9}]})
}

fn storm() -> Value {
    json!({
        "coverage": 1,
        "density": 8,
        "layers": [{"kind": "volume", "base_m": 500, "top_m": 6000, "type": 1}],
        "weather_map": {"kind": "uniform", "coverage": 1, "type": 1, "rain": 0},
    })
}

/// With so many steps that it hardly matters where in each the clouds are looked at: a frame's answer at a pixel varies
/// with its jitter, by 10 % of the mean with the usual steps.
fn fine(clouds: &Value) -> Value {
    let mut clouds = clouds.clone();
    clouds["steps"] = json!(1024);
    clouds
}

#[test]
fn the_probe_is_a_final_frame_without_jitter() {
    for (name, scene, width) in [
        // Shafts are found at every second pixel: in a smaller frame 15° apart.
        ("all kinds", cloudy(fine(&scattered()), 2.0, 45.0), 96),
        ("between", cloudy(fine(&scattered()), 3000.0, 6.0), 48),
        ("from above", cloudy(fine(&cumulus()), 6000.0, 30.0), 48),
        ("cirrus", cloudy(cirrus(), 2.0, 20.0), 96),
        ("moonlit", moonlit(fine(&cumulus())), 48),
    ] {
        let height = width / 2;
        let frame = radiance(&scene, width, height, Quality::Final);
        let size = (f64::from(width), f64::from(height));
        let towards = |(x, y, _)| sight(&scene.camera, size, (x as f64 + 0.5, y as f64 + 0.5));
        let directions: Vec<_> = frame.pixels().map(towards).map(Direction::Vector).collect();
        let exact = probe(&scene, &directions).radiance_w_m2_sr;
        let up = scene.observer().up;
        let (mut square, mut off_square, mut sum, mut off_sum) = (0.0, 0.0, 0.0, 0.0);
        for (((_, _, found), exact), direction) in frame.pixels().zip(&exact).zip(&directions) {
            // Pixels of 7.5° that the horizon crosses hold a mean; from 6 km it lies 2.5° down.
            if dot(direction.unit(), up).asin().to_degrees().abs() < 7.5 {
                continue;
            }
            let (found, exact) = (luma(found), luma(*exact));
            square += exact * exact;
            off_square += (found - exact).powi(2);
            sum += exact;
            off_sum += found - exact;
        }
        // What is left of the jitter, and of tables in clear air, which are good to 1 %.
        let (rms, bias) = ((off_square / square).sqrt(), off_sum / sum);
        assert!(rms < 0.015, "{name}: {rms}");
        assert!(bias.abs() < 0.002, "{name}: {bias}");
    }
}

/// Clouds have edges, and 20736 nodes over the sphere miss some of what a map of 2^17 pixels shows.
#[test]
fn the_probes_sums_hold_under_clouds() {
    for (name, scene) in [
        ("all kinds", cloudy(json!({}), 2.0, 45.0)),
        ("low sun", cloudy(json!({}), 2.0, 6.0)),
        ("cumulus", cloudy(cumulus(), 2.0, 45.0)),
        ("cirrus", cloudy(cirrus(), 2.0, 45.0)),
        ("from above", cloudy(json!({}), 1e4, 45.0)),
        ("moonlit", moonlit(json!({}))),
    ] {
        let answer = probe(&scene, &[]).irradiance;
        let (diffuse, sh9) = sums(&scene, 512, 256);
        for c in 0..3 {
            // The product's 1 %.
            let off = answer.diffuse_w_m2[c] / diffuse[c] - 1.0;
            assert!(off.abs() < 0.01, "{name}, band {c}: {off}");
            for k in 0..9 {
                // Of the mean. Higher harmonics divide the sky into parts, each with fewer nodes.
                let off = (answer.sh9[k][c] - sh9[k][c]).abs() / sh9[0][c];
                assert!(off < 0.02, "{name}, band {c}, Y {k}: {off}");
            }
        }
    }
}

#[test]
fn clouds_that_cover_nothing_leave_the_probe_as_it_is() {
    let layers = json!([
        {"kind": "volume", "base_m": 1500, "top_m": 4000},
        {"kind": "sheet", "height_m": 8000, "genus": "cirrus"},
    ]);
    let directions = [[0.0, 60.0], [100.0, 30.0], [100.0, 2.0], [200.0, -20.0]];
    let directions = directions.map(|[azimuth, elevation]| Direction::angles(azimuth, elevation));
    for clouds in [
        json!({"coverage": 0, "layers": layers}),
        json!({"density": 0, "layers": layers}),
    ] {
        for sun_deg in [30.0, -2.0] {
            let clear = probe(&cloudy(json!(null), 2.0, sun_deg), &directions);
            let cloudless = probe(&cloudy(clouds.clone(), 2.0, sun_deg), &directions);
            assert_eq!(clear, cloudless, "{clouds}, sun {sun_deg}°");
        }
    }
}

#[test]
fn a_storm_lets_none_of_the_suns_own_light_through() {
    let directions = [[100.0, 45.0], [0.0, 89.0], [280.0, 30.0], [100.0, -30.0]];
    let directions = directions.map(|[azimuth, elevation]| Direction::angles(azimuth, elevation));
    let clear = probe(&cloudy(json!(null), 2.0, 45.0), &directions);
    let dark = probe(&cloudy(storm(), 2.0, 45.0), &directions);
    for c in 0..3 {
        // A thousandth is what a march takes for opaque, and some.
        let left = dark.irradiance.direct_w_m2[c] / clear.irradiance.direct_w_m2[c];
        assert!(left < 1e-3, "{left}");
        assert!(dark.irradiance.diffuse_w_m2[c] > 0.0);
        for sky in 0..3 {
            let left = dark.transmittance[sky][c] / clear.transmittance[sky][c];
            assert!(left < 1e-3, "{sky}: {left}");
        }
        // Nothing stands before the ground, but its own light is less.
        assert_eq!(dark.transmittance[3][c], clear.transmittance[3][c]);
        let ground = dark.radiance_w_m2_sr[3][c] / clear.radiance_w_m2_sr[3][c];
        assert!(ground < 0.5, "{ground}");
    }
    assert_eq!(dark.distance_m, clear.distance_m);
}

/// The discs of sun and moon are dimmed by what the clouds before them let through, in the probe as in what a frame says
/// of itself.
#[test]
fn clouds_dim_the_light_of_the_discs() {
    let veil =
        json!({"layers": [{"kind": "sheet", "height_m": 8000, "genus": "cirrostratus", "coverage": 1}]});
    let towards = [Direction::angles(100.0, 40.0)];
    let sunlit = |clouds: Value| cloudy(clouds, 2.0, 40.0);
    for scene in [sunlit, moonlit] {
        let (clear, dim) = (
            probe(&scene(json!(null)), &towards),
            probe(&scene(veil.clone()), &towards),
        );
        let facts = frame(order(scene(veil.clone()), 8, 8, Quality::Final, Output::Linear)).facts;
        assert_eq!(facts.sun_irradiance_w_m2, dim.irradiance.direct_normal_w_m2);
        assert_eq!(facts.moon_irradiance_w_m2, dim.irradiance.moon_direct_normal_w_m2);
        let direct = |answer: &welkin_scene::ProbeAnswer| {
            answer.irradiance.direct_normal_w_m2[1] + answer.irradiance.moon_direct_normal_w_m2[1]
        };
        let left = direct(&dim) / direct(&clear);
        let at_centre = dim.transmittance[0][1] / clear.transmittance[0][1];
        assert!(left < 0.98, "{left}: nothing is before the disc");
        // Half a degree is 120 m of a sheet at 8 km and 40°, whose waves are kilometres long.
        assert!((left / at_centre - 1.0).abs() < 0.02, "{left} for {at_centre}");
    }
}
