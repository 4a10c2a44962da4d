// The clouds before every pixel of one tile.
import package::lib::camera::{Camera, sight_at};
import package::lib::cloud_march::march_clouds;
import package::lib::cloud_ray::cloud_ray;
import package::lib::view_ray::Observer;

// As `sight_at` numbers it.
override PROJECTION: u32 = 0u;
// True where more than the sphere stands on the ground.
override GROUND: bool = false;

struct Tile {
    origin_px: vec2u,
    size_px: vec2u,
}

@group(0) @binding(18) var<uniform> camera: Camera;
@group(0) @binding(19) var<uniform> tile: Tile;
@group(0) @binding(20) var<uniform> observer: Observer;
// Radiance to add in R, G, B; alpha is the share of what lies behind that comes through.
@group(0) @binding(21) var table: texture_storage_2d<rgba32float, write>;
// In alpha, how far away that is; else -1.
@group(0) @binding(22) var<storage, read> lit_ground: array<vec4f>;

// Interleaved gradient noise (Jimenez 2014): even over every 3×3 pixels, so that what is left of it is fine-grained.
fn jitter_of(pixel: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(pixel, vec2f(0.06711056, 0.00583715))));
}

@compute @workgroup_size(8, 8)
fn cloud_view(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= tile.size_px) {
        return;
    }
    let pixel = vec2f(tile.origin_px + id.xy) + 0.5;
    let sight = sight_at(camera, PROJECTION, pixel);
    var value = vec4f(0.0, 0.0, 0.0, 1.0);
    if sight.seen {
        let jitter = jitter_of(vec2f(tile.origin_px + id.xy));
        var ray = cloud_ray(observer, sight.direction, jitter, 0.0);
        if GROUND {
            let distance_m = lit_ground[id.y * tile.size_px.x + id.x].w;
            ray.stop_m = select(ray.end_m, distance_m, distance_m >= 0.0);
        }
        let seen = march_clouds(ray);
        value = vec4f(seen.light, seen.left);
    }
    textureStore(table, id.xy, value);
}
