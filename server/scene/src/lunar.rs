//! Where the moon stands: given outright, or by the lunar theory ELP-2000/82 in Meeus' selection (10" in longitude, 4"
//! in latitude), seen from the observer's place on the Earth's ellipsoid.

use crate::{
    celestial::{apply, horizon, lifted},
    direction::{Angles, Direction},
    document::Scene,
    moon::{Moon, MoonPlace},
    sun::{SunPosition, TimeAndPlace},
};
use astro::lunar::geocent_ecl_pos;

/// Mean radius (IAU), metres.
const MOON_RADIUS_M: f64 = 1_737_400.0;
/// Mean distance of the centres, metres.
pub const MEAN_DISTANCE_M: f64 = 384_400_000.0;
/// Seen at its mean distance, degrees.
const MEAN_DIAMETER_DEG: f64 = 0.518;
/// Mean distance of the sun, metres (IAU 2012).
const ASTRONOMICAL_UNIT_M: f64 = 149_597_870_700.0;

/// The moon as it is seen from the scene's origin. Vectors are in the world frame and of unit length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoonSeen {
    /// Towards the moon.
    pub direction: [f64; 3],
    /// From the moon towards the sun.
    pub light: [f64; 3],
    /// The moon's north pole.
    pub north: [f64; 3],
    /// Angle between sun and observer as seen from the moon, degrees.
    pub phase_angle_deg: f64,
    /// Diameter of the disc, degrees.
    pub angular_diameter_deg: f64,
    /// Distance, metres.
    pub distance_m: f64,
}

impl Scene {
    /// The moon, if the scene has one.
    #[must_use]
    pub fn moon_seen(&self) -> Option<MoonSeen> {
        let moon = self.moon.as_ref()?;
        let (direction, computed_m) = match (&moon.position, &self.sun.position) {
            (Some(direction), _) => (direction.unit(), None),
            (None, SunPosition::TimeAndPlace(place)) => {
                let (direction, distance_m) = place.moon(self.time_s)?;
                (direction, Some(distance_m))
            }
            (None, SunPosition::Direction(_)) => return None,
        };
        let distance_m = computed_m.unwrap_or(MEAN_DISTANCE_M);
        let (light, phase_angle_deg) = light(direction, self.sun_direction(), distance_m, moon);
        let by_distance = || computed_m.map(|d| 2.0 * (MOON_RADIUS_M / d).asin().to_degrees());
        let angular_diameter_deg = moon
            .angular_diameter_deg
            .or_else(by_distance)
            .unwrap_or(MEAN_DIAMETER_DEG);
        Some(MoonSeen {
            direction,
            light,
            north: self.firmament().ecliptic_pole(),
            phase_angle_deg,
            angular_diameter_deg,
            distance_m,
        })
    }

    /// Where the moon stands, if the scene has one.
    #[must_use]
    pub fn moon_place(&self) -> Option<MoonPlace> {
        let seen = self.moon_seen()?;
        let Angles {
            azimuth_deg,
            elevation_deg,
        } = Direction::Vector(seen.direction).to_angles();
        Some(MoonPlace {
            azimuth_deg,
            elevation_deg,
            phase_angle_deg: seen.phase_angle_deg,
            illuminated_fraction: 0.5 * (1.0 + seen.phase_angle_deg.to_radians().cos()),
            angular_diameter_deg: seen.angular_diameter_deg,
            distance_m: seen.distance_m,
        })
    }
}

/// Towards the sun from the moon, and the phase angle. With the elongation ψ, the sun's distance R and the moon's Δ,
/// tan α = R sin ψ / (Δ - R cos ψ) (Meeus, ch. 48). Where the scene says another phase angle, the sun's side stays.
fn light(moon: [f64; 3], sun: [f64; 3], distance_m: f64, settings: &Moon) -> ([f64; 3], f64) {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cos = dot(moon, sun);
    let across = [0, 1, 2].map(|i| sun[i] - cos * moon[i]);
    let sin = dot(across, across).sqrt();
    let computed = (ASTRONOMICAL_UNIT_M * sin).atan2(distance_m - ASTRONOMICAL_UNIT_M * cos);
    let angle = settings.phase_angle_deg.map_or(computed, f64::to_radians);
    let (sin_angle, cos_angle) = angle.sin_cos();
    // Sun and moon in one line: any side will do.
    let side = if sin > 1e-9 {
        across.map(|c| c / sin)
    } else {
        let level = moon[0].hypot(moon[1]);
        if level > 0.0 {
            [moon[1] / level, -moon[0] / level, 0.0]
        } else {
            [1.0, 0.0, 0.0]
        }
    };
    let light = [0, 1, 2].map(|i| sin_angle * side[i] - cos_angle * moon[i]);
    (light, angle.to_degrees())
}

impl TimeAndPlace {
    /// Unit vector towards the moon, and its distance in metres, from sea level at the place.
    fn moon(&self, time_s: f64) -> Option<([f64; 3], f64)> {
        let epoch = self.epoch(time_s)?;
        let (ecliptic, distance_km) = geocent_ecl_pos(epoch.terrestrial);
        let (obliquity, in_longitude) = epoch.obliquity_and_nutation();
        let (sin_long, cos_long) = (ecliptic.long + in_longitude).sin_cos();
        let (sin_lat, cos_lat) = ecliptic.lat.sin_cos();
        let (sin_ob, cos_ob) = obliquity.sin_cos();
        let geocentric_m = [
            cos_lat * cos_long,
            cos_lat * sin_long * cos_ob - sin_lat * sin_ob,
            cos_lat * sin_long * sin_ob + sin_lat * cos_ob,
        ]
        .map(|c| 1e3 * distance_km * c);
        let latitude = self.latitude_deg.to_radians();
        let sidereal = epoch.sidereal(self.longitude_deg);
        let observer_m = on_the_ellipsoid(latitude, sidereal);
        let from_here = [0, 1, 2].map(|i| geocentric_m[i] - observer_m[i]);
        let [east, north, up] = apply(&horizon(latitude, sidereal), from_here);
        let distance_m = east.hypot(north).hypot(up);
        let direction = [east, north, up].map(|c| c / distance_m);
        let direction = if self.refraction {
            lifted(direction)
        } else {
            direction
        };
        Some((direction, distance_m))
    }
}

/// A place at sea level (WGS 84), in the equatorial frame of the date, metres.
fn on_the_ellipsoid(latitude: f64, sidereal: f64) -> [f64; 3] {
    const EQUATOR_M: f64 = 6_378_137.0;
    const FLATTENING: f64 = 1.0 / 298.257_223_563;
    const SQUASHED: f64 = (1.0 - FLATTENING) * (1.0 - FLATTENING);
    let (sin, cos) = latitude.sin_cos();
    let curvature_m = EQUATOR_M / (cos * cos + SQUASHED * sin * sin).sqrt();
    [
        curvature_m * cos * sidereal.cos(),
        curvature_m * cos * sidereal.sin(),
        curvature_m * SQUASHED * sin,
    ]
}
