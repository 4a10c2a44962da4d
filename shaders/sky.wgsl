// What is seen in every pixel of one tile: radiance, or the picture itself. A preview's picture is made in stages, each a
// variant of this pass: what is seen on a lattice of places, one to a few pixels; under clouds a finer lattice that
// takes the clear sky from the first; and the pixels between.
import package::lib::camera::sight_at;
import package::lib::dome::{BLOCK_CORNERS, BLOCK_SIDE, Dome, dome_cell, dome_coordinate};
import package::lib::even::{cell_evenness, is_even_run};
import package::lib::geometry::{angle_if_near, angle_of_cosine, edge_cosine};
import package::lib::picture::{Exposure, Tone, packed_pixel, picture_pixel, shown_colour};
import package::lib::sky_light::{
    CLOUDS, Light, MOON, PROJECTION, air, camera, changed_under_clouds, cloud_frame, corona_towards, disc_in_pixel, light_towards, linear_clamp,
    moon, moon_in_pixel, radiance_of, shade, share_above, single_of, view,
};

// 0: every pixel; 1: the lattice; 2: the finer lattice; 3: the pixels between.
override STAGE: u32 = 0u;
// Pixels between the places of the lattice that the stage writes, or reads if it is the last.
override GRAIN_X: u32 = 8u;
override GRAIN_Y: u32 = 8u;
// Those of the first lattice, where there is a finer one.
override COARSE_X: u32 = 8u;
override COARSE_Y: u32 = 8u;

// True to write the picture itself, where nothing else reads its radiance: to store and load four floats a pixel is
// half of a software device's work on a clear sky.
override PICTURE: bool = false;
// Pixels of a row that share a thread, so that they may share the light in the air where it runs evenly.
override SPAN: u32 = 1u;
// As `picture_pixel` numbers it.
override CURVE: u32 = 3u;
// True to look clouds up by direction, false for a table of the tile's pixels.
override DOME: bool = false;
// True where more than the sphere stands on the ground, or shafts fall through the air.
override GROUND: bool = false;
// True where the dome's clouds may hang before what stands on the ground.
override BEFORE_GROUND: bool = false;

struct Tile {
    origin_px: vec2u,
    size_px: vec2u,
    // From one pixel of the tile to the next in the frame; 1 but in stage 0.
    stride_px: u32,
}

@group(0) @binding(3) var<uniform> tile: Tile;
// R, G, B in W/m²/sr; alpha is 0 where the projection sees nothing, else one more than the angle from what glares.
@group(0) @binding(10) var<storage, read_write> radiance: array<vec4f>;
@group(0) @binding(16) var<uniform> tone_settings: Tone;
@group(0) @binding(17) var<storage, read> exposure: Exposure;
@group(0) @binding(18) var<storage, read_write> picture: array<u32>;
// What clouds add in R, G and B, and what they let through.
@group(0) @binding(19) var cloud_table: texture_2d<f32>;
// A place of a lattice: R, G, B of the clear sky's radiance or, for the last stage, from 0 to 255; alpha tells of the
// cell right and down of it: 0 uneven, 1 even but for shadows on the ground, 2 even.
@group(0) @binding(23) var<storage, read> lattice: array<vec4f>;
@group(0) @binding(24) var<storage, read_write> next_lattice: array<vec4f>;
@group(0) @binding(25) var<uniform> dome: Dome;
// Where each block of the dome is kept, and what is seen of clouds at their corners.
@group(0) @binding(26) var<storage, read> dome_pages: array<u32>;
@group(0) @binding(27) var dome_seen: texture_2d<f32>;
// Of each pixel of the tile: radiance and distance of what stands on the ground; or what the sky loses to shafts, and -1
// less the share of what clear air before the horizon sends that is lost.
@group(0) @binding(28) var<storage, read> lit_ground: array<vec4f>;
// Six vectors a corner of the dome, as `Nodes` has them.
@group(0) @binding(29) var<storage, read> dome_nodes: array<vec4f>;

// Pixels of a row that share a thread of the last stage, and of which uneven ones may share as SPAN says.
const BLOCK = 8u;

fn glaring() -> vec3f {
    return select(view.sun, moon.direction, MOON && moon.glares == 1.0);
}

fn clouds_towards(direction: vec3f) -> vec4f {
    let cell = dome_cell(dome, direction, view.up, edge_cosine(air.radius_m, view.altitude_m));
    let at = dome_coordinate(dome_pages[cell.page], cell.place, textureDimensions(dome_seen));
    return textureSampleLevel(dome_seen, linear_clamp, at, 0.0);
}

// Of the clouds in a direction what hangs before the ground: as large a part as of their places' shares. A place stands for
// some depth about it, so that no hard edge shows where a slope rises through a cloud.
fn clouds_before(direction: vec3f, ground_m: f32) -> vec4f {
    let cell = dome_cell(dome, direction, view.up, edge_cosine(air.radius_m, view.altitude_m));
    let corner = min(vec2u(max(cell.place, vec2f(0.0))), vec2u(BLOCK_SIDE - 2u));
    let right = clamp(cell.place - vec2f(corner), vec2f(0.0), vec2f(1.0));
    let slot = dome_pages[cell.page];
    let depth_m = 50.0 + 0.05 * ground_m;
    var near = 0.0;
    var whole = 0.0;
    for (var k = 0u; k < 8u; k++) {
        let at = vec2u((k >> 1u) & 1u, k >> 2u);
        let weights = mix(1.0 - right, right, vec2f(at));
        let i = 6u * (slot * BLOCK_CORNERS + (corner.y + at.y) * BLOCK_SIDE + corner.x + at.x) + 3u * (k & 1u);
        let share = weights.x * weights.y * dome_nodes[i + 1u];
        whole += dot(share, vec4f(1.0));
        near += dot(share, clamp(0.5 + (ground_m - dome_nodes[i]) / depth_m, vec4f(0.0), vec4f(1.0)));
    }
    let all = textureSampleLevel(dome_seen, linear_clamp, dome_coordinate(slot, cell.place, textureDimensions(dome_seen)), 0.0);
    let part = near / max(whole, 1e-6);
    return vec4f(part * all.rgb, 1.0 - part * (1.0 - all.a));
}

// Before the clouds, if there are any. `place` is the pixel's in the tile.
fn with_clouds(behind: vec3f, place: vec2u, direction: vec3f) -> vec3f {
    if !CLOUDS {
        return behind;
    }
    var clouds: vec4f;
    if DOME {
        clouds = clouds_towards(direction);
    } else {
        clouds = textureLoad(cloud_table, place, 0);
    }
    return max(clouds.a * behind + clouds.rgb, vec3f(0.0));
}

// A pixel that the horizon crosses, seen from under the clouds: they stand before the sky's share of it alone.
fn on_horizon(direction: vec3f, above: f32, disc: vec3f, lost: vec3f, lost_to_ground: f32, place: vec2u) -> vec3f {
    let off = edge_cosine(air.radius_m, view.altitude_m) - dot(direction, view.up);
    let sky = normalize(direction + (off + 0.6 * camera.pixel_angle) * view.up);
    let ground = normalize(direction + (off - 0.6 * camera.pixel_angle) * view.up);
    let sky_nu = clamp(dot(sky, view.sun), -1.0, 1.0);
    let ground_nu = clamp(dot(ground, view.sun), -1.0, 1.0);
    let behind = max(radiance_of(light_towards(sky, dot(sky, view.up), sky_nu), sky_nu, disc) - lost, vec3f(0.0));
    let clear = light_towards(ground, dot(ground, view.up), ground_nu);
    let lost_before = lost_to_ground * single_of(clear.rayleigh, clear.mie, ground_nu);
    var below = max(radiance_of(clear, ground_nu, vec3f(0.0)) - lost_before, vec3f(0.0));
    if DOME {
        below = with_clouds(below, place, ground);
    } else {
        below = max(below + changed_under_clouds(ground, dot(ground, view.up), ground_nu), vec3f(0.0));
    }
    return mix(below, with_clouds(behind, place, sky), above);
}

// The tile's pixels from `begin` to `end` of a row, which may share the light at the first and the last of SPAN from
// `first` on.
fn write_run(first: vec2u, begin: u32, end: u32) {
    let row = vec2f(first) + 0.5;
    var even = false;
    var at_first: Light;
    var at_last: Light;
    if SPAN > 1u {
        let a = sight_at(camera, PROJECTION, row);
        let b = sight_at(camera, PROJECTION, row + vec2f(f32(SPAN - 1u), 0.0));
        let mu_a = dot(a.direction, view.up);
        let mu_b = dot(b.direction, view.up);
        even = a.seen && b.seen && is_even_run(mu_a, mu_b, angle_if_near(a.direction, b.direction));
        if even {
            at_first = light_towards(a.direction, mu_a, clamp(dot(a.direction, view.sun), -1.0, 1.0));
            at_last = light_towards(b.direction, mu_b, clamp(dot(b.direction, view.sun), -1.0, 1.0));
        }
    }
    let y = (first.y - tile.origin_px.y) / tile.stride_px;
    var x = (first.x + begin - tile.origin_px.x) / tile.stride_px;
    for (var k = begin; k < end; k += tile.stride_px) {
        let i = y * tile.size_px.x + x;
        let place = row + vec2f(f32(k), 0.0);
        let sight = sight_at(camera, PROJECTION, place);
        var value = vec4f(0.0);
        var before = vec4f(0.0, 0.0, 0.0, -1.0);
        if GROUND {
            before = lit_ground[i];
        }
        if sight.seen && before.w >= 0.0 {
            var seen = before.rgb;
            if !DOME {
                seen = with_clouds(seen, vec2u(x, y), sight.direction);
            } else if BEFORE_GROUND {
                let clouds = clouds_before(sight.direction, before.w);
                seen = max(clouds.a * seen + clouds.rgb, vec3f(0.0));
            }
            value = vec4f(seen, 1.0 + angle_if_near(sight.direction, glaring()));
        }
        // A loop of one round, behind which no compiler joins this arithmetic with the tone curve's: both ways to the
        // picture round alike.
        for (var open = sight.seen && before.w < 0.0; open; open = false) {
            var disc = disc_in_pixel(place, sight.direction);
            if MOON {
                disc = moon.sun_disc_scale * (disc + corona_towards(sight.direction));
            }
            if DOME {
                disc *= dome.sun_left;
            }
            if MOON {
                disc += select(1.0, dome.moon_left, DOME) * moon_in_pixel(place, sight.direction);
            }
            let nu = clamp(dot(sight.direction, view.sun), -1.0, 1.0);
            var light: Light;
            if even {
                let part = f32(k) / f32(max(SPAN, 2u) - 1u);
                light.rayleigh = mix(at_first.rayleigh, at_last.rayleigh, part);
                light.mie = mix(at_first.mie, at_last.mie, part);
                light.even = mix(at_first.even, at_last.even, part);
                light.left = mix(at_first.left, at_last.left, part);
            } else {
                light = light_towards(sight.direction, dot(sight.direction, view.up), nu);
            }
            let own = select(disc, vec3f(0.0), DOME);
            var lost = vec3f(0.0);
            if GROUND {
                lost = before.rgb;
            }
            var seen: vec3f;
            let above = share_above(angle_of_cosine(dot(sight.direction, view.up)));
            if CLOUDS && above > 0.0 && above < 1.0 && view.altitude_m < shade.base_m {
                seen = on_horizon(sight.direction, above, own, lost, -1.0 - before.w, vec2u(x, y));
            } else {
                seen = with_clouds(max(radiance_of(light, nu, own) - lost, vec3f(0.0)), vec2u(x, y), sight.direction);
            }
            if DOME {
                seen += light.left * disc;
            }
            value = vec4f(seen, 1.0 + angle_if_near(sight.direction, glaring()));
        }
        if PICTURE {
            picture[i] = picture_pixel(tone_settings, exposure.scale, CURVE, value, first + vec2u(k, 0u));
        } else {
            radiance[i] = value;
        }
        x++;
    }
}

// True where something stands on the ground in a block of pixels, from `begin` to before `end`.
fn is_ground_within(begin: vec2u, end: vec2u) -> bool {
    var there = false;
    for (var y = begin.y; y < end.y; y++) {
        for (var x = begin.x; x < end.x; x++) {
            let before = lit_ground[(y - tile.origin_px.y) * tile.size_px.x + x - tile.origin_px.x];
            there |= before.w >= 0.0;
        }
    }
    return there;
}

// Lattices lie on the whole frame, so that tiles leave no seam. This is the first place of the tile's part.
fn first_place(grain: vec2u) -> vec2u {
    return tile.origin_px / grain;
}

// Places of the tile's part. One more than reaches its end, so that the last place has a cell as it has in the next tile.
fn place_count(grain: vec2u) -> vec2u {
    return (tile.origin_px + tile.size_px + grain - 1u) / grain - first_place(grain) + 2u;
}

// The clear sky at a place of the finer lattice, where the first one's cell is even.
struct Clear {
    seen: vec3f,
    // As alpha.
    even: f32,
}

fn clear_from_lattice(place: vec2u) -> Clear {
    let grain = vec2u(COARSE_X, COARSE_Y);
    let cell = place / grain;
    let width = place_count(grain).x;
    let at = cell - first_place(grain);
    let i = at.y * width + at.x;
    let part = vec2f(place - cell * grain) / vec2f(grain);
    let corner = lattice[i];
    let top = mix(corner.rgb, lattice[i + 1u].rgb, part.x);
    let bottom = mix(lattice[i + width].rgb, lattice[i + width + 1u].rgb, part.x);
    return Clear(mix(top, bottom, part.y), corner.a);
}

fn write_place(id: vec2u) {
    let grain = vec2u(GRAIN_X, GRAIN_Y);
    let count = place_count(grain);
    // Of the finer lattice nobody reads the last places, nor are there any of the first beside them.
    if any(id >= count - select(0u, 1u, STAGE == 2u)) {
        return;
    }
    let pixel = (first_place(grain) + id) * grain;
    let place = vec2f(pixel);
    let sight = sight_at(camera, PROJECTION, place);
    var clear: Clear;
    if STAGE == 2u {
        clear = clear_from_lattice(pixel);
    }
    if sight.seen && clear.even < 2.0 {
        let nu = clamp(dot(sight.direction, view.sun), -1.0, 1.0);
        clear.seen = radiance_of(light_towards(sight.direction, dot(sight.direction, view.up), nu), nu, vec3f(0.0));
    }
    if GROUND {
        // Places beyond the tile's edge lose what those at the edge do.
        let within = clamp(pixel, tile.origin_px, tile.origin_px + tile.size_px - 1u) - tile.origin_px;
        let before = lit_ground[within.y * tile.size_px.x + within.x];
        clear.seen -= select(before.rgb, vec3f(0.0), before.w >= 0.0 || (STAGE == 2u && clear.even == 2.0));
        clear.seen = max(clear.seen, vec3f(0.0));
    }
    var even = clear.even;
    if even == 0.0 {
        let veil = tone_settings.glare > 0.0 && any(tone_settings.glaring_irradiance > vec3f(0.0));
        even = cell_evenness(place, vec2f(grain), veil, glaring());
    }
    var shown = clear.seen;
    if !CLOUDS || STAGE == 2u {
        let seen = vec4f(with_clouds(clear.seen, vec2u(0u), sight.direction), 1.0 + angle_if_near(sight.direction, glaring()));
        shown = shown_colour(tone_settings, exposure.scale, CURVE, seen);
    }
    next_lattice[id.y * count.x + id.x] = vec4f(shown, even);
}

// A block of pixels from the lattice's places about it, or each from its own ray where a cell of it is not even.
fn write_block(id: vec2u) {
    let grain = vec2u(GRAIN_X, GRAIN_Y);
    let size = vec2u(BLOCK, GRAIN_Y);
    let first = (tile.origin_px / size + id) * size;
    let begin = max(first, tile.origin_px);
    let end = min(first + size, tile.origin_px + tile.size_px);
    if any(begin >= end) {
        return;
    }
    let width = place_count(grain).x;
    let corner = first / grain;
    // Of a tile that begins within the block, only the cells from there on.
    let at = max(corner, first_place(grain)) - first_place(grain);
    let cells_begin = max(corner.x, first_place(grain).x);
    let cells_end = (end.x + GRAIN_X - 1u) / GRAIN_X;
    var i = at.y * width + at.x;
    var even = true;
    for (var x = cells_begin; x < cells_end; x++) {
        even &= lattice[i + x - cells_begin].a > 0.0;
    }
    if GROUND {
        even &= !is_ground_within(begin, end);
    }
    if !even {
        for (var y = begin.y; y < end.y; y++) {
            write_run(vec2u(first.x, y), begin.x - first.x, end.x - first.x);
        }
        return;
    }
    var top = lattice[i].rgb;
    var bottom = lattice[i + width].rgb;
    for (var x = cells_begin; x < cells_end; x++) {
        i++;
        let next_top = lattice[i].rgb;
        let next_bottom = lattice[i + width].rgb;
        let column = x * GRAIN_X;
        for (var y = begin.y; y < end.y; y++) {
            let down = (f32(y - first.y) + 0.5) / f32(GRAIN_Y);
            let row_begin = mix(top, bottom, down);
            let slope = (mix(next_top, next_bottom, down) - row_begin) / f32(GRAIN_X);
            let row = (y - tile.origin_px.y) * tile.size_px.x - tile.origin_px.x + column;
            var shown = row_begin - 0.5 * slope;
            for (var k = 0u; k < GRAIN_X; k++) {
                shown += slope;
                if column + k >= begin.x && column + k < end.x {
                    picture[row + k] = packed_pixel(tone_settings, shown, true, vec2u(column + k, y));
                }
            }
        }
        top = next_top;
        bottom = next_bottom;
    }
}

// Runs lie on the whole frame, so that neither tiles nor strides leave a trace.
fn write_own(id: vec2u) {
    let first = vec2u(
        tile.origin_px.x / SPAN * SPAN + id.x * max(SPAN, tile.stride_px),
        tile.origin_px.y + id.y * tile.stride_px,
    );
    let edge = tile.origin_px.x + tile.size_px.x * tile.stride_px;
    if first.x >= edge || id.y >= tile.size_px.y {
        return;
    }
    // From the run's first pixel to the tile's own next one; where the run begins before the tile, to the tile.
    let next = (tile.stride_px - (first.x - tile.origin_px.x) % tile.stride_px) % tile.stride_px;
    let begin = select(next, tile.origin_px.x - first.x, first.x < tile.origin_px.x);
    write_run(first, begin, min(SPAN, edge - first.x));
}

@compute @workgroup_size(8, 8)
fn sky(@builtin(global_invocation_id) id: vec3u) {
    switch STAGE {
        case 0u: { write_own(id.xy); }
        case 3u: { write_block(id.xy); }
        default: { write_place(id.xy); }
    }
}
