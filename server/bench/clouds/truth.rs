//! How far frames are from brute force.

use super::super::{
    Size, Work,
    viewer::{Viewer, radiance},
};
use crate::commands::Failure;
use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageRgb8, FlipPool, flip};
use std::sync::Arc;
use welkin_scene::{
    Projection, Quality, Scene,
    renderer::{Frame, Output, Pixels, Render},
};

/// Of the reference.
const STEPS: u32 = 1024;
const LIGHT_STEPS: u32 = 64;

/// The middle `size` pixels of a frame of the size `whole`, as each quality gives them and by brute force; and how far
/// each is from that. They have the angle that pixels of the frame have: a smaller frame of all would have larger ones,
/// and with them coarser previews.
pub(super) fn works(
    renderer: &dyn Render,
    scene: &Scene,
    whole: Size,
    size: Size,
) -> Result<Vec<Work>, Failure> {
    let scene = cropped(scene, whole, size);
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
        assets: Arc::default(),
    };
    let exact = viewer(Quality::Final);
    let (brute_force, true_picture) = exact.see("brute-force", &reference)?;
    let true_radiance = exact.frame(&reference, size, Output::Linear)?;
    let mut works = Vec::new();
    for (name, quality) in [("preview", Quality::Preview), ("final", Quality::Final)] {
        let (mut work, seen) = viewer(quality).see(name, &scene)?;
        let error_map = flip(
            picture(&true_picture)?,
            picture(&seen)?,
            DEFAULT_PIXELS_PER_DEGREE,
        );
        work.flip = Some(f64::from(FlipPool::from_image(&error_map).mean()));
        let seen = viewer(quality).frame(&scene, size, Output::Linear)?;
        work.error = Some(relative_rmse(radiance(&seen)?, radiance(&true_radiance)?));
        works.push(work);
    }
    works.push(brute_force);
    Ok(works)
}

fn cropped(scene: &Scene, whole: Size, part: Size) -> Scene {
    let mut scene = scene.clone();
    if let Projection::Perspective { vertical_fov_deg } = &mut scene.camera.projection {
        let share = f64::from(part.height_px) / f64::from(whole.height_px);
        let half = (0.5 * *vertical_fov_deg).to_radians().tan();
        *vertical_fov_deg = 2.0 * (share * half).atan().to_degrees();
    }
    scene
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
    fn a_part_of_a_frame_has_its_pixels_angle() {
        let mut scene = Scene::default();
        scene.camera.projection = Projection::Perspective {
            vertical_fov_deg: 90.0,
        };
        let part = cropped(&scene, Size::new(1280, 720), Size::new(160, 90));
        // tan 45° / 8.
        let expected = 2.0 * 0.125_f64.atan().to_degrees();
        assert!(
            matches!(part.camera.projection, Projection::Perspective { vertical_fov_deg } if (vertical_fov_deg - expected).abs() < 1e-12)
        );
        assert_eq!(cropped(&scene, Size::new(160, 90), Size::new(160, 90)), scene);
    }

    #[test]
    fn the_error_is_relative_to_the_truth() {
        assert_eq!(relative_rmse(&[1.0, 2.0], &[1.0, 2.0]), 0.0);
        assert_eq!(relative_rmse(&[0.0, 0.0], &[3.0, 4.0]), 1.0);
        // √(0.3² + 0.4²) / √(3² + 4²); the values are of single precision.
        assert!((relative_rmse(&[3.3, 4.4], &[3.0, 4.0]) - 0.1).abs() < 1e-6);
    }
}
