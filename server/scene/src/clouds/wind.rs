//! What moves the clouds.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The wind that carries the clouds. At `time_s` they have come `drift_m` plus speed times `time_s`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Wind {
    /// Speed, m/s.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub speed_m_s: f64,
    /// Where it blows from, as meteorologists say it, clockwise from north, degrees: 270 is a west wind, which carries
    /// clouds to the east.
    #[schemars(range(min = -360.0, max = 360.0))]
    pub azimuth_deg: f64,
    /// How far the clouds' tops are ahead of their bases, metres.
    #[schemars(range(min = 0.0, max = 5e3))]
    pub shear_m: f64,
    /// How fast the noises rise through the clouds, which changes their shapes as they drift, m/s.
    #[schemars(range(min = 0.0, max = 20.0))]
    pub evolution_m_s: f64,
    /// How far clouds have drifted east and north, and noises have risen, before `time_s` is 0, metres.
    #[schemars(inner(range(min = -1e12, max = 1e12)))]
    pub drift_m: [f64; 3],
}

impl Default for Wind {
    fn default() -> Self {
        Self {
            speed_m_s: 8.0,
            azimuth_deg: 270.0,
            shear_m: 500.0,
            evolution_m_s: 0.5,
            drift_m: [0.0; 3],
        }
    }
}

impl Wind {
    /// What a second adds to `drift_m`: east, north, and the rise of the noises, m/s.
    #[must_use]
    pub fn velocity_m_s(&self) -> [f64; 3] {
        let (sin, cos) = self.azimuth_deg.to_radians().sin_cos();
        [-self.speed_m_s * sin, -self.speed_m_s * cos, self.evolution_m_s]
    }

    /// How far clouds have drifted east and north, and noises have risen, at a time, metres.
    #[must_use]
    pub fn displacement_m(&self, time_s: f64) -> [f64; 3] {
        let velocity = self.velocity_m_s();
        [0, 1, 2].map(|i| velocity[i].mul_add(time_s, self.drift_m[i]))
    }
}
