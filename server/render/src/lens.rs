//! The camera in f64, both ways: from a place on the picture to a direction (the twin of `lib/camera.wgsl`), and from a
//! direction to its place.

use crate::camera::axes;
use glam::{DVec2, DVec3, UVec2};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use welkin_scene::{Camera, FisheyeMapping, Projection};

/// A camera and the size of its picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lens {
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    projection: Projection,
    size_px: DVec2,
}

/// Faces of a cubemap in the frame x east, y up, z south: the axis, and where s (right) and t (down) lead.
const FACES: [[DVec3; 3]; 6] = [
    [DVec3::X, DVec3::NEG_Z, DVec3::NEG_Y],
    [DVec3::NEG_X, DVec3::Z, DVec3::NEG_Y],
    [DVec3::Y, DVec3::X, DVec3::Z],
    [DVec3::NEG_Y, DVec3::X, DVec3::NEG_Z],
    [DVec3::Z, DVec3::X, DVec3::NEG_Y],
    [DVec3::NEG_Z, DVec3::NEG_X, DVec3::NEG_Y],
];

/// A world direction in the cubemap's frame, and back.
fn to_cube(d: DVec3) -> DVec3 {
    DVec3::new(d.x, d.z, -d.y)
}

fn from_cube(d: DVec3) -> DVec3 {
    DVec3::new(d.x, -d.z, d.y)
}

impl Lens {
    pub(crate) fn new(camera: &Camera, size_px: UVec2) -> Self {
        let [right, up, forward] = axes(camera);
        Self {
            right,
            up,
            forward,
            projection: camera.projection,
            size_px: size_px.as_dvec2(),
        }
    }

    /// Radius of a fisheye's circle, pixels, or the focal length of a pinhole.
    fn scale_px(&self) -> f64 {
        match self.projection {
            Projection::Perspective { vertical_fov_deg } => {
                self.size_px.y / 2.0 / (vertical_fov_deg.to_radians() / 2.0).tan()
            }
            Projection::Fisheye { .. } => self.size_px.min_element() / 2.0,
            Projection::Equirectangular {} => self.size_px.y / PI,
            Projection::Cubemap {} => self.size_px.y / 2.0,
        }
    }

    /// Direction seen at a place on the picture, pixels from the upper left corner; none outside a fisheye's circle.
    pub(crate) fn sight(&self, place: DVec2) -> Option<DVec3> {
        let off = (place - self.size_px / 2.0) * DVec2::new(1.0, -1.0);
        match self.projection {
            Projection::Perspective { .. } => {
                let at = off / self.scale_px();
                Some((self.forward + at.x * self.right + at.y * self.up).normalize())
            }
            Projection::Fisheye { fov_deg, mapping } => {
                let radius = off.length() / self.scale_px();
                let half = fov_deg.to_radians() / 2.0;
                let angle = match mapping {
                    FisheyeMapping::Equidistant => radius * half,
                    FisheyeMapping::Equisolid => 2.0 * (radius * (half / 2.0).sin()).min(1.0).asin(),
                    FisheyeMapping::Stereographic => 2.0 * (radius * (half / 2.0).tan()).atan(),
                };
                let across = off.normalize_or_zero();
                let sideways = across.x * self.right + across.y * self.up;
                (radius <= 1.0).then(|| angle.cos() * self.forward + angle.sin() * sideways)
            }
            Projection::Equirectangular {} => {
                let azimuth = PI * (0.5 + 2.0 * off.x / self.size_px.x);
                let elevation = PI * off.y / self.size_px.y;
                let level = elevation.cos();
                Some(DVec3::new(
                    azimuth.sin() * level,
                    azimuth.cos() * level,
                    elevation.sin(),
                ))
            }
            Projection::Cubemap {} => {
                let side = self.size_px.y;
                let (face, s) = face_of(place.x / side);
                let [axis, right, down] = FACES[face];
                let t = 2.0 * place.y / side - 1.0;
                Some(from_cube((axis + (2.0 * s - 1.0) * right + t * down).normalize()))
            }
        }
    }

    /// Where on the picture a direction is seen; none outside of it.
    pub(crate) fn place(&self, direction: DVec3) -> Option<DVec2> {
        self.image(direction).filter(|place| {
            let inside = place.cmpge(DVec2::ZERO) & place.cmple(self.size_px);
            inside.all()
        })
    }

    /// The same, on a picture without edges; none behind a pinhole and outside a fisheye's circle.
    pub(crate) fn image(&self, direction: DVec3) -> Option<DVec2> {
        let ahead = direction.dot(self.forward);
        let across = DVec2::new(direction.dot(self.right), direction.dot(self.up));
        let off = match self.projection {
            Projection::Perspective { .. } => {
                if ahead <= 0.0 {
                    return None;
                }
                across / ahead * self.scale_px()
            }
            Projection::Fisheye { fov_deg, mapping } => {
                let half = fov_deg.to_radians() / 2.0;
                let angle = across.length().atan2(ahead);
                if angle > half {
                    return None;
                }
                let radius = match mapping {
                    FisheyeMapping::Equidistant => angle / half,
                    FisheyeMapping::Equisolid => (angle / 2.0).sin() / (half / 2.0).sin(),
                    FisheyeMapping::Stereographic => (angle / 2.0).tan() / (half / 2.0).tan(),
                };
                across.normalize_or_zero() * radius * self.scale_px()
            }
            Projection::Equirectangular {} => {
                let azimuth = direction.x.atan2(direction.y);
                let elevation = direction.z.atan2(direction.x.hypot(direction.y));
                let x = ((azimuth / TAU + 0.25).rem_euclid(1.0) - 0.5) * self.size_px.x;
                DVec2::new(x, elevation / PI * self.size_px.y)
            }
            Projection::Cubemap {} => {
                let d = to_cube(direction);
                let axis = d.abs().max_position();
                let face = 2 * axis + usize::from(d[axis] < 0.0);
                let [axis, right, down] = FACES[face];
                let [s, t] = [right, down].map(|v| (d.dot(v) / d.dot(axis) + 1.0) / 2.0);
                #[allow(clippy::cast_precision_loss, reason = "one of six")]
                return Some(DVec2::new(face as f64 + s.min(1.0 - 1e-9), t) * self.size_px.y);
            }
        };
        Some(self.size_px / 2.0 + off * DVec2::new(1.0, -1.0))
    }

    /// Solid angle of the pixel whose centre is at a place and looks in `direction`, sr.
    ///
    /// A pinhole's pixel of area a² / f² at an angle θ from the axis spans a² / f² cos³ θ; a fisheye's r(θ) has
    /// sin θ / (r r') per unit of area.
    pub(crate) fn solid_angle_sr(&self, direction: DVec3) -> f64 {
        let pixel = 1.0 / self.scale_px();
        match self.projection {
            Projection::Perspective { .. } => pixel * pixel * direction.dot(self.forward).max(0.0).powi(3),
            Projection::Cubemap {} => pixel * pixel * direction.abs().max_element().powi(3),
            Projection::Equirectangular {} => {
                let level = direction.x.hypot(direction.y);
                TAU / self.size_px.x * 2.0 * (FRAC_PI_2 / self.size_px.y).sin() * level
            }
            Projection::Fisheye { fov_deg, mapping } => {
                let half = fov_deg.to_radians() / 2.0;
                let sin = direction.cross(self.forward).length();
                let angle = sin.atan2(direction.dot(self.forward));
                let spread = match mapping {
                    FisheyeMapping::Equidistant if angle > 0.0 => half * half * sin / angle,
                    FisheyeMapping::Equidistant => half * half,
                    FisheyeMapping::Equisolid => 4.0 * (half / 2.0).sin().powi(2),
                    FisheyeMapping::Stereographic => {
                        4.0 * (half / 2.0).tan().powi(2) * (angle / 2.0).cos().powi(4)
                    }
                };
                pixel * pixel * spread
            }
        }
    }

    /// The pixel that counts for another beside it: itself, its fellow across the seam of a full turn, or none where
    /// the picture or a cubemap's face ends.
    pub(crate) fn neighbour(&self, of: [i64; 2], by: [i64; 2]) -> Option<[i64; 2]> {
        #[allow(clippy::cast_possible_truncation, reason = "sizes of pictures")]
        let (width, height) = (self.size_px.x as i64, self.size_px.y as i64);
        let [mut x, y] = [of[0] + by[0], of[1] + by[1]];
        match self.projection {
            Projection::Equirectangular {} => x = x.rem_euclid(width),
            Projection::Cubemap {} if x.div_euclid(height) != of[0].div_euclid(height) => return None,
            _ => {}
        }
        ((0..width).contains(&x) && (0..height).contains(&y)).then_some([x, y])
    }
}

/// Face and the place across it, from the place along the strip in faces.
fn face_of(along: f64) -> (usize, f64) {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the six faces"
    )]
    let face = along.clamp(0.0, 5.0) as usize;
    #[allow(clippy::cast_precision_loss, reason = "one of six")]
    let s = along - face as f64;
    (face, s)
}
