//! The camera as the shaders see it.

use crate::uniforms::narrow;
use encase::ShaderType;
use glam::{DVec3, UVec2, Vec2, Vec3};
use std::f64::consts::PI;
use welkin_scene::{Camera, Direction, FisheyeMapping, Projection};

/// Right, up and forward: unit vectors across the picture and into it.
pub(crate) fn axes(camera: &Camera) -> [DVec3; 3] {
    let forward = DVec3::from_array(camera.direction.unit());
    // The right edge lies a quarter turn clockwise from the azimuth; so a camera that tilts through the zenith does
    // not spin. A vector straight up or down has no azimuth and counts as north.
    let azimuth = match camera.direction {
        Direction::Angles(angles) => angles.azimuth_deg,
        vector @ Direction::Vector(_) => vector.to_angles().azimuth_deg,
    };
    let (sin, cos) = azimuth.to_radians().sin_cos();
    let right = DVec3::new(cos, -sin, 0.0);
    let up = right.cross(forward);
    let (sin, cos) = camera.roll_deg.to_radians().sin_cos();
    // The picture turns clockwise as the camera turns the other way.
    [right * cos + up * sin, up * cos - right * sin, forward]
}

/// `Camera` of `lib/camera.wgsl`.
#[derive(Clone, Debug, ShaderType)]
pub(crate) struct CameraUniform {
    pub(crate) right: Vec3,
    pub(crate) half_field: f32,
    pub(crate) up: Vec3,
    pub(crate) pixel_angle: f32,
    pub(crate) forward: Vec3,
    pub(crate) size_px: Vec2,
}

/// The projection as `sight_at` numbers it.
pub(crate) const fn projection_code(projection: &Projection) -> u32 {
    match projection {
        Projection::Perspective { .. } => 0,
        Projection::Fisheye { mapping, .. } => match mapping {
            FisheyeMapping::Equidistant => 1,
            FisheyeMapping::Equisolid => 2,
            FisheyeMapping::Stereographic => 3,
        },
        Projection::Equirectangular {} => 4,
        Projection::Cubemap {} => 5,
    }
}

impl CameraUniform {
    pub(crate) fn new(camera: &Camera, size_px: UVec2) -> Self {
        let [right, up, forward] = axes(camera);
        let (width, height) = (f64::from(size_px.x), f64::from(size_px.y));
        let (half_field, pixel_angle) = match camera.projection {
            Projection::Perspective { vertical_fov_deg } => {
                let half = (vertical_fov_deg.to_radians() / 2.0).tan();
                (half, 2.0 * half / height)
            }
            Projection::Fisheye { fov_deg, .. } => {
                let half = fov_deg.to_radians() / 2.0;
                (half, 2.0 * half / width.min(height))
            }
            Projection::Equirectangular {} => (0.0, PI / height),
            Projection::Cubemap {} => (0.0, PI / 2.0 / height),
        };
        Self {
            right: right.as_vec3(),
            up: up.as_vec3(),
            half_field: narrow(half_field),
            forward: forward.as_vec3(),
            pixel_angle: narrow(pixel_angle),
            size_px: size_px.as_vec2(),
        }
    }
}
