//! What no schema can say: fields that contradict one another, or physics.

use crate::{
    camera::{FisheyeMapping, Projection},
    clouds,
    direction::Direction,
    document::Scene,
    frame::FrameDocument,
    ice_crystals, lights,
    observer::Observer,
    probe::ProbeRequest,
    problem::{Problem, Problems, number},
    solar::{YEARS, later, moment},
    sun::SunPosition,
    terrain,
};
use chrono::SecondsFormat;
use serde_json::{Value, json};

/// Highest camera, metres over the ground: a quarter of the way to the moon.
const MAX_ALTITUDE_M: f64 = 1e8;
/// A stereographic picture grows as tan(fov / 4), without end towards 360°.
pub(crate) const MAX_STEREOGRAPHIC_FOV_DEG: f64 = 300.0;

/// A document that is checked beyond its schema.
pub(crate) trait Check {
    /// Adds what is wrong; the document stands at the pointer `at`.
    fn check(&self, at: &str, problems: &mut Problems);
}

impl Check for Scene {
    fn check(&self, at: &str, problems: &mut Problems) {
        let camera = format!("{at}/camera");
        direction(&self.camera.direction, &format!("{camera}/direction"), problems);
        altitude(self, &format!("{camera}/position_m"), problems);
        if let Projection::Fisheye {
            fov_deg,
            mapping: FisheyeMapping::Stereographic,
        } = self.camera.projection
            && fov_deg > MAX_STEREOGRAPHIC_FOV_DEG
        {
            let allowed = format!(
                "a number from 1 to {MAX_STEREOGRAPHIC_FOV_DEG} degrees where `mapping` is `stereographic`"
            );
            problems.push(Problem::new(
                format!("{camera}/projection/fov_deg"),
                &json!(fov_deg),
                allowed,
            ));
        }
        sun(self, at, problems);
        haze(self, at, problems);
        moon(self, at, problems);
        airglow(self, at, problems);
        if let Some(clouds) = &self.clouds {
            clouds::check(clouds, &format!("{at}/clouds"), problems);
        }
        if let Some(terrain) = &self.terrain {
            terrain::check(terrain, &format!("{at}/terrain"), problems);
        }
        lights::check(&self.lights, &format!("{at}/lights"), problems);
        if let Some(crystals) = &self.ice_crystals {
            ice_crystals::check(crystals, &format!("{at}/ice_crystals"), problems);
        }
    }
}

impl Check for FrameDocument {
    fn check(&self, at: &str, problems: &mut Problems) {
        let mut leave_out = |field: &str, value: Value, reason: &str| {
            problems.push(Problem::new(
                format!("{at}/{field}"),
                &value,
                format!("left out where {reason}"),
            ));
        };
        match (&self.timeline, &self.scene, self.at_s) {
            (Some(_), Some(scene), _) => leave_out("scene", json!(scene), "`timeline` is given"),
            (None, _, Some(at_s)) => leave_out("at_s", json!(at_s), "there is no `timeline`"),
            (Some(timeline), None, _) => timeline.check(&format!("{at}/timeline"), problems),
            (None, scene, None) => {
                if let Some(scene) = scene {
                    scene.check(&format!("{at}/scene"), problems);
                }
            }
        }
        if !problems.is_empty() {
            return;
        }
        let scene = match self.seen() {
            Ok(scene) => scene,
            Err(error) => {
                let allowed = "a time at which the timeline is a scene".into();
                let mut problem = Problem::new(format!("{at}/at_s"), &json!(self.at_s), allowed);
                problem.message.push_str(&format!("; there, {error}"));
                return problems.push(problem);
            }
        };
        let Self {
            width_px, height_px, ..
        } = *self;
        if matches!(scene.camera.projection, Projection::Cubemap {}) && width_px != 6 * height_px {
            let allowed = format!("6 times `height_px` ({height_px}), for six square faces");
            problems.push(Problem::new(format!("{at}/width_px"), &json!(width_px), allowed));
        }
    }
}

impl Check for ProbeRequest {
    fn check(&self, at: &str, problems: &mut Problems) {
        self.scene.check(&format!("{at}/scene"), problems);
        for (i, d) in self.directions.iter().enumerate() {
            if problems.is_full() {
                return;
            }
            direction(d, &format!("{at}/directions/{i}"), problems);
        }
    }
}

pub(crate) fn direction(direction: &Direction, at: &str, problems: &mut Problems) {
    if let Direction::Vector(v) = direction
        && *v == [0.0; 3]
    {
        problems.push(Problem::new(
            at.into(),
            &json!(v),
            "a vector of any length but zero".into(),
        ));
    }
}

fn altitude(scene: &Scene, at: &str, problems: &mut Problems) {
    let Observer { altitude_m, .. } = scene.observer();
    if (0.0..=MAX_ALTITUDE_M).contains(&altitude_m) {
        return;
    }
    let allowed = format!("on the ground or above it, up to {MAX_ALTITUDE_M:e} metres");
    let mut problem = Problem::new(at.into(), &json!(scene.camera.position_m), allowed);
    let side = if altitude_m < 0.0 { "below" } else { "above" };
    problem.message.push_str(&format!(
        ", which is {} m {side} the ground",
        number(altitude_m.abs())
    ));
    problems.push(problem);
}

fn sun(scene: &Scene, at: &str, problems: &mut Problems) {
    let position = format!("{at}/sun/position");
    let place = match &scene.sun.position {
        SunPosition::Direction(d) => return direction(d, &position, problems),
        SunPosition::TimeAndPlace(place) => place,
    };
    let years = format!("from {} to {}", YEARS.start(), YEARS.end());
    match moment(&place.time) {
        None => {
            let allowed =
                format!("a date and time as in RFC 3339, like 2026-06-21T05:00:00Z, in the years {years}");
            problems.push(Problem::new(
                format!("{position}/time"),
                &json!(place.time),
                allowed,
            ));
        }
        Some(moment) if later(moment, scene.time_s).is_none() => {
            let allowed = format!(
                "a number of seconds that leads from {} to a time in the years {years}",
                moment.to_rfc3339_opts(SecondsFormat::Secs, true)
            );
            problems.push(Problem::new(
                format!("{at}/time_s"),
                &json!(scene.time_s),
                allowed,
            ));
        }
        Some(_) => {}
    }
}

fn haze(scene: &Scene, at: &str, problems: &mut Problems) {
    let Some(haze) = &scene.haze else { return };
    if let (Some(_), Some(extinction_per_m)) = (haze.visibility_m, haze.extinction_per_m) {
        problems.push(Problem::new(
            format!("{at}/haze/extinction_per_m"),
            &json!(extinction_per_m),
            "left out where `visibility_m` is given: both say how dense the haze is".into(),
        ));
    }
    if let Some(air) = &scene.atmosphere
        && haze.top_m > air.top_m
    {
        problems.push(Problem::new(
            format!("{at}/haze/top_m"),
            &json!(haze.top_m),
            format!(
                "a number of metres no higher than the air's top, {}",
                number(air.top_m)
            ),
        ));
    }
}

fn moon(scene: &Scene, at: &str, problems: &mut Problems) {
    if let Some(position) = scene.moon.as_ref().and_then(|moon| moon.position.as_ref()) {
        direction(position, &format!("{at}/moon/position"), problems);
    }
}

fn airglow(scene: &Scene, at: &str, problems: &mut Problems) {
    if let Some(airglow) = scene.atmosphere.as_ref().and_then(|air| air.airglow.as_ref())
        && airglow.top_m <= airglow.base_m
    {
        problems.push(Problem::new(
            format!("{at}/atmosphere/airglow/top_m"),
            &json!(airglow.top_m),
            format!("a number of metres above `base_m`, {}", number(airglow.base_m)),
        ));
    }
}
