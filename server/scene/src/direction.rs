//! Directions in the world frame.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A direction: angles, or a vector of any length but zero.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Direction {
    /// Azimuth and elevation.
    Angles(Angles),
    /// East, north, up; any length but zero.
    Vector(#[schemars(inner(range(min = -1e12, max = 1e12)))] [f64; 3]),
}

/// Azimuth clockwise from north and elevation up from the horizon, degrees.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Angles {
    /// Clockwise from north, degrees.
    #[schemars(range(min = -360.0, max = 360.0))]
    pub azimuth_deg: f64,
    /// Up from the horizon, degrees.
    #[schemars(range(min = -90.0, max = 90.0))]
    pub elevation_deg: f64,
}

impl Direction {
    /// From azimuth and elevation, degrees.
    #[must_use]
    pub const fn angles(azimuth_deg: f64, elevation_deg: f64) -> Self {
        Self::Angles(Angles {
            azimuth_deg,
            elevation_deg,
        })
    }

    /// The unit vector (east, north, up). A zero vector, which validation refuses, gives zeros.
    #[must_use]
    pub fn unit(&self) -> [f64; 3] {
        match *self {
            Self::Angles(Angles {
                azimuth_deg,
                elevation_deg,
            }) => {
                let (sin_az, cos_az) = azimuth_deg.to_radians().sin_cos();
                let (sin_el, cos_el) = elevation_deg.to_radians().sin_cos();
                [sin_az * cos_el, cos_az * cos_el, sin_el]
            }
            Self::Vector(v) => {
                let largest = v.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
                if largest == 0.0 {
                    return [0.0; 3];
                }
                // Scaled first, so that the squares of very long or very short vectors stay in range.
                let s = v.map(|c| c / largest);
                let length = (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]).sqrt();
                s.map(|c| c / length)
            }
        }
    }

    /// Azimuth in 0..360 and elevation, degrees.
    #[must_use]
    pub fn to_angles(&self) -> Angles {
        let [x, y, z] = self.unit();
        Angles {
            azimuth_deg: x.atan2(y).to_degrees().rem_euclid(360.0),
            elevation_deg: z.atan2(x.hypot(y)).to_degrees(),
        }
    }
}
