// The clouds before every pixel of one tile.
import package::lib::camera::{Camera, sight_at};
import package::lib::cloud_march::{CloudRay, air, clouds, march_clouds, view};
import package::lib::geometry::{angle_of_cosine, distance_to_sphere};
import package::lib::source::cosine_of_azimuth;
import package::lib::view_ray::{Observer, enter_air};

// As `sight_at` numbers it.
override PROJECTION: u32 = 0u;

struct Tile {
    origin_px: vec2u,
    // Of the table.
    size_px: vec2u,
    // Pixels of the picture to the side of one texel.
    grain: u32,
}

@group(0) @binding(18) var<uniform> camera: Camera;
@group(0) @binding(19) var<uniform> tile: Tile;
@group(0) @binding(20) var<uniform> observer: Observer;
// Radiance to add in R, G, B; alpha is the share of what lies behind that comes through.
@group(0) @binding(21) var table: texture_storage_2d<rgba32float, write>;

// A ray that nothing stops.
const ENDLESS_M = 1e12;

// Interleaved gradient noise (Jimenez 2014): even over every 3×3 pixels, so that what is left of it is fine-grained.
fn jitter_of(pixel: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(pixel, vec2f(0.06711056, 0.00583715))));
}

@compute @workgroup_size(8, 8)
fn cloud_view(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= tile.size_px) {
        return;
    }
    let pixel = vec2f(tile.origin_px) + (vec2f(id.xy) + 0.5) * f32(tile.grain);
    let sight = sight_at(camera, PROJECTION, pixel);
    var value = vec4f(0.0, 0.0, 0.0, 1.0);
    if sight.seen {
        let mu = clamp(dot(sight.direction, view.up), -1.0, 1.0);
        let nu = clamp(dot(sight.direction, view.sun), -1.0, 1.0);
        let met_m = distance_to_sphere(air.radius_m, view.altitude_m, mu);
        let ground = met_m >= 0.0;
        let entry = enter_air(air, observer, mu, nu, ground, met_m);
        let end_m = select(ENDLESS_M, met_m, ground);
        let azimuth = angle_of_cosine(cosine_of_azimuth(mu, view.mu_s, nu));
        let from_m = select(0.0, distance_to_sphere(air.radius_m + air.top_m, view.altitude_m - air.top_m, mu), view.altitude_m > air.top_m);
        let ray = CloudRay(sight.direction, mu, nu, azimuth, angle_of_cosine(mu), ground, end_m, from_m, max(entry.length_m, 0.0), jitter_of(vec2f(tile.origin_px / tile.grain + id.xy)), camera.pixel_angle);
        let seen = march_clouds(ray);
        value = vec4f(seen.light, seen.left);
    }
    textureStore(table, id.xy, value);
}
