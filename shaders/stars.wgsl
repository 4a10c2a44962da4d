// Adds the stars to a tile of the picture. The list holds each pixel once, so that no two threads meet.
import package::lib::air::Air;
import package::lib::dome::{Dome, dome_cell, dome_coordinate};
import package::lib::geometry::edge_cosine;
import package::lib::light::View;
import package::lib::stars::light_left;

struct Glint {
    direction: vec3f,
    // Row times width, plus column.
    pixel: u32,
    radiance: vec3f,
}

struct Stretch {
    // Of the list, the part from the tile's first pixel to its last.
    first: u32,
    count: u32,
    frame_width: u32,
    // Rises from 0 to 1 as the stars come out.
    out: f32,
    // Of the tile.
    origin_px: vec2u,
    size_px: vec2u,
    // From one pixel of the tile to the next in the frame.
    stride_px: u32,
}

// True where there are clouds.
override CLOUDS: bool = false;
// True to look clouds up by direction, false for a table of the tile's pixels.
override DOME: bool = false;
// True where more than the sphere stands on the ground.
override GROUND: bool = false;

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(1) var<uniform> view: View;
@group(0) @binding(2) var<uniform> stretch: Stretch;
@group(0) @binding(3) var transmittance_table: texture_2d<f32>;
@group(0) @binding(4) var linear_clamp: sampler;
@group(0) @binding(5) var<storage, read> glints: array<Glint>;
@group(0) @binding(6) var<storage, read_write> radiance: array<vec4f>;
// What they let through, in alpha.
@group(0) @binding(7) var cloud_table: texture_2d<f32>;
@group(0) @binding(8) var<uniform> dome: Dome;
// Where each block of the dome is kept, and what is seen of clouds at their corners.
@group(0) @binding(9) var<storage, read> dome_pages: array<u32>;
@group(0) @binding(10) var dome_seen: texture_2d<f32>;
// Of each pixel, in alpha, how far away that is; else -1.
@group(0) @binding(11) var<storage, read> lit_ground: array<vec4f>;

fn left_towards(direction: vec3f) -> f32 {
    let cell = dome_cell(dome, direction, view.up, edge_cosine(air.radius_m, view.altitude_m));
    let at = dome_coordinate(dome_pages[cell.page], cell.place, textureDimensions(dome_seen));
    return textureSampleLevel(dome_seen, linear_clamp, at, 0.0).a;
}

@compute @workgroup_size(64)
fn stars(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= stretch.count {
        return;
    }
    let glint = glints[stretch.first + id.x];
    // Those left of the tile wrap round and lie beyond its size.
    let off = vec2u(glint.pixel % stretch.frame_width, glint.pixel / stretch.frame_width) - stretch.origin_px;
    let place = off / stretch.stride_px;
    if any(place * stretch.stride_px != off) || any(place >= stretch.size_px) {
        return;
    }
    let mu = dot(glint.direction, view.up);
    var left = light_left(air, transmittance_table, linear_clamp, view.altitude_m, mu);
    if DOME {
        left *= left_towards(glint.direction);
    } else if CLOUDS {
        left *= textureLoad(cloud_table, place, 0).a;
    }
    let i = place.y * stretch.size_px.x + place.x;
    if GROUND {
        left *= select(1.0, 0.0, lit_ground[i].w >= 0.0);
    }
    radiance[i] += vec4f(stretch.out * left * glint.radiance, 0.0);
}
