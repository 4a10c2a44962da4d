//! The projections in f64: where a direction falls on the picture, from the definitions alone.

use welkin_scene::{Camera, FisheyeMapping, Projection};

type Vector = [f64; 3];

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

pub(crate) fn unit(azimuth_deg: f64, elevation_deg: f64) -> Vector {
    let (s, c) = azimuth_deg.to_radians().sin_cos();
    let (sin, cos) = elevation_deg.to_radians().sin_cos();
    [s * cos, c * cos, sin]
}

/// The camera's heading and height, degrees.
fn angles(camera: &Camera) -> (f64, f64) {
    let angles = camera.direction.to_angles();
    (angles.azimuth_deg, angles.elevation_deg)
}

/// Forward, right and up of the picture before its roll.
fn axes(camera: &Camera) -> [Vector; 3] {
    let (azimuth, elevation) = angles(camera);
    let right = unit(azimuth + 90.0, 0.0);
    let forward = unit(azimuth, elevation);
    [forward, right, cross(right, forward)]
}

/// Turns a place on the picture, x right and y down from its centre, clockwise.
fn rolled((x, y): (f64, f64), roll_deg: f64) -> (f64, f64) {
    let (s, c) = roll_deg.to_radians().sin_cos();
    (c * x - s * y, s * x + c * y)
}

/// Radius of a fisheye picture at an angle from its axis, as a share of its rim's.
fn fisheye(mapping: FisheyeMapping, angle: f64, half_field: f64) -> f64 {
    match mapping {
        FisheyeMapping::Equidistant => angle / half_field,
        FisheyeMapping::Equisolid => (angle / 2.0).sin() / (half_field / 2.0).sin(),
        FisheyeMapping::Stereographic => (angle / 2.0).tan() / (half_field / 2.0).tan(),
    }
}

/// The face and the place on it, s to the right and t down in -1..1, of OpenGL's cube maps (specification, table 8.19)
/// in three.js's axes: x east, y up, z south.
fn cube(d: Vector) -> (usize, f64, f64) {
    let (x, y, z) = (d[0], d[2], -d[1]);
    let (ax, ay, az) = (x.abs(), y.abs(), z.abs());
    let (face, s, t, along) = if ax >= ay && ax >= az {
        if x > 0.0 { (0, -z, -y, ax) } else { (1, z, -y, ax) }
    } else if ay >= az {
        if y > 0.0 { (2, x, z, ay) } else { (3, x, -z, ay) }
    } else if z > 0.0 {
        (4, x, -y, az)
    } else {
        (5, -x, -y, az)
    };
    (face, s / along, t / along)
}

/// Where a direction falls on the picture, in pixels from its upper left corner; none where it does not.
pub(crate) fn place(camera: &Camera, (width, height): (f64, f64), d: Vector) -> Option<(f64, f64)> {
    let [forward, right, up] = axes(camera);
    let (ahead, x, y) = (dot(d, forward), dot(d, right), -dot(d, up));
    let centred = |(x, y): (f64, f64)| {
        let (x, y) = rolled((x, y), camera.roll_deg);
        Some((width / 2.0 + x, height / 2.0 + y))
    };
    match camera.projection {
        Projection::Perspective { vertical_fov_deg } => {
            let scale = height / 2.0 / (vertical_fov_deg.to_radians() / 2.0).tan();
            (ahead > 0.0)
                .then(|| centred((x / ahead * scale, y / ahead * scale)))
                .flatten()
        }
        Projection::Fisheye { fov_deg, mapping } => {
            let half = fov_deg.to_radians() / 2.0;
            let across = x.hypot(y);
            let angle = across.atan2(ahead);
            let radius = fisheye(mapping, angle, half) * width.min(height) / 2.0;
            (angle <= half)
                .then(|| centred((x / across * radius, y / across * radius)))
                .flatten()
        }
        Projection::Equirectangular {} => {
            let azimuth = d[0].atan2(d[1]).to_degrees();
            let elevation = d[2].asin().to_degrees();
            // East in the middle, the left edge west.
            Some((
                (azimuth + 90.0).rem_euclid(360.0) / 360.0 * width,
                (90.0 - elevation) / 180.0 * height,
            ))
        }
        Projection::Cubemap {} => {
            let (face, s, t) = cube(d);
            Some(((face as f64 + (s + 1.0) / 2.0) * height, (t + 1.0) / 2.0 * height))
        }
    }
}

/// The direction seen at a place on the picture: the inverse of [`place`] for pictures without roll.
pub(crate) fn sight(camera: &Camera, (width, height): (f64, f64), (x, y): (f64, f64)) -> Vector {
    match camera.projection {
        Projection::Perspective { vertical_fov_deg } => {
            let scale = height / 2.0 / (vertical_fov_deg.to_radians() / 2.0).tan();
            let [forward, right, up] = axes(camera);
            let (x, y) = ((x - width / 2.0) / scale, (height / 2.0 - y) / scale);
            let d = [0, 1, 2].map(|i| forward[i] + x * right[i] + y * up[i]);
            let length = dot(d, d).sqrt();
            d.map(|c| c / length)
        }
        Projection::Equirectangular {} => unit(x / width * 360.0 - 90.0, 90.0 - y / height * 180.0),
        other => panic!("no inverse of {other:?}"),
    }
}
