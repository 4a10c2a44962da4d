// What a preview's dome of clouds lets through.
import package::lib::dome::{Dome, dome_cell, dome_coordinate};
import package::lib::geometry::edge_cosine;

@group(0) @binding(8) var<uniform> dome: Dome;
// Where each block of the dome is kept, and what is seen of clouds at their corners.
@group(0) @binding(9) var<storage, read> dome_pages: array<u32>;
@group(0) @binding(10) var dome_seen: texture_2d<f32>;

fn left_towards(radius_m: f32, up: vec3f, altitude_m: f32, direction: vec3f, linear_clamp: sampler) -> f32 {
    let cell = dome_cell(dome, direction, up, edge_cosine(radius_m, altitude_m));
    let at = dome_coordinate(dome_pages[cell.page], cell.place, textureDimensions(dome_seen));
    return textureSampleLevel(dome_seen, linear_clamp, at, 0.0).a;
}
