// The light of the clouds that are seen in the directions of some blocks of the dome.
import package::lib::cloud_nodes::{FourNodes, Nodes};
import package::lib::cloud_ray::{air, cloud_ray, view};
import package::lib::cloud_seen::clouds_seen;
import package::lib::dome::{BLOCK_CORNERS, BLOCK_CELLS, BLOCK_SIDE, CELL_ANGLE, Dome, dome_sight, dome_texel};
import package::lib::geometry::edge_cosine;
import package::lib::shaft_lattice::Lost;
import package::lib::view_ray::Observer;

@group(0) @binding(22) var<uniform> dome: Dome;
@group(0) @binding(23) var<uniform> observer: Observer;
// Column and row of each block, and where it is kept.
@group(0) @binding(24) var<storage, read> blocks: array<vec4u>;
// Six vectors a corner, as `Nodes` has them.
@group(0) @binding(25) var<storage, read> nodes: array<vec4f>;
// Radiance to add in R, G, B; alpha is the share of what lies behind that comes through.
@group(0) @binding(26) var seen: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(64)
fn cloud_dome_light(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= BLOCK_CORNERS {
        return;
    }
    let block = blocks[id.y];
    let in_block = vec2u(id.x % BLOCK_SIDE, id.x / BLOCK_SIDE);
    let corner = block.xy * BLOCK_CELLS + in_block;
    let direction = dome_sight(dome, corner, view.up, edge_cosine(air.radius_m, view.altitude_m));
    let ray = cloud_ray(observer, direction, 0.5, CELL_ANGLE / f32(dome.cells));
    let k = 6u * (block.z * BLOCK_CORNERS + id.x);
    let first = FourNodes(nodes[k], nodes[k + 1u], nodes[k + 2u]);
    // Shafts are found before pixels.
    var lost: Lost;
    let light = clouds_seen(ray, Nodes(first, FourNodes(nodes[k + 3u], nodes[k + 4u], nodes[k + 5u])), lost);
    textureStore(seen, dome_texel(block.z, in_block), light);
}
