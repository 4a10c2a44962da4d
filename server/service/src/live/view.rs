//! What one viewer looks at.

use super::message::{Message, OutputChange};
use crate::{
    error::{Error, Fault},
    state::Service,
};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::sync::Arc;
use welkin_scene::{Scene, SceneAssets, Timeline, frame::Quality, timeline::Playback};

/// Kind of picture that a viewer gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum LiveFormat {
    Jpeg,
    Png,
    Raw,
}

/// Size and kind of what a viewer gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LiveOutput {
    pub(crate) width_px: u16,
    pub(crate) height_px: u16,
    pub(crate) format: LiveFormat,
    pub(crate) quality: Quality,
}

impl Default for LiveOutput {
    fn default() -> Self {
        Self {
            width_px: 1280,
            height_px: 720,
            format: LiveFormat::Jpeg,
            quality: Quality::Final,
        }
    }
}

/// The scene and output of the last message that was accepted.
#[derive(Clone, Debug)]
pub(crate) struct View {
    pub(crate) seq: u32,
    pub(crate) scene: Arc<Scene>,
    /// The assets of the scene as they were last seen, without their pixels: a viewer who looks on holds none.
    pub(crate) assets: Arc<SceneAssets>,
    pub(crate) output: LiveOutput,
    /// Which moment of the timeline it is; none where the scene was sent as such.
    pub(crate) at_s: Option<f64>,
    /// What patches change: the scene as the client sent it, or as the timeline has it.
    document: Value,
    playback: Option<Arc<Playback>>,
}

impl Default for View {
    fn default() -> Self {
        Self {
            seq: 0,
            scene: Arc::default(),
            assets: Arc::default(),
            output: LiveOutput::default(),
            at_s: None,
            document: json!({}),
            playback: None,
        }
    }
}

impl View {
    /// The view after a message, or why there is none; this one stays as it is.
    pub(crate) fn after(&self, message: Message) -> Result<Self, Error> {
        let Message {
            seq,
            scene,
            patch,
            timeline,
            at_s,
            output,
        } = message;
        let mut next = Self { seq, ..self.clone() };
        if timeline.is_some() || at_s.is_some() {
            next.move_to(timeline.as_ref(), at_s)?;
        }
        if scene.is_some() || patch.is_some() {
            if let Some(document) = scene {
                next.document = document;
            }
            if let Some(patch) = patch {
                json_patch::merge(&mut next.document, &patch);
            }
            let scene = Scene::from_value(&next.document).map_err(|e| Error::from(e).within("/scene"))?;
            next.scene = Arc::new(scene);
            next.at_s = None;
        }
        if let Some(OutputChange {
            width_px,
            height_px,
            format,
            quality,
        }) = output
        {
            let old = next.output;
            next.output = LiveOutput {
                width_px: width_px.unwrap_or(old.width_px),
                height_px: height_px.unwrap_or(old.height_px),
                format: format.unwrap_or(old.format),
                quality: quality.unwrap_or(old.quality),
            };
        }
        Ok(next)
    }

    /// Shows a moment of a timeline: a new one, or the one it has; from the beginning where no moment is named.
    fn move_to(&mut self, timeline: Option<&Value>, at_s: Option<f64>) -> Result<(), Error> {
        if let Some(timeline) = timeline {
            let playback = Timeline::from_value(timeline).and_then(|timeline| timeline.playback());
            let playback = playback.map_err(|e| Error::from(e).within("/timeline"))?;
            self.playback = Some(Arc::new(playback));
        }
        let at_s = at_s.unwrap_or_default();
        let refused = |allowed: &str, message: String| {
            Error::Invalid(vec![Fault::field("/at_s", at_s.into(), allowed.into(), message)])
        };
        let Some(playback) = &self.playback else {
            return Err(refused(
                "given with or after `timeline`",
                "there is no `timeline` yet that `at_s` could be a moment of".into(),
            ));
        };
        let scene = playback
            .at(at_s)
            .map_err(|e| refused("a time at which the timeline is a scene", e.to_string()))?;
        self.document = serde_json::to_value(&scene).map_err(|e| Error::Internal { cause: e.to_string() })?;
        self.scene = Arc::new(scene);
        self.at_s = Some(at_s);
        Ok(())
    }

    /// The view with the assets of its scene as they are now.
    pub(crate) async fn with_assets(self, service: &Service) -> Result<Self, Error> {
        let assets = service.assets_of(&self.scene).await;
        let assets = assets.map_err(|e| e.within("/scene"))?;
        let assets = Arc::new(assets.without_content());
        Ok(Self { assets, ..self })
    }
}
