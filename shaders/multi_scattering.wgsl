// Light scattered twice and more, order by order, and the light that the sky sends to the ground.
//
// One dispatch takes the radiance L_n of one order along rays all round each point to its moments c_n, from which the
// source of the next order follows, and to the irradiance E_n of the ground, so that light goes back and forth between
// air and ground as it does in truth:
//   L_1 = single scattering + T ρ/π E_0,   L_{n+1} = ∫ T σ_s S(c_n) dt + T ρ/π E_n.
// After the last order the rest is summed as a geometric series with the ratio of the last two orders.
// Hillaire 2020 §5.5 keeps the zeroth moment alone, sums from the first order on, and leaves the lit ground out of the
// ratio. The aerosols' forward peak needs the higher moments: without them a third more of the ground's light comes
// back down.
import package::lib::air::Air;
import package::lib::geometry::{PI, cosine_after, distance_to_sphere, distance_to_top, horizon_distance_squared};
import package::lib::moments::{MOMENTS, harmonics};
import package::lib::phase::{rayleigh_phase, cornette_shanks_phase};
import package::lib::scattering::{AirRay, March, scatter_along};
import package::lib::tables::{multi_scattering_point, sun_cosine_unit, texel_to_unit, unit_to_coordinate};
import package::lib::transmittance::transmittance_to_space;

// True for the light that the sun sends. A variant of its own: neither has to pay for the other's work, as a software
// device runs both sides of every branch.
override FIRST: bool = true;

struct Order {
    // 1 where the sums shall be written rather than this order.
    last: u32,
    steps: u32,
}

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(1) var<uniform> order: Order;
@group(0) @binding(2) var transmittance_table: texture_2d<f32>;
@group(0) @binding(3) var linear_clamp: sampler;
@group(0) @binding(4) var moments_before: texture_2d_array<f32>;
@group(0) @binding(5) var irradiance_before: texture_2d<f32>;
@group(0) @binding(6) var moments: texture_storage_2d_array<rgba32float, write>;
@group(0) @binding(7) var irradiance: texture_storage_2d<rgba32float, write>;
// For each texel: the sums of the orders, then the last order; six moments and the irradiance in each.
@group(0) @binding(8) var<storage, read_write> sums: array<vec4f>;

// Directions: six Gauss-Legendre nodes x on either side of the horizon, bent towards it by mu = mu_h ± Δ x², times
// six azimuths on one side of the sun (the other side is its mirror image).
const POLAR = 6u;
const AZIMUTHS = 6u;
const THREADS = 24u;
const NODES = array<f32, 6>(0.0337652429, 0.1693953068, 0.3806904070, 0.6193095930, 0.8306046932, 0.9662347571);
const WEIGHTS = array<f32, 6>(0.0856622462, 0.1803807865, 0.2339569673, 0.2339569673, 0.1803807865, 0.0856622462);

// Light from one direction or several: the moments, and the irradiance on the ground in the last place.
const VALUES = 7u;

struct Share {
    light: array<vec3f, 7>,
    // Aerosol light, and the sum of the phase function over the directions, by which it is divided: the peak is
    // narrower than the directions are apart, and its energy is known.
    mie: array<vec3f, 7>,
    mie_norm: f32,
}

var<workgroup> shares: array<Share, 24>;

fn add_direction(share: ptr<function, Share>, h: f32, mu_s: f32, mu: f32, azimuth: f32, weight: f32) {
    let sin_view = sqrt(max(1.0 - mu * mu, 0.0));
    let sin_sun = sqrt(max(1.0 - mu_s * mu_s, 0.0));
    let nu = clamp(mu * mu_s + sin_view * sin_sun * cos(azimuth), -1.0, 1.0);
    let to_ground = distance_to_sphere(air.radius_m, h, mu);
    let ground = to_ground >= 0.0;
    let length_m = select(distance_to_top(air.radius_m, air.top_m, h, mu), to_ground, ground);
    let ray = AirRay(h, mu, mu_s, nu, length_m);
    let scattered = scatter_along(air, ray, transmittance_table, moments_before, linear_clamp, March(FIRST, !FIRST, false, order.steps, 0u));
    var radiance = scattered.multiple;
    if FIRST {
        radiance = rayleigh_phase(nu) * scattered.rayleigh;
    }
    if ground {
        let mu_s_ground = cosine_after(air.radius_m, h, 0.0, mu_s, nu, length_m);
        let x = unit_to_coordinate(sun_cosine_unit(mu_s_ground), textureDimensions(irradiance_before).x);
        var lit = textureSampleLevel(irradiance_before, linear_clamp, vec2f(x, 0.5), 0.0).rgb;
        if FIRST {
            lit = max(mu_s_ground, 0.0) * transmittance_to_space(air, transmittance_table, linear_clamp, 0.0, mu_s_ground);
        }
        radiance += exp(-scattered.optical_depth) * air.ground_albedo / PI * lit;
    }
    var mie = vec3f(0.0);
    if FIRST {
        let phase = cornette_shanks_phase(nu, air.mie_asymmetry);
        mie = phase * scattered.mie;
        (*share).mie_norm += phase * weight;
    }
    let y = harmonics(mu, mu_s, nu);
    for (var k = 0u; k < VALUES; k++) {
        let share_of = weight * select(max(mu, 0.0), y[min(k, MOMENTS - 1u)], k < MOMENTS);
        (*share).light[k] += share_of * radiance;
        (*share).mie[k] += share_of * mie;
    }
}

@compute @workgroup_size(24)
fn multi_scattering(@builtin(workgroup_id) texel: vec3u, @builtin(local_invocation_index) thread: u32) {
    let size = textureDimensions(moments);
    let p = multi_scattering_point(air.top_m, vec2f(texel_to_unit(texel.x, size.x), texel_to_unit(texel.y, size.y)));
    let h = p.altitude_m;
    let horizon = -sqrt(horizon_distance_squared(air.radius_m, h)) / (air.radius_m + h);
    var mine: Share;
    for (var i = thread; i < 2u * POLAR * AZIMUTHS; i += THREADS) {
        let polar = (i / AZIMUTHS) % POLAR;
        let up = i < POLAR * AZIMUTHS;
        let x = NODES[polar];
        let reach = select(-1.0 - horizon, 1.0 - horizon, up);
        let mu = horizon + reach * x * x;
        // dω = dmu dφ; both sides of the sun.
        let weight = WEIGHTS[polar] * 2.0 * x * abs(reach) * 2.0 * PI / f32(AZIMUTHS);
        let azimuth = PI * (f32(i % AZIMUTHS) + 0.5) / f32(AZIMUTHS);
        add_direction(&mine, h, p.mu, mu, azimuth, weight);
    }
    shares[thread] = mine;
    workgroupBarrier();
    // One thread a value.
    if thread >= VALUES {
        return;
    }
    var light = vec3f(0.0);
    var mie = vec3f(0.0);
    var mie_norm = 0.0;
    for (var i = 0u; i < THREADS; i++) {
        light += shares[i].light[thread];
        mie += shares[i].mie[thread];
        mie_norm += shares[i].mie_norm;
    }
    if FIRST {
        light += mie / max(mie_norm, 1e-6);
    }
    let total = with_orders_before(2u * VALUES * (texel.y * size.x + texel.x) + thread, light);
    if thread < MOMENTS {
        textureStore(moments, texel.xy, thread, vec4f(total, 0.0));
    } else if texel.y == 0u {
        textureStore(irradiance, vec2u(texel.x, 0u), vec4f(total, 0.0));
    }
}

// Adds this order to its cell; gives what the next reader needs: this order, or after the last the sum of all.
fn with_orders_before(cell: u32, light: vec3f) -> vec3f {
    if FIRST {
        sums[cell] = vec4f(0.0);
    }
    let before = sums[cell + VALUES].rgb;
    let sum = sums[cell].rgb + light;
    sums[cell] = vec4f(sum, 0.0);
    sums[cell + VALUES] = vec4f(light, 0.0);
    if order.last == 0u {
        return light;
    }
    let ratio = clamp(light / select(before, vec3f(1.0), before == vec3f(0.0)), vec3f(0.0), vec3f(0.98));
    return sum + light * ratio / (1.0 - ratio);
}
