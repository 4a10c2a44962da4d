//! How far frames are from brute force.

use super::super::{
    Size, Work,
    viewer::{Viewer, radiance},
};
use crate::commands::Failure;
use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageRgb8, FlipPool, flip};
use welkin_scene::{
    Quality, Scene,
    renderer::{Frame, Output, Pixels, Render},
};

/// Of the reference.
const STEPS: u32 = 1024;
const LIGHT_STEPS: u32 = 64;

/// A scene as each quality gives it and by brute force, and how far each is from that.
pub(super) fn works(renderer: &dyn Render, scene: &Scene, size: Size) -> Result<Vec<Work>, Failure> {
    let reference = {
        let mut scene = scene.clone();
        if let Some(clouds) = &mut scene.clouds {
            (clouds.steps, clouds.light_steps) = (STEPS, LIGHT_STEPS);
        }
        scene
    };
    let viewer = |quality| Viewer {
        renderer,
        size,
        quality,
    };
    let exact = viewer(Quality::Final);
    let (brute_force, true_picture) = exact.see("brute-force", &reference)?;
    let true_radiance = exact.frame(&reference, size, Output::Linear)?;
    let mut works = Vec::new();
    for (name, quality) in [("preview", Quality::Preview), ("final", Quality::Final)] {
        let (mut work, seen) = viewer(quality).see(name, scene)?;
        let error_map = flip(
            picture(&true_picture)?,
            picture(&seen)?,
            DEFAULT_PIXELS_PER_DEGREE,
        );
        work.flip = Some(f64::from(FlipPool::from_image(&error_map).mean()));
        let seen = viewer(quality).frame(scene, size, Output::Linear)?;
        work.error = Some(relative_rmse(radiance(&seen)?, radiance(&true_radiance)?));
        works.push(work);
    }
    works.push(brute_force);
    Ok(works)
}

fn relative_rmse(seen: &[f32], truth: &[f32]) -> f64 {
    let (mut off, mut all) = (0.0, 0.0);
    for (seen, truth) in seen.iter().zip(truth) {
        let (seen, truth) = (f64::from(*seen), f64::from(*truth));
        off += (seen - truth).powi(2);
        all += truth.powi(2);
    }
    (off / all).sqrt()
}

fn picture(frame: &Frame) -> Result<FlipImageRgb8, Failure> {
    match &frame.pixels {
        Pixels::Display(bytes) => Ok(FlipImageRgb8::with_data(frame.width_px, frame.height_px, bytes)),
        Pixels::Linear(_) => Err(Failure::Bench(
            "the renderer gave radiance for a picture".to_owned(),
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_is_relative_to_the_truth() {
        assert_eq!(relative_rmse(&[1.0, 2.0], &[1.0, 2.0]), 0.0);
        assert_eq!(relative_rmse(&[0.0, 0.0], &[3.0, 4.0]), 1.0);
        // √(0.3² + 0.4²) / √(3² + 4²); the values are of single precision.
        assert!((relative_rmse(&[3.3, 4.4], &[3.0, 4.0]) - 0.1).abs() < 1e-6);
    }
}
