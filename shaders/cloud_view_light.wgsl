// The light of the clouds that every pixel of one tile sees.
import package::lib::camera::{Camera, sight_at};
import package::lib::cloud_nodes::{FourNodes, Nodes};
import package::lib::cloud_ray::{cloud_ray, sight_of_clouds, spread_of_pixel};
import package::lib::cloud_seen::clouds_seen;
import package::lib::shaft_lattice::Lost;
import package::lib::view_ray::Observer;

// As `sight_at` numbers it.
override PROJECTION: u32 = 0u;

// True where the whole frame has its places in one buffer, false where the tile has one of its own.
override WHOLE_FRAME: bool = false;

// True where more than the sphere stands on the ground.
override GROUND: bool = false;
// True where shafts fall through the air.
override SHAFTS: bool = false;

struct Tile {
    origin_px: vec2u,
    size_px: vec2u,
    // From one pixel of the tile to the next in the frame.
    stride_px: u32,
}

@group(0) @binding(22) var<uniform> camera: Camera;
@group(0) @binding(23) var<uniform> tile: Tile;
@group(0) @binding(24) var<uniform> observer: Observer;
// Six vectors a pixel, as `Nodes` has them.
@group(0) @binding(25) var<storage, read> nodes: array<vec4f>;
// Radiance to add in R, G, B; alpha is the share of what lies behind that comes through.
@group(0) @binding(26) var table: texture_storage_2d<rgba32float, write>;
// In alpha, how far away what stands on the ground is; else -1.
@group(0) @binding(27) var<storage, read> lit_ground: array<vec4f>;
// What each pixel loses to shafts.
@group(0) @binding(28) var<storage, read> lost_to_shafts: array<Lost>;

@compute @workgroup_size(8, 8)
fn cloud_view_light(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= tile.size_px) {
        return;
    }
    let in_frame = tile.origin_px + tile.stride_px * id.xy;
    let sight = sight_at(camera, PROJECTION, vec2f(in_frame) + 0.5);
    var value = vec4f(0.0, 0.0, 0.0, 1.0);
    if sight.seen {
        var ray = cloud_ray(observer, sight_of_clouds(sight.direction, camera.pixel_angle), 0.5, spread_of_pixel(camera.pixel_angle));
        if GROUND {
            let distance_m = lit_ground[id.y * tile.size_px.x + id.x].w;
            ray.stop_m = select(ray.end_m, distance_m, distance_m >= 0.0);
        }
        var k = 6u * (id.y * tile.size_px.x + id.x);
        if WHOLE_FRAME {
            k = 6u * (in_frame.y * u32(camera.size_px.x) + in_frame.x);
        }
        let first = FourNodes(nodes[k], nodes[k + 1u], nodes[k + 2u]);
        var lost: Lost;
        if SHAFTS {
            lost = lost_to_shafts[id.y * tile.size_px.x + id.x];
        }
        value = clouds_seen(ray, Nodes(first, FourNodes(nodes[k + 3u], nodes[k + 4u], nodes[k + 5u])), lost);
    }
    textureStore(table, id.xy, value);
}
