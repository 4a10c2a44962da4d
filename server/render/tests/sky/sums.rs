//! Irradiance and spherical harmonics, summed over a map of the environment.

use crate::{
    lens::sight,
    scenes::{Rgb, radiance},
};
use std::f64::consts::PI;
use welkin_scene::{Quality, Scene};

/// Irradiance of the upper half, and harmonics of the whole, of an equirectangular frame of that size.
pub(crate) fn sums(scene: &Scene, width: u32, height: u32) -> (Rgb, [Rgb; 9]) {
    let frame = radiance(scene, width, height, Quality::Final);
    let side = PI / f64::from(height);
    let (mut diffuse, mut sh9) = ([0.0; 3], [[0.0; 3]; 9]);
    for (x, y, light) in frame.pixels() {
        let d = sight(
            &scene.camera,
            (f64::from(width), f64::from(height)),
            (x as f64 + 0.5, y as f64 + 0.5),
        );
        let sr = side * side * (1.0 - d[2] * d[2]).sqrt();
        let basis = harmonics(d);
        for c in 0..3 {
            diffuse[c] += light[c] * d[2].max(0.0) * sr;
            for (sum, y) in sh9.iter_mut().zip(basis) {
                sum[c] += light[c] * y * sr;
            }
        }
    }
    (diffuse, sh9)
}

/// Real orthonormal harmonics in the order that the probe states.
fn harmonics([x, y, z]: [f64; 3]) -> [f64; 9] {
    let (one, two) = ((3.0 / (4.0 * PI)).sqrt(), (15.0 / (4.0 * PI)).sqrt());
    [
        (0.25 / PI).sqrt(),
        one * y,
        one * z,
        one * x,
        two * x * y,
        two * y * z,
        (5.0 / (16.0 * PI)).sqrt() * (3.0 * z * z - 1.0),
        two * x * z,
        0.5 * two * (x * x - y * y),
    ]
}
