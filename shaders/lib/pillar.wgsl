// Light that plates of ice mirror from a lamp to the observer, single scattering in closed form but for one angle.
//
// With S the lamp as seen from the observer, w = S - V, d = |w|, a view ray v, β the angle between them and b = d sin β,
// every plate on the ray lies in the plane of both. A plate at P is told by ψ = (γ-β)/2, where γ is the angle at the lamp
// from the observer to P: its axis is e1 sin ψ + e2 cos ψ, so that
//     L = (N A / 2b) ∫ D(δ) R(ε) I(ω) T(S,P) T(P,V) dψ
//     cos δ = cos δmin |cos(ψ-ψ0)|, sin δmin = |q_z|, cos ε = sin(β+ψ), |SP| = b/sin(β+γ), |VP| = d sin γ/sin(β+γ).
// 1/r² and the Jacobians are inside; nothing is divided by a component of a vector. Zenith is +z here, the layers are flat.
import package::lib::geometry::PI;

const MOST_LAYERS = 4u;

struct Crystals {
    // Heights over the observer.
    base_m: f32,
    top_m: f32,
    // N A: what of a square metre the faces in a metre of air cover, 1/m.
    face_per_m: f32,
    extinction_per_m: f32,
    // 0: gaussian; 1: uniform; 2: slopes.
    law: u32,
    // Of the tilt, radians; as slopes, its tangent.
    sigma: f32,
    // Of the density of axes, 1/sr.
    peak_per_sr: f32,
    cos_max: f32,
    sin_max: f32,
    // 1 for an outer face alone.
    outer: u32,
    // Share of the density that varies, clumps per metre, and the clumps' stream.
    uneven: f32,
    clumps_per_m: f32,
    // Where the wind has moved them, seen from the observer.
    moved_m: vec3f,
    stream: u32,
}

// Where a lamp sends its light.
const ISOTROPIC = 0u;
const COSINE_UP = 1u;

struct Lamp {
    // From the observer.
    place_m: vec3f,
    radius_m: f32,
    // Where it sends the most, W/sr.
    intensity: vec3f,
    emission: u32,
}

// The plane through lamp, observer and a view ray.
struct Fan {
    d: f32,
    beta: f32,
    sin_beta: f32,
    cos_beta: f32,
    // The perpendicular from the lamp to the ray, no shorter than the lamp is wide.
    b: f32,
    e1: vec3f,
    e2: vec3f,
    psi0: f32,
    // Of the least tilt that mirrors the lamp.
    sin_least: f32,
}

// `blur_m` is the spread of the lamp's disc to each side: half its radius, and what a pixel blurs.
fn fan_of(w: vec3f, v: vec3f, blur_m: f32) -> Fan {
    var fan: Fan;
    fan.d = length(w);
    fan.e1 = w / fan.d;
    let across = cross(w, v);
    let b = length(across);
    // Right at the lamp no plane is better than another: the upright one.
    let q = select(normalize(vec3f(fan.e1.y, -fan.e1.x, 1e-12)), across / b, b > 1e-9 * fan.d);
    fan.beta = atan2(b, dot(w, v));
    fan.b = max(b, blur_m);
    fan.sin_beta = b / fan.d;
    fan.cos_beta = dot(w, v) / fan.d;
    fan.e2 = cross(q, fan.e1);
    fan.psi0 = atan2(fan.e1.z, fan.e2.z);
    fan.sin_least = abs(q.z);
    return fan;
}

// ψ at a way t along the view ray.
fn psi_at(fan: Fan, t: f32) -> f32 {
    return 0.5 * (atan2(t * fan.sin_beta, fan.d - t * fan.cos_beta) - fan.beta);
}

// What an ice plate mirrors of light that meets its axis at an angle ε, unpolarised.
fn plate_reflectance(cos_e: f32, outer: u32) -> f32 {
    const ICE = 1.31;
    let c = clamp(cos_e, 0.0, 1.0);
    let t = sqrt(ICE * ICE - 1.0 + c * c);
    let s = (c - t) / (c + t);
    let p = (ICE * ICE * c - t) / (ICE * ICE * c + t);
    let r = vec2f(s * s, p * p);
    // Both faces: R + (1-R)²R/(1-R²) = 2R/(1+R), and the mean of two polarisations.
    return select(r.x / (1.0 + r.x) + r.y / (1.0 + r.y), 0.5 * (r.x + r.y), outer == 1u);
}

// Density of the plates' axes, 1/sr, at a tilt of which the sine's square is given.
fn tilted_per_sr(layer: Crystals, s2: f32) -> f32 {
    if s2 > layer.sin_max * layer.sin_max * 1.00001 {
        return 0.0;
    }
    if layer.law == 1u {
        return layer.peak_per_sr;
    }
    let c2 = max(1.0 - s2, 1e-12);
    if layer.law == 2u {
        return layer.peak_per_sr * exp(-0.5 * s2 / (c2 * layer.sigma * layer.sigma)) / (c2 * sqrt(c2));
    }
    let tilt = atan2(sqrt(s2), sqrt(c2));
    return layer.peak_per_sr * exp(-0.5 * tilt * tilt / (layer.sigma * layer.sigma));
}

// The same where the tilt's cosine is that of the least times |cos x|; sines carried along, since tilts are small.
fn axes_per_sr(layer: Crystals, sin_least: f32, x: f32) -> f32 {
    let least2 = sin_least * sin_least;
    return tilted_per_sr(layer, least2 + (1.0 - least2) * sin(x) * sin(x));
}

// e^{x²/2} ∫ e^{-u²/2} du from x to infinity, by Press et al.'s rational Chebyshev fit of erfc ("Numerical Recipes", 1.2e-7).
fn mills(x: f32) -> f32 {
    let z = max(x, 0.0) * 0.70710678;
    let t = 1.0 / (1.0 + 0.5 * z);
    let fit = -1.26551223 + t * (1.00002368 + t * (0.37409196 + t * (0.09678418 + t * (-0.18628806
        + t * (0.27886807 + t * (-1.13520398 + t * (1.48851587 + t * (-0.82215223 + t * 0.17087277))))))));
    return 1.25331414 * t * exp(fit);
}

// Places x = ψ - ψ0 and weights by which an integrand that holds the plates' density is summed from `x.x` to `x.y`.
struct Nodes {
    x: vec3f,
    weight: vec3f,
}

// Two nodes at the mean ± the spread of the normal distribution cut off at both ends, each weighed by what the density is
// there; three of Gauss and Legendre where the density hardly changes.
fn nodes_of(layer: Crystals, ends: vec2f) -> Nodes {
    let sigma = layer.sigma;
    let width = (ends.y - ends.x) / sigma;
    if layer.law == 1u || width < 0.7 {
        let middle = 0.5 * (ends.x + ends.y);
        let half = 0.5 * (ends.y - ends.x);
        return Nodes(middle + half * vec3f(-0.77459667, 0.0, 0.77459667), half * vec3f(5.0, 8.0, 5.0) / 9.0);
    }
    // Mirrored, so that the end nearer to the peak comes first.
    let side = select(1.0, -1.0, ends.x + ends.y < 0.0);
    let a = min(side * ends.x, side * ends.y) / sigma;
    let b = max(side * ends.x, side * ends.y) / sigma;
    // All relative to e^{-a²/2} where the peak is left out, so that tails keep their digits.
    let shift = select(0.0, 0.5 * a * a, a > 0.0);
    let at_a = exp(shift - 0.5 * a * a);
    let at_b = exp(shift - 0.5 * b * b);
    let beyond = at_b * mills(b);
    let mass = select(2.50662827 - at_a * mills(-a) - beyond, mills(a) - beyond, a > 0.0);
    let mean = (at_a - at_b) / mass;
    let spread = sqrt(max(1.0 + (a * at_a - b * at_b) / mass - mean * mean, 0.0));
    let u = vec2f(mean - spread, mean + spread);
    let weight = 0.5 * sigma * mass * exp(0.5 * u * u - shift);
    return Nodes(side * sigma * vec3f(u, 0.0), vec3f(weight, 0.0));
}

// Share of a lamp's greatest intensity that it sends where `up` is the cosine from the zenith.
fn emitted(emission: u32, up: f32) -> f32 {
    if emission == ISOTROPIC {
        return 1.0;
    }
    return select(clamp(-up / 0.17364818, 0.0, 1.0), max(up, 0.0), emission == COSINE_UP);
}

// Length in a layer of a straight way between two heights.
fn length_in(layer: Crystals, from_m: f32, to_m: f32, length_m: f32) -> f32 {
    let rise = abs(to_m - from_m);
    let low = max(min(from_m, to_m), layer.base_m);
    let high = min(max(from_m, to_m), layer.top_m);
    let inside = from_m >= layer.base_m && from_m <= layer.top_m;
    return length_m * select(max(high - low, 0.0) / max(rise, 1e-6), select(0.0, 1.0, inside), rise < 1e-3);
}

// The stretch of a view ray in a layer, up to `end_m`; empty where x ≥ y.
fn stretch_in(layer: Crystals, up: f32, end_m: f32) -> vec2f {
    if abs(up) < 1e-7 {
        let inside = layer.base_m <= 0.0 && layer.top_m >= 0.0;
        return vec2f(0.0, select(-1.0, end_m, inside));
    }
    let ways = vec2f(layer.base_m, layer.top_m) / up;
    return vec2f(max(min(ways.x, ways.y), 0.0), min(max(ways.x, ways.y), end_m));
}
