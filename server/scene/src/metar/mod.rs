//! A weather report in, a scene out.
//!
//! A report (METAR or SPECI) tells the air at an airport: how far one sees, what hides the view, temperature, humidity
//! and pressure, and when. Its place follows from the station's indicator. Every group is read or refused by name;
//! what a scene cannot show yet is told in the answer.

mod air;
mod fault;
mod ground;
mod groups;
mod layer;
mod obscuration;
mod read;
pub mod report;
mod scan;
mod sky;
mod station;
mod when;
mod words;

pub use fault::ReportFault;
pub use report::Report;

use crate::{
    check::Check,
    document::Scene,
    problem::{Problem, Problems, SceneError},
    solar::YEARS,
    sun::{SunPosition, TimeAndPlace},
};
use chrono::{DateTime, Datelike, Utc};
use read::Part;
use report::Place;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::time::{SystemTime, UNIX_EPOCH};

/// Longest report, bytes.
pub const MAX_REPORT_BYTES: usize = 4096;

/// Asks for the scene that a weather report tells.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MetarRequest {
    /// The report, METAR or SPECI, 4096 bytes at most; `=` may end it.
    #[schemars(example = "METAR EGLL 092050Z 24008KT 9999 FEW018 SCT033 17/12 Q1019")]
    pub metar: String,
    /// The report is the last of its day and time up to the end of this date (UTC), as `2026-06-21`; null: up to now.
    /// Reports tell neither month nor year.
    #[serde(default)]
    pub date: Option<String>,
    /// Where the station is, north positive, degrees; null: as its indicator tells.
    #[serde(default)]
    #[schemars(range(min = -90.0, max = 90.0))]
    pub latitude_deg: Option<f64>,
    /// Where the station is, east positive, degrees; given with `latitude_deg` or not at all.
    #[serde(default)]
    #[schemars(range(min = -180.0, max = 180.0))]
    pub longitude_deg: Option<f64>,
}

/// The scene that a weather report tells, and how.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct MetarAnswer {
    /// The scene, complete.
    pub scene: Scene,
    /// What was read.
    pub report: Report,
    /// Groups of the report that have no effect on the scene, in capital letters.
    pub not_rendered: Vec<String>,
    /// What was assumed.
    pub notes: Vec<String>,
}

impl MetarRequest {
    /// The scene that the report tells. `now` is the clock's time, for a report without a date.
    ///
    /// # Errors
    /// [`SceneError::Report`] names the group that is not understood; [`SceneError::Invalid`] a date before the years for
    /// which the sun's place is known.
    pub fn scene(&self, now: SystemTime) -> Result<MetarAnswer, SceneError> {
        let text = self.metar.to_ascii_uppercase();
        let read::Reading {
            mut report,
            clock,
            passed,
        } = read::read(&text)?;
        let moment = when::last(clock, self.until(now)).filter(|moment| YEARS.contains(&moment.year()));
        let Some(moment) = moment else {
            return Err(SceneError::Invalid(vec![wrong_date(&json!(self.date))]));
        };
        report.time = when::text(moment);
        report.place = self.place(&report.station);
        let both = report.temperature_c.zip(report.dew_point_c);
        report.relative_humidity = both.map(|(air, dew)| air::relative_humidity(air, dew));

        let (mut scene, mut notes) = (Scene::clear(), Vec::new());
        match report.place {
            Some(place) => scene.sun.position = SunPosition::TimeAndPlace(sun(&report, place)),
            None => notes.push(format!(
                "it is not known where {} is: the sun keeps the default direction; give `latitude_deg` and \
                 `longitude_deg`",
                report.station
            )),
        }
        let air = air::air(&report);
        let snow = ground::snow(&report);
        let sky = sky::sky(&report, air.is_fogged);
        let mut not_rendered: Vec<String> = passed
            .into_iter()
            .filter(|(part, _)| match part {
                Part::None => true,
                Part::Wind => sky.clouds.is_none(),
                Part::Cloud(i) => !sky.shown.contains(i),
            })
            .map(|(_, text)| text)
            .collect();
        let shown = [
            air.shown,
            snow.as_ref().and_then(|(_, weather, _)| *weather),
            sky.rain,
        ];
        let is_hidden = |weather: &&report::Weather| !shown.iter().flatten().any(|shown| *shown == *weather);
        not_rendered.extend(
            report
                .weather
                .iter()
                .filter(is_hidden)
                .map(|weather| weather.text.clone()),
        );
        notes.extend(air.notes);
        notes.extend(sky.notes);
        scene.atmosphere = Some(air.atmosphere);
        scene.haze = air.haze;
        scene.clouds = sky.clouds;
        if let Some((albedo, _, note)) = snow {
            scene.planet.ground_albedo = [albedo; 3];
            notes.push(note);
        }
        Ok(MetarAnswer {
            scene,
            report,
            not_rendered,
            notes,
        })
    }

    /// The report is not later than this.
    fn until(&self, now: SystemTime) -> DateTime<Utc> {
        let date = self.date.as_deref().and_then(when::date).and_then(when::end_of);
        date.unwrap_or_else(|| {
            let seconds = now.duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
            let now = i64::try_from(seconds)
                .ok()
                .and_then(|s| DateTime::from_timestamp(s, 0));
            when::about(now.unwrap_or_default())
        })
    }

    fn place(&self, station: &str) -> Option<Place> {
        let known = station::place(station);
        let Some((latitude_deg, longitude_deg)) = self.latitude_deg.zip(self.longitude_deg) else {
            return known;
        };
        Some(Place {
            latitude_deg,
            longitude_deg,
            elevation_m: known.map_or(0.0, |place| place.elevation_m),
        })
    }
}

impl Check for MetarRequest {
    fn check(&self, at: &str, problems: &mut Problems) {
        if self.metar.len() > MAX_REPORT_BYTES {
            let allowed = format!("a report of {MAX_REPORT_BYTES} bytes at most");
            problems.push(Problem::new(format!("{at}/metar"), &json!(self.metar), allowed));
        }
        let is_in_range = |date: &str| when::date(date).is_some_and(|date| YEARS.contains(&date.year()));
        if self.date.as_deref().is_some_and(|date| !is_in_range(date)) {
            problems.push(wrong_date(&json!(self.date)));
        }
        let halves = [
            ("latitude_deg", self.latitude_deg),
            ("longitude_deg", self.longitude_deg),
        ];
        for ((missing, value), (_, other)) in [(halves[0], halves[1]), (halves[1], halves[0])] {
            if value.is_none() && other.is_some() {
                let allowed = "given, since the other half of the place is".into();
                problems.push(Problem::new(format!("{at}/{missing}"), &Value::Null, allowed));
            }
        }
    }
}

fn wrong_date(value: &Value) -> Problem {
    let years = format!("from {} to {}", YEARS.start(), YEARS.end());
    let allowed = format!("a date like 2026-06-21, such that the report is of the years {years}");
    Problem::new("/date".into(), value, allowed)
}

/// Where the sun stood, as it was seen.
fn sun(report: &Report, place: Place) -> TimeAndPlace {
    TimeAndPlace {
        time: report.time.clone(),
        latitude_deg: place.latitude_deg,
        longitude_deg: place.longitude_deg,
        refraction: true,
    }
}
