// Light along a ray through the clouds. Whoever imports from here binds what `lib/cloud.wgsl` names, and then this.
import package::lib::aerial::aerial_to;
import package::lib::air::Air;
import package::lib::cloud::{CloudBand, band_extinction, clouds, sheet_optical_depth};
import package::lib::cloud_light::{ambient_source, cloud_phase, lit_source};
import package::lib::cloud_shade::{CloudShade, shade_depth};
import package::lib::geometry::{PI, altitude_after, cosine_after, distance_to_sphere, distance_to_top, shell_stretch};
import package::lib::light::{View, scattered_radiance};
import package::lib::scattering::Scattered;
import package::lib::tables::{SkyViewRay, light_from_table, sun_cosine_unit, unit_to_coordinate};
import package::lib::transmittance::transmittance_to_space;

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
    // Angle of a pixel.
    pixel_angle: f32,
}

// Nothing is seen through what lets less through.
const OPAQUE = 0.002;
// Of one band, at the usual fineness.
const MOST_STEPS = 1400u;
// After this many empty steps they grow by that factor.
const EMPTY = 4u;
const WIDE = 3.0;
// Within a cloud's bulk, where the detail noise has its edges, they are closer.
const CLOSER = 2.5;
// Optical depth after which the light is found anew.
const AGAIN = 0.15;
// And after so many steps, however thin.
const MOST_CELLS = 8.0;
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

// Optical depth of a band from a place on towards a direction and no farther than its edge; steps grow with the square.
fn depth_within(band: CloudBand, p: vec3f, altitude_m: f32, towards: vec3f, mu: f32, steps: u32, most_m: f32) -> f32 {
    var way_m = most_m;
    if mu > 0.0 {
        way_m = min(way_m, distance_to_top(clouds.radius_m, band.top_m, altitude_m, mu));
    } else {
        let down = distance_to_sphere(clouds.radius_m + band.base_m, altitude_m - band.base_m, mu);
        way_m = min(way_m, select(most_m, down, down >= 0.0));
    }
    var sum = 0.0;
    for (var k = 0u; k < steps; k++) {
        let near = f32(k) / f32(steps);
        let far = f32(k + 1u) / f32(steps);
        let t = way_m * 0.5 * (near * near + far * far);
        let h = altitude_after(clouds.radius_m, altitude_m, mu, t);
        sum += band_extinction(band, p + t * towards, h, false, 0.0).value * way_m * (far * far - near * near);
    }
    return sum;
}

// Light of the whole sky on a level place, over the air below it; and of the ground and the air beneath.
struct Surroundings {
    above: vec3f,
    below: vec3f,
}

const AIR_SCALE_M = 8500.0;

fn surroundings(altitude_m: f32, mu_s: f32) -> Surroundings {
    let x = unit_to_coordinate(sun_cosine_unit(mu_s), textureDimensions(irradiance_table).x);
    let sky = light_from_table(textureSampleLevel(irradiance_table, linear_clamp, vec2f(x, 0.5), 0.0).rgb);
    let sun = max(mu_s, 0.0) * transmittance_to_space(air, transmittance_table, linear_clamp, 0.0, mu_s);
    let above = exp(-altitude_m / AIR_SCALE_M);
    let ground = air.ground_albedo * (shade.diffuse_left * (sun + sky));
    return Surroundings(view.sun_irradiance * sky * above, view.sun_irradiance * (ground + sky * (1.0 - above)));
}

// Source function of a place in a band, W/m²/sr.
fn source_at(band: CloudBand, p: vec3f, altitude_m: f32, extinction_per_m: f32, nu: f32) -> vec3f {
    let mu_s = dot(normalize(p + vec3f(0.0, 0.0, clouds.radius_m)), view.sun);
    let thickness = band.top_m - band.base_m;
    let reach_m = min(thickness / max(abs(mu_s), 0.05), 12.0 * thickness);
    let before = depth_within(band, p, altitude_m, view.sun, mu_s, clouds.light_steps, reach_m);
    let behind = depth_within(band, p, altitude_m, -view.sun, -mu_s, max(clouds.light_steps / 2u, 2u), reach_m);
    let over = shade_depth(shade, shade_maps, linear_clamp, clouds.radius_m, p, max(altitude_m, band.top_m), view.sun, mu_s);
    let sun = view.sun_irradiance * transmittance_to_space(air, transmittance_table, linear_clamp, altitude_m, mu_s);
    let h = clamp((altitude_m - band.base_m) / thickness, 0.0, 1.0);
    // Even light comes by the shortest way out, not straight up: a share of the thickness on either side.
    let up = 0.5 * extinction_per_m * (1.0 - h) * thickness;
    let down = 0.5 * extinction_per_m * h * thickness;
    let around = surroundings(altitude_m, mu_s);
    let direct = clouds.sun_factor * clouds.sun_colour * sun * exp(-over) * lit_source(nu, before, behind);
    let even = clouds.ambient_factor * (around.above * ambient_source(up, down) + around.below * ambient_source(down, up));
    return clouds.albedo * (direct + even);
}

struct BandSeen {
    light: vec3f,
    left: f32,
    // Where what is seen stands, by how much of it is seen.
    distance_m: f32,
}

fn march_band(band: CloudBand, ray: CloudRay, start_m: f32, stop_m: f32, left_before: f32) -> BandSeen {
    var seen = BandSeen(vec3f(0.0), 1.0, 0.0);
    var weight = 0.0;
    let least_m = band.thickness_m / (128.0 * clouds.fineness);
    let growth = 0.5 * 0.0125 / clouds.fineness;
    // Each step is a cell, looked at somewhere in it; the last one ends where the band does.
    var t = start_m;
    var empty = 0u;
    var within = false;
    var until_m = 0.0;
    var source = vec3f(0.0);
    // Of what is seen, the share since the light was found last.
    var pending = 0.0;
    let again = AGAIN / clouds.fineness;
    var since = again;
    let most = u32(f32(MOST_STEPS) * max(clouds.fineness, 0.25));
    for (var k = 0u; k < most && t < stop_m && seen.left * left_before > OPAQUE; k++) {
        let usual_m = max(least_m, growth * t);
        let narrow_m = min(select(usual_m, usual_m / CLOSER, within), stop_m - t);
        // Not quite at a cell's end: an edge that begins with the cell belongs to it.
        let at = t + mix(0.05, 0.95, ray.jitter) * narrow_m;
        let h = altitude_after(clouds.radius_m, view.altitude_m, ray.mu, at);
        let p = place_at(at, ray.direction);
        let density = band_extinction(band, p, h, true, narrow_m);
        // The way walked back is gone in close steps, whatever is there.
        if density.bulk <= 0.0 && t >= until_m {
            within = false;
            seen.light += pending * source;
            pending = 0.0;
            since = again;
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
        let depth = density.value * narrow_m;
        let passed = exp(-depth);
        let share = seen.left * (1.0 - passed);
        // Light changes over a mean free path: between two places where it is found it counts by their mean.
        for (var anew = share > 0.0 && since >= again; anew; anew = false) {
            let found = source_at(band, p, h, density.value, ray.nu);
            seen.light += pending * 0.5 * (source + found);
            source = found;
            pending = 0.0;
            since = 0.0;
        }
        since += max(depth, again / MOST_CELLS);
        pending += share;
        seen.distance_m += share * at;
        weight += share;
        seen.left *= passed;
        t += narrow_m;
    }
    seen.light += pending * source;
    seen.distance_m = select(start_m, seen.distance_m / max(weight, 1e-6), weight > 0.0);
    // What is left of an opaque cloud is nothing.
    if seen.left * left_before <= OPAQUE {
        seen.left = 0.0;
    }
    return seen;
}

// A thin layer: its light scattered once with the phase function, and the rest as a slab's.
fn sheet_seen(index: u32, ray: CloudRay, t: f32) -> BandSeen {
    let sheet = clouds.sheets[index];
    let p = place_at(t, ray.direction);
    let up = normalize(p + vec3f(0.0, 0.0, clouds.radius_m));
    let mu = max(abs(dot(up, ray.direction)), 0.02);
    let mu_s = dot(up, view.sun);
    let depth = sheet_optical_depth(sheet, p, sheet.height_m);
    let sun = view.sun_irradiance * transmittance_to_space(air, transmittance_table, linear_clamp, sheet.height_m, mu_s);
    let slant = max(abs(mu_s), 0.05);
    let lit_from_above = mu_s > 0.0;
    let seen_from_below = dot(up, ray.direction) > 0.0;
    // Half the way in, towards the light.
    let before = 0.5 * depth / slant;
    let around = surroundings(sheet.height_m, mu_s);
    let over = shade_depth(shade, shade_maps, linear_clamp, clouds.radius_m, p, sheet.height_m + 1.0, view.sun, mu_s);
    let direct = clouds.sun_factor * clouds.sun_colour * sun * exp(-over) * lit_source(ray.nu, before, before);
    let even = clouds.ambient_factor * (around.above + around.below) * ambient_source(0.5 * depth, 0.5 * depth);
    let left = exp(-depth / mu);
    return BandSeen((1.0 - left) * clouds.albedo * (direct + even), left, t);
}

// The next thing along the ray, of those that begin at `t` or later: bands, then sheets.
struct Next {
    index: u32,
    start_m: f32,
    stop_m: f32,
}

const NOTHING = 1000u;

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
                best = nearer(best, 8u + i, inside.x, inside.x + 1.0, t);
            }
            if inside.y < ray.end_m {
                best = nearer(best, 8u + i, inside.y, inside.y + 1.0, t);
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
        if next.index < 8u {
            part = march_band(clouds.bands[next.index], ray, next.start_m, next.stop_m, seen.left);
        } else {
            part = sheet_seen(next.index - 8u, ray, next.start_m);
        }
        let before = air_before(ray, part.distance_m);
        // The control takes far clouds out of sight as S2 does, by a share that grows with the way.
        let faded = clouds.haze * (1.0 - exp(-part.distance_m / HAZE_M));
        part.left = mix(part.left, 1.0, faded);
        part.light *= 1.0 - faded;
        seen.light += seen.left * (before.left * part.light + (1.0 - part.left) * (before.single + before.multiple));
        seen.left *= part.left;
        t = next.start_m + 0.5;
    }
    // Under the clouds the air gets what they let through, on average: the light of clear air less the rest.
    if view.altitude_m < shade.base_m {
        let up_m = distance_to_top(clouds.radius_m, shade.base_m, view.altitude_m, ray.mu);
        let under = air_before(ray, min(up_m, ray.end_m));
        seen.light -= (1.0 - shade.direct_left) * under.single + (1.0 - shade.diffuse_left) * under.multiple;
    }
    return seen;
}
