//! Rays and spheres: the shader against vectors in f64, from the ground to 40,000 km.

use super::{engine, evaluate};
use crate::{
    cpu::geometry::{Ray, in_shadow},
    shader,
};
use glam::DVec3;

const RADII_M: [f32; 3] = [1e5, 6.36e6, 7e7];
const ALTITUDES_M: [f32; 10] = [0.0, 0.5, 2.0, 100.0, 1e4, 35_786.0, 99_999.0, 4e5, 3.6e7, 4e7];

/// Cosines from the zenith to the nadir, crowded about the horizon seen from an altitude.
fn cosines(radius_m: f32, altitude_m: f32) -> Vec<f32> {
    let (r, h) = (f64::from(radius_m), f64::from(altitude_m));
    let horizon = -(h * (2.0 * r + h)).sqrt() / (r + h);
    let about = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5].into_iter();
    about
        .flat_map(|d| [horizon + d, horizon - d])
        .chain([1.0, 0.9, 0.3, 0.0, -0.3, -0.9, -1.0])
        .filter(|mu| mu.abs() <= 1.0)
        .map(|mu| mu as f32)
        .collect()
}

fn unit(mu: f32) -> DVec3 {
    let mu = f64::from(mu);
    DVec3::new((1.0 - mu * mu).sqrt(), 0.0, mu)
}

#[test]
fn altitude_and_zenith_angle_along_a_ray() {
    let engine = engine();
    let mut rows = Vec::new();
    for radius in RADII_M {
        // Rays begin inside the air, or where they enter it.
        for h in ALTITUDES_M.into_iter().filter(|h| *h <= 1e5) {
            for mu in cosines(radius, h) {
                let ray = Ray::new(radius.into(), h.into(), unit(mu));
                let reach = ray.ground(radius.into()).unwrap_or(1e6);
                for share in [0.0, 1e-5, 0.01, 0.5, 0.99, 1.0] {
                    rows.push([radius, h, mu, (share * reach) as f32, 0.0, 0.0, 0.0, 0.0]);
                }
            }
        }
    }
    let statements = "x.x = altitude_after(a.x, a.y, a.z, a.w);
        x.y = cosine_after(a.x, a.y, x.x, a.z, 1.0, a.w);";
    for (row, found) in rows
        .iter()
        .zip(evaluate(&engine.gpu, &shader::PROBE, statements, &rows, &[]))
    {
        let [radius, h, mu, t, ..] = row.map(f64::from);
        let ray = Ray::new(radius, h, unit(row[2]));
        let point = ray.at(t);
        let (height, cos) = (point.length() - radius, point.normalize().dot(ray.direction));
        // The squares t(t + 2 r mu) and h(2R + h) round at 6e-8 each and are divided by 2R; a metre is well below
        // every scale height that a scene may have.
        let rounding = 2e-7 * (t * t + 2.0 * (radius + h) * (mu * t).abs() + h * (2.0 * radius + h));
        let allowed = 0.01 + rounding / (2.0 * radius + height.max(0.0));
        assert!(
            (f64::from(found[0]) - height).abs() < allowed,
            "{row:?}: {} {height}",
            found[0]
        );
        let allowed = 1e-6 * (1.0 + (radius + h) / (radius + height));
        assert!(
            (f64::from(found[1]) - cos).abs() < allowed,
            "{row:?}: {} {cos}",
            found[1]
        );
    }
}

#[test]
fn distances_to_the_ground_and_to_the_top() {
    let engine = engine();
    let mut rows = Vec::new();
    for radius in RADII_M {
        for h in ALTITUDES_M {
            for mu in cosines(radius, h) {
                rows.push([radius, 1e5_f32.max(h), h, mu, 0.0, 0.0, 0.0, 0.0]);
            }
        }
    }
    let statements = "x.x = distance_to_sphere(a.x, a.z, a.w);
        x.y = distance_to_top(a.x, a.y, a.z, a.w);
        x.z = edge_zenith_angle(a.x, a.z);";
    for (row, found) in rows
        .iter()
        .zip(evaluate(&engine.gpu, &shader::SKY, statements, &rows, &[]))
    {
        let [radius, top, h, mu, ..] = row.map(f64::from);
        let ray = Ray::new(radius, h, unit(row[3]));
        let r = radius + h;
        let horizon = -(h * (2.0 * radius + h)).sqrt() / r;
        // How far f32 moves the ray past the planet: b² - c rounds at about 1e-7 of b².
        if (mu - horizon).abs() > 2e-6 * horizon.abs() {
            let expected = ray.ground(radius).unwrap_or(-1.0);
            let root = ((r * mu).powi(2) - h * (2.0 * radius + h)).abs().sqrt();
            let allowed = 1e-6 * expected.abs() + 2e-7 * (r * mu).powi(2) / root.max(1.0) + 1e-9 * radius;
            assert!(
                (f64::from(found[0]) - expected).abs() <= allowed,
                "ground {row:?}: {} {expected}",
                found[0]
            );
        }
        let (_, expected) = ray.crossing(radius + top).unwrap_or_default();
        // Roundings of b² + c in f32, and of f64 against 1e8 m.
        let allowed = 1e-6 * expected + 0.05;
        assert!(
            h >= top || (f64::from(found[1]) - expected).abs() <= allowed,
            "top {row:?}: {} {expected}",
            found[1]
        );
        // Roundings of π/2, and what the driver makes of atan: Mesa is within 2e-6. That is a hundredth of a pixel of a
        // 1080p frame 12° high.
        assert!(
            (f64::from(found[2]) - horizon.acos()).abs() < 3e-6,
            "edge {row:?}: {}",
            found[2]
        );
    }
}

/// The stretch of shadow of each ray against the shadow's definition, point by point.
#[test]
fn the_planets_shadow_begins_and_ends_where_the_sun_sets() {
    let engine = engine();
    let radius = 6.36e6_f32;
    let mut rows = Vec::new();
    let mut suns = Vec::new();
    for h in [0.0_f32, 2.0, 1e4, 1e5] {
        for sun_deg in [90.0_f64, 30.0, 1.0, 0.0, -0.5, -4.0, -12.0, -18.0, -60.0, -90.0] {
            for mu in cosines(radius, h) {
                for azimuth_deg in [0.0_f64, 40.0, 90.0, 150.0, 180.0] {
                    let sun = DVec3::new(sun_deg.to_radians().cos(), 0.0, sun_deg.to_radians().sin());
                    let (s, c) = azimuth_deg.to_radians().sin_cos();
                    let flat = unit(mu);
                    let view = DVec3::new(flat.x * c, flat.x * s, flat.z);
                    let ray = Ray::new(radius.into(), h.into(), view);
                    let to = ray.ground(radius.into());
                    let t_max = to.unwrap_or_else(|| ray.crossing(f64::from(radius) + 1e5 + 1.0).unwrap().1);
                    if t_max < 1.0 {
                        continue;
                    }
                    let nu = view.dot(sun);
                    rows.push([radius, h, mu, sun.z as f32, nu as f32, t_max as f32, 0.0, 0.0]);
                    suns.push((ray, sun));
                }
            }
        }
    }
    let statements = "x = vec4f(shadow_stretch(a.x, a.y, a.z, a.w, b.x, b.y), 0.0, 0.0);";
    let found = evaluate(&engine.gpu, &shader::PROBE, statements, &rows, &[]);
    let mut compared = 0;
    for ((row, found), (ray, sun)) in rows.iter().zip(found).zip(suns) {
        let t_max = f64::from(row[5]);
        let (from, to) = (f64::from(found[0]), f64::from(found[1]));
        for k in 0..200 {
            let t = t_max * (f64::from(k) + 0.5) / 200.0;
            let point = ray.at(t);
            // Height of the point over the shadow's mantle, and its place before or behind the terminator's plane.
            let over_m = point.cross(sun).length() - f64::from(radius);
            let behind_m = -point.dot(sun);
            // f32 resolves 0.5 m at the planet's radius; the quadratic's c = (rho - |b|)(rho + |b|) some metres more. A
            // hundred metres of air are 1 % of the molecules' scale height.
            if over_m.abs() < 100.0 || behind_m.abs() < 100.0 {
                continue;
            }
            let dark = (from..to).contains(&t);
            assert_eq!(
                dark,
                in_shadow(radius.into(), point, sun),
                "{row:?} sun {sun} at {t}: {from}..{to}, {over_m} over, {behind_m} behind"
            );
            compared += 1;
        }
    }
    assert!(compared > 300_000, "{compared}");
}
