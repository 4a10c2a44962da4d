// Optical depth from every height and direction to the top of the air, without the haze.
import package::lib::air::Air;
import package::lib::tables::{texel_to_unit, transmittance_point};
import package::lib::transmittance::integrate_optical_depth;

struct Integral {
    steps: u32,
}

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(1) var<uniform> integral: Integral;
@group(0) @binding(2) var optical_depth: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn transmittance(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(optical_depth);
    if any(id.xy >= size) {
        return;
    }
    let unit = vec2f(texel_to_unit(id.x, size.x), texel_to_unit(id.y, size.y));
    let p = transmittance_point(air.radius_m, air.top_m, unit);
    let tau = integrate_optical_depth(air, p.altitude_m, p.mu, integral.steps);
    textureStore(optical_depth, id.xy, vec4f(tau, 0.0));
}
