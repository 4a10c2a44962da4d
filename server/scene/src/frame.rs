//! A request for one frame.

use crate::{document::Scene, problem::SceneError, timeline::Timeline};
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize, de::Error};

/// The longest side of a frame, pixels.
pub const MAX_SIDE_PX: u32 = 16_384;

/// One frame of a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FrameRequest {
    /// What is seen.
    pub scene: Scene,
    /// Where in the document that stands.
    #[serde(skip)]
    pub source: Source,
    /// Width, pixels.
    pub width_px: u32,
    /// Height, pixels.
    pub height_px: u32,
    /// Kind of file. Without it, the `Accept` header or the file's name decides, else PNG.
    pub format: Option<Format>,
    /// How much work goes into it.
    pub quality: Quality,
}

/// Where the scene of a frame comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Source {
    /// It was given.
    #[default]
    Scene,
    /// It is a timeline's at some time.
    Timeline,
}

impl Default for FrameRequest {
    fn default() -> Self {
        Self {
            scene: Scene::default(),
            source: Source::Scene,
            width_px: 1280,
            height_px: 720,
            format: None,
            quality: Quality::Final,
        }
    }
}

/// One frame of a scene, or of a timeline at a time: [`FrameRequest`] as it is written.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "FrameRequest")]
pub(crate) struct FrameDocument {
    /// What is seen. It is left out where there is a timeline.
    #[schemars(with = "Scene", default = "Scene::default")]
    pub(crate) scene: Option<Scene>,
    /// What is seen, in place of `scene`.
    pub(crate) timeline: Option<Timeline>,
    /// Which moment of the timeline, seconds; null for 0.
    #[schemars(range(min = -1e9, max = 1e9))]
    pub(crate) at_s: Option<f64>,
    /// Width, pixels.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 1, max = 16_384))]
    pub(crate) width_px: u32,
    /// Height, pixels.
    #[serde(deserialize_with = "whole")]
    #[schemars(range(min = 1, max = 16_384))]
    pub(crate) height_px: u32,
    /// Kind of file. Without it, the `Accept` header or the file's name decides, else PNG.
    pub(crate) format: Option<Format>,
    /// How much work goes into it.
    pub(crate) quality: Quality,
}

impl Default for FrameDocument {
    fn default() -> Self {
        let FrameRequest {
            scene: _,
            source: _,
            width_px,
            height_px,
            format,
            quality,
        } = FrameRequest::default();
        Self {
            scene: None,
            timeline: None,
            at_s: None,
            width_px,
            height_px,
            format,
            quality,
        }
    }
}

impl FrameDocument {
    /// The scene, or the timeline's at its time.
    pub(crate) fn seen(&self) -> Result<Scene, SceneError> {
        match &self.timeline {
            Some(timeline) => timeline.at(self.at_s.unwrap_or_default()),
            None => Ok(self.scene.clone().unwrap_or_default()),
        }
    }
}

/// As [`whole`], or null.
pub(crate) fn whole_or_null<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<u32>, D::Error> {
    #[derive(Deserialize)]
    struct Whole(#[serde(deserialize_with = "whole")] u32);
    Ok(Option::<Whole>::deserialize(deserializer)?.map(|Whole(number)| number))
}

/// Reads a whole number however JSON writes it: 1280, 1280.0 or 1.28e3 are one `integer` in JSON Schema.
pub(crate) fn whole<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u32, D::Error> {
    let number = f64::deserialize(deserializer)?;
    if number.fract() != 0.0 || !(0.0..=f64::from(u32::MAX)).contains(&number) {
        return Err(D::Error::custom(format!("{number} is not a whole number")));
    }
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole and in range as checked above"
    )]
    Ok(number as u32)
}

/// Kind of file. Display formats hold the picture; linear formats hold radiance in W/m²/sr before exposure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Format {
    /// 8-bit sRGB, lossless.
    Png,
    /// 8-bit sRGB.
    Jpeg,
    /// OpenEXR, half floats, ZIP; what renderers expect.
    Exr,
    /// OpenEXR, 32-bit floats, ZIP.
    ExrFloat,
    /// Radiance RGBE.
    Hdr,
    /// NumPy array of shape (height, width, 3), 32-bit floats.
    Npy,
    /// 32-bit little-endian floats, R G B, rows from the top.
    Raw,
}

impl Format {
    /// True where the file holds radiance rather than the picture.
    #[must_use]
    pub const fn is_linear(self) -> bool {
        !matches!(self, Self::Png | Self::Jpeg)
    }
}

/// How much work goes into a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Quality {
    /// Small tables, at once.
    Preview,
    /// All detail.
    #[default]
    Final,
}
