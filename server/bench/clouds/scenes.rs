//! The skies that are compared with brute force.

use super::tables::preset_scene;
use welkin_scene::{Direction, Scene, SunPosition};

/// Their names.
pub(super) const NAMES: [&str; 6] = [
    "noon",
    "low-sun-in-view",
    "sun-behind",
    "overcast",
    "cirrus",
    "storm",
];

/// So high the camera looks: the horizon stands in the lower part of the middle half of the frame.
const UP_DEG: f64 = 12.0;

/// One of [`NAMES`]: a preset, for the first three under another sun. The sun's own disc, thousands of times as bright
/// as all else, would decide every error by itself.
pub(super) fn named(name: &str) -> Scene {
    // Where the sun stands from where the camera looks, to the right, and how high, degrees.
    let (preset, sun) = match name {
        "noon" => ("fair-weather", Some((-30.0, 60.0))),
        "low-sun-in-view" => ("fair-weather", Some((2.0, 8.0))),
        "sun-behind" => ("fair-weather", Some((180.0, 25.0))),
        preset => (preset, None),
    };
    let mut scene = preset_scene(preset);
    scene.sun.disc = false;
    let ahead_deg = scene.camera.direction.to_angles().azimuth_deg;
    scene.camera.direction = Direction::angles(ahead_deg, UP_DEG);
    if let Some((aside_deg, elevation_deg)) = sun {
        // Half covered: as many rays meet clouds as miss them.
        scene.clouds.iter_mut().for_each(|clouds| clouds.coverage = 0.5);
        let azimuth_deg = (ahead_deg + aside_deg).rem_euclid(360.0);
        scene.sun.position = SunPosition::Direction(Direction::angles(azimuth_deg, elevation_deg));
    }
    scene
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use welkin_scene::Projection;

    #[test]
    fn each_is_a_sky_of_its_own_with_clouds_and_the_horizon_in_view() {
        let mut seen = Vec::new();
        for name in NAMES {
            let scene = named(name);
            assert!(scene.clouds.is_some(), "{name}");
            let text = serde_json::to_string(&scene).unwrap();
            assert_eq!(Scene::from_json(&text).unwrap(), scene, "{name}");
            let Projection::Perspective { vertical_fov_deg } = scene.camera.projection else {
                panic!("{name}")
            };
            let up_deg = scene.camera.direction.to_angles().elevation_deg;
            // Of the middle half, which is what is compared.
            let half_deg = (0.5 * (0.5 * vertical_fov_deg).to_radians().tan())
                .atan()
                .to_degrees();
            assert!(up_deg.abs() < half_deg, "{name}: {up_deg} {half_deg}");
            assert!(!seen.contains(&scene), "{name}");
            seen.push(scene);
        }
    }
}
