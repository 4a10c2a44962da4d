//! The stars on the picture: which pixel gets how much light from above the air.

use crate::{catalogue::stars, lens::Lens, uniforms::narrow3};
use bytemuck::{Pod, Zeroable};
use glam::{DVec2, DVec3};
use std::{collections::BTreeMap, ops::Range};
use welkin_scene::{Firmament, Stars};

/// Light of stars in one pixel; `Glint` of `stars.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Glint {
    /// Towards them.
    pub(crate) direction: [f32; 3],
    /// Row times width, plus column.
    pub(crate) pixel: u32,
    /// Without the air, W/m²/sr.
    pub(crate) radiance: [f32; 3],
    /// The shader's rows are of 16 bytes.
    padding: u32,
}

/// A disc that hides the stars behind it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Screen {
    pub(crate) towards: DVec3,
    pub(crate) angular_radius: f64,
}

/// Radius of a star's image as a normal distribution, pixels: sharp, yet no star flickers as it crosses pixels.
const SPREAD_PX: f64 = 0.6;
/// Pixels to either side of the one that holds the star.
const REACH: i64 = 2;

/// What one pixel gathers.
#[derive(Clone, Copy, Default)]
struct Gathered {
    radiance: DVec3,
    /// Weighted by the light.
    direction: DVec3,
}

/// All pixels with stars in them, in the order of the picture, each once.
///
/// A star's light is shared among pixels by weights that sum to one, and divided by each pixel's own solid angle: its
/// irradiance is in the picture whatever the projection and however large the pixels are.
pub(crate) fn glints(
    stars_of: &Stars,
    firmament: &Firmament,
    lens: &Lens,
    width_px: u32,
    screens: &[Screen],
) -> Vec<Glint> {
    let mut pixels: BTreeMap<i64, Gathered> = BTreeMap::new();
    let bright_enough = stars().partition_point(|s| s.magnitude <= stars_of.limiting_magnitude);
    for star in &stars()[..bright_enough] {
        let towards = DVec3::from_array(firmament.direction(star.right_ascension_deg, star.declination_deg));
        let hidden = screens
            .iter()
            .any(|s| towards.angle_between(s.towards) < s.angular_radius);
        let Some(place) = lens.place(towards).filter(|_| !hidden) else {
            continue;
        };
        let light = DVec3::from_array(star.irradiance_w_m2) * stars_of.intensity;
        let image = image(lens, place);
        let sum: f64 = image.iter().map(|(_, weight, _)| weight).sum();
        for ([x, y], weight, solid_angle_sr) in image {
            let radiance = light * (weight / (sum * solid_angle_sr));
            let pixel = pixels.entry(y * i64::from(width_px) + x).or_default();
            pixel.radiance += radiance;
            pixel.direction += towards * radiance.y;
        }
    }
    pixels
        .into_iter()
        .filter_map(|(at, gathered)| glint(at, gathered))
        .collect()
}

fn glint(at: i64, gathered: Gathered) -> Option<Glint> {
    Some(Glint {
        direction: narrow3(gathered.direction.try_normalize()?.to_array()).to_array(),
        pixel: u32::try_from(at).ok()?,
        radiance: narrow3(gathered.radiance.to_array()).to_array(),
        padding: 0,
    })
}

/// The pixels of a star's image, with weight and solid angle.
fn image(lens: &Lens, place: DVec2) -> Vec<([i64; 2], f64, f64)> {
    #[allow(clippy::cast_possible_truncation, reason = "places on the picture")]
    let centre = [place.x.floor() as i64, place.y.floor() as i64];
    let mut image = Vec::new();
    for by in (-REACH..=REACH).flat_map(|y| (-REACH..=REACH).map(move |x| [x, y])) {
        // On the last pixel's far edge the floor is one too many.
        let Some(pixel) = lens.neighbour(centre, by) else {
            continue;
        };
        #[allow(clippy::cast_precision_loss, reason = "places on the picture")]
        let [middle, from_star] = [pixel, [centre[0] + by[0], centre[1] + by[1]]]
            .map(|[x, y]| DVec2::new(x as f64 + 0.5, y as f64 + 0.5));
        let weight = (-(from_star - place).length_squared() / (2.0 * SPREAD_PX * SPREAD_PX)).exp();
        if let Some(direction) = lens.sight(middle) {
            image.push((pixel, weight, lens.solid_angle_sr(direction)));
        }
    }
    image
}

/// The glints of a stretch of pixels that follow one another.
pub(crate) fn within(glints: &[Glint], pixels: Range<u32>) -> Range<usize> {
    let before = |end: u32| glints.partition_point(|g| g.pixel < end);
    before(pixels.start)..before(pixels.end)
}
