// Which clouds are seen in the directions of some blocks of the dome.
import package::lib::cloud_march::march_clouds;
import package::lib::cloud_ray::{air, cloud_ray, view};
import package::lib::dome::{BLOCK_CORNERS, BLOCK_CELLS, BLOCK_SIDE, CELL_ANGLE, Dome, dome_sight};
import package::lib::geometry::edge_cosine;
import package::lib::view_ray::Observer;

@group(0) @binding(10) var<uniform> dome: Dome;
@group(0) @binding(11) var<uniform> observer: Observer;
// Column and row of each block, and where it is kept.
@group(0) @binding(12) var<storage, read> blocks: array<vec4u>;
// Six vectors a corner, as `Nodes` has them.
@group(0) @binding(13) var<storage, read_write> nodes: array<vec4f>;

// Interleaved gradient noise (Jimenez 2014): even over every 3×3 corners.
fn jitter_of(corner: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(corner, vec2f(0.06711056, 0.00583715))));
}

@compute @workgroup_size(64)
fn cloud_dome(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= BLOCK_CORNERS {
        return;
    }
    let block = blocks[id.y];
    let corner = block.xy * BLOCK_CELLS + vec2u(id.x % BLOCK_SIDE, id.x / BLOCK_SIDE);
    let direction = dome_sight(dome, corner, view.up, edge_cosine(air.radius_m, view.altitude_m));
    let seen = march_clouds(cloud_ray(observer, direction, jitter_of(vec2f(corner)), CELL_ANGLE / f32(dome.cells)));
    let at = 6u * (block.z * BLOCK_CORNERS + id.x);
    nodes[at] = seen.first.distance_m;
    nodes[at + 1u] = seen.first.share;
    nodes[at + 2u] = seen.first.kind;
    nodes[at + 3u] = seen.second.distance_m;
    nodes[at + 4u] = seen.second.share;
    nodes[at + 5u] = seen.second.kind;
}
