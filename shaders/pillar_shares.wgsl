// What each cell sees of each pillar, by nine of its rays: `lib/pillar_share.wgsl` says how it is written down.
import package::lib::air::Air;
import package::lib::geometry::{PI, distance_to_sphere};
import package::lib::pillar::{Crystals, Fan, Lamp, fan_of, plate_reflectance};
import package::lib::pillar_lamp::{Support, depth_of, ice, mirror_at, support_of};
import package::lib::pillar_open::open_pillar;
import package::lib::pillar_polar::{SHADED_ABOVE, SHADED_BELOW};
import package::lib::pillar_shaded::{polar, polar_words, shaded_pillar};
import package::lib::pillar_share::{DARK, ROUGH, SHARE_WORDS, SMOOTH, Share, across, blur_of, polynomial};

struct Sharing {
    // Where the lists begin, and how many entries they have.
    first: u32,
    entries: u32,
    // Angle between two pixels.
    pixel_angle: f32,
    // Invocations to a row of the dispatch.
    row: u32,
}

// As in `pillars.wgsl`.
override SHADED: bool = false;

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(4) var<uniform> sharing: Sharing;
@group(0) @binding(5) var<storage, read> lamps: array<Lamp>;
@group(0) @binding(6) var<storage, read> cells: array<u32>;
// Which cell an entry belongs to.
@group(0) @binding(7) var<storage, read> owners: array<u32>;
// About what each cell sees: a direction and an angle.
@group(0) @binding(8) var<storage, read> cones: array<vec4f>;
@group(0) @binding(9) var<storage, read_write> shares: array<vec4f>;

const IN_PILLAR = 0x80000000u;
const WHICH = 0x3fffffffu;

// The rays in x and y, as parts of the cone: a star that makes the polynomial and four between that try it.
const RAYS = 9u;
const PLACES = array<vec2f, RAYS>(
    vec2f(0.0, 0.0), vec2f(1.0, 0.0), vec2f(-1.0, 0.0), vec2f(0.0, 1.0), vec2f(0.0, -1.0),
    vec2f(0.6, 0.6), vec2f(-0.6, 0.6), vec2f(0.6, -0.6), vec2f(-0.6, -0.6),
);
// Corners of a cell lie on the cone, most pixels deep in it.
const OF_CONE = 0.85;
// By how much the polynomial may be off: of what the brightest of the cell's rays would be on the axis,
// and of what the axis would be if the plates had no end and nothing stood in the light, as nobody sees errors in the dark.
const OF_BRIGHTEST = 0.002;
const OF_WHOLE = 0.0005;
// Beyond so many spreads the pillar is too dim to be looked at but where it fills the cell.
const SPREADS = 2.5;

fn rough() -> Share {
    var share: Share;
    share.kind = ROUGH;
    return share;
}

// The ways along a ray between which it mirrors the lamp.
fn lit_stretch(fan: Fan, support: Support) -> vec2f {
    var found = vec2f(1e9, 0.0);
    for (var k = 0u; k < ice.three; k++) {
        let psi0 = fan.psi0 + (f32(k) - 1.0) * PI;
        let ends = vec2f(max(psi0 - support.reach, support.ends.x), min(psi0 + support.reach, support.ends.y));
        if ends.x < ends.y {
            found = vec2f(min(found.x, mirror_at(fan, ends.x).t), max(found.y, mirror_at(fan, ends.y).t));
        }
    }
    return found;
}

// L b on the axis, of a pillar whose plates have no end.
fn whole(layer: Crystals, lamp: Lamp, fan: Fan) -> vec3f {
    let mass = select(2.50662827 * layer.sigma, 2.0 * layer.sigma, layer.law == 1u) * layer.peak_per_sr;
    let reflected = plate_reflectance(abs(sin(fan.beta + fan.psi0)), layer.outer);
    return lamp.intensity * (0.5 * layer.face_per_m * mass * reflected) * exp(-depth_of(air, lamp.place_m.z, 0.0, fan.d));
}

fn light_of(layer: Crystals, lamp: Lamp, which: u32, v: vec3f, blur_m: f32) -> vec3f {
    if SHADED {
        return shaded_pillar(air, layer, lamp, which, v, end_of(v), blur_m);
    }
    return open_pillar(air, layer, lamp, v, end_of(v), blur_m);
}

fn end_of(v: vec3f) -> f32 {
    let sphere_m = distance_to_sphere(air.radius_m, ice.altitude_m, v.z);
    return select(1e9, sphere_m, sphere_m >= 0.0);
}

fn share_of(layer: Crystals, lamp: Lamp, which: u32, cone: vec4f) -> Share {
    let d = length(lamp.place_m);
    let e1 = lamp.place_m / d;
    let normal = cross(e1, cone.xyz);
    let sin_beta = length(normal);
    let beta = atan2(sin_beta, dot(e1, cone.xyz));
    let level = sqrt(max(1.0 - e1.z * e1.z, 1e-12));
    let blur_m = blur_of(lamp, sharing.pixel_angle);
    let spread = select(layer.sigma, 0.5 * layer.sin_max, layer.law == 1u);
    let blur = blur_m / (max(d * sin_beta, blur_m) * spread);
    // As far to a side as plates mirror; a little less, as S has a root at the end.
    let most = 0.97 * layer.sin_max * sqrt(1.0 + level * level * blur * blur);
    let across_rho = sin(cone.w) / sin_beta;
    // Too near to the axis, where β and χ are no even measure, or too far to a side.
    if min(beta, PI - beta) < 1.5 * cone.w || across_rho > 0.7 || most > 0.7 * level || layer.uneven > 0.0 {
        return rough();
    }
    let aside = vec3f(-e1.y, e1.x, 0.0) / level;
    let upright = cross(e1, aside);
    let middle = normal.z / sin_beta;
    let half = level * across_rho * OF_CONE;
    let gap = 0.1 * most;
    let nearest = max(abs(middle) - half, 0.0);
    let widest = min(max(SPREADS * layer.sigma * (most / layer.sin_max), nearest + gap), most);
    let from_y = clamp(middle - half, -widest, widest - gap);
    let to_y = clamp(middle + half, gap - widest, widest);
    let side = select(-1.0, 1.0, dot(cone.xyz, upright) > 0.0);
    if SHADED && (polar_words[which * polar.words] & select(SHADED_BELOW, SHADED_ABOVE, side > 0.0)) != 0u {
        // Edges of shadows may pass between the rays.
        return rough();
    }
    let half_x = OF_CONE * cone.w;
    var lights: array<vec3f, RAYS>;
    var weights: array<f32, RAYS>;
    var most_light = vec3f(0.0);
    var sum = vec3f(0.0);
    var stretch_m = vec2f(1e9, 0.0);
    let places = PLACES;
    for (var i = 0u; i < ice.three * ice.three; i++) {
        let at = beta + half_x * places[i].x;
        let y = mix(from_y, to_y, 0.5 + 0.5 * places[i].y);
        // q = e1 × e2 has a z of sin χ cos(elevation).
        let sin_chi = y / level;
        let e2 = side * sqrt(1.0 - sin_chi * sin_chi) * upright + sin_chi * aside;
        let v = cos(at) * e1 + sin(at) * e2;
        let fan = fan_of(lamp.place_m, v, blur_m);
        let support = support_of(layer, fan, v.z, blur_m, end_of(v));
        var light = vec3f(0.0);
        if support.factor > 0.0 {
            light = light_of(layer, lamp, which, v, blur_m);
            let stretch = lit_stretch(fan, support);
            stretch_m = vec2f(min(stretch_m.x, stretch.x), max(stretch_m.y, stretch.y));
        }
        let weight = across(layer, vec4f(support.sin_least)).x;
        light *= fan.b / max(support.factor * weight, 1e-30);
        lights[i] = light;
        weights[i] = weight;
        // What S makes of it on the axis.
        most_light = max(most_light, light);
        sum += light;
    }
    var share: Share;
    let scale = max(sum.x, max(sum.y, sum.z));
    if scale <= 0.0 {
        share.kind = DARK;
        return share;
    }
    share.colour = sum / scale;
    let of_colour = share.colour / dot(share.colour, share.colour);
    var bright: array<f32, RAYS>;
    for (var i = 0u; i < ice.three * ice.three; i++) {
        bright[i] = dot(lights[i], of_colour);
    }
    share.even = bright[0];
    share.by_x = 0.5 * (bright[1] - bright[2]);
    share.by_xx = 0.5 * (bright[1] + bright[2]) - bright[0];
    share.by_y = 0.5 * (bright[3] - bright[4]);
    share.by_yy = 0.5 * (bright[3] + bright[4]) - bright[0];
    share.by_xy = (bright[5] - bright[6] - bright[7] + bright[8]) / (4.0 * 0.36);
    let allowed = OF_BRIGHTEST * most_light + OF_WHOLE * whole(layer, lamp, fan_of(lamp.place_m, cone.xyz, blur_m));
    let limit = max(allowed.x, max(allowed.y, allowed.z));
    var off = 0.0;
    for (var i = 0u; i < ice.three * ice.three; i++) {
        let miss = abs(lights[i] - polynomial(share, vec4f(places[i].x), vec4f(places[i].y)).x * share.colour);
        off = max(off, max(miss.x, max(miss.y, miss.z)) * weights[i]);
    }
    // sin(β - β0) ≈ β - β0.
    share.x_of = vec2f(cos(beta), -sin(beta)) / (half_x * d);
    share.y_of = vec2f(2.0, -(from_y + to_y)) / (to_y - from_y);
    share.stretch_m = stretch_m * vec2f(0.8, 1.25);
    share.kind = select(ROUGH, SMOOTH, off <= limit);
    return share;
}

@compute @workgroup_size(64)
fn pillar_shares(@builtin(global_invocation_id) id: vec3u) {
    let i = id.y * sharing.row + id.x;
    if id.x >= sharing.row || i >= sharing.entries {
        return;
    }
    let entry = cells[sharing.first + i];
    if (entry & IN_PILLAR) == 0u {
        return;
    }
    let which = entry & WHICH;
    let cone = cones[owners[i]];
    for (var k = 0u; k < ice.count; k++) {
        let share = share_of(ice.layers[k], lamps[which], which, cone);
        let at = (i * ice.count + k) * SHARE_WORDS;
        shares[at] = vec4f(share.even, share.by_x, share.by_y, share.by_xx);
        shares[at + 1u] = vec4f(share.by_xy, share.by_yy, share.x_of);
        shares[at + 2u] = vec4f(share.y_of, share.stretch_m);
        shares[at + 3u] = vec4f(share.colour, f32(share.kind));
    }
}
