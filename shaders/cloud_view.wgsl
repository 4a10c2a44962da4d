// Which clouds every pixel of one tile sees.
import package::lib::camera::{Camera, sight_at};
import package::lib::cloud_march::march_clouds;
import package::lib::cloud_nodes::Nodes;
import package::lib::cloud_ray::{cloud_ray, sight_of_clouds, spread_of_pixel};
import package::lib::view_ray::Observer;

// As `sight_at` numbers it.
override PROJECTION: u32 = 0u;
// True where more than the sphere stands on the ground.
override GROUND: bool = false;

// True where the whole frame has its places in one buffer, false where the tile has one of its own.
override WHOLE_FRAME: bool = false;

struct Tile {
    origin_px: vec2u,
    size_px: vec2u,
    // From one pixel of the tile to the next in the frame.
    stride_px: u32,
}

@group(0) @binding(10) var<uniform> camera: Camera;
@group(0) @binding(11) var<uniform> tile: Tile;
@group(0) @binding(12) var<uniform> observer: Observer;
// Six vectors a pixel, as `Nodes` has them.
@group(0) @binding(13) var<storage, read_write> nodes: array<vec4f>;
// In alpha, how far away what stands on the ground is; else -1.
@group(0) @binding(14) var<storage, read> lit_ground: array<vec4f>;

// Interleaved gradient noise (Jimenez 2014): even over every 3×3 pixels, so that what is left of it is fine-grained.
fn jitter_of(pixel: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(pixel, vec2f(0.06711056, 0.00583715))));
}

@compute @workgroup_size(8, 8)
fn cloud_view(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= tile.size_px) {
        return;
    }
    let in_frame = tile.origin_px + tile.stride_px * id.xy;
    // What lies left of the frame wraps round.
    let pixel = vec2f(vec2i(in_frame));
    let sight = sight_at(camera, PROJECTION, pixel + 0.5);
    var seen: Nodes;
    if sight.seen {
        var ray = cloud_ray(observer, sight_of_clouds(sight.direction, camera.pixel_angle), jitter_of(pixel), spread_of_pixel(camera.pixel_angle));
        if GROUND {
            let distance_m = lit_ground[id.y * tile.size_px.x + id.x].w;
            ray.stop_m = select(ray.end_m, distance_m, distance_m >= 0.0);
        }
        seen = march_clouds(ray);
    }
    var at = 6u * (id.y * tile.size_px.x + id.x);
    if WHOLE_FRAME {
        at = 6u * (in_frame.y * u32(camera.size_px.x) + in_frame.x);
    }
    nodes[at] = seen.first.distance_m;
    nodes[at + 1u] = seen.first.share;
    nodes[at + 2u] = seen.first.kind;
    nodes[at + 3u] = seen.second.distance_m;
    nodes[at + 4u] = seen.second.share;
    nodes[at + 5u] = seen.second.kind;
}
