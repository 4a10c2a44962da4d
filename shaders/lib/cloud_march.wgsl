// Light along a ray through the clouds. Whoever imports from here binds what `lib/cloud.wgsl` names, and then this.
import package::lib::aerial::aerial_to;
import package::lib::air::Air;
import package::lib::cloud::{CloudBand, CloudSheet, band_extinction, clouds, sheet_optical_depth};
import package::lib::cloud_light::{Lobes, ambient_source, lit_source};
import package::lib::cloud_shade::{CloudShade, LightDepth, light_cosine, light_depth_within, shade_depth};
import package::lib::cloud_nodes::{NODE_SHARE, Nodes, with_node};
import package::lib::geometry::{PI, altitude_after, cosine_after, distance_to_sphere, distance_to_top, shell_stretch};
import package::lib::light::{View, scattered_radiance};
import package::lib::scattering::Scattered;
import package::lib::tables::{SkyViewRay, light_from_table, sun_cosine_unit, unit_to_coordinate};
import package::lib::transmittance::transmittance_to_space;

// True to note the places that are seen instead of their light.
override NODES: bool = false;

@group(0) @binding(8) var<uniform> air: Air;
// The light that counts: the sun, or at night the moon.
@group(0) @binding(9) var<uniform> view: View;
@group(0) @binding(10) var<uniform> shade: CloudShade;
@group(0) @binding(11) var linear_clamp: sampler;
@group(0) @binding(12) var transmittance_table: texture_2d<f32>;
@group(0) @binding(13) var irradiance_table: texture_2d<f32>;
@group(0) @binding(14) var aerial_rayleigh: texture_3d<f32>;
@group(0) @binding(15) var aerial_mie: texture_3d<f32>;
@group(0) @binding(16) var aerial_multiple: texture_3d<f32>;
@group(0) @binding(17) var shade_maps: texture_2d_array<f32>;

// What clouds do to a ray: the radiance behind them comes through by `left`, and `light` is added.
struct CloudsSeen {
    light: vec3f,
    left: f32,
}

struct CloudRay {
    direction: vec3f,
    mu: f32,
    // With the light.
    nu: f32,
    azimuth: f32,
    zenith_angle: f32,
    ground: bool,
    // To the ground, or farther than anything.
    end_m: f32,
    // The stretch in the air.
    air_from_m: f32,
    air_length_m: f32,
    // Even over 0 to 1, from pixel to pixel.
    jitter: f32,
    // Angle that it stands for.
    spread: f32,
    lobes: Lobes,
}

// Nothing is seen through what lets less through.
const OPAQUE = 0.002;
// Of one band, at the usual fineness.
const MOST_STEPS = 1400u;
// After this many empty steps they grow by that factor.
const EMPTY = 4u;
const WIDE = 3.0;
// Within a cloud's bulk, where the detail noise has its edges, they are closer.
const CLOSER = 1.5;
// The light is found once for so many steps.
const RESTS = 8.0;
// A cloud that stands apart counts by itself if it is more than this.
const LEAST_APART = 0.05;
// Over which way clouds fade, where they are asked to.
const HAZE_M = 3e4;
// A ray through more air than this sees none of the clouds beyond.
const FARTHEST_M = 6e5;

fn place_at(t: f32, direction: vec3f) -> vec3f {
    return clouds.place_m + t * direction;
}

// Light in the air up to a distance, and what the air lets through.
struct AirBefore {
    single: vec3f,
    multiple: vec3f,
    left: vec3f,
}

fn air_before(ray: CloudRay, t: f32) -> AirBefore {
    let way_m = clamp(t - ray.air_from_m, 0.0, ray.air_length_m);
    let sky_ray = SkyViewRay(ray.azimuth, ray.zenith_angle, ray.ground, ray.end_m);
    let light = aerial_to(air, aerial_rayleigh, aerial_mie, aerial_multiple, linear_clamp, view.altitude_m, sky_ray, way_m, ray.air_length_m);
    let all = scattered_radiance(air, view, light, ray.nu);
    let multiple = view.sun_irradiance * light.multiple;
    return AirBefore(all - multiple, multiple, exp(-light.optical_depth));
}

// Optical depth of a band from a place on, that way; steps grow with the square.
fn depth_within(band: CloudBand, p: vec3f, altitude_m: f32, towards: vec3f, mu: f32, steps: u32, most_m: f32) -> f32 {
    var sum = 0.0;
    var near_m = 0.0;
    for (var k = 1u; k <= steps; k++) {
        let far = f32(k) / f32(steps);
        let far_m = most_m * far * far;
        let t = 0.5 * (near_m + far_m);
        let h = altitude_after(clouds.radius_m, altitude_m, mu, t);
        sum += band_extinction(band, p + t * towards, h, false, 0.0).value * (far_m - near_m);
        near_m = far_m;
    }
    return sum;
}

// Light about a place of a cloud, W/m².
struct Surroundings {
    // Of the sun, through the air alone.
    sun: vec3f,
    // Of the whole sky on a level place, over the air below it; and of the ground and the air beneath.
    above: vec3f,
    below: vec3f,
    // The light's cosine with the zenith.
    mu_s: f32,
}

const AIR_SCALE_M = 8500.0;

fn surroundings(p: vec3f, altitude_m: f32) -> Surroundings {
    let mu_s = dot(normalize(p + vec3f(0.0, 0.0, clouds.radius_m)), view.sun);
    let x = unit_to_coordinate(sun_cosine_unit(mu_s), textureDimensions(irradiance_table).x);
    let sky = light_from_table(textureSampleLevel(irradiance_table, linear_clamp, vec2f(x, 0.5), 0.0).rgb);
    let on_ground = max(mu_s, 0.0) * transmittance_to_space(air, transmittance_table, linear_clamp, 0.0, mu_s);
    let here = transmittance_to_space(air, transmittance_table, linear_clamp, altitude_m, mu_s);
    let above = exp(-altitude_m / AIR_SCALE_M);
    let ground = air.ground_albedo * (shade.diffuse_left * (on_ground + sky));
    let even = clouds.ambient_factor * view.sun_irradiance;
    let sun = clouds.sun_factor * clouds.sun_colour * view.sun_irradiance * here;
    return Surroundings(sun, even * sky * above, even * (ground + sky * (1.0 - above)), mu_s);
}

fn mixed(a: Surroundings, b: Surroundings, s: f32) -> Surroundings {
    return Surroundings(mix(a.sun, b.sun, s), mix(a.above, b.above, s), mix(a.below, b.below, s), mix(a.mu_s, b.mu_s, s));
}

// With so many steps the light's way is followed to its ends.
const ALL_LIGHT_STEPS = 64u;
// With fewer, over this share of the shape noise's scale. Within it density changes faster than the maps can hold, which
// stand in texels and at eight heights.
const REACH = 0.5;

// Optical depth of a band from a place towards the light (`side` 1) or away from it (-1): followed close to the place,
// and beyond as it stands in the maps of shadows.
fn depth_beside(index: u32, band: CloudBand, p: vec3f, altitude_m: f32, mu_s: f32, side: f32) -> f32 {
    let towards = side * view.sun;
    let cosine = side * light_cosine(mu_s);
    let out_m = select(altitude_m - band.base_m, band.top_m - altitude_m, cosine > 0.0) / abs(cosine);
    let all = clouds.light_steps >= ALL_LIGHT_STEPS;
    let reach_m = min(out_m, select(REACH / clouds.base_inverse_scale_per_m, out_m, all));
    var depth = depth_within(band, p, altitude_m, towards, side * mu_s, clouds.light_steps, reach_m);
    for (var beyond = reach_m < out_m; beyond; beyond = false) {
        let there_m = altitude_after(clouds.radius_m, altitude_m, side * mu_s, reach_m);
        let there = light_depth(index, band, p + reach_m * towards, there_m, mu_s);
        depth += select(there.behind, there.before, side > 0.0);
    }
    return depth;
}

// Source function of a place in a band, W/m²/sr. With no steps on the light's way its optical depth is that of the maps.
fn source_at(index: u32, p: vec3f, altitude_m: f32, extinction_per_m: f32, around: Surroundings, lobes: Lobes) -> vec3f {
    let band = clouds.bands[index];
    let mu_s = around.mu_s;
    let thickness = band.top_m - band.base_m;
    var way: LightDepth;
    for (var far = clouds.light_steps == 0u; far; far = false) {
        way = light_depth(index, band, p, altitude_m, mu_s);
    }
    for (var close = clouds.light_steps > 0u; close; close = false) {
        way.before = depth_beside(index, band, p, altitude_m, mu_s, 1.0);
        way.behind = depth_beside(index, band, p, altitude_m, mu_s, -1.0);
    }
    let over = shade_depth(shade, shade_maps, linear_clamp, clouds.radius_m, p, band.top_m, view.sun, mu_s);
    let h = clamp((altitude_m - band.base_m) / thickness, 0.0, 1.0);
    // Even light comes by the shortest way out, not straight up: a share of the thickness on either side.
    let up = 0.5 * extinction_per_m * (1.0 - h) * thickness;
    let down = 0.5 * extinction_per_m * h * thickness;
    let direct = around.sun * exp(-over) * lit_source(lobes, way.before, way.behind, band.leak);
    return clouds.albedo * (direct + around.above * ambient_source(up, down) + around.below * ambient_source(down, up));
}

fn light_depth(index: u32, band: CloudBand, p: vec3f, altitude_m: f32, mu_s: f32) -> LightDepth {
    return light_depth_within(shade, shade_maps, linear_clamp, index, band.base_m, band.top_m, clouds.radius_m, p, altitude_m, view.sun, mu_s);
}

var<private> noted: Nodes;
var<private> noted_count: u32;

fn note(share: f32, distance_m: f32, index: u32, extinction_per_m: f32) {
    noted = with_node(noted, noted_count, distance_m, (1.0 - faded(distance_m)) * share, index, extinction_per_m);
    noted_count += 1u;
}

struct BandSeen {
    light: vec3f,
    left: f32,
    // Where what is seen stands, by how much of it is seen.
    distance_m: f32,
}

fn march_band(index: u32, ray: CloudRay, start_m: f32, stop_m: f32, left_before: f32) -> BandSeen {
    let band = clouds.bands[index];
    var seen = BandSeen(vec3f(0.0), 1.0, 0.0);
    let least_m = band.thickness_m / (128.0 * clouds.fineness);
    let growth = 0.5 * 0.0125 / clouds.fineness;
    // Each step is a cell, looked at somewhere in it; the last one ends where the band does.
    var t = start_m;
    var empty = 0u;
    var within = false;
    var until_m = 0.0;
    // What lights the clouds changes slowly: it is found where they begin and where the band ends.
    var first: Surroundings;
    var last: Surroundings;
    var first_m = -1.0;
    // Of what is seen, what no light has been found for yet: the share, where it stands and its extinction by that share.
    var pending = vec3f(0.0);
    let rests = u32(max(RESTS / max(clouds.fineness, 1.0), 1.0));
    let most = u32(f32(MOST_STEPS) * max(clouds.fineness, 0.25));
    for (var k = 0u; k < most; k++) {
        let ends = t >= stop_m || seen.left * left_before <= OPAQUE || k + 1u == most;
        // One place for the mean of some steps, and the same steps for all neighbours: devices run them in step.
        let apart = pending.x >= NODE_SHARE || (pending.x > LEAST_APART && !within);
        let due = ends || select(k % rests == 0u, apart, NODES);
        for (var lit = pending.x > 0.0 && due; lit; lit = false) {
            let at = pending.y / pending.x;
            if NODES {
                note(left_before * pending.x, at, index, pending.z / pending.x);
                pending = vec3f(0.0);
                continue;
            }
            let p = place_at(at, ray.direction);
            let h = altitude_after(clouds.radius_m, view.altitude_m, ray.mu, at);
            for (var begins = first_m < 0.0; begins; begins = false) {
                first_m = at;
                first = surroundings(p, h);
                last = surroundings(place_at(stop_m, ray.direction), altitude_after(clouds.radius_m, view.altitude_m, ray.mu, stop_m));
            }
            let around = mixed(first, last, clamp((at - first_m) / max(stop_m - first_m, 1.0), 0.0, 1.0));
            seen.light += pending.x * source_at(index, p, h, pending.z / pending.x, around, ray.lobes);
            pending = vec3f(0.0);
        }
        if ends {
            break;
        }
        let usual_m = max(least_m, growth * t);
        let narrow_m = min(select(usual_m, usual_m / CLOSER, within), stop_m - t);
        // Not quite at a cell's end: an edge that begins with the cell belongs to it.
        let at = t + mix(0.05, 0.95, ray.jitter) * narrow_m;
        let h = altitude_after(clouds.radius_m, view.altitude_m, ray.mu, at);
        let density = band_extinction(band, place_at(at, ray.direction), h, true, narrow_m);
        // The way walked back is gone in close steps, whatever is there.
        if density.bulk <= 0.0 && t >= until_m {
            within = false;
            empty += 1u;
            t += select(narrow_m, WIDE * narrow_m, empty > EMPTY);
            continue;
        }
        if !within {
            // Walked in: back to where the closer steps begin.
            within = true;
            until_m = t + narrow_m;
            t = max(t - select(1.0, WIDE, empty > EMPTY) * usual_m, start_m);
            empty = 0u;
            continue;
        }
        let passed = exp(-density.value * narrow_m);
        let share = seen.left * (1.0 - passed);
        pending += share * vec3f(1.0, at, density.value);
        seen.distance_m += share * at;
        seen.left *= passed;
        t += narrow_m;
    }
    seen.distance_m = select(start_m, seen.distance_m / max(1.0 - seen.left, 1e-6), seen.left < 1.0 - 1e-6);
    // What is left of an opaque cloud is nothing.
    if seen.left * left_before <= OPAQUE {
        seen.left = 0.0;
    }
    return seen;
}

// A thin layer: its light scattered once with the phase function, and the rest as a slab's.
fn sheet_source(index: u32, p: vec3f, depth: f32, lobes: Lobes) -> vec3f {
    let sheet = clouds.sheets[index];
    let around = surroundings(p, sheet.height_m);
    let over = shade_depth(shade, shade_maps, linear_clamp, clouds.radius_m, p, sheet.height_m + 1.0, view.sun, around.mu_s);
    // Half the way in, towards the light.
    let before = 0.5 * depth / max(abs(around.mu_s), 0.05);
    let direct = around.sun * exp(-over) * lit_source(lobes, before, before, 0.0);
    let even = (around.above + around.below) * ambient_source(0.5 * depth, 0.5 * depth);
    return clouds.albedo * (direct + even);
}

// Places along each side of what a ray stands for, at which a sheet is looked at where nothing else evens it out.
const SHEET_PLACES = 3;

fn sheet_left(sheet: CloudSheet, p: vec3f, up: vec3f, ray: CloudRay, t: f32) -> f32 {
    let mu = max(abs(dot(up, ray.direction)), 0.02);
    if !NODES {
        return exp(-sheet_optical_depth(sheet, p, sheet.height_m) / mu);
    }
    let level = ray.direction - dot(up, ray.direction) * up;
    let along = level / max(length(level), 1e-3);
    let across = cross(up, along);
    var sum = 0.0;
    for (var k = 0; k < SHEET_PLACES * SHEET_PLACES; k++) {
        let off = (vec2f(f32(k % SHEET_PLACES), f32(k / SHEET_PLACES)) + 0.5) / f32(SHEET_PLACES) - 0.5;
        let place = p + t * ray.spread * (off.x / mu * along + off.y * across);
        sum += exp(-sheet_optical_depth(sheet, place, sheet.height_m) / mu);
    }
    return sum / f32(SHEET_PLACES * SHEET_PLACES);
}

fn sheet_seen(index: u32, ray: CloudRay, t: f32, left_before: f32) -> BandSeen {
    let sheet = clouds.sheets[index];
    let p = place_at(t, ray.direction);
    let up = normalize(p + vec3f(0.0, 0.0, clouds.radius_m));
    let left = sheet_left(sheet, p, up, ray, t);
    if NODES {
        if left < 1.0 {
            note(left_before * (1.0 - left), t, FIRST_SHEET + index, 0.0);
        }
        return BandSeen(vec3f(0.0), left, t);
    }
    let depth = sheet_optical_depth(sheet, p, sheet.height_m);
    return BandSeen((1.0 - left) * sheet_source(index, p, depth, ray.lobes), left, t);
}

// The next thing along the ray, of those that begin at `t` or later: bands, then sheets.
struct Next {
    index: u32,
    start_m: f32,
    stop_m: f32,
}

const NOTHING = 1000u;
// Sheets are numbered after the bands.
const FIRST_SHEET = 8u;

fn nearer(best: Next, index: u32, start_m: f32, stop_m: f32, t: f32) -> Next {
    if start_m < stop_m && start_m >= t && start_m < best.start_m {
        return Next(index, start_m, stop_m);
    }
    return best;
}

fn next_after(ray: CloudRay, t: f32) -> Next {
    var best = Next(NOTHING, FARTHEST_M + max(ray.air_from_m, 0.0), 0.0);
    let h = view.altitude_m;
    for (var i = 0u; i < clouds.band_count; i++) {
        let band = clouds.bands[i];
        let outer = shell_stretch(clouds.radius_m + band.top_m, h - band.top_m, ray.mu, ray.end_m);
        let inner = shell_stretch(clouds.radius_m + band.base_m, h - band.base_m, ray.mu, ray.end_m);
        let hollow = inner.x < inner.y;
        best = nearer(best, i, outer.x, select(outer.y, inner.x, hollow), t);
        if hollow {
            best = nearer(best, i, inner.y, outer.y, t);
        }
    }
    for (var i = 0u; i < clouds.sheet_count; i++) {
        let height_m = clouds.sheets[i].height_m;
        let inside = shell_stretch(clouds.radius_m + height_m, h - height_m, ray.mu, FARTHEST_M * 100.0);
        if inside.x < inside.y {
            if inside.x > 0.0 && inside.x < ray.end_m {
                best = nearer(best, FIRST_SHEET + i, inside.x, inside.x + 1.0, t);
            }
            if inside.y < ray.end_m {
                best = nearer(best, FIRST_SHEET + i, inside.y, inside.y + 1.0, t);
            }
        }
    }
    return best;
}

fn march_clouds(ray: CloudRay) -> CloudsSeen {
    var seen = CloudsSeen(vec3f(0.0), 1.0);
    var t = 0.0;
    // Each band is crossed twice at most, each sheet too.
    for (var k = 0u; k < 32u && seen.left > OPAQUE; k++) {
        let next = next_after(ray, t);
        if next.index == NOTHING {
            break;
        }
        var part: BandSeen;
        if next.index < FIRST_SHEET {
            part = march_band(next.index, ray, next.start_m, next.stop_m, seen.left);
        } else {
            part = sheet_seen(next.index - FIRST_SHEET, ray, next.start_m, seen.left);
        }
        let away = faded(part.distance_m);
        part.left = mix(part.left, 1.0, away);
        part.light *= 1.0 - away;
        if !NODES {
            let before = air_before(ray, part.distance_m);
            seen.light += seen.left * (before.left * part.light + (1.0 - part.left) * (before.single + before.multiple));
        }
        seen.left *= part.left;
        t = next.start_m + 0.5;
    }
    if !NODES {
        seen.light -= unlit_air(ray);
    }
    return seen;
}

// Under the clouds the air gets what they let through, on average: this is the light of clear air less that.
fn unlit_air(ray: CloudRay) -> vec3f {
    if view.altitude_m >= shade.base_m {
        return vec3f(0.0);
    }
    let up_m = distance_to_top(clouds.radius_m, shade.base_m, view.altitude_m, ray.mu);
    let under = air_before(ray, min(up_m, ray.end_m));
    return (1.0 - shade.direct_left) * under.single + (1.0 - shade.diffuse_left) * under.multiple;
}

// The control takes far clouds out of sight as S2 does, by a share that grows with the way.
fn faded(distance_m: f32) -> f32 {
    return clouds.haze * (1.0 - exp(-distance_m / HAZE_M));
}
