// What rays in all directions lose of the light that the air scatters, to clouds that keep it from the light's source.
import package::lib::air::Air;
import package::lib::cloud_air::cloud_air_direction;
import package::lib::cloud_shade::{CloudShade, shade_depth};
import package::lib::geometry::{altitude_after, cosine_after, distance_to_air, distance_to_sphere, edge_cosine, shell_stretch};
import package::lib::light::View;
import package::lib::phase::{cornette_shanks_phase, rayleigh_phase};
import package::lib::shaft_ray::{LostSum, with_step};
import package::lib::transmittance::transmittance_to_space;

struct CloudFrame {
    // The observer's place in the scene.
    place_m: vec3f,
    // The light that casts shadows.
    light: vec3f,
}

@group(0) @binding(0) var<uniform> air: Air;
// The light that counts: the sun, or at night the moon.
@group(0) @binding(1) var<uniform> view: View;
@group(0) @binding(2) var transmittance_table: texture_2d<f32>;
@group(0) @binding(3) var linear_clamp: sampler;
@group(0) @binding(4) var<uniform> shade: CloudShade;
@group(0) @binding(5) var shade_maps: texture_2d_array<f32>;
@group(0) @binding(6) var<uniform> cloud_frame: CloudFrame;
// `LostInAir` of `lib/cloud_air.wgsl`.
@group(0) @binding(7) var lost: texture_storage_2d_array<rgba32float, write>;

const STEPS = 24u;
// Beyond, no shadow is looked for.
const FARTHEST_M = 1.6e5;

@compute @workgroup_size(8, 8)
fn cloud_air(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(lost);
    if any(id.xy >= size) {
        return;
    }
    let h0 = view.altitude_m;
    let direction = cloud_air_direction(id.xy, size, view.up, edge_cosine(air.radius_m, h0));
    let mu = clamp(dot(direction, view.up), -1.0, 1.0);
    let nu = clamp(dot(direction, view.sun), -1.0, 1.0);
    let met_m = distance_to_sphere(air.radius_m, h0, mu);
    let end_m = select(1e12, met_m, met_m >= 0.0);
    let air_from_m = distance_to_air(air.radius_m, air.top_m, h0, mu);
    let last = max(shade.count, 1u) - 1u;
    let top_m = shade.middles_m[last / 4u][last % 4u];
    let reach = shell_stretch(air.radius_m + top_m, h0 - top_m, mu, end_m);
    // From where the air begins to behind the last place that clouds can shade.
    let way_m = select(0.0, max(min(reach.y, max(reach.x, air_from_m) + FARTHEST_M) - air_from_m, 0.0), shade.count > 0u && reach.x < reach.y);
    let phases = vec2f(rayleigh_phase(nu), cornette_shanks_phase(nu, air.mie_asymmetry));
    var sum: LostSum;
    sum.left = vec3f(1.0);
    for (var k = 0u; k < STEPS; k++) {
        let near = f32(k) / f32(STEPS);
        let far = f32(k + 1u) / f32(STEPS);
        let x = 0.5 * (near + far);
        let t = air_from_m + way_m * x * x;
        let h = max(altitude_after(air.radius_m, h0, mu, t), 0.0);
        let mu_light = cosine_after(air.radius_m, h0, h, view.mu_s, nu, t);
        var hidden = 0.0;
        if h < top_m {
            hidden = 1.0 - exp(-shade_depth(shade, shade_maps, linear_clamp, air.radius_m, cloud_frame.place_m + t * direction, h, cloud_frame.light, mu_light));
        }
        let lit = transmittance_to_space(air, transmittance_table, linear_clamp, h, mu_light);
        sum = with_step(sum, air, h, phases, lit, hidden, way_m * (far * far - near * near), far);
    }
    textureStore(lost, id.xy, 0u, vec4f(view.sun_irradiance * sum.lost, way_m));
    textureStore(lost, id.xy, 1u, sum.first);
    textureStore(lost, id.xy, 2u, sum.second);
}
