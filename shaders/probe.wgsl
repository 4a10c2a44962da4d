// Radiance, transmittance and distance at exact directions, integrated along each ray without the sky-view table.
import package::lib::air::Air;
import package::lib::geometry::distance_to_sphere;
import package::lib::light::{View, ground_radiance, scattered_radiance, sun_disc};
import package::lib::scattering::{March, Scattered, scatter_along};
import package::lib::view_ray::{Observer, enter_air};

// False for the first order alone.
override MULTIPLE: bool = true;
// True where the optical depth to the sun is integrated in every step.
override NESTED: bool = false;

struct Answer {
    radiance: vec3f,
    // Negative where the sky is seen.
    distance_m: f32,
    transmittance: vec3f,
}

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(1) var<uniform> view: View;
@group(0) @binding(2) var<uniform> observer: Observer;
@group(0) @binding(3) var transmittance_table: texture_2d<f32>;
@group(0) @binding(4) var linear_clamp: sampler;
@group(0) @binding(5) var irradiance_table: texture_2d<f32>;
@group(0) @binding(6) var source_table: texture_2d_array<f32>;
// World direction; w is 1 where the sun's disc counts.
@group(0) @binding(7) var<storage, read> directions: array<vec4f>;
@group(0) @binding(8) var<storage, read_write> answers: array<Answer>;

@compute @workgroup_size(64)
fn probe(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&directions) {
        return;
    }
    let direction = directions[id.x].xyz;
    let mu = clamp(dot(direction, view.up), -1.0, 1.0);
    let nu = clamp(dot(direction, view.sun), -1.0, 1.0);
    let ground_m = distance_to_sphere(air.radius_m, view.altitude_m, mu);
    let ground = ground_m >= 0.0;
    let entry = enter_air(air, observer, mu, nu, ground, ground_m);
    var light: Scattered;
    if entry.length_m > 0.0 {
        light = scatter_along(air, entry, transmittance_table, source_table, linear_clamp, March(true, MULTIPLE, NESTED, observer.steps, observer.sun_steps));
    }
    var behind = directions[id.x].w * sun_disc(view, direction);
    if ground {
        behind = ground_radiance(air, view, nu, ground_m, transmittance_table, irradiance_table, linear_clamp);
    }
    let transmittance = exp(-light.optical_depth);
    answers[id.x] = Answer(scattered_radiance(air, view, light, nu) + transmittance * behind, ground_m, transmittance);
}
