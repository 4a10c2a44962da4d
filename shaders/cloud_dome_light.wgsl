// The light of the clouds that are seen in the directions of some blocks of the dome.
import package::lib::cloud::{clouds, sheet_optical_depth};
import package::lib::cloud_march::{FIRST_SHEET, OPAQUE};
import package::lib::cloud_source::{
    AirBefore, Surroundings, air_before, place_at, sheet_source, source_at, surroundings, unlit_air, view,
};
import package::lib::cloud_ray::cloud_ray;
import package::lib::dome::{BLOCK_CORNERS, BLOCK_CELLS, BLOCK_SIDE, Dome, dome_direction};
import package::lib::geometry::altitude_after;
import package::lib::view_ray::Observer;

@group(0) @binding(18) var<uniform> dome: Dome;
@group(0) @binding(19) var<uniform> observer: Observer;
// Column and row of each block, and where it is kept.
@group(0) @binding(20) var<storage, read> blocks: array<vec4u>;
// Three vectors a corner, as `Nodes` has them.
@group(0) @binding(21) var<storage, read> nodes: array<vec4f>;
// Radiance to add in R, G, B; alpha is the share of what lies behind that comes through.
@group(0) @binding(22) var<storage, read_write> seen: array<vec4f>;

// What lights a place, and the air before it, serve for others that are no farther from it than this part of the way.
const NEAR = 0.05;

@compute @workgroup_size(64)
fn cloud_dome_light(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= BLOCK_CORNERS {
        return;
    }
    let block = blocks[id.y];
    let corner = block.xy * BLOCK_CELLS + vec2u(id.x % BLOCK_SIDE, id.x / BLOCK_SIDE);
    let ray = cloud_ray(observer, dome_direction(vec2f(corner) / f32(dome.cells)), 0.5, 0.0);
    let at = block.z * BLOCK_CORNERS + id.x;
    let distances_m = nodes[3u * at];
    let shares = nodes[3u * at + 1u];
    let kinds = nodes[3u * at + 2u];
    var light = vec3f(0.0);
    var around: Surroundings;
    var before: AirBefore;
    var around_m = -1.0;
    for (var k = 0u; k < 4u; k++) {
        for (var there = shares[k] > 0.0; there; there = false) {
            let distance_m = distances_m[k];
            let p = place_at(distance_m, ray.direction);
            let altitude_m = altitude_after(clouds.radius_m, view.altitude_m, ray.mu, distance_m);
            let index = u32(kinds[k]);
            let part = fract(kinds[k]);
            let extinction = part / (1.0 - part);
            for (var anew = around_m < 0.0 || abs(distance_m - around_m) > NEAR * distance_m; anew; anew = false) {
                around = surroundings(p, altitude_m);
                before = air_before(ray, distance_m);
                around_m = distance_m;
            }
            var source = vec3f(0.0);
            for (var band = index < FIRST_SHEET; band; band = false) {
                source = source_at(index, p, altitude_m, extinction, around, ray.lobes);
            }
            for (var sheet = index >= FIRST_SHEET; sheet; sheet = false) {
                let sheet = clouds.sheets[index - FIRST_SHEET];
                source = sheet_source(index - FIRST_SHEET, p, sheet_optical_depth(sheet, p, sheet.height_m), ray.lobes);
            }
            light += shares[k] * (before.left * source + before.single + before.multiple);
        }
    }
    // What is left of an opaque cloud is nothing.
    let left = 1.0 - dot(shares, vec4f(1.0));
    seen[at] = vec4f(light - unlit_air(ray), select(left, 0.0, left < 2.0 * OPAQUE));
}
