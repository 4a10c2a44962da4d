//! From a job to its frames.

use super::{Frames, JobRequest, MAX_FRAMES, Panorama, vary::bits};
use crate::{
    camera::Projection,
    document::Scene,
    problem::{Problem, SceneError},
    timeline::Playback,
};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use std::sync::Arc;

/// A part of a frame, pixels from its top left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Window {
    /// Columns before it.
    pub x_px: u32,
    /// Rows above it.
    pub y_px: u32,
    /// Columns of it.
    pub width_px: u32,
    /// Rows of it.
    pub height_px: u32,
}

/// One frame of a job.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedFrame {
    /// What is seen.
    pub scene: Arc<Scene>,
    /// The part of the job's width and height that it is, where it is not all.
    pub window: Option<Window>,
    /// What tells it from the job's other frames: fields of the scene by their pointer, or `at_s` of a timeline.
    pub parameters: Map<String, Value>,
}

/// A job made ready to be asked for its frames.
#[derive(Debug)]
pub struct JobPlan {
    request: JobRequest,
    source: Source,
    count: u32,
}

#[derive(Debug)]
enum Source {
    /// The documents stand in the request.
    Listed,
    /// The base scene with all its defaults, so that every field is there.
    Varied(Value),
    Played(Playback),
    Tiled(Arc<Scene>),
}

impl JobPlan {
    /// Makes a job ready; of a request that has been read and checked, nothing can be wrong.
    ///
    /// # Errors
    /// Where the request is of more frames than a job may have, or its base is not a scene.
    pub fn new(request: JobRequest) -> Result<Self, SceneError> {
        let base = |scene: &Value| Scene::from_value(scene).map_err(|e| within(e, "/frames/scene"));
        let source = match &request.frames {
            Frames::List(_) => Source::Listed,
            Frames::Grid(grid) => Source::Varied(json!(base(&grid.scene)?)),
            Frames::Random(random) => Source::Varied(json!(base(&random.scene)?)),
            Frames::Timeline(lapse) => Source::Played(lapse.timeline.playback()?),
            Frames::Panorama(panorama) => {
                let mut scene = base(&panorama.scene)?;
                scene.camera.projection = Projection::Equirectangular {};
                Source::Tiled(scene.into())
            }
        };
        let count = frames_of(&request);
        let few = u32::try_from(count).ok().filter(|count| *count <= MAX_FRAMES);
        let count = few.ok_or_else(|| {
            let allowed = format!("of {MAX_FRAMES} frames at most");
            let mut problem = Problem::new("/frames".into(), &Value::Null, allowed);
            problem.message = format!("the job has {count} frames; it may have {MAX_FRAMES} at most");
            SceneError::Invalid(vec![problem])
        })?;
        Ok(Self {
            request,
            source,
            count,
        })
    }

    /// The request.
    #[must_use]
    pub const fn request(&self) -> &JobRequest {
        &self.request
    }

    /// How many frames there are.
    #[must_use]
    pub const fn count(&self) -> u32 {
        self.count
    }

    /// Frames that among them have all scenes of the job; the tiles of a panorama are of one.
    #[must_use]
    pub fn scenes(&self) -> std::ops::Range<u32> {
        match self.source {
            Source::Tiled(_) => 0..1,
            _ => 0..self.count,
        }
    }

    /// The frame of a number, from 0.
    ///
    /// # Errors
    /// Where it is not a scene, or there is no such frame.
    pub fn frame(&self, number: u32) -> Result<PlannedFrame, SceneError> {
        let document = |n: u32| match &self.request.frames {
            Frames::List(list) => list.scenes.get(n as usize),
            _ => None,
        };
        match &self.source {
            Source::Listed => {
                let at = format!("/frames/scenes/{number}");
                let scene = Scene::from_value(document(number).unwrap_or(&Value::Null));
                Ok(plain(scene.map_err(|e| within(e, &at))?, Map::new()))
            }
            Source::Varied(base) => {
                let parameters = self.parameters(number);
                Ok(plain(varied(base, &parameters)?, parameters))
            }
            Source::Played(playback) => {
                let at_s = self.at_s(number);
                let parameters = Map::from_iter([("at_s".to_owned(), json!(at_s))]);
                Ok(plain(playback.at(at_s)?, parameters))
            }
            Source::Tiled(scene) => Ok(PlannedFrame {
                scene: Arc::clone(scene),
                window: self.tile(number),
                parameters: Map::new(),
            }),
        }
    }

    /// Tiles across and down of a panorama.
    #[must_use]
    pub fn tiles(&self) -> Option<(u32, u32)> {
        let Frames::Panorama(Panorama { tile_px, .. }) = self.request.frames else {
            return None;
        };
        let JobRequest {
            width_px, height_px, ..
        } = self.request;
        Some((width_px.div_ceil(tile_px), height_px.div_ceil(tile_px)))
    }

    /// The time of a frame of a timeline.
    fn at_s(&self, number: u32) -> f64 {
        let Frames::Timeline(lapse) = &self.request.frames else {
            return 0.0;
        };
        let share = f64::from(number) / f64::from((lapse.count - 1).max(1));
        lapse.from_s * (1.0 - share) + lapse.to_s * share
    }

    fn tile(&self, number: u32) -> Option<Window> {
        let Frames::Panorama(Panorama { tile_px, .. }) = self.request.frames else {
            return None;
        };
        let (across, _) = self.tiles()?;
        let (x_px, y_px) = (number % across * tile_px, number / across * tile_px);
        Some(Window {
            x_px,
            y_px,
            width_px: tile_px.min(self.request.width_px - x_px),
            height_px: tile_px.min(self.request.height_px.checked_sub(y_px)?),
        })
    }

    /// The values of the fields that vary.
    fn parameters(&self, number: u32) -> Map<String, Value> {
        match &self.request.frames {
            Frames::Grid(grid) => {
                let mut rest = u64::from(number);
                let mut values: Vec<_> = (grid.axes.iter().rev())
                    .map(|axis| {
                        let step = rest % axis.count();
                        rest /= axis.count();
                        (axis.field().to_owned(), axis.value(step))
                    })
                    .collect();
                values.reverse();
                values.into_iter().collect()
            }
            Frames::Random(random) => (random.ranges.iter().enumerate())
                .map(|(i, range)| {
                    (
                        range.field().to_owned(),
                        range.value(bits(random.seed, number, i)),
                    )
                })
                .collect(),
            _ => Map::new(),
        }
    }
}

/// How many frames a request asks for, however many are allowed.
pub(super) fn frames_of(request: &JobRequest) -> u64 {
    match &request.frames {
        Frames::List(list) => list.scenes.len() as u64,
        Frames::Grid(grid) => grid
            .axes
            .iter()
            .fold(1, |all, axis| all.saturating_mul(axis.count())),
        Frames::Random(random) => random.count.into(),
        Frames::Timeline(lapse) => lapse.count.into(),
        Frames::Panorama(Panorama { tile_px, .. }) => {
            let tiles = |side: u32| u64::from(side.div_ceil(*tile_px));
            tiles(request.width_px) * tiles(request.height_px)
        }
    }
}

fn plain(scene: Scene, parameters: Map<String, Value>) -> PlannedFrame {
    PlannedFrame {
        scene: scene.into(),
        window: None,
        parameters,
    }
}

fn varied(base: &Value, parameters: &Map<String, Value>) -> Result<Scene, SceneError> {
    let mut document = base.clone();
    for (field, value) in parameters {
        let Some(place) = document.pointer_mut(field) else {
            let mut problem = Problem::new(field.clone(), &Value::Null, "a field of the scene".into());
            problem.message = format!("the job's scene has no field {field}");
            return Err(SceneError::Invalid(vec![problem]));
        };
        *place = value.clone();
    }
    Scene::from_value(&document)
}

/// The error of a document that stands at `at`.
pub(super) fn within(error: SceneError, at: &str) -> SceneError {
    let SceneError::Invalid(problems) = error else {
        return error;
    };
    let moved = |problem: Problem| Problem {
        pointer: format!("{at}{}", problem.pointer),
        ..problem
    };
    SceneError::Invalid(problems.into_iter().map(moved).collect())
}
