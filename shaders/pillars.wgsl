// Adds pillars of light and the lamps below them to a tile of radiance, or sums them along a list of directions.
import package::lib::air::Air;
import package::lib::camera::{Camera, Sight, sight_at};
import package::lib::dome_left::left_towards;
import package::lib::geometry::{PI, angle_if_near, distance_to_sphere};
import package::lib::picture::lens_veil;
import package::lib::pillar::{Lamp, emitted};
import package::lib::pillar_lamp::{depth_of, ice};
import package::lib::pillar_open::open_pillar;
import package::lib::pillar_polar::SEEN;
import package::lib::pillar_shaded::{polar, polar_words, shaded_pillar};
import package::lib::pillar_share::{ROUGH, Rays, SHARE_WORDS, SMOOTH, Share, blur_of, ray_of, smooth_pillar};
import package::lib::pillar_sun::{Distant, distant_pillar};

struct Tile {
    origin_px: vec2u,
    size_px: vec2u,
    // From one pixel of the tile to the next in the frame.
    stride_px: u32,
}

// The observer's own frame, with the zenith as z, and what lies far away.
struct Scene {
    east: vec3f,
    altitude_m: f32,
    north: vec3f,
    suns: u32,
    up: vec3f,
    // Cells of 16×16 pixels in a row of the frame.
    cells_across: u32,
    // Share of the lens' veil about lamps.
    glare: f32,
    // Angle between two pixels, or 0 where there are none.
    pixel_angle: f32,
    // Where the cells' lists begin.
    first: u32,
    distant: array<Distant, 2>,
}

// As `sight_at` numbers it.
override PROJECTION: u32 = 0u;
// True to look along a list of directions.
override LIST: bool = false;
// True where more than the sphere stands on the ground.
override GROUND: bool = false;
// True where cells share what they see of a pillar.
override SHARED: bool = false;
// True where things stand in the lamps' light.
override SHADED: bool = false;
// True where clouds hide the pillars of lamps, and of sun and moon.
override CLOUDED_LAMPS: bool = false;
override CLOUDED_SUN: bool = false;
// True to look clouds up by direction, false for a table of the tile's pixels, or `left_list`.
override DOME: bool = false;

// Pixels to a side of a cell, and what each number in its list says beside which lamp it is.
const CELL_PX = 16u;
// Pixels of a column that an invocation looks along.
const ROWS = 4u;
const IN_PILLAR = 0x80000000u;
const NEAR_LAMP = 0x40000000u;
const WHICH = 0x3fffffffu;

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(4) var linear_clamp: sampler;
@group(0) @binding(5) var<uniform> camera: Camera;
@group(0) @binding(6) var<storage, read_write> radiance: array<vec4f>;
// What clouds let through, in alpha.
@group(0) @binding(7) var cloud_table: texture_2d<f32>;
// Of each pixel or direction, in alpha, how far away that is; else -1.
@group(0) @binding(11) var<storage, read> lit_ground: array<vec4f>;
@group(0) @binding(12) var<uniform> tile: Tile;
@group(0) @binding(13) var<storage, read> lamps: array<Lamp>;
// Where each cell's list begins, where the last one ends, and the lists.
@group(0) @binding(14) var<storage, read> cells: array<u32>;
// In a list the directions; in a tile what cells share of each entry.
@group(0) @binding(15) var<storage, read> given: array<vec4f>;
@group(0) @binding(16) var<uniform> scene: Scene;
@group(0) @binding(17) var transmittance_table: texture_2d<f32>;
// Along each direction, what clouds let through, in alpha.
@group(0) @binding(18) var<storage, read> left_list: array<vec4f>;

const ENDLESS_M = 1e9;
// No veil is drawn farther from a lamp, degrees.
const VEIL_DEG = 1.5;

// A lamp's light here, W/m².
fn falling_of(lamp: Lamp) -> vec3f {
    let d = length(lamp.place_m);
    return lamp.intensity * emitted(lamp.emission, -lamp.place_m.z / d) / (d * d)
        * exp(-depth_of(air, lamp.place_m.z, 0.0, d));
}

// Of a lamp's light what a ray sees in its own disc and the lens' veil about it, 1/sr. A disc smaller than a pixel is as
// large as one.
fn lamp_seen(lamp: Lamp, v: vec3f) -> f32 {
    let d = length(lamp.place_m);
    let angle = angle_if_near(v, lamp.place_m / d);
    let soft = max(scene.pixel_angle, 1e-7);
    let disc = max(lamp.radius_m / d, scene.pixel_angle);
    let drawn = disc > 0.0;
    let shown = clamp((disc - angle) / soft + 0.5, 0.0, 1.0) / (PI * max(disc * disc + soft * soft / 12.0, 1e-20));
    let off_deg = degrees(max(angle, disc));
    let fades = 1.0 - smoothstep(0.5 * VEIL_DEG, VEIL_DEG, off_deg);
    return select(0.0, shown, drawn) + scene.glare * lens_veil(off_deg) * fades;
}

fn share_at(at: u32) -> Share {
    let a = given[at];
    let b = given[at + 1u];
    let c = given[at + 2u];
    let d = given[at + 3u];
    return Share(a.x, a.y, a.z, a.w, b.x, b.y, b.zw, c.xy, c.zw, d.xyz, u32(d.w));
}

// Radiance along four rays, a band at a time.
struct Bands {
    r: vec4f,
    g: vec4f,
    b: vec4f,
}

// Pillars and lamps of a list, along the rays of `rows`.
fn lamps_of(rays: Rays, end_m: vec4f, rows: vec2u, begin: u32, end: u32) -> Bands {
    var found: Bands;
    for (var k = begin; k < end; k++) {
        var entry = k | IN_PILLAR | NEAR_LAMP;
        if !LIST {
            entry = cells[k];
        }
        let which = entry & WHICH;
        let lamp = lamps[which];
        if (entry & NEAR_LAMP) != 0u {
            let d = length(lamp.place_m);
            let falling = falling_of(lamp);
            for (var j = rows.x; j < rows.y; j++) {
                var is_seen = d < end_m[j] * 1.05 + 5.0;
                if SHADED {
                    is_seen = (polar_words[which * polar.words] & SEEN) != 0u;
                }
                if is_seen {
                    let light = falling * lamp_seen(lamp, ray_of(rays, j));
                    found.r[j] += light.x;
                    found.g[j] += light.y;
                    found.b[j] += light.z;
                }
            }
        }
        if (entry & IN_PILLAR) == 0u {
            continue;
        }
        let blur_m = blur_of(lamp, scene.pixel_angle);
        for (var i = 0u; i < ice.count; i++) {
            // Which rays sum by themselves.
            var alone = vec4<bool>(true);
            if SHARED {
                let share = share_at(((k - scene.first) * ice.count + i) * SHARE_WORDS);
                alone = vec4<bool>(share.kind == ROUGH);
                if share.kind == SMOOTH {
                    var light = smooth_pillar(ice.layers[i], share, lamp, rays, blur_m);
                    if GROUND {
                        // What stands there hides all of it, or a part.
                        alone = (end_m < vec4f(share.stretch_m.y)) & (end_m >= vec4f(share.stretch_m.x));
                        light = select(light, vec4f(0.0), end_m < vec4f(share.stretch_m.y));
                    }
                    found.r += light * share.colour.x;
                    found.g += light * share.colour.y;
                    found.b += light * share.colour.z;
                }
            }
            if any(alone) {
                for (var j = rows.x; j < rows.y; j++) {
                    if !alone[j] {
                        continue;
                    }
                    var light: vec3f;
                    if SHADED {
                        light = shaded_pillar(air, ice.layers[i], lamp, which, ray_of(rays, j), end_m[j], blur_m);
                    } else {
                        light = open_pillar(air, ice.layers[i], lamp, ray_of(rays, j), end_m[j], blur_m);
                    }
                    found.r[j] += light.x;
                    found.g[j] += light.y;
                    found.b[j] += light.z;
                }
            }
        }
    }
    return found;
}

@compute @workgroup_size(8, 8)
fn pillars(@builtin(global_invocation_id) id: vec3u) {
    // An invocation looks along a few pixels of a column, so that what they share is read once.
    var count = 1u;
    if LIST {
        if id.x >= arrayLength(&given) || id.y > 0u {
            return;
        }
    } else {
        if id.x >= tile.size_px.x || id.y * ROWS >= tile.size_px.y {
            return;
        }
        count = min(ROWS, tile.size_px.y - id.y * ROWS);
    }
    var rays = Rays(vec4f(1.0), vec4f(0.0), vec4f(0.0));
    var end_m = vec4f(ENDLESS_M);
    var cell = vec4u(0u);
    var seen = vec4<bool>(false);
    for (var j = 0u; j < count; j++) {
        var sight: Sight;
        var i = id.x;
        if LIST {
            sight = Sight(given[id.x].xyz, true);
        } else {
            let at = vec2u(id.x, id.y * ROWS + j);
            let pixel = tile.origin_px + tile.stride_px * at;
            sight = sight_at(camera, PROJECTION, vec2f(pixel) + 0.5);
            i = at.y * tile.size_px.x + at.x;
            cell[j] = (pixel.y / CELL_PX) * scene.cells_across + pixel.x / CELL_PX;
        }
        if !sight.seen {
            continue;
        }
        seen[j] = true;
        rays.x[j] = dot(sight.direction, scene.east);
        rays.y[j] = dot(sight.direction, scene.north);
        rays.z[j] = dot(sight.direction, scene.up);
        let sphere_m = distance_to_sphere(air.radius_m, scene.altitude_m, rays.z[j]);
        end_m[j] = select(ENDLESS_M, sphere_m, sphere_m >= 0.0);
        if GROUND {
            let ground_m = lit_ground[i].w;
            end_m[j] = select(end_m[j], ground_m, ground_m >= 0.0);
        }
    }
    // Where another cell begins, another list does.
    var rows = vec2u(0u);
    while rows.x < count {
        rows.y = rows.x + 1u;
        while rows.y < count && cell[min(rows.y, ROWS - 1u)] == cell[rows.x] {
            rows.y++;
        }
        var begin = 0u;
        var end = arrayLength(&lamps);
        if !LIST {
            begin = cells[cell[rows.x]];
            end = cells[cell[rows.x] + 1u];
        }
        let lit = lamps_of(rays, end_m, rows, begin, end);
        for (var j = rows.x; j < rows.y; j++) {
            if seen[j] {
                let i = select((id.y * ROWS + j) * tile.size_px.x + id.x, id.x, LIST);
                add(i, vec2u(id.x, id.y * ROWS + j), ray_of(rays, j), end_m[j], vec3f(lit.r[j], lit.g[j], lit.b[j]));
            }
        }
        rows.x = rows.y;
    }
}

// Adds a ray's lamps and its pillars of sun and moon, behind clouds.
fn add(i: u32, at: vec2u, v: vec3f, end_m: f32, lit: vec3f) {
    var left = 1.0;
    if CLOUDED_LAMPS || CLOUDED_SUN {
        if DOME {
            let direction = v.x * scene.east + v.y * scene.north + v.z * scene.up;
            left = left_towards(air.radius_m, scene.up, scene.altitude_m, direction, linear_clamp);
        } else if LIST {
            left = left_list[i].a;
        } else {
            left = textureLoad(cloud_table, at, 0).a;
        }
    }
    var found = select(1.0, left, CLOUDED_LAMPS) * lit;
    for (var k = 0u; k < scene.suns; k++) {
        found += select(1.0, left, CLOUDED_SUN)
            * distant_pillar(air, transmittance_table, linear_clamp, scene.distant[k], v, end_m);
    }
    radiance[i] += vec4f(found, 0.0);
}
