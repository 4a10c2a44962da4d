//! Where the observer stands over the planet's sphere.

use crate::document::Scene;

/// The observer's place over the sphere, whose centre is at (0, 0, -R).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observer {
    /// Height above the ground, metres.
    pub altitude_m: f64,
    /// Unit vector away from the planet's centre, in the world frame.
    pub up: [f64; 3],
}

impl Observer {
    /// Of a position in the world frame over a planet of the given radius, both in metres.
    ///
    /// h = |p - c| - R with |p - c|² = |p|² + 2Rz + R². Multiplied by (|p - c| + R) / (|p - c| + R), the difference of
    /// two large numbers becomes h = (|p|² + 2Rz) / (|p - c| + R), exact to the last digits at any height.
    #[must_use]
    pub fn at(position_m: [f64; 3], radius_m: f64) -> Self {
        let [x, y, z] = position_m;
        let excess = x * x + y * y + z * (z + 2.0 * radius_m);
        let distance = x.hypot(y).hypot(z + radius_m);
        // The centre has no up; any will do.
        let up = if distance > 0.0 {
            [x, y, z + radius_m].map(|c| c / distance)
        } else {
            [0.0, 0.0, 1.0]
        };
        Self {
            altitude_m: excess / (distance + radius_m),
            up,
        }
    }
}

impl Scene {
    /// Where the camera stands over the ground.
    #[must_use]
    pub fn observer(&self) -> Observer {
        Observer::at(self.camera.position_m, self.planet.radius_m)
    }
}
