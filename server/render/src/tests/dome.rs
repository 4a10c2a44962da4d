//! The dome's directions: the shader against its twin in f64, and its first row over the horizon.

use super::{engine, evaluate};
use crate::{cloud_dome::dome_place, shader};
use glam::{DVec2, DVec3};

/// Directions all over the sphere, each octant's edges and corners among them.
fn directions() -> Vec<[f32; 3]> {
    let steps = [-1.0, -0.6, -0.1, -1e-3, 0.0, 1e-3, 0.1, 0.6, 1.0];
    let all = steps.into_iter().flat_map(|x| {
        steps
            .into_iter()
            .flat_map(move |y| steps.into_iter().map(move |z| DVec3::new(x, y, z)))
    });
    all.filter(|v| v.length() > 0.0)
        .map(|v| v.normalize().as_vec3().to_array())
        .collect()
}

/// Places that are the same point of the sphere: the lower pole is all four corners, and the square's edge is folded.
fn same_place(a: DVec2, b: DVec2) -> f64 {
    let edge = |v: f64| v.min(1.0 - v) < 1e-5;
    let folded = |p: DVec2| match [edge(p.x), edge(p.y)] {
        [true, true] => DVec2::ZERO,
        [true, false] => DVec2::new(p.x, p.y.min(1.0 - p.y)),
        [false, true] => DVec2::new(p.x.min(1.0 - p.x), p.y),
        [false, false] => p,
    };
    if (a - b).length() < 1e-5 {
        (a - b).length()
    } else {
        (folded(a) - folded(b)).length()
    }
}

#[test]
fn a_directions_place_is_what_its_twin_says() {
    let engine = engine();
    let rows: Vec<[f32; 8]> = directions()
        .into_iter()
        .map(|[x, y, z]| [x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0])
        .collect();
    let statements = "x = vec4f(dome_place(a.xyz), 0.0, 0.0);";
    let found = evaluate(&engine.gpu, &shader::SKY, statements, &rows, &[]);
    for (row, found) in rows.iter().zip(found) {
        let expected = dome_place(DVec3::new(row[0].into(), row[1].into(), row[2].into()));
        let found = DVec2::new(found[0].into(), found[1].into());
        // A few roundings of numbers up to 1.
        assert!(same_place(found, expected) < 1e-6, "{row:?}: {found} {expected}");
    }
}

#[test]
fn a_places_direction_has_that_place() {
    let engine = engine();
    let rows: Vec<[f32; 8]> = (0..=40)
        .flat_map(|x| (0..=40).map(move |y| (x, y)))
        .map(|(x, y)| [x as f32 / 40.0, y as f32 / 40.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
        .collect();
    let statements = "x = vec4f(dome_direction(a.xy), 0.0);";
    let found = evaluate(&engine.gpu, &shader::CLOUD_DOME, statements, &rows, &[]);
    for (row, found) in rows.iter().zip(found) {
        let direction = DVec3::new(found[0].into(), found[1].into(), found[2].into());
        assert!((direction.length() - 1.0).abs() < 1e-6, "{row:?}: {direction}");
        let place = dome_place(direction);
        let asked = DVec2::new(row[0].into(), row[1].into());
        // As above; the direction is in f32.
        assert!(same_place(place, asked) < 2e-6, "{row:?}: {place}");
    }
}

/// Under clouds, corners just under the horizon look over it, and all others where they are.
#[test]
fn corners_under_the_horizon_look_just_over_it() {
    let engine = engine();
    let horizon = -1e-3_f32;
    let cells = 544;
    // `APART` of `lib/dome.wgsl`.
    let reach = 6.0 / cells as f32;
    let rows: Vec<[f32; 8]> = (0..cells / 3)
        .flat_map(|x| (0..cells / 3).map(move |y| (3 * x, 3 * y)))
        .map(|(x, y)| [x as f32, y as f32, horizon, cells as f32, 0.0, 0.0, 0.0, 0.0])
        .collect();
    let statements = "let own = dome_direction(a.xy / a.w);
        let lifted = dome_sight(Dome(u32(a.w), 1.0, 1.0, 1u), vec2u(a.xy), vec3f(0.0, 0.0, 1.0), a.z);
        let other = dome_sight(Dome(u32(a.w), 1.0, 1.0, 0u), vec2u(a.xy), vec3f(0.0, 0.0, 1.0), a.z);
        x = vec4f(own.z, lifted.z, other.z, length(own.xy - lifted.xy));";
    let found = evaluate(&engine.gpu, &shader::CLOUD_DOME, statements, &rows, &[]);
    let mut moved = 0;
    for (row, [own, lifted, other, aside, ..]) in rows.iter().zip(found) {
        assert!((own - other).abs() < 1e-6, "{row:?}: {own} {other}");
        if own < horizon && own > horizon - reach {
            moved += 1;
            // Over it, by no more than 1e-5 and a rounding; and not aside.
            assert!(lifted > horizon && lifted < horizon + 2e-5, "{row:?}: {lifted}");
            assert!(aside < reach * reach, "{row:?}: {aside}");
        } else if own > horizon + 2e-5 || own < horizon - reach {
            assert!((own - lifted).abs() < 1e-6, "{row:?}: {own} {lifted}");
        }
    }
    assert!(moved > 20, "{moved}");
}

#[test]
fn the_horizons_cosine_is_that_of_its_angle() {
    let engine = engine();
    let rows: Vec<[f32; 8]> = [0.0, 2.0, 100.0, 1e4, 1e5, 4e5, 4e7]
        .map(|h| [6.36e6, h, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
        .to_vec();
    let statements = "x.x = edge_cosine(a.x, a.y);";
    let found = evaluate(&engine.gpu, &shader::SKY, statements, &rows, &[]);
    for (row, found) in rows.iter().zip(found) {
        let (radius, h) = (f64::from(row[0]), f64::from(row[1]));
        let angle = std::f64::consts::FRAC_PI_2 + ((h * (2.0 * radius + h)).sqrt() / radius).atan();
        // f32's rounding of numbers up to 1.
        assert!(
            (f64::from(found[0]) - angle.cos()).abs() < 2e-7,
            "{row:?}: {}",
            found[0]
        );
    }
}
