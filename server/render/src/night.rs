//! What moon and stars are to a frame: which of them are there, and how much they count against the sun.

use crate::{
    cpu::air::optical_depth_to_space,
    moonlight::{Moonlight, Uncovered},
    starfield::Screen,
    uniforms::{Standpoint, ViewUniform, narrow, night::MoonUniform},
};
use glam::DVec3;
use welkin_scene::{MoonSeen, Scene, Sun};

/// Moon, stars and eclipse, as an observer has them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Night {
    pub(crate) moon: Option<MoonOver>,
    pub(crate) uncovered: Uncovered,
    /// Rises from 0 to 1 as the stars come out.
    pub(crate) stars: f32,
}

/// The moon over an observer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MoonOver {
    pub(crate) seen: MoonSeen,
    pub(crate) light: Moonlight,
    /// True where the disc is shown.
    disc: bool,
    /// Rises from 0 to 1 as its light on air and ground begins to count.
    pub(crate) counts: f64,
}

/// Sun's elevations between which the stars come out, degrees. In full daylight nothing of them is in the frame; at -2°
/// the brightest fixed star gives a pixel of 0.1° a hundredth of the sky's light, and the next ones far less.
const STARS_DEG: [f64; 2] = [-2.0, -5.0];
/// Optical depths in blue over the observer between which the stars come out by day: the sky goes with the depth.
const STARS_DEPTH: [f64; 2] = [0.02, 0.002];
/// Sun's elevations between which the moon's light on air and ground begins to count. At 4° the sun gives the ground more
/// than ten thousand times a full moon's light.
const MOONLIGHT_DEG: [f64; 2] = [4.0, 0.0];
/// From this height one sees beyond the horizon, to where it is night.
const FAR_SIGHTED_M: f64 = 20_000.0;
/// A moon farther below the horizon lights no air in sight, degrees.
const MOON_DOWN_DEG: f64 = -18.0;

/// Rises from 0 at `from` to 1 at `to`.
fn rising([from, to]: [f64; 2], at: f64) -> f64 {
    let x = ((at - from) / (to - from)).clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

fn elevation_deg(stand: &Standpoint, towards: DVec3) -> f64 {
    stand.up.dot(towards).clamp(-1.0, 1.0).asin().to_degrees()
}

impl Night {
    pub(crate) fn new(scene: &Scene, stand: &Standpoint) -> Self {
        let seen = scene.moon_seen();
        let sun_deg = elevation_deg(stand, stand.sun);
        let dark = scene.sun.irradiance_w_m2 == [0.0; 3];
        let far_sighted = stand.altitude_m > FAR_SIGHTED_M || dark;
        let moon = scene.moon.as_ref().zip(seen).map(|(moon, seen)| {
            let up = elevation_deg(stand, DVec3::from_array(seen.direction)) > MOON_DOWN_DEG;
            let counts = match (far_sighted, up) {
                (true, _) => 1.0,
                (false, true) => rising(MOONLIGHT_DEG, sun_deg),
                (false, false) => 0.0,
            };
            MoonOver {
                seen,
                light: Moonlight::new(moon, &seen, &scene.sun),
                disc: moon.disc,
                counts,
            }
        });
        let uncovered = Uncovered::new(scene, seen.as_ref());
        let by_depth = || {
            let depth = optical_depth_to_space(scene, stand.altitude_m, 1.0).map_or(1.0, |d| d[2]);
            rising(STARS_DEPTH, depth)
        };
        let by_sun = rising(STARS_DEG, sun_deg);
        // In the moon's shadow it is as dark as in deep twilight.
        let by_eclipse = rising([0.02, 0.0], uncovered.sky);
        let stars = match &scene.stars {
            None => 0.0,
            Some(_) if dark => 1.0,
            Some(_) if by_sun < 1.0 => by_sun.max(by_eclipse).max(by_depth()),
            Some(_) => 1.0,
        };
        Self {
            moon,
            uncovered,
            stars: narrow(stars),
        }
    }

    /// The sun as the sky has it: during an eclipse it sends less.
    pub(crate) fn sun(&self, sun: &Sun) -> Sun {
        Sun {
            irradiance_w_m2: sun.irradiance_w_m2.map(|e| e * self.uncovered.sky),
            ..sun.clone()
        }
    }

    /// Discs that hide stars.
    pub(crate) fn screens(&self, stand: &Standpoint, sun: &Sun) -> Vec<Screen> {
        let radius = |diameter_deg: f64| (diameter_deg / 2.0).to_radians();
        let sun = Screen {
            towards: stand.sun,
            angular_radius: radius(sun.angular_diameter_deg),
        };
        let moon = self.moon.map(|moon| Screen {
            towards: DVec3::from_array(moon.seen.direction),
            angular_radius: radius(moon.seen.angular_diameter_deg),
        });
        std::iter::once(sun).chain(moon).collect()
    }
}

impl MoonOver {
    /// Where it stands over the observer.
    pub(crate) fn stand(&self, stand: &Standpoint) -> Standpoint {
        Standpoint {
            sun: DVec3::from_array(self.seen.direction),
            ..*stand
        }
    }

    /// The moon as a second sun; a meter looks neither at the disc nor at its image on water.
    pub(crate) fn view(&self, scene: &Scene, stand: &Standpoint, metered: bool) -> ViewUniform {
        let light = Sun {
            irradiance_w_m2: (self.light.irradiance_w_m2 * self.counts).to_array(),
            disc: self.disc && !metered,
            ..scene.sun.clone()
        };
        ViewUniform::new(&light, &self.stand(stand))
    }

    /// For the shaders; a meter does not look at the disc.
    pub(crate) fn uniform(&self, uncovered: Uncovered, metered: bool, glares: bool) -> MoonUniform {
        MoonUniform::new(self.disc && !metered, glares, &self.seen, &self.light, uncovered)
    }
}
