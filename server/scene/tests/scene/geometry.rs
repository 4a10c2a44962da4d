//! The observer over the sphere, and directions.

use proptest::prelude::*;
use welkin_scene::{Direction, Observer, Scene};

const EARTH_M: f64 = 6_360_000.0;

#[test]
fn altitude_above_the_origin_is_z() {
    for z in [0.0, 1e-9, 2.0, 1e4, 4e5, 1e8] {
        let observer = Observer::at([0.0, 0.0, z], EARTH_M);
        // The last digit of z: where R + h is formed first, 1e-9 is lost.
        assert!(
            (observer.altitude_m - z).abs() <= 2.0 * f64::EPSILON * z,
            "{z}: {observer:?}"
        );
        assert_eq!(
            observer.up.map(f64::to_bits),
            [0.0, 0.0, 1.0_f64].map(f64::to_bits)
        );
    }
}

#[test]
fn the_plane_through_the_origin_lies_above_the_sphere() {
    // h = √(R² + d²) - R = d²/2R - d⁴/8R³ + …; the next term is 1e-9 of the first for d = 1 km.
    let d = 1000.0_f64;
    let series = d.powi(2) / (2.0 * EARTH_M) - d.powi(4) / (8.0 * EARTH_M.powi(3));
    let observer = Observer::at([600.0, -800.0, 0.0], EARTH_M);
    assert!((observer.altitude_m - series).abs() < 1e-9 * series);
}

#[test]
fn the_antipode_is_on_the_ground() {
    let observer = Observer::at([0.0, 0.0, -2.0 * EARTH_M], EARTH_M);
    assert_eq!(observer.altitude_m.to_bits(), 0.0_f64.to_bits());
    assert_eq!(observer.up[2].to_bits(), (-1.0_f64).to_bits());
}

#[test]
fn the_centre_has_an_up() {
    let observer = Observer::at([0.0, 0.0, -EARTH_M], EARTH_M);
    assert!((observer.altitude_m + EARTH_M).abs() < 1e-9, "{observer:?}");
    assert!(observer.up.iter().all(|c| c.is_finite()));
}

#[test]
fn azimuth_is_clockwise_from_north() {
    // East is +x, north +y; cos 90° is 6e-17 rather than 0.
    for (azimuth_deg, expected) in [
        (0.0, [0.0, 1.0, 0.0]),
        (90.0, [1.0, 0.0, 0.0]),
        (180.0, [0.0, -1.0, 0.0]),
    ] {
        let unit = Direction::angles(azimuth_deg, 0.0).unit();
        assert!(
            unit.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15),
            "{azimuth_deg}: {unit:?}"
        );
    }
    let up = Direction::angles(37.0, 90.0).unit();
    assert!((up[2] - 1.0).abs() < 1e-15);
}

proptest! {
    #[test]
    fn a_point_at_a_height_has_that_height(azimuth in -360.0..360.0, elevation in -90.0..90.0, log_h in -3.0..8.0) {
        let h = 10_f64.powf(log_h);
        let up = Direction::angles(azimuth, elevation).unit();
        let p = up.map(|c| c * (EARTH_M + h));
        let observer = Observer::at([p[0], p[1], p[2] - EARTH_M], EARTH_M);
        // The position itself is rounded: five roundings of |p|, up to 2R + h.
        let rounding = 5.0 * f64::EPSILON * (2.0 * EARTH_M + h);
        prop_assert!((observer.altitude_m - h).abs() < rounding, "{} {}", observer.altitude_m, h);
        let cos: f64 = observer.up.iter().zip(up).map(|(a, b)| a * b).sum();
        prop_assert!((cos - 1.0).abs() < 1e-14);
    }

    #[test]
    fn angles_round_trip(azimuth in 0.0..360.0, elevation in -89.9..89.9) {
        let back = Direction::Vector(Direction::angles(azimuth, elevation).unit()).to_angles();
        // Near the zenith a rounding of 1e-16 turns the azimuth by 1e-16 / cos(89.9°) rad = 4e-12°.
        prop_assert!((back.azimuth_deg - azimuth).abs() < 1e-10);
        prop_assert!((back.elevation_deg - elevation).abs() < 1e-10);
    }

    #[test]
    fn sun_given_as_a_vector_keeps_its_direction(v in prop::array::uniform3(-1e12..1e12_f64)) {
        let scene = Scene::from_value(&serde_json::json!({"sun": {"position": v}})).unwrap();
        let sun = scene.sun_direction();
        let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        prop_assert!(sun.iter().zip(v).all(|(s, c): (&f64, f64)| (s - c / length).abs() < 1e-15));
    }
}
