//! What no schema can say of a job. Every frame is checked before the first is rendered.

use super::{
    Axis, Frames, JobPlan, JobRequest, Panorama, Spread, TimelineFrames, frames::Film, plan::within,
};
use crate::{
    camera::Projection,
    check::{Check, direction},
    document::Scene,
    frame::MAX_SIDE_PX,
    problem::{Problem, Problems, SceneError},
};
use serde_json::{Value, json};
use std::{collections::HashSet, ops::Range, sync::Mutex, thread};

/// Fewer frames are not worth another thread.
const LEAST_A_THREAD: u32 = 256;

impl Check for JobRequest {
    fn check(&self, at: &str, problems: &mut Problems) {
        self.size(at, problems);
        for (i, probed) in self.probe.iter().enumerate() {
            direction(probed, &format!("{at}/probe/{i}"), problems);
        }
        let frames = format!("{at}/frames");
        match &self.frames {
            Frames::List(_) => {}
            Frames::Grid(grid) => fields(
                grid.axes.iter().map(Axis::field),
                &grid.scene,
                &format!("{frames}/axes"),
                problems,
            ),
            Frames::Random(random) => {
                let ranges = format!("{frames}/ranges");
                fields(
                    random.ranges.iter().map(Spread::field),
                    &random.scene,
                    &ranges,
                    problems,
                );
                for (i, spread) in random.ranges.iter().enumerate() {
                    order(spread, &format!("{ranges}/{i}"), problems);
                }
            }
            Frames::Timeline(lapse) => self.timeline(lapse, &frames, problems),
            Frames::Panorama(panorama) => self.panorama(panorama, at, problems),
        }
        if problems.is_empty()
            && let Err(error) = self.all_frames()
        {
            problems.extend(match within(error, at) {
                SceneError::Invalid(found) => found,
                other => {
                    let mut problem = Problem::new(frames, &Value::Null, "a job".into());
                    problem.message = other.to_string();
                    vec![problem]
                }
            });
        }
    }
}

impl JobRequest {
    fn size(&self, at: &str, problems: &mut Problems) {
        if matches!(self.frames, Frames::Panorama(_)) {
            return;
        }
        for (field, side) in [("width_px", self.width_px), ("height_px", self.height_px)] {
            if side > MAX_SIDE_PX {
                let allowed =
                    format!("a whole number from 1 to {MAX_SIDE_PX} pixels where frames are no panorama");
                problems.push(Problem::new(format!("{at}/{field}"), &json!(side), allowed));
            }
        }
    }

    fn timeline(&self, lapse: &TimelineFrames, at: &str, problems: &mut Problems) {
        lapse.timeline.check(&format!("{at}/timeline"), problems);
        if lapse.to_s < lapse.from_s {
            let allowed = format!("a number of seconds of `from_s` ({}) or more", lapse.from_s);
            problems.push(Problem::new(format!("{at}/to_s"), &json!(lapse.to_s), allowed));
        }
        let mut seen = HashSet::new();
        for (i, film) in lapse.films.iter().enumerate() {
            let place = || format!("{at}/films/{i}");
            if !seen.insert(film) {
                problems.push(Problem::new(
                    place(),
                    &json!(film),
                    "another film than those before it".into(),
                ));
            }
            if self.format().is_linear() {
                let allowed = "left out where `format` holds radiance: films show pictures".into();
                problems.push(Problem::new(place(), &json!(film), allowed));
            }
            if *film == Film::Gif && self.width_px.max(self.height_px) > u32::from(u16::MAX) {
                problems.push(Problem::new(
                    place(),
                    &json!(film),
                    "left out for frames this large".into(),
                ));
            }
        }
    }

    fn panorama(&self, panorama: &Panorama, at: &str, problems: &mut Problems) {
        if !matches!(self.format(), crate::Format::Exr | crate::Format::ExrFloat) {
            let allowed = "`exr` or `exr-float` for a panorama, which becomes one OpenEXR file".into();
            problems.push(Problem::new(format!("{at}/format"), &json!(self.format), allowed));
        }
        if !panorama.tile_px.is_multiple_of(16) {
            let allowed = "a whole number from 16 to 4096 pixels, a multiple of 16".into();
            problems.push(Problem::new(
                format!("{at}/frames/tile_px"),
                &json!(panorama.tile_px),
                allowed,
            ));
        }
    }

    /// Makes every frame once.
    fn all_frames(&self) -> Result<(), SceneError> {
        let plan = JobPlan::new(self.clone())?;
        let count = plan.scenes().end;
        let threads = thread::available_parallelism().map_or(1, |n| u32::try_from(n.get()).unwrap_or(1));
        let threads = threads.min(count.div_ceil(LEAST_A_THREAD)).max(1);
        let share = count.div_ceil(threads);
        let first: Mutex<Option<(u32, SceneError)>> = Mutex::new(None);
        let check = |frames: Range<u32>| {
            for number in frames {
                if let Err(error) = self.one_frame(&plan, number) {
                    let mut first = first.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
                    if first.as_ref().is_none_or(|(known, _)| number < *known) {
                        *first = Some((number, error));
                    }
                    return;
                }
            }
        };
        thread::scope(|scope| {
            for begin in (0..count).step_by(share as usize) {
                let check = &check;
                scope.spawn(move || check(begin..(begin + share).min(count)));
            }
        });
        let found = first
            .into_inner()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        found.map_or(Ok(()), |(_, error)| Err(error))
    }

    fn one_frame(&self, plan: &JobPlan, number: u32) -> Result<(), SceneError> {
        let frame = plan.frame(number).map_err(|e| self.of_frame(e, plan, number))?;
        let JobRequest {
            width_px, height_px, ..
        } = *self;
        if matches!(frame.scene.camera.projection, Projection::Cubemap {}) && width_px != 6 * height_px {
            let allowed =
                format!("6 times `height_px` ({height_px}) where frames are cubemaps, as frame {number} is");
            let problem = Problem::new("/width_px".into(), &json!(width_px), allowed);
            return Err(SceneError::Invalid(vec![problem]));
        }
        Ok(())
    }

    /// The error of a frame, as the author of the job finds it.
    fn of_frame(&self, error: SceneError, plan: &JobPlan, number: u32) -> SceneError {
        let at = match &self.frames {
            // The pointers lead there already.
            Frames::List(_) => return error,
            Frames::Grid(_) => "/frames/axes",
            Frames::Random(_) => "/frames/ranges",
            Frames::Timeline(_) => "/frames/timeline",
            Frames::Panorama(_) => "/frames/scene",
        };
        let SceneError::Invalid(problems) = error else {
            return error;
        };
        let told = |problem: Problem| Problem {
            message: format!(
                "in frame {number} of {}, {}{}",
                plan.count(),
                problem.pointer,
                colon(&problem)
            ),
            pointer: at.into(),
            ..problem
        };
        SceneError::Invalid(problems.into_iter().map(told).collect())
    }
}

fn colon(problem: &Problem) -> String {
    format!(": {}", problem.message)
}

/// Fields that vary must be there, and each only once.
fn fields<'a>(varied: impl Iterator<Item = &'a str>, scene: &Value, at: &str, problems: &mut Problems) {
    let Ok(scene) = Scene::from_value(scene) else {
        // Told when the plan is made.
        return;
    };
    let document = json!(scene);
    let mut before: Vec<&str> = Vec::new();
    for (i, field) in varied.enumerate() {
        let place = format!("{at}/{i}/field");
        let inside = |outer: &str, inner: &str| {
            inner
                .strip_prefix(outer)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
        };
        if field.is_empty() || document.pointer(field).is_none() {
            let allowed =
                "a JSON pointer to a field that the job's scene has, such as /sun/position/elevation_deg"
                    .into();
            problems.push(Problem::new(place, &json!(field), allowed));
        } else if before
            .iter()
            .any(|other| inside(other, field) || inside(field, other))
        {
            problems.push(Problem::new(
                place,
                &json!(field),
                "another field than those before it".into(),
            ));
        }
        before.push(field);
    }
}

fn order(spread: &Spread, at: &str, problems: &mut Problems) {
    let Spread::Range(range) = spread else { return };
    let (least, most) = if range.whole {
        (range.from.ceil(), range.to.floor())
    } else {
        (range.from, range.to)
    };
    if most < least {
        let words = if range.whole {
            "a number with a whole one between `from` and it"
        } else {
            "a number of `from` or more"
        };
        problems.push(Problem::new(format!("{at}/to"), &json!(range.to), words.into()));
    }
}
