//! Where the sun stands: given outright, or by the Solar Position Algorithm (Reda and Andreas 2004), which is within
//! 0.0003° for the years that we take.

use crate::{
    direction::{Angles, Direction},
    document::Scene,
    probe::SunPlace,
    sun::{SunPosition, TimeAndPlace},
};
use chrono::{DateTime, Datelike, TimeDelta, Utc};
use solar_positioning::{Location, RefractionCorrection, SolarPositions, delta_t};
use std::{ops::RangeInclusive, time::Duration};

/// Years for which the sun's place is computed.
pub(crate) const YEARS: RangeInclusive<i32> = 1900..=2100;

/// Air at the ground, whose refraction lifts the sun: hPa and °C, the usual assumption of solar almanacs.
pub(crate) const PRESSURE_HPA: f64 = 1013.25;
pub(crate) const TEMPERATURE_C: f64 = 12.0;

impl Scene {
    /// Unit vector towards the sun in the world frame at the origin. Zeros for a scene that validation refuses.
    #[must_use]
    pub fn sun_direction(&self) -> [f64; 3] {
        match &self.sun.position {
            SunPosition::Direction(direction) => direction.unit(),
            SunPosition::TimeAndPlace(at) => at.direction(self.time_s).map_or([0.0; 3], |d| d.unit()),
        }
    }

    /// Where the sun stands at the origin: azimuth in 0..360 and elevation.
    #[must_use]
    pub fn sun_place(&self) -> SunPlace {
        let Angles {
            azimuth_deg,
            elevation_deg,
        } = Direction::Vector(self.sun_direction()).to_angles();
        SunPlace {
            azimuth_deg,
            elevation_deg,
        }
    }
}

impl TimeAndPlace {
    fn direction(&self, time_s: f64) -> Option<Direction> {
        let moment = later(moment(&self.time)?, time_s)?;
        let place = Location {
            latitude: self.latitude_deg,
            longitude: self.longitude_deg,
        };
        let refraction = if self.refraction {
            Some(RefractionCorrection::new(PRESSURE_HPA, TEMPERATURE_C).ok()?)
        } else {
            None
        };
        // UTC keeps within 0.9 s of UT1; delta-T leads from there to the even time of the ephemeris.
        let delta_t_s = delta_t::estimate_from_date_like(&moment).ok()?;
        let sun = SolarPositions::new()
            .at(&moment, place, 0.0, delta_t_s, refraction)
            .ok()?;
        Some(Direction::angles(sun.azimuth(), sun.elevation_angle()))
    }
}

/// Reads RFC 3339, years as in [`YEARS`].
pub(crate) fn moment(time: &str) -> Option<DateTime<Utc>> {
    let moment = DateTime::parse_from_rfc3339(time).ok()?.to_utc();
    YEARS.contains(&moment.year()).then_some(moment)
}

/// The moment `time_s` seconds later, if its year is in [`YEARS`].
pub(crate) fn later(moment: DateTime<Utc>, time_s: f64) -> Option<DateTime<Utc>> {
    let by = TimeDelta::from_std(Duration::try_from_secs_f64(time_s.abs()).ok()?).ok()?;
    let by = if time_s < 0.0 { -by } else { by };
    moment
        .checked_add_signed(by)
        .filter(|moment| YEARS.contains(&moment.year()))
}
