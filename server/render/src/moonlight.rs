//! The moon's light: how bright it is by its phase, and what it hides of the sun.

use crate::{catalogue::MAGNITUDE_ZERO_W_M2, moon_face, quadrature::gauss_legendre};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};
use welkin_scene::{Moon, MoonSeen, Scene, Sun, lunar::MEAN_DISTANCE_M};

/// The full moon's V magnitude at its mean distance (Allen 1976).
const FULL_MAGNITUDE: f64 = -12.73;
/// The sun's irradiance at 550 nm that goes with it, W/m²/nm.
const SUN_GREEN_W_M2: f64 = 1.8504;
/// The moon is redder than the sun: its B-V is 0.92 against 0.65, its V-R 0.15 more.
const COLOUR: [f64; 3] = [1.15, 1.0, 0.78];
/// Full earth seen from the moon sends geometric albedo 0.367 times (6371 / 384 400)² of the sun's light, and is blue.
const EARTHLIGHT: f64 = 0.367 * (6371.0 / 384_400.0) * (6371.0 / 384_400.0);
const EARTH_COLOUR: [f64; 3] = [0.85, 1.0, 1.3];
/// Phase angle from which on nobody has measured; from there the crescent dims with its own width.
const LAST_MEASURED_DEG: f64 = 160.0;
/// During totality the air beyond the shadow still lights the sky: about this share of its daylight.
const TOTALITY: f64 = 2e-4;

/// Share of the full moon's light by the phase angle (Allen 1976): 0.026 |α| + 4e-9 α⁴ magnitudes, α in degrees.
pub(crate) fn phase_law(angle_deg: f64) -> f64 {
    let measured = |a: f64| 10_f64.powf(-0.4 * (0.026 * a + 4e-9 * a.powi(4)));
    if angle_deg <= LAST_MEASURED_DEG {
        return measured(angle_deg);
    }
    measured(LAST_MEASURED_DEG) * lommel_seeliger(angle_deg.to_radians())
        / lommel_seeliger(LAST_MEASURED_DEG.to_radians())
}

/// Light of a sphere whose surface scatters by mu0 / (mu0 + mu), over that at full (Lommel and Seeliger):
/// 1 - sin(α/2) tan(α/2) ln cot(α/4).
pub(crate) fn lommel_seeliger(angle: f64) -> f64 {
    let half = angle / 2.0;
    if half <= 0.0 {
        return 1.0;
    }
    if half >= FRAC_PI_2 {
        return 0.0;
    }
    (1.0 + half.sin() * half.tan() * (half / 2.0).tan().ln()).max(0.0)
}

/// Lambert's sphere: (sin β + (π - β) cos β) / π.
fn lambert(angle: f64) -> f64 {
    (angle.sin() + (PI - angle) * angle.cos()) / PI
}

/// The moon's light above the air.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moonlight {
    /// Of the lit side on a plane that faces it, W/m².
    pub(crate) irradiance_w_m2: DVec3,
    /// Multiplies face and 2 mu0 / (mu0 + mu): the full moon's mean radiance, for this phase, W/m²/sr.
    pub(crate) radiance_w_m2_sr: DVec3,
    /// Multiplies the face: radiance by the Earth's light, W/m²/sr.
    pub(crate) earthshine_w_m2_sr: DVec3,
    /// Axes of the disc: towards the observer, selenographic east, north.
    pub(crate) axes: [DVec3; 3],
    /// Towards the sun along these axes.
    pub(crate) light: DVec3,
}

impl Moonlight {
    pub(crate) fn new(moon: &Moon, seen: &MoonSeen, sun: &Sun) -> Self {
        let away = -DVec3::from_array(seen.direction);
        let pole = DVec3::from_array(seen.north);
        let north = pole - away * pole.dot(away);
        // Seen from above its own pole no side of the moon is north; any will do.
        let north = north
            .try_normalize()
            .unwrap_or_else(|| away.any_orthonormal_vector());
        let east = north.cross(away);
        let sunward = DVec3::from_array(seen.light);
        let light = DVec3::new(sunward.dot(away), sunward.dot(east), sunward.dot(north));
        let near = (MEAN_DISTANCE_M / seen.distance_m).powi(2);
        let full_share = MAGNITUDE_ZERO_W_M2 * 10_f64.powf(-0.4 * FULL_MAGNITUDE) / SUN_GREEN_W_M2;
        let full = DVec3::from_array(sun.irradiance_w_m2)
            * DVec3::from_array(COLOUR)
            * (full_share * near * moon.irradiance_scale);
        let irradiance_w_m2 = full * phase_law(seen.phase_angle_deg);
        let disc_sr = 4.0 * PI * (seen.angular_diameter_deg.to_radians() / 4.0).sin().powi(2);
        let over_disc = |irradiance: DVec3| {
            if disc_sr > 0.0 {
                irradiance / disc_sr
            } else {
                DVec3::ZERO
            }
        };
        let earth = lambert(PI - seen.phase_angle_deg.to_radians());
        Self {
            irradiance_w_m2,
            radiance_w_m2_sr: over_disc(irradiance_w_m2) / lit_mean(light),
            earthshine_w_m2_sr: over_disc(full)
                * DVec3::from_array(EARTH_COLOUR)
                * (EARTHLIGHT * earth * moon.earthshine),
            axes: [away, east, north],
            light,
        }
    }
}

/// Mean over the disc of face times 2 mu0 / (mu0 + mu): by Gauss and Legendre along the parallels of the luminance
/// equator, from the terminator to the lit limb, so that the thinnest crescent is as exact as the full disc.
fn lit_mean(light: DVec3) -> DVec3 {
    const NODES: usize = 64;
    let towards = DVec3::X;
    let Some(across) = (light - towards * light.x).try_normalize() else {
        // Full, or new, where a mean of zero would serve nobody.
        return if light.x > 0.0 {
            full_mean()
        } else {
            DVec3::INFINITY
        };
    };
    let phase = light.y.hypot(light.z).atan2(light.x);
    let up = towards.cross(across);
    let nodes = gauss_legendre(NODES);
    let mut sum = DVec3::ZERO;
    for (x, wx) in &nodes {
        let longitude = (phase - FRAC_PI_2) + x * (PI - phase);
        for (y, wy) in &nodes {
            let latitude = PI * (y - 0.5);
            let level = latitude.cos();
            let at =
                towards * level * longitude.cos() + across * level * longitude.sin() + up * latitude.sin();
            let (mu, mu0) = (at.x, at.dot(light));
            if mu > 0.0 && mu0 > 0.0 {
                let weight = wx * (PI - phase) * wy * PI * level * mu / PI;
                sum += moon_face::at(at.y, at.z) * (2.0 * mu0 / (mu0 + mu) * weight);
            }
        }
    }
    // A new moon sends nothing, whatever it is divided by.
    if sum.min_element() > 0.0 {
        sum
    } else {
        DVec3::INFINITY
    }
}

/// The face's own mean, as the sampler sees it.
fn full_mean() -> DVec3 {
    DVec3::ONE
}

/// Share of the sun's disc that the moon leaves, and the share of its light that the sky has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Uncovered {
    pub(crate) disc: f64,
    pub(crate) sky: f64,
}

impl Uncovered {
    pub(crate) fn new(scene: &Scene, seen: Option<&MoonSeen>) -> Self {
        let disc = seen.map_or(1.0, |moon| {
            let apart =
                DVec3::from_array(moon.direction).angle_between(DVec3::from_array(scene.sun_direction()));
            let [sun, moon] = [scene.sun.angular_diameter_deg, moon.angular_diameter_deg]
                .map(|diameter| diameter.to_radians() / 2.0);
            1.0 - covered(sun, moon, apart)
        });
        Self {
            disc,
            sky: disc.max(TOTALITY),
        }
    }
}

/// Share of a disc of radius `sun` behind one of radius `moon` whose centre is `apart` from its own: the lens between two
/// circles.
pub(crate) fn covered(sun: f64, moon: f64, apart: f64) -> f64 {
    if apart >= sun + moon {
        return 0.0;
    }
    if apart <= (sun - moon).abs() {
        return if moon >= sun { 1.0 } else { (moon / sun).powi(2) };
    }
    let (s2, m2, d2) = (sun * sun, moon * moon, apart * apart);
    let of_sun = ((d2 + s2 - m2) / (2.0 * apart * sun)).clamp(-1.0, 1.0).acos();
    let of_moon = ((d2 + m2 - s2) / (2.0 * apart * moon)).clamp(-1.0, 1.0).acos();
    let kite = (4.0 * d2 * s2 - (d2 + s2 - m2).powi(2)).max(0.0).sqrt() / 2.0;
    (s2 * of_sun + m2 * of_moon - kite) / (PI * s2)
}

#[cfg(test)]
mod tests;
