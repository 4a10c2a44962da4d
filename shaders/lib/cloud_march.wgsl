// Light along a ray through the clouds. Whoever imports from here binds what `lib/cloud_source.wgsl` names.
import package::lib::cloud::{CloudSheet, band_extinction, clouds, sheet_optical_depth};
import package::lib::cloud_nodes::{NODE_SHARE, Nodes, with_node};
import package::lib::cloud_source::{
    CloudRay, Surroundings, air_before, mixed, place_at, sheet_source, source_at, surroundings, unlit_air, view,
};
import package::lib::geometry::{altitude_after, shell_stretch};

// True to note the places that are seen instead of their light.
override NODES: bool = false;

// What clouds do to a ray: the radiance behind them comes through by `left`, and `light` is added.
struct CloudsSeen {
    light: vec3f,
    left: f32,
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
        let outer = shell_stretch(clouds.radius_m + band.top_m, h - band.top_m, ray.mu, ray.stop_m);
        let inner = shell_stretch(clouds.radius_m + band.base_m, h - band.base_m, ray.mu, ray.stop_m);
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
            if inside.x > 0.0 && inside.x < ray.stop_m {
                best = nearer(best, FIRST_SHEET + i, inside.x, inside.x + 1.0, t);
            }
            if inside.y < ray.stop_m {
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

// The control takes far clouds out of sight as S2 does, by a share that grows with the way.
fn faded(distance_m: f32) -> f32 {
    return clouds.haze * (1.0 - exp(-distance_m / HAZE_M));
}
