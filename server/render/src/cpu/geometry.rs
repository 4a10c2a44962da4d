//! Twin of `lib/geometry.wgsl`, by vectors from the planet's centre: f64 has digits enough to subtract radii.

use glam::DVec3;

/// A ray; positions are metres from the planet's centre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
}

impl Ray {
    /// From an altitude over the pole z.
    pub(crate) fn new(radius_m: f64, altitude_m: f64, direction: DVec3) -> Self {
        Self {
            origin: DVec3::Z * (radius_m + altitude_m),
            direction: direction.normalize(),
        }
    }

    pub(crate) fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
    }

    /// Length to the point closest to the centre; negative where it lies behind.
    pub(crate) fn closest(&self) -> f64 {
        -self.origin.dot(self.direction)
    }

    /// Lengths at which the ray enters and leaves a sphere about the centre, behind the origin too.
    pub(crate) fn crossing(&self, radius_m: f64) -> Option<(f64, f64)> {
        let miss = self.origin.cross(self.direction).length();
        let half = ((radius_m - miss) * (radius_m + miss)).sqrt();
        (miss <= radius_m).then(|| (self.closest() - half, self.closest() + half))
    }

    /// Length to the ground from a point on or above it.
    pub(crate) fn ground(&self, radius_m: f64) -> Option<f64> {
        let (enters, _) = self.crossing(radius_m)?;
        (self.origin.dot(self.direction) < 0.0).then_some(enters.max(0.0))
    }
}

/// True where the planet hides the sun's centre.
pub(crate) fn in_shadow(radius_m: f64, point: DVec3, sun: DVec3) -> bool {
    point.dot(sun) < 0.0 && point.cross(sun).length() < radius_m
}
