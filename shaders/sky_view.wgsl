// Light in the air, for every direction from one height, for a sun of unit irradiance. The phase functions are left
// to the reader: without them the table is smooth in azimuth, few columns serve, and the aureole is exact at any zoom.
import package::lib::air::Air;
import package::lib::geometry::edge_zenith_angle;
import package::lib::scattering::{March, Scattered, scatter_along};
import package::lib::view_ray::{Observer, enter_air};
import package::lib::tables::{light_to_table, sky_view_ray};

// False for the first order alone.
override MULTIPLE: bool = true;
// True where there is haze.
override HAZE: bool = true;

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(1) var<uniform> observer: Observer;
@group(0) @binding(2) var transmittance_table: texture_2d<f32>;
@group(0) @binding(3) var linear_clamp: sampler;
@group(0) @binding(4) var source_table: texture_2d_array<f32>;
// Layers: Rayleigh, Mie, multiple; their alpha is the optical depth in R, G, B.
@group(0) @binding(5) var table: texture_storage_2d_array<rgba32float, write>;

// Angle from the horizon, radians.
const LONG_RAYS = 0.05;
// Rays to the ground that are no longer see little of it.
const SHORT_M = 5e4;

@compute @workgroup_size(8, 8)
fn sky_view(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(table);
    if any(id.xy >= size) {
        return;
    }
    let horizon = edge_zenith_angle(air.radius_m, observer.altitude_m);
    let ray = sky_view_ray(air.radius_m, air.top_m, observer.altitude_m, id.xy, size);
    let mu = cos(ray.zenith_angle);
    let nu = mu * observer.mu_s + sin(ray.zenith_angle) * observer.sin_s * cos(ray.azimuth);
    let entry = enter_air(air, observer, mu, clamp(nu, -1.0, 1.0), ray.ground, ray.distance_m);
    var light: Scattered;
    if entry.length_m > 0.0 {
        // Long rays near the horizon see the light change most.
        let steps = select(1u, 2u, abs(horizon - ray.zenith_angle) < LONG_RAYS && (!ray.ground || ray.distance_m > SHORT_M)) * observer.steps;
        let march = March(true, MULTIPLE, HAZE, false, steps, 4u, 0u);
        light = scatter_along(air, entry, transmittance_table, source_table, linear_clamp, march);
    }
    textureStore(table, id.xy, 0, vec4f(light_to_table(light.rayleigh), light.optical_depth.r));
    textureStore(table, id.xy, 1, vec4f(light_to_table(light.mie), light.optical_depth.g));
    textureStore(table, id.xy, 2, vec4f(light_to_table(light.multiple), light.optical_depth.b));
}
