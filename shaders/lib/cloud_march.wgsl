// Which clouds a ray sees. Whoever imports from here binds what `lib/cloud_ray.wgsl` names.
import package::lib::cloud::{CloudSheet, Look, band_at, band_extinction, clouds, one_or, sheet_optical_depth};
import package::lib::cloud_nodes::{NODES, NODE_SHARE, Nodes, with_node};
import package::lib::cloud_ray::{COARSEST_PIXEL, CloudRay, place_at, view};
import package::lib::geometry::{altitude_after, shell_stretch};

// Nothing is seen through what lets less through.
const OPAQUE = 0.002;
// Of one band, at the usual fineness.
const MOST_STEPS = 2000u;
// After this many empty steps they grow by that factor.
const EMPTY = 4u;
const WIDE = 3.0;
// Within a cloud's bulk, where the detail noise has its edges, they are closer by the first factor while all that lies there is
// seen, and by the second where nothing is: an error counts by as much as is seen of it.
const CLOSER = 3.0;
const CLOSER_UNSEEN = 0.5;
// The detail noise is blurred over this part of a step.
const BLUR = 0.5;
// A cloud that stands apart, or is longer than this part of its distance, counts by itself if it is more than this: between
// two of them there may be sun.
const LEAST_APART = 0.01;
const SPREAD = 0.05;
// Nor longer than this part of what the ray crosses of a band.
const SPREAD_LONGEST = 0.33;
// Nor less than this part of what each place that is left would have if all had as much, when some are kept for rims: else a
// near fringe would take them all, and one would stand for the sky behind it.
const FAIR_SHARE = 0.7;
const FOR_RIMS = 2.0;
// A rim, which has a gap behind it or is so many times as far behind as a cloud may be long, counts by itself if it has this
// part: one in the sun before a dark cloud is seen however thin it is.
const FAIR_SHARE_BEHIND = 0.1;
const LEFT_BEHIND = 1.5;
// A band is crossed in no fewer steps, at the usual fineness.
const CROSSING = 24.0;
// Over which way clouds fade, where they are asked to.
const HAZE_M = 3e4;
// A ray through more air than this sees none of the clouds beyond.
const FARTHEST_M = 6e5;

var<private> noted: Nodes;
var<private> noted_count: u32;
// What comes through all that is noted.
var<private> left: f32;
// How many places are kept for what lies beyond the band that is crossed.
var<private> kept: u32;

// `share` is of what comes through to it.
fn note(share: f32, distance_m: f32, index: u32, extinction_per_m: f32) {
    let seen = left * share;
    noted = with_node(noted, noted_count, distance_m, (1.0 - faded(distance_m)) * seen, index, extinction_per_m);
    noted_count += 1u;
    left -= seen;
}

// Without the places that are kept.
fn places_left() -> u32 {
    return NODES - min(noted_count + kept, NODES);
}

// Of what is seen, what a place takes at least; less if the ray has left it behind.
fn least_share(behind: bool) -> f32 {
    let places = f32(places_left());
    let fair = select(FAIR_SHARE / max(places - FOR_RIMS, 0.5), FAIR_SHARE_BEHIND / max(places, 1.0), behind);
    return max(LEAST_APART, fair * left);
}

fn march_band(index: u32, ray: CloudRay, start_m: f32, stop_m: f32) {
    let band = band_at(index);
    let least_m = band.thickness_m / (128.0 * clouds.fineness);
    let growth = 0.5 * 0.0125 / clouds.fineness;
    // Far away, from an orbit, what a ray crosses is short for its distance.
    let longest_m = max(least_m, (stop_m - start_m) / (CROSSING * clouds.fineness));
    // Each step is a cell, looked at somewhere in it; the last one ends where the band does.
    var t = start_m;
    var empty = 0u;
    var within = false;
    var until_m = 0.0;
    // Of what is seen, what no node stands for yet: the share, where it is and its extinction by that share.
    var pending = vec3f(0.0);
    var begun_m = 0.0;
    // Of that, what lies before the last gap.
    var before_gap = vec3f(0.0);
    let most = u32(f32(MOST_STEPS) * max(clouds.fineness, 0.25));
    for (var k = 0u; k < most; k++) {
        let through = left * (1.0 - pending.x);
        let ends = t >= stop_m || through <= OPAQUE || k + 1u == most;
        let share_seen = left * pending.x;
        let spread_m = clamp(SPREAD * t, 0.06 * band.thickness_m, SPREAD_LONGEST * (stop_m - start_m));
        let behind = !within || pending.x * t - pending.y > LEFT_BEHIND * spread_m * pending.x;
        let enough = share_seen >= NODE_SHARE || (share_seen > least_share(behind) && (behind || t - begun_m > spread_m));
        // What is left of the band has the last place.
        let apart = enough && places_left() > 1u;
        if pending.x > 0.0 && (ends || apart) {
            // Between two clouds there is none to be lit: both stand where the larger share is.
            let after_gap = pending - before_gap;
            let larger = select(before_gap, after_gap, after_gap.x >= before_gap.x);
            note(pending.x, larger.y / larger.x, index, larger.z / larger.x);
            pending = vec3f(0.0);
            before_gap = vec3f(0.0);
        }
        if ends {
            break;
        }
        let usual_m = min(max(least_m, growth * t), longest_m);
        let narrow_m = min(select(usual_m, usual_m / mix(CLOSER_UNSEEN, CLOSER, through), within), stop_m - t);
        // Not quite at a cell's end: an edge that begins with the cell belongs to it.
        let at = t + mix(0.05, 0.95, ray.jitter) * narrow_m;
        let h = altitude_after(clouds.radius_m, view.altitude_m, ray.mu, at);
        let density = band_extinction(band, place_at(at, ray.direction), h, Look(true, BLUR * narrow_m, min(ray.spread, COARSEST_PIXEL) * at));
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
            if pending.x - before_gap.x > before_gap.x {
                before_gap = pending;
            }
            continue;
        }
        let share = (1.0 - pending.x) * (1.0 - exp(-density.value * narrow_m));
        begun_m = select(begun_m, t, pending.x == 0.0);
        pending += share * vec3f(1.0, at, density.value);
        t += narrow_m;
    }
}

// Places along each side of what a ray stands for, at which a sheet is looked at.
const SHEET_PLACES = 3;
// What spans less of the sheet's pattern is even.
const EVEN_SHARE = 0.004;

fn sheet_passed(sheet: CloudSheet, p: vec3f, up: vec3f, ray: CloudRay, t: f32) -> f32 {
    let mu = max(abs(dot(up, ray.direction)), 0.02);
    if t * ray.spread / mu * length(sheet.turn) < EVEN_SHARE {
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

fn note_sheet(index: u32, ray: CloudRay, t: f32) {
    let sheet = clouds.sheets[index];
    let p = place_at(t, ray.direction);
    let up = normalize(p + vec3f(0.0, 0.0, clouds.radius_m));
    let passed = sheet_passed(sheet, p, up, ray, t);
    if passed < 1.0 {
        note(1.0 - passed, t, FIRST_SHEET + index, 0.0);
    }
}

// The next thing along the ray, of those that begin at `t` or later: bands, then sheets.
struct Next {
    index: u32,
    start_m: f32,
    stop_m: f32,
}

const NOTHING = 1000u;
const KEPT_EACH = 2u;
const MOST_KEPT = 4u;
// Sheets are numbered after the bands.
const FIRST_SHEET = 8u;

fn nearer(best: Next, index: u32, start_m: f32, stop_m: f32, t: f32) -> Next {
    if start_m < stop_m && start_m >= t && start_m < best.start_m {
        return Next(index, start_m, stop_m);
    }
    return best;
}

fn next_after(ray: CloudRay, t: f32) -> Next {
    var best = Next(NOTHING, FARTHEST_M + ray.air_from_m, 0.0);
    let h = view.altitude_m;
    for (var i = 0u; i < one_or(clouds.band_count); i++) {
        let band = band_at(i);
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

fn march_clouds(ray: CloudRay) -> Nodes {
    left = 1.0;
    var t = 0.0;
    // Each band is crossed twice at most, each sheet too.
    for (var k = 0u; k < 32u && left > OPAQUE; k++) {
        let next = next_after(ray, t);
        if next.index == NOTHING {
            break;
        }
        kept = min(KEPT_EACH * (max(clouds.band_count + clouds.sheet_count, k + 1u) - k - 1u), MOST_KEPT);
        if next.index < FIRST_SHEET {
            march_band(next.index, ray, next.start_m, next.stop_m);
        } else {
            note_sheet(next.index - FIRST_SHEET, ray, next.start_m);
        }
        t = next.start_m + 0.5;
    }
    return noted;
}

// The control takes far clouds out of sight as S2 does, by a share that grows with the way.
fn faded(distance_m: f32) -> f32 {
    return clouds.haze * (1.0 - exp(-distance_m / HAZE_M));
}
