//! Somebody who looks at one scene after the other, and what is asked of what they see.

use super::{Pass, Size, Work, stopwatch::Stopwatch};
use crate::commands::Failure;
use serde_json::Map;
use std::sync::Arc;
use welkin_scene::{
    Direction, ProbeRequest, Quality, Scene,
    assets::SceneAssets,
    renderer::{Frame, FrameOrder, Output, Pixels, Priority, Render},
};

/// The tables of the air alone: neither sun nor camera may cost them.
pub(super) const AIR_TABLES: [&str; 2] = ["transmittance", "multi_scattering"];
/// The passes that see where the camera looks: a turn may cost these and no other.
pub(super) const CAMERA_PASSES: [&str; 3] = ["sky", "exposure", "tone"];

/// Names the passes that ran and should not have.
pub(super) fn forbidden(passes: &[Pass], allowed: impl Fn(&str) -> bool) -> Option<String> {
    let names = passes.iter().map(|pass| pass.pass.as_str());
    let wrong: Vec<_> = names.filter(|pass| !allowed(pass)).collect();
    (!wrong.is_empty()).then(|| format!("ran {}", wrong.join(", ")))
}

/// A frame's radiance, R, G and B of each pixel.
pub(super) fn radiance(frame: &Frame) -> Result<&[f32], Failure> {
    match &frame.pixels {
        Pixels::Linear(values) => Ok(values),
        Pixels::Display(_) => Err(Failure::Bench(
            "the renderer gave a picture for radiance".to_owned(),
        )),
    }
}

pub(super) struct Viewer<'a> {
    pub(super) renderer: &'a dyn Render,
    pub(super) size: Size,
    pub(super) quality: Quality,
    /// What the scenes name.
    pub(super) assets: Arc<SceneAssets>,
}

/// A pixel of a frame, to be compared.
pub(super) struct Sight {
    /// Its number, from the top left.
    pub(super) index: usize,
    /// Where its centre looks.
    pub(super) direction: Direction,
    /// How much it counts.
    pub(super) weight: f64,
}

impl Viewer<'_> {
    /// A picture, and what it cost.
    pub(super) fn see(&self, work: &str, scene: &Scene) -> Result<(Work, Arc<Frame>), Failure> {
        let order = self.order(scene, self.size, Output::Display);
        let watch = Stopwatch::start();
        let frame = pollster::block_on(self.renderer.frame(order))?;
        let work = Work {
            work: work.to_owned(),
            varied: Map::new(),
            spent: watch.stop(),
            passes: frame.passes.iter().map(Pass::from).collect(),
            error: None,
            flip: None,
            fault: None,
        };
        Ok((work, frame))
    }

    /// A frame of another size, for its pixels.
    pub(super) fn frame(&self, scene: &Scene, size: Size, output: Output) -> Result<Arc<Frame>, Failure> {
        Ok(pollster::block_on(
            self.renderer.frame(self.order(scene, size, output)),
        )?)
    }

    fn order(&self, scene: &Scene, size: Size, output: Output) -> FrameOrder {
        FrameOrder {
            scene: Arc::new(scene.clone()),
            assets: Arc::clone(&self.assets),
            width_px: size.width_px,
            height_px: size.height_px,
            quality: self.quality,
            output,
            priority: Priority::Interactive,
        }
    }

    /// Relative RMSE of a frame's radiance against a probe of `truth` in the same directions, which integrates along
    /// each of them without the sky-view table.
    pub(super) fn error(
        &self,
        scene: &Scene,
        truth: &Scene,
        size: Size,
        sights: &[Sight],
    ) -> Result<f64, Failure> {
        let frame = self.frame(scene, size, Output::Linear)?;
        let request = ProbeRequest {
            scene: truth.clone(),
            directions: sights.iter().map(|sight| sight.direction).collect(),
        };
        let truth = pollster::block_on(self.renderer.probe(request.into()))?;
        let values = radiance(&frame)?;
        let (mut off, mut all) = (0.0, 0.0);
        for (sight, truth) in sights.iter().zip(&truth.radiance_w_m2_sr) {
            let seen = &values[3 * sight.index..3 * sight.index + 3];
            for (seen, truth) in seen.iter().zip(truth) {
                off += sight.weight * (f64::from(*seen) - truth).powi(2);
                all += sight.weight * truth.powi(2);
            }
        }
        Ok((off / all).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pass_that_should_not_have_run_is_named() {
        let ran = ["sky_view", "sky"].map(|pass| Pass {
            pass: pass.to_owned(),
            ms: 1.0,
        });
        let fault = forbidden(&ran, |pass| CAMERA_PASSES.contains(&pass));
        assert_eq!(fault.as_deref(), Some("ran sky_view"));
        assert_eq!(forbidden(&ran, |pass| !AIR_TABLES.contains(&pass)), None);
        assert_eq!(forbidden(&[], |_| false), None);
    }
}
