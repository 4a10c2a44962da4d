//! A scene that changes: keyframes, and what lies between them.
//!
//! Every number passes through its keyframes without a corner and without overshooting them; directions do so on the
//! sphere. What is not a number changes half-way between two keyframes, save for what can fade: clouds by coverage and
//! density, haze and air by extinction, stars, moon and airglow by their light, weather by cross-fading its maps.

mod curve;
mod drift;
mod fade;
mod layers;
mod merge;
mod place;
mod sphere;
mod track;
mod tween;
mod weather;

use crate::{
    check::Check,
    document::Scene,
    problem::{Problem, Problems, SceneError, number},
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use track::Track;

/// Most keyframes of a timeline.
pub const MAX_KEYFRAMES: usize = 256;

/// A scene and what becomes of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Timeline {
    /// What all keyframes begin with. Its `time_s` is the time at which `at_s` is 0.
    #[schemars(with = "Scene")]
    pub scene: Value,
    /// What changes, and when. Before the first keyframe and after the last all stands still but time. Without any,
    /// only time passes.
    #[schemars(length(max = MAX_KEYFRAMES))]
    pub keyframes: Vec<Keyframe>,
}

/// The scene at one moment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Keyframe {
    /// When, seconds; later than the keyframe before.
    #[schemars(range(min = -1e9, max = 1e9))]
    pub at_s: f64,
    /// What differs from the timeline's scene: a JSON Merge Patch (RFC 7396). It is not added to the patches of other
    /// keyframes. Null switches a part off, as in a scene, and removes other members. An object of another `kind`
    /// replaces the one that was.
    #[serde(default)]
    pub patch: Map<String, Value>,
}

impl Default for Timeline {
    fn default() -> Self {
        Self {
            scene: json!({}),
            keyframes: Vec::new(),
        }
    }
}

impl Timeline {
    /// The scene at a time, in seconds as keyframes count them.
    ///
    /// At a keyframe it is the keyframe's own, but for what keeps clouds from jumping: their `seed` is the first
    /// keyframe's, and where the wind changes, `drift_m` is as far as it has carried them.
    ///
    /// # Errors
    /// Where a keyframe is not a scene, which validation refuses, or where `at_s` leads the sun's time out of its years.
    pub fn at(&self, at_s: f64) -> Result<Scene, SceneError> {
        self.playback()?.at(at_s)
    }

    /// Made ready to be asked for many moments.
    ///
    /// # Errors
    /// Where a keyframe is not a scene, which validation refuses.
    pub fn playback(&self) -> Result<Playback, SceneError> {
        Track::new(self).map(Playback)
    }

    /// The document that a keyframe makes of the scene.
    fn document(&self, keyframe: &Keyframe) -> Value {
        merge::merged(&self.scene, &keyframe.patch)
    }
}

/// A timeline whose keyframes have been read: each further moment costs one scene, however many there are.
#[derive(Debug)]
pub struct Playback(Track);

impl Playback {
    /// The scene at a time, as [`Timeline::at`].
    ///
    /// # Errors
    /// Where `at_s` leads the sun's time out of its years.
    pub fn at(&self, at_s: f64) -> Result<Scene, SceneError> {
        self.0.at(at_s)
    }
}

impl Check for Timeline {
    fn check(&self, at: &str, problems: &mut Problems) {
        if let Err(SceneError::Invalid(found)) = Scene::from_value(&self.scene) {
            found
                .into_iter()
                .for_each(|problem| problems.push(within(problem, &format!("{at}/scene"))));
            return;
        }
        for (i, keyframe) in self.keyframes.iter().enumerate() {
            if problems.is_full() {
                return;
            }
            let place = format!("{at}/keyframes/{i}");
            if let Some(before) = i.checked_sub(1).map(|before| self.keyframes[before].at_s)
                && keyframe.at_s <= before
            {
                let allowed = format!(
                    "a number of seconds later than the keyframe before, {}",
                    number(before)
                );
                problems.push(Problem::new(
                    format!("{place}/at_s"),
                    &json!(keyframe.at_s),
                    allowed,
                ));
            }
            if let Err(SceneError::Invalid(found)) = Scene::from_value(&self.document(keyframe)) {
                for problem in found {
                    let is_in_patch = Value::from(keyframe.patch.clone())
                        .pointer(&problem.pointer)
                        .is_some();
                    let patch = format!("{place}/patch");
                    problems.push(if is_in_patch {
                        within(problem, &patch)
                    } else {
                        Problem {
                            pointer: patch,
                            ..problem
                        }
                    });
                }
            }
        }
    }
}

/// A problem of a document that stands at `at`.
fn within(problem: Problem, at: &str) -> Problem {
    Problem {
        pointer: format!("{at}{}", problem.pointer),
        ..problem
    }
}
