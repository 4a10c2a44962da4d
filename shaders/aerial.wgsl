// Light in the air up to every distance in every direction, from one height, for a sun of unit irradiance and without the
// phase functions: what stands in the air reads it.
import package::lib::aerial::aerial_share;
import package::lib::air::Air;
import package::lib::geometry::{altitude_after, cosine_after};
import package::lib::scattering::{AirRay, March, Scattered, scatter_along};
import package::lib::tables::{light_to_table, sky_view_ray};
import package::lib::view_ray::{Observer, enter_air};

// False for the first order alone.
override MULTIPLE: bool = true;
// True where there is haze.
override HAZE: bool = true;

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(1) var<uniform> observer: Observer;
@group(0) @binding(2) var transmittance_table: texture_2d<f32>;
@group(0) @binding(3) var linear_clamp: sampler;
@group(0) @binding(4) var source_table: texture_2d_array<f32>;
// Means over the way; their alpha is the mean extinction in R, G, B.
@group(0) @binding(5) var rayleigh_volume: texture_storage_3d<rgba32float, write>;
@group(0) @binding(6) var mie_volume: texture_storage_3d<rgba32float, write>;
@group(0) @binding(7) var multiple_volume: texture_storage_3d<rgba32float, write>;

// The first slice stands for the observer's own place.
const LEAST_SHARE = 1e-7;

@compute @workgroup_size(8, 8)
fn aerial(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(rayleigh_volume);
    if any(id.xy >= size.xy) {
        return;
    }
    let ray = sky_view_ray(air.radius_m, air.top_m, observer.altitude_m, id.xy, size.xy);
    let mu = cos(ray.zenith_angle);
    let nu = clamp(mu * observer.mu_s + sin(ray.zenith_angle) * observer.sin_s * cos(ray.azimuth), -1.0, 1.0);
    let entry = enter_air(air, observer, mu, nu, ray.ground, ray.distance_m);
    var sum: Scattered;
    var gone_m = 0.0;
    for (var k = 0u; k < size.z; k++) {
        let to_m = max(aerial_share(k, size.z), LEAST_SHARE) * max(entry.length_m, 0.0);
        let h = altitude_after(air.radius_m, entry.altitude_m, entry.mu, gone_m);
        let here_mu = cosine_after(air.radius_m, entry.altitude_m, h, entry.mu, 1.0, gone_m);
        let here_mu_s = cosine_after(air.radius_m, entry.altitude_m, h, entry.mu_s, entry.nu, gone_m);
        let piece = AirRay(h, clamp(here_mu, -1.0, 1.0), clamp(here_mu_s, -1.0, 1.0), entry.nu, to_m - gone_m);
        if piece.length_m > 0.0 {
            let march = March(true, MULTIPLE, HAZE, false, observer.steps, 4u, 0u);
            let light = scatter_along(air, piece, transmittance_table, source_table, linear_clamp, march);
            let left = exp(-sum.optical_depth);
            sum.rayleigh += left * light.rayleigh;
            sum.mie += left * light.mie;
            sum.multiple += left * light.multiple;
            sum.optical_depth += light.optical_depth;
        }
        let mean = 1.0 / max(to_m, 1e-6);
        textureStore(rayleigh_volume, vec3u(id.xy, k), vec4f(light_to_table(mean * sum.rayleigh), mean * sum.optical_depth.r));
        textureStore(mie_volume, vec3u(id.xy, k), vec4f(light_to_table(mean * sum.mie), mean * sum.optical_depth.g));
        textureStore(multiple_volume, vec3u(id.xy, k), vec4f(light_to_table(mean * sum.multiple), mean * sum.optical_depth.b));
        gone_m = to_m;
    }
}
