//! A timeline made ready: its keyframes as whole scenes.

use super::{
    Timeline,
    curve::{Four, Moment},
    drift::Drift,
    place, sphere,
    tween::tween,
};
use crate::{
    check::MAX_STEREOGRAPHIC_FOV_DEG,
    clouds::{Clouds, Layer, PlainMap, WeatherMap},
    document::Scene,
    haze::Haze,
    observer::Observer,
    problem::{Problem, SceneError},
    solar::moment as parsed,
    sun::SunPosition,
};
use serde_json::{Value, json};

/// A time written out longer than this is written anew.
const MOST_TIME_CHARS: usize = 40;

#[derive(Debug)]
pub(super) struct Track {
    keys: Vec<Key>,
    drift: Option<Drift>,
    /// The time of the scene at which `at_s` is 0; none where keyframes tell the time themselves.
    begin_s: Option<f64>,
}

#[derive(Debug)]
pub(super) struct Key {
    pub(super) at_s: f64,
    scene: Scene,
    /// The same scene, written such that what differs between keyframes is numbers as far as can be.
    pub(super) document: Value,
}

impl Track {
    pub(super) fn new(timeline: &Timeline) -> Result<Self, SceneError> {
        let base: Scene = complete(&timeline.scene)?;
        let is_time_told = timeline
            .keyframes
            .iter()
            .any(|key| key.patch.contains_key("time_s"));
        let mut scenes: Vec<(f64, Scene)> = match &timeline.keyframes[..] {
            [] => vec![(0.0, base.clone())],
            keyframes => keyframes
                .iter()
                .map(|key| Ok((key.at_s, complete(&timeline.document(key))?)))
                .collect::<Result<_, SceneError>>()?,
        };
        keep_seed(&mut scenes);
        let keys = scenes.into_iter().map(|(at_s, scene)| {
            let document = serde_json::to_value(normal(&scene)).map_err(|e| unreadable(&e))?;
            Ok(Key {
                at_s,
                scene,
                document,
            })
        });
        let mut track = Self {
            keys: keys.collect::<Result<_, SceneError>>()?,
            drift: None,
            begin_s: (!is_time_told).then_some(base.time_s),
        };
        track.drift = Drift::new(&track);
        Ok(track)
    }

    pub(super) fn keys(&self) -> &[Key] {
        &self.keys
    }

    pub(super) fn at(&self, at_s: f64) -> Result<Scene, SceneError> {
        let place = self.place(at_s);
        let mut document = match place {
            Place::At(i) => serde_json::to_value(&self.keys[i].scene).map_err(|e| unreadable(&e))?,
            Place::Between(i, ref moment) => {
                let documents = self.four(i).part(|key| Some(&key.document));
                let mut document = documents.map_or(Value::Null, |four| tween("scene", four, moment));
                self.mend(&mut document, i, moment, at_s);
                document
            }
        };
        document["time_s"] = self.time_s(at_s).into();
        if let Some(drift) = &self.drift {
            drift.add_to(&mut document, self, at_s);
        }
        Scene::from_value(&document)
    }

    /// The scene's time.
    pub(super) fn time_s(&self, at_s: f64) -> f64 {
        match (self.begin_s, self.place(at_s)) {
            (Some(begin_s), _) => begin_s + at_s,
            (None, Place::At(i)) => self.keys[i].scene.time_s,
            (None, Place::Between(i, moment)) => moment.number(self.times(i)),
        }
    }

    /// How fast the scene's time passes.
    pub(super) fn pace(&self, i: usize, moment: &Moment) -> f64 {
        self.begin_s.map_or_else(|| moment.rate(self.times(i)), |_| 1.0)
    }

    fn times(&self, i: usize) -> Four<f64> {
        let Four {
            before,
            from,
            to,
            after,
        } = self.four(i);
        Four {
            before: before.map(|key| key.scene.time_s),
            from: from.scene.time_s,
            to: to.scene.time_s,
            after: after.map(|key| key.scene.time_s),
        }
    }

    /// Which keyframe counts, or between which and the next.
    pub(super) fn place(&self, at_s: f64) -> Place {
        let after = self.keys.partition_point(|key| key.at_s <= at_s);
        let Some(i) = after.checked_sub(1) else {
            return Place::At(0);
        };
        if after == self.keys.len() || self.keys[i].at_s == at_s {
            return Place::At(i);
        }
        let length_s = self.keys[after].at_s - self.keys[i].at_s;
        Place::Between(i, self.moment(i, (at_s - self.keys[i].at_s) / length_s))
    }

    /// A part of the way from a keyframe to the next.
    pub(super) fn moment(&self, i: usize, part: f64) -> Moment {
        let at_s = |i: usize| self.keys.get(i).map(|key| key.at_s);
        let span =
            |from: Option<usize>, to: usize| from.and_then(at_s).zip(at_s(to)).map_or(1.0, |(a, b)| b - a);
        Moment {
            before_s: span(i.checked_sub(1), i),
            length_s: span(Some(i), i + 1),
            after_s: span(Some(i + 1), i + 2),
            part,
        }
    }

    /// A keyframe that has a next, with its neighbours.
    pub(super) fn four(&self, i: usize) -> Four<&Key> {
        Four {
            before: i.checked_sub(1).and_then(|i| self.keys.get(i)),
            from: &self.keys[i],
            to: &self.keys[i + 1],
            after: self.keys.get(i + 2),
        }
    }

    /// What member by member cannot be right.
    fn mend(&self, document: &mut Value, i: usize, moment: &Moment, at_s: f64) {
        let Four { from, to, .. } = self.four(i);
        self.mend_sun(document, [&from.scene, &to.scene], moment, at_s);
        mend_altitude(document, [&from.scene, &to.scene]);
        let air_top_m = document.pointer("/atmosphere/top_m").and_then(Value::as_f64);
        if let (Some(most), Some(top_m)) = (air_top_m, document.pointer_mut("/haze/top_m"))
            && top_m.as_f64().is_some_and(|top_m| top_m > most)
        {
            *top_m = most.into();
        }
        // A fisheye's angle may be greater before its mapping changes than the new mapping can show.
        let projection = &mut document["camera"]["projection"];
        if projection["mapping"] == "stereographic"
            && projection["fov_deg"].as_f64() > Some(MAX_STEREOGRAPHIC_FOV_DEG)
        {
            projection["fov_deg"] = MAX_STEREOGRAPHIC_FOV_DEG.into();
        }
    }

    /// From a sun by time to one by direction, or back: from where the one is now to the other.
    fn mend_sun(&self, document: &mut Value, ends: [&Scene; 2], moment: &Moment, at_s: f64) {
        let is_timed = |scene: &Scene| matches!(scene.sun.position, SunPosition::TimeAndPlace(_));
        if is_timed(ends[0]) == is_timed(ends[1]) {
            return;
        }
        let time_s = self.time_s(at_s);
        let [from, to] = ends.map(|scene| {
            let now = Scene {
                time_s,
                sun: scene.sun.clone(),
                ..Scene::default()
            };
            now.sun_direction()
        });
        document["sun"]["position"] = sphere::value(sphere::slerp(from, to, moment.share()));
    }
}

/// Where a time is among the keyframes.
pub(super) enum Place {
    At(usize),
    /// This and the next.
    Between(usize, Moment),
}

/// The straight way between two places may lead through the planet: it is lifted to the lower of both.
fn mend_altitude(document: &mut Value, ends: [&Scene; 2]) {
    let position: Option<[f64; 3]> = serde_json::from_value(document["camera"]["position_m"].clone()).ok();
    let Some((position_m, radius_m)) = position.zip(document["planet"]["radius_m"].as_f64()) else {
        return;
    };
    let least_m = ends
        .map(|scene| scene.observer().altitude_m)
        .into_iter()
        .fold(f64::INFINITY, f64::min);
    let Observer { altitude_m, up } = Observer::at(position_m, radius_m);
    if altitude_m < least_m {
        // Beyond what the sum's rounding takes away: 53 bits of the largest number.
        let size = position_m.iter().fold(radius_m, |most, c| c.abs().max(most));
        let lift_m = least_m - altitude_m + 8.0 * f64::EPSILON * size;
        document["camera"]["position_m"] = json!([0, 1, 2].map(|i| position_m[i] + lift_m * up[i]));
    }
}

/// A document that validation let pass, with all its members.
fn complete(document: &Value) -> Result<Scene, SceneError> {
    let mut scene: Scene = serde_json::from_value(document.clone()).map_err(|e| unreadable(&e))?;
    if let SunPosition::TimeAndPlace(at) = &mut scene.sun.position
        && at.time.len() > MOST_TIME_CHARS
        && let Some(time) = parsed(&at.time)
    {
        at.time = place::text(time);
    }
    Ok(scene)
}

fn unreadable(error: &serde_json::Error) -> SceneError {
    let mut problem = Problem::new(String::new(), &Value::Null, "a timeline".into());
    problem.message = error.to_string();
    SceneError::Invalid(vec![problem])
}

/// Haze by extinction, layers with coverages and optical depths of their own.
fn normal(scene: &Scene) -> Scene {
    let haze = scene.haze.as_ref().map(|haze| Haze {
        visibility_m: None,
        extinction_per_m: Some(haze.extinction()),
        ..haze.clone()
    });
    let mut clouds = scene.clouds.clone();
    if let Some(Clouds { coverage, layers, .. }) = &mut clouds {
        for layer in layers {
            match layer {
                Layer::Volume(volume) => volume.coverage = volume.coverage.or(Some(*coverage)),
                Layer::Sheet(sheet) => {
                    sheet.coverage = sheet.coverage.or(Some(*coverage));
                    sheet.optical_depth = Some(sheet.densest_optical_depth());
                }
            }
        }
    }
    Scene {
        haze,
        clouds,
        ..scene.clone()
    }
}

/// Where seeds differ, all clouds are carved by those of the first; the weather keeps its own, for it can fade.
fn keep_seed(scenes: &mut [(f64, Scene)]) {
    let seeds = |clouds: &Clouds| (clouds.seed, clouds.shape.seed);
    let mut all = scenes
        .iter()
        .filter_map(|(_, scene)| scene.clouds.as_ref().map(seeds));
    let Some(first) = all.next() else { return };
    if all.all(|other| other == first) {
        return;
    }
    for clouds in scenes.iter_mut().filter_map(|(_, scene)| scene.clouds.as_mut()) {
        let own = clouds.seed;
        match &mut clouds.weather_map {
            WeatherMap::Procedural(map) => map.seed = map.seed.or(Some(own)),
            WeatherMap::Blend(blend) => {
                for map in [&mut blend.from, &mut blend.to] {
                    if let PlainMap::Procedural(map) = map {
                        map.seed = map.seed.or(Some(own));
                    }
                }
            }
            WeatherMap::Asset(_) | WeatherMap::Uniform(_) => {}
        }
        (clouds.seed, clouds.shape.seed) = first;
    }
}
