// What a preview's dome of clouds lets through.
import package::lib::dome::{BLOCK_CORNERS, BLOCK_SIDE, Dome, dome_cell};
import package::lib::geometry::edge_zenith_angle;

@group(0) @binding(8) var<uniform> dome: Dome;
// Where each block of the dome is kept, and what is seen of clouds at their corners.
@group(0) @binding(9) var<storage, read> dome_pages: array<u32>;
@group(0) @binding(10) var<storage, read> dome_seen: array<vec4f>;

fn left_towards(radius_m: f32, up: vec3f, altitude_m: f32, direction: vec3f) -> f32 {
    let cell = dome_cell(dome, direction, up, cos(edge_zenith_angle(radius_m, altitude_m)));
    let i = dome_pages[cell.page] * BLOCK_CORNERS + cell.corner;
    let top = mix(dome_seen[i].a, dome_seen[i + 1u].a, cell.part.x);
    let bottom = mix(dome_seen[i + BLOCK_SIDE].a, dome_seen[i + BLOCK_SIDE + 1u].a, cell.part.x);
    return mix(top, bottom, cell.part.y);
}
