// A lamp's pillar along a view ray, with the air and the plates between, and shadows.
import package::lib::air::Air;
import package::lib::geometry::PI;
import package::lib::noise::perlin3;
import package::lib::pillar::{Crystals, Fan, Lamp, MOST_LAYERS, Nodes, axes_per_sr, emitted, fan_of, length_in, nodes_of, plate_reflectance, psi_at, stretch_in};

struct Ice {
    count: u32,
    // The observer over the sphere, metres, for the air's density.
    altitude_m: f32,
    // Always 3 and 2. Bounds that a compiler knows make it write loops out, here twentyfold, and take many seconds over it.
    three: u32,
    two: u32,
    layers: array<Crystals, MOST_LAYERS>,
}

@group(0) @binding(1) var<uniform> ice: Ice;

// Cells to a side of the clumps' noise before it repeats.
const CLUMPS = 64u;

// Optical depth of the air along a straight way between two heights over the observer: exponentials have a mean in closed
// form, (e^{-a} - e^{-b})/(b-a), and the haze is even up to its top.
fn air_depth(air: Air, altitude_m: f32, from_m: f32, to_m: f32, length_m: f32) -> vec3f {
    let low = max(altitude_m + min(from_m, to_m), 0.0);
    let rise = abs(to_m - from_m);
    let in_haze = select(
        clamp((air.haze_top_m - low) / max(rise, 1e-3), 0.0, 1.0),
        select(0.0, 1.0, low < air.haze_top_m),
        rise < 1e-3,
    );
    return length_m * (mean_density(low, rise, air.rayleigh_inverse_height_per_m) * air.rayleigh_extinction_per_m
        + mean_density(low, rise, air.mie_inverse_height_per_m) * air.mie_extinction_per_m
        + in_haze * air.haze_extinction_per_m);
}

fn mean_density(low_m: f32, rise_m: f32, inverse_height_per_m: f32) -> f32 {
    let x = rise_m * inverse_height_per_m;
    // The quotient cancels for short rises, where two terms of its series do.
    let share = select((1.0 - exp(-x)) / max(x, 1e-6), 1.0 - 0.5 * x + x * x / 6.0, x < 0.02);
    return share * exp(-low_m * inverse_height_per_m);
}

// Optical depth of plates and air between two heights over the observer.
fn depth_of(air: Air, from_m: f32, to_m: f32, length_m: f32) -> vec3f {
    var depth = air_depth(air, ice.altitude_m, from_m, to_m, length_m);
    for (var i = 0u; i < ice.count; i++) {
        depth += ice.layers[i].extinction_per_m * length_in(ice.layers[i], from_m, to_m, length_m);
    }
    return depth;
}

fn clumped(layer: Crystals, p: vec3f) -> f32 {
    if layer.uneven == 0.0 {
        return 1.0;
    }
    let place = (p - layer.moved_m) * (layer.clumps_per_m / f32(CLUMPS));
    return max(1.0 + layer.uneven * 1.6 * perlin3(place - floor(place), CLUMPS, layer.stream), 0.0);
}

// A place on the ray where it mirrors the lamp at an angle ψ.
struct Mirror {
    // From the lamp, and from the observer.
    r: f32,
    t: f32,
}

fn mirror_at(fan: Fan, psi: f32) -> Mirror {
    let gamma = fan.beta + 2.0 * psi;
    let across = max(sin(fan.beta + gamma), 1e-7);
    return Mirror(max(fan.d * fan.sin_beta, 1e-6) / across, fan.d * sin(gamma) / across);
}

// The sum over the stretch of ψ between two ends, N A / 2b left out. What is let through hardly depends on ψ, as the way
// by the plate is about as long as the straight one: it is found once, in the middle.
fn mirrored(air: Air, layer: Crystals, lamp: Lamp, fan: Fan, v: vec3f, sin_least: f32, psi0: f32, ends: vec2f) -> vec3f {
    let nodes = nodes_of(layer, ends - psi0);
    var sum = 0.0;
    for (var k = 0u; k < ice.three; k++) {
        let weight = nodes.weight[k];
        if weight <= 0.0 {
            break;
        }
        let psi = clamp(psi0 + nodes.x[k], ends.x, ends.y);
        let at = mirror_at(fan, psi);
        let p = at.t * v;
        sum += weight * axes_per_sr(layer, sin_least, psi - psi0) * plate_reflectance(sin(fan.beta + psi), layer.outer)
            * emitted(lamp.emission, (p.z - lamp.place_m.z) / at.r) * clumped(layer, p);
    }
    let middle = select(nodes.x.y, 0.5 * (nodes.x.x + nodes.x.y), nodes.weight.z == 0.0);
    let at = mirror_at(fan, clamp(psi0 + middle, ends.x, ends.y));
    let height_m = at.t * v.z;
    return sum * exp(-depth_of(air, lamp.place_m.z, height_m, at.r) - depth_of(air, height_m, 0.0, at.t));
}

// Stretches of ψ in which one layer mirrors the lamp: about ψ0 - π, ψ0 and ψ0 + π.
struct Support {
    // The least tilt's sine, narrowed by as much as the disc blurs, and the factor that goes with it.
    sin_least: f32,
    factor: f32,
    reach: f32,
    // What the ray leaves of them.
    ends: vec2f,
}

// A disc as wide as `blur_m` to each side widens the pillar to σχ² = σ² + (cos(elevation) blur/b)². The gaussian of δmin
// that this makes is the point's at δmin σ/σχ, times σ/σχ.
fn support_of(layer: Crystals, fan: Fan, up: f32, blur_m: f32, end_m: f32) -> Support {
    let spread = select(layer.sigma, 0.5 * layer.sin_max, layer.law == 1u);
    let blur = sqrt(max(1.0 - up * up, 0.0)) * blur_m / fan.b;
    let narrowed = inverseSqrt(1.0 + blur * blur / (spread * spread));
    let sin_least = narrowed * fan.sin_least;
    let t = stretch_in(layer, up, end_m);
    if sin_least >= layer.sin_max || t.x >= t.y {
        return Support(sin_least, 0.0, 0.0, vec2f(0.0));
    }
    let reach = atan2(sqrt((layer.sin_max - sin_least) * (layer.sin_max + sin_least)), layer.cos_max);
    return Support(sin_least, narrowed, reach, vec2f(psi_at(fan, t.x), psi_at(fan, t.y)));
}
