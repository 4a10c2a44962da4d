// Adds pillars of light and the lamps below them to a tile of radiance, or sums them along a list of directions.
import package::lib::air::Air;
import package::lib::camera::{Camera, Sight, sight_at};
import package::lib::dome_left::left_towards;
import package::lib::geometry::{PI, angle_if_near, distance_to_sphere};
import package::lib::picture::lens_veil;
import package::lib::pillar::{Lamp, emitted};
import package::lib::pillar_lamp::depth_of;
import package::lib::pillar_open::open_pillar;
import package::lib::pillar_polar::SEEN;
import package::lib::pillar_shaded::{polar, polar_words, shaded_pillar};
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
    distant: array<Distant, 2>,
}

// As `sight_at` numbers it.
override PROJECTION: u32 = 0u;
// True to look along a list of directions.
override LIST: bool = false;
// True where more than the sphere stands on the ground.
override GROUND: bool = false;
// True where things stand in the lamps' light.
override SHADED: bool = false;
// True where clouds hide the pillars of lamps, and of sun and moon.
override CLOUDED_LAMPS: bool = false;
override CLOUDED_SUN: bool = false;
// True to look clouds up by direction, false for a table of the tile's pixels, or `left_list`.
override DOME: bool = false;

// Pixels to a side of a cell, and what each number in its list says beside which lamp it is.
const CELL_PX = 16u;
const IN_PILLAR = 0x80000000u;
const NEAR_LAMP = 0x40000000u;
const WHICH = 0x3fffffffu;

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(2) var<uniform> scene: Scene;
@group(0) @binding(3) var transmittance_table: texture_2d<f32>;
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
@group(0) @binding(15) var<storage, read> directions: array<vec4f>;
// Along each direction, what clouds let through, in alpha.
@group(0) @binding(18) var<storage, read> left_list: array<vec4f>;

const ENDLESS_M = 1e9;
// No veil is drawn farther from a lamp, degrees.
const VEIL_DEG = 1.5;

// A lamp's own disc and the lens' veil about it. A disc smaller than a pixel is as large as one.
fn lamp_seen(lamp: Lamp, v: vec3f) -> vec3f {
    let d = length(lamp.place_m);
    let to_lamp = lamp.place_m / d;
    let angle = angle_if_near(v, to_lamp);
    let falling = lamp.intensity * emitted(lamp.emission, -to_lamp.z) / (d * d)
        * exp(-depth_of(air, lamp.place_m.z, 0.0, d));
    let soft = max(scene.pixel_angle, 1e-7);
    let disc = max(lamp.radius_m / d, scene.pixel_angle);
    let drawn = disc > 0.0;
    var shown = clamp((disc - angle) / soft + 0.5, 0.0, 1.0) / (PI * max(disc * disc + soft * soft / 12.0, 1e-20));
    let off_deg = degrees(max(angle, disc));
    let fades = 1.0 - smoothstep(0.5 * VEIL_DEG, VEIL_DEG, off_deg);
    shown = select(0.0, shown, drawn) + scene.glare * lens_veil(off_deg) * fades;
    return falling * shown;
}

fn lamps_of(v: vec3f, end_m: f32, begin: u32, end: u32) -> vec3f {
    var found = vec3f(0.0);
    for (var k = begin; k < end; k++) {
        var entry = k | IN_PILLAR | NEAR_LAMP;
        if !LIST {
            entry = cells[k];
        }
        let which = entry & WHICH;
        let lamp = lamps[which];
        let d = length(lamp.place_m);
        if (entry & NEAR_LAMP) != 0u {
            var is_seen = d < end_m * 1.05 + 5.0;
            if SHADED {
                is_seen = (polar_words[which * polar.words] & SEEN) != 0u;
            }
            if is_seen {
                found += lamp_seen(lamp, v);
            }
        }
        if (entry & IN_PILLAR) != 0u {
            let spread = d * scene.pixel_angle * 0.3;
            let blur_m = sqrt(0.25 * lamp.radius_m * lamp.radius_m + spread * spread);
            if SHADED {
                found += shaded_pillar(air, lamp, which, v, end_m, blur_m);
            } else {
                found += open_pillar(air, lamp, v, end_m, blur_m);
            }
        }
    }
    return found;
}

@compute @workgroup_size(8, 8)
fn pillars(@builtin(global_invocation_id) id: vec3u) {
    var sight: Sight;
    var i = id.x;
    var begin = 0u;
    var end = arrayLength(&lamps);
    if LIST {
        if id.x >= arrayLength(&directions) || id.y > 0u {
            return;
        }
        sight = Sight(directions[id.x].xyz, true);
    } else {
        if any(id.xy >= tile.size_px) {
            return;
        }
        let pixel = tile.origin_px + tile.stride_px * id.xy;
        sight = sight_at(camera, PROJECTION, vec2f(pixel) + 0.5);
        i = id.y * tile.size_px.x + id.x;
        let cell = pixel / CELL_PX;
        let at = cell.y * scene.cells_across + cell.x;
        begin = cells[at];
        end = cells[at + 1u];
    }
    if !sight.seen {
        return;
    }
    let v = vec3f(dot(sight.direction, scene.east), dot(sight.direction, scene.north), dot(sight.direction, scene.up));
    let sphere_m = distance_to_sphere(air.radius_m, scene.altitude_m, v.z);
    var end_m = select(ENDLESS_M, sphere_m, sphere_m >= 0.0);
    if GROUND {
        let ground_m = lit_ground[i].w;
        end_m = select(end_m, ground_m, ground_m >= 0.0);
    }
    var left = 1.0;
    if CLOUDED_LAMPS || CLOUDED_SUN {
        if DOME {
            left = left_towards(air.radius_m, scene.up, scene.altitude_m, sight.direction, linear_clamp);
        } else if LIST {
            left = left_list[i].a;
        } else {
            left = textureLoad(cloud_table, id.xy, 0).a;
        }
    }
    var found = select(1.0, left, CLOUDED_LAMPS) * lamps_of(v, end_m, begin, end);
    for (var k = 0u; k < scene.suns; k++) {
        found += select(1.0, left, CLOUDED_SUN)
            * distant_pillar(air, transmittance_table, linear_clamp, scene.distant[k], v, end_m);
    }
    radiance[i] += vec4f(found, 0.0);
}
