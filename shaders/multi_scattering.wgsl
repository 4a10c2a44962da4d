// Light scattered twice and more, order by order, and the light that the sky sends to the ground.
//
// One dispatch takes the radiance L_n of one order along rays all round each point to the source function S_n of the
// next, and to the irradiance E_n of the ground, so that light goes back and forth between air and ground as it does in
// truth:
//   L_1 = single scattering + T ρ/π E_0,   L_{n+1} = ∫ T σ_s S_n dt + T ρ/π E_n,
//   S_n(v) = Σ_kind σ_kind/σ_s ∫ p_kind(ω·v) L_n(ω) dω.
// After the last order the rest is summed as a geometric series with the ratio of the last two orders.
// Hillaire 2020 §5.5 keeps the mean of the light alone, sums from the first order on, and leaves the lit ground out of
// the ratio.
//
// The aerosols' peak is narrower than the directions are apart. Its integrals are therefore taken as known integrals
// times weighted means: ∫ p(ω·v) L dω as the mean of L with the weights p, and of the light that aerosols scattered
// first, L = p(ω·s) B(ω), as (p*p)(v·s) times the mean of B with the weights p(ω·v) p(ω·s), where p*p is the phase
// function convolved with itself, from a list.
import package::lib::air::{Air, Coefficients, coefficients_at};
import package::lib::geometry::{PI, cosine_after, distance_to_sphere, distance_to_top, horizon_distance_squared};
import package::lib::phase::{rayleigh_phase, cornette_shanks_phase};
import package::lib::scattering::{AirRay, March, scatter_along};
import package::lib::source::VIEW_AZIMUTHS;
import package::lib::tables::{
    light_from_table, light_to_table, multi_scattering_point, sun_cosine_unit, unit_to_coordinate,
    view_zenith_angle,
};
import package::lib::transmittance::transmittance_to_space;

// True for the light that the sun sends. A variant of its own: neither has to pay for the other's work, as a software
// device runs both sides of every branch.
override FIRST: bool = true;
// True where there is haze.
override HAZE: bool = true;
// Directions: Gauss-Legendre nodes x on either side of the horizon, bent towards it by mu = mu_h ± Δ x², times azimuths
// on one side of the sun (the other side is its mirror image).
override POLAR: u32 = 6u;
override AZIMUTHS: u32 = 6u;

struct Order {
    // 1 where the sums shall be written rather than this order.
    last: u32,
    steps: u32,
}

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(1) var<uniform> order: Order;
@group(0) @binding(2) var transmittance_table: texture_2d<f32>;
@group(0) @binding(3) var linear_clamp: sampler;
@group(0) @binding(4) var source_before: texture_2d_array<f32>;
@group(0) @binding(5) var irradiance_before: texture_2d<f32>;
@group(0) @binding(6) var source: texture_storage_2d_array<rgba32float, write>;
@group(0) @binding(7) var irradiance: texture_storage_2d<rgba32float, write>;
// For each texel: the sums of the orders, then the last order; the source in every direction of view and the irradiance
// in each.
@group(0) @binding(8) var<storage, read_write> sums: array<vec4f>;
// x: nodes from 0 to 1, y: their weights.
@group(0) @binding(9) var<storage, read> nodes: array<vec2f>;
// The aerosols' phase function convolved with itself, at even angles from 0 to π.
@group(0) @binding(10) var<storage, read> twice_scattered: array<f32>;

const THREADS = 32u;
// Directions of view of one thread: of 96 or 144 in all.
const VIEWS = 5u;
// 2 · POLAR · AZIMUTHS of the largest variant.
const MOST_DIRECTIONS = 160u;

struct Incoming {
    // Light times solid angle; the solid angle of the direction, and of its mirror image too. Even light: molecules,
    // ground, later orders.
    light: vec3f,
    weight: f32,
    // Light that aerosols scattered first, and the solid angle, both times the aerosols' phase function towards the sun.
    mie: vec3f,
    mie_weight: f32,
    // x towards the sun's azimuth, z up.
    direction: vec3f,
}

var<workgroup> incoming: array<Incoming, 160>;

fn look(h: f32, mu_s: f32, index: u32) -> Incoming {
    let horizon = -sqrt(horizon_distance_squared(air.radius_m, h)) / (air.radius_m + h);
    let node = nodes[(index / AZIMUTHS) % POLAR];
    let reach = select(-1.0 - horizon, 1.0 - horizon, index < POLAR * AZIMUTHS);
    let mu = clamp(horizon + reach * node.x * node.x, -1.0, 1.0);
    let cos_azimuth = cos(PI * (f32(index % AZIMUTHS) + 0.5) / f32(AZIMUTHS));
    // dω = dmu dφ
    let weight = node.y * 2.0 * node.x * abs(reach) * PI / f32(AZIMUTHS);
    let sine = sqrt(1.0 - mu * mu);
    let nu = clamp(mu * mu_s + sine * sqrt(1.0 - mu_s * mu_s) * cos_azimuth, -1.0, 1.0);
    let to_ground = distance_to_sphere(air.radius_m, h, mu);
    let ground = to_ground >= 0.0;
    let length_m = select(distance_to_top(air.radius_m, air.top_m, h, mu), to_ground, ground);
    let ray = AirRay(h, mu, mu_s, nu, length_m);
    let march = March(FIRST, !FIRST, HAZE, false, order.steps, 1u, 0u);
    let scattered = scatter_along(air, ray, transmittance_table, source_before, linear_clamp, march);
    var light = scattered.multiple;
    var mie_weight = 0.0;
    if FIRST {
        light = rayleigh_phase(nu) * scattered.rayleigh;
        mie_weight = weight * cornette_shanks_phase(nu, air.mie_asymmetry);
    }
    if ground {
        let mu_s_ground = cosine_after(air.radius_m, h, 0.0, mu_s, nu, length_m);
        let x = unit_to_coordinate(sun_cosine_unit(mu_s_ground), textureDimensions(irradiance_before).x);
        var lit = light_from_table(textureSampleLevel(irradiance_before, linear_clamp, vec2f(x, 0.5), 0.0).rgb);
        if FIRST {
            lit = max(mu_s_ground, 0.0) * transmittance_to_space(air, transmittance_table, linear_clamp, 0.0, mu_s_ground);
        }
        light += exp(-scattered.optical_depth) * air.ground_albedo / PI * lit;
    }
    let direction = vec3f(sine * cos_azimuth, sine * sqrt(1.0 - cos_azimuth * cos_azimuth), mu);
    return Incoming(weight * light, weight, mie_weight * scattered.mie, mie_weight, direction);
}

// Sums over the directions of what reaches one direction of view.
struct Gathered {
    molecules: vec3f,
    aerosols: vec3f,
    aerosols_weight: f32,
    again: vec3f,
    again_weight: f32,
}

// Cornette and Shanks without the factor before 1 + cos²θ, which means do not see.
fn aerosol_weight(nu: f32) -> f32 {
    let g = air.mie_asymmetry;
    let inverse = inverseSqrt(max((1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - nu), 1e-10));
    return (1.0 + nu * nu) * inverse * inverse * inverse;
}

fn gather(before: Gathered, seen: Incoming, view: vec3f) -> Gathered {
    var g = before;
    // The direction and its mirror image beyond the sun's plane.
    let left = dot(seen.direction, view);
    let right = left - 2.0 * seen.direction.y * view.y;
    let by_molecules = rayleigh_phase(left) + rayleigh_phase(right);
    let by_aerosols = aerosol_weight(left) + aerosol_weight(right);
    g.molecules += by_molecules * seen.light;
    g.aerosols += by_aerosols * seen.light;
    g.aerosols_weight += by_aerosols * seen.weight;
    if FIRST {
        g.again += by_aerosols * seen.mie;
        g.again_weight += by_aerosols * seen.mie_weight;
    }
    return g;
}

fn convolved_phase(nu: f32) -> f32 {
    let count = arrayLength(&twice_scattered);
    let at = acos(clamp(nu, -1.0, 1.0)) / PI * f32(count - 1u);
    let i = min(u32(at), count - 2u);
    return mix(twice_scattered[i], twice_scattered[i + 1u], at - f32(i));
}

// The moments of the first light that aerosols scattered, which molecules see: ∫ L dω and ∫ ω ω L dω, as
// 1 + (ω·v)² asks for no others. Its peak is narrower than the directions are apart, but its energy is known.
struct Peak {
    mean: vec3f,
    // xx, yy, zz and xz of ω ω.
    square: array<vec3f, 4>,
    // Cosine times light, for the ground.
    falling: vec3f,
}

var<workgroup> peak: Peak;

fn gather_peak() {
    var sum: Peak;
    var weight = 0.0;
    for (var i = 0u; i < 2u * POLAR * AZIMUTHS; i++) {
        let seen = incoming[i];
        let d = seen.direction;
        weight += 2.0 * seen.mie_weight;
        sum.mean += 2.0 * seen.mie;
        sum.square[0] += 2.0 * d.x * d.x * seen.mie;
        sum.square[1] += 2.0 * d.y * d.y * seen.mie;
        sum.square[2] += 2.0 * d.z * d.z * seen.mie;
        sum.square[3] += 2.0 * d.x * d.z * seen.mie;
        sum.falling += 2.0 * max(d.z, 0.0) * seen.mie;
    }
    let norm = 1.0 / max(weight, 1e-9);
    peak.mean = norm * sum.mean;
    for (var k = 0u; k < 4u; k++) {
        peak.square[k] = norm * sum.square[k];
    }
    peak.falling = norm * sum.falling;
}

// The source function in one direction of view.
fn source_towards(g: Gathered, view: vec3f, sun: vec3f, c: Coefficients) -> vec3f {
    var molecules = g.molecules;
    var aerosols = g.aerosols / max(g.aerosols_weight, 1e-9);
    if FIRST {
        let square = view.x * view.x * peak.square[0] + view.y * view.y * peak.square[1]
            + view.z * view.z * peak.square[2] + 2.0 * view.x * view.z * peak.square[3];
        molecules += 3.0 / (16.0 * PI) * (peak.mean + square);
        aerosols += convolved_phase(dot(view, sun)) * g.again / max(g.again_weight, 1e-9);
    }
    let all = c.rayleigh_per_m + c.mie_per_m;
    return (c.rayleigh_per_m * molecules + c.mie_per_m * aerosols) / max(all, vec3f(1e-30));
}

fn light_on_ground() -> vec3f {
    var light = vec3f(0.0);
    for (var i = 0u; i < POLAR * AZIMUTHS; i++) {
        light += 2.0 * max(incoming[i].direction.z, 0.0) * incoming[i].light;
    }
    if FIRST {
        light += peak.falling;
    }
    return light;
}

fn view_direction(view: u32, view_angles: u32) -> vec3f {
    let zenith_angle = view_zenith_angle(f32(view / VIEW_AZIMUTHS) / f32(view_angles - 1u));
    let azimuth = PI * f32(view % VIEW_AZIMUTHS) / f32(VIEW_AZIMUTHS - 1u);
    let sine = sin(zenith_angle);
    return vec3f(sine * cos(azimuth), sine * sin(azimuth), cos(zenith_angle));
}

@compute @workgroup_size(32)
fn multi_scattering(@builtin(workgroup_id) texel: vec3u, @builtin(local_invocation_index) thread: u32) {
    let size = textureDimensions(source);
    let p = multi_scattering_point(air, texel.xy, size);
    for (var i = thread; i < min(2u * POLAR * AZIMUTHS, MOST_DIRECTIONS); i += THREADS) {
        incoming[i] = look(p.altitude_m, p.mu_s, i);
    }
    workgroupBarrier();
    if FIRST {
        if thread == 0u {
            gather_peak();
        }
        workgroupBarrier();
    }
    let views = textureNumLayers(source);
    let view_angles = views / VIEW_AZIMUTHS;
    // Each thread gathers for VIEWS directions of view at once: a direction is fetched once for all of them.
    var view: array<vec3f, VIEWS>;
    var gathered: array<Gathered, VIEWS>;
    for (var k = 0u; k < VIEWS; k++) {
        view[k] = view_direction(min(thread + k * THREADS, views - 1u), view_angles);
        gathered[k] = Gathered();
    }
    for (var i = 0u; i < 2u * POLAR * AZIMUTHS; i++) {
        let seen = incoming[i];
        for (var k = 0u; k < VIEWS; k++) {
            gathered[k] = gather(gathered[k], seen, view[k]);
        }
    }
    let c = coefficients_at(air, p.altitude_m, p.in_haze);
    let sun = vec3f(sqrt(1.0 - p.mu_s * p.mu_s), 0.0, p.mu_s);
    let cell = 2u * (views + 1u) * (texel.y * size.x + texel.x);
    for (var k = 0u; k < VIEWS; k++) {
        let index = thread + k * THREADS;
        if index < views {
            let found = source_towards(gathered[k], view[k], sun, c);
            let total = with_orders_before(cell + 2u * index, found);
            textureStore(source, texel.xy, index, vec4f(light_to_table(total), 0.0));
        }
    }
    if texel.y == 0u && thread == THREADS - 1u {
        let total = with_orders_before(cell + 2u * views, light_on_ground());
        textureStore(irradiance, vec2u(texel.x, 0u), vec4f(light_to_table(total), 0.0));
    }
}

// Adds this order to its cell; gives what the next reader needs: this order, or after the last the sum of all.
fn with_orders_before(cell: u32, light: vec3f) -> vec3f {
    if FIRST {
        sums[cell] = vec4f(0.0);
    }
    let before = sums[cell + 1u].rgb;
    let sum = sums[cell].rgb + light;
    sums[cell] = vec4f(sum, 0.0);
    sums[cell + 1u] = vec4f(light, 0.0);
    if order.last == 0u {
        return light;
    }
    let ratio = clamp(light / select(before, vec3f(1.0), before == vec3f(0.0)), vec3f(0.0), vec3f(0.98));
    return sum + light * ratio / (1.0 - ratio);
}
