//! The frame of what stands on the sphere: level at its own centre.

use glam::{DMat3, DVec2, DVec3};

/// Axes and origin in the scene's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame {
    pub(crate) east: DVec3,
    pub(crate) north: DVec3,
    pub(crate) up: DVec3,
    /// On the sphere.
    pub(crate) origin_m: DVec3,
}

impl Frame {
    /// At a place east and north of the scene's origin, as far along the sphere; its north is turned clockwise.
    pub(crate) fn new(radius_m: f64, centre_m: [f64; 2], azimuth_deg: f64) -> Self {
        let centre = DVec2::from_array(centre_m);
        let angle = centre.length() / radius_m;
        let along = centre.normalize_or_zero();
        let (sin, cos) = angle.sin_cos();
        let up = (along * sin).extend(cos);
        // Carried along the great circle: what looks along it tips down with it.
        let carried = |v: DVec2| {
            let forward = v.dot(along);
            (v + along * forward * (cos - 1.0)).extend(-forward * sin)
        };
        let (s, c) = azimuth_deg.to_radians().sin_cos();
        Self {
            east: carried(DVec2::new(c, -s)),
            north: carried(DVec2::new(s, c)),
            up,
            // R (cos - 1), without the loss.
            origin_m: (along * sin * radius_m).extend(-2.0 * radius_m * (angle / 2.0).sin().powi(2)),
        }
    }

    /// From the scene's axes to these.
    pub(crate) fn turn(&self, v: DVec3) -> DVec3 {
        DMat3::from_cols(self.east, self.north, self.up).transpose() * v
    }

    /// Of a place in the scene.
    pub(crate) fn place(&self, p: DVec3) -> DVec3 {
        self.turn(p - self.origin_m)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Wherever it stands its axes are at right angles, its up points away from the planet's centre, and its origin is
        /// as far along the sphere as asked.
        #[test]
        fn frames_stand_on_the_sphere(x in -1e6..1e6, y in -1e6..1e6, azimuth in -360.0..360.0) {
            let radius_m = 6.36e6;
            let frame = Frame::new(radius_m, [x, y], azimuth);
            let axes = DMat3::from_cols(frame.east, frame.north, frame.up);
            // f64 rounds at 1e-16 an operation.
            prop_assert!((axes.transpose() * axes).abs_diff_eq(DMat3::IDENTITY, 1e-12));
            prop_assert!(frame.east.cross(frame.north).abs_diff_eq(frame.up, 1e-12));
            let from_centre = frame.origin_m + DVec3::Z * radius_m;
            prop_assert!(from_centre.abs_diff_eq(frame.up * radius_m, 1e-6));
            let along = radius_m * from_centre.angle_between(DVec3::Z);
            // acos of a small angle keeps half of the digits.
            prop_assert!((along - DVec2::new(x, y).length()).abs() < 1.0);
        }
    }
}
