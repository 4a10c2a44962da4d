// From a place on the picture to a direction in the world.
import package::lib::geometry::PI;

struct Camera {
    right: vec3f,
    // Perspective: tangent of half the vertical field of view. Fisheye: half the field of view, radians.
    half_field: f32,
    up: vec3f,
    // Angle that one pixel spans at the centre, radians.
    pixel_angle: f32,
    forward: vec3f,
    size_px: vec2f,
}

struct Sight {
    direction: vec3f,
    // False outside a fisheye's circle.
    seen: bool,
}

// `projection`: 0 perspective, 1 fisheye equidistant, 2 equisolid, 3 stereographic, 4 equirectangular, 5 cubemap;
// constant where it is called, since a software device runs all branches.
fn sight_at(camera: Camera, projection: u32, pixel: vec2f) -> Sight {
    let ndc = vec2f(2.0, -2.0) * (pixel / camera.size_px - 0.5);
    switch projection {
        case 0u: {
            let at = ndc * camera.half_field * vec2f(camera.size_px.x / camera.size_px.y, 1.0);
            return Sight(normalize(camera.forward + at.x * camera.right + at.y * camera.up), true);
        }
        case 4u: {
            // Left edge west, centre east, right half south.
            let azimuth = PI * (0.5 + ndc.x);
            let elevation = 0.5 * PI * ndc.y;
            return Sight(vec3f(sin(azimuth) * cos(elevation), cos(azimuth) * cos(elevation), sin(elevation)), true);
        }
        case 5u: {
            return Sight(cube_direction(camera, pixel), true);
        }
        default: {
            let at = ndc * camera.size_px / min(camera.size_px.x, camera.size_px.y);
            let radius = length(at);
            var angle = radius * camera.half_field;
            if projection == 2u {
                // Drivers' asin may be off by 1e-4, half a pixel of a large frame; their atan2 is exact.
                let sine = min(radius * sin(0.5 * camera.half_field), 1.0);
                angle = 2.0 * atan2(sine, sqrt(1.0 - sine * sine));
            } else if projection == 3u {
                angle = 2.0 * atan(radius * tan(0.5 * camera.half_field));
            }
            let across = at / max(radius, 1e-9);
            let direction = cos(angle) * camera.forward + sin(angle) * (across.x * camera.right + across.y * camera.up);
            return Sight(direction, radius <= 1.0);
        }
    }
}

// Faces left to right +x, -x, +y, -y, +z, -z of a frame with y up and z south, s to the right and t down in each.
fn cube_direction(camera: Camera, pixel: vec2f) -> vec3f {
    let side = camera.size_px.y;
    let face = u32(pixel.x / side);
    let s = 2.0 * (pixel.x / side - f32(face)) - 1.0;
    let t = 2.0 * pixel.y / side - 1.0;
    var d: vec3f;
    switch face {
        case 0u: { d = vec3f(1.0, -t, -s); }
        case 1u: { d = vec3f(-1.0, -t, s); }
        case 2u: { d = vec3f(s, 1.0, t); }
        case 3u: { d = vec3f(s, -1.0, -t); }
        case 4u: { d = vec3f(s, -t, 1.0); }
        default: { d = vec3f(-s, -t, -1.0); }
    }
    return normalize(vec3f(d.x, -d.z, d.y));
}
