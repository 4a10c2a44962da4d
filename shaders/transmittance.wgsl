// Optical depth from every height and direction to the top of the air.
import package::lib::air::{Air, coefficients_at};
import package::lib::geometry::{altitude_after, distance_to_top};
import package::lib::tables::{texel_to_unit, transmittance_point};

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(1) var optical_depth: texture_storage_2d<rgba32float, write>;

// Midpoints of 64 steps that grow with the square from the lower end: within 0.01 % of the integral for the Earth.
const STEPS = 64u;

@compute @workgroup_size(8, 8)
fn transmittance(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(optical_depth);
    if any(id.xy >= size) {
        return;
    }
    let unit = vec2f(texel_to_unit(id.x, size.x), texel_to_unit(id.y, size.y));
    let p = transmittance_point(air.radius_m, air.top_m, unit);
    let length_m = distance_to_top(air.radius_m, air.top_m, p.altitude_m, p.mu);
    let lowest = clamp(-(air.radius_m + p.altitude_m) * p.mu, 0.0, length_m);
    var tau = vec3f(0.0);
    for (var k = 0u; k < STEPS; k++) {
        let a = f32(k) / f32(STEPS);
        let b = f32(k + 1u) / f32(STEPS);
        let m = 0.5 * (a + b);
        let weight = b * b - a * a;
        // The falling part, from its lower end backwards, and the rising part.
        let h_fall = altitude_after(air.radius_m, p.altitude_m, p.mu, lowest * (1.0 - m * m));
        let h_rise = altitude_after(air.radius_m, p.altitude_m, p.mu, lowest + (length_m - lowest) * m * m);
        tau += weight * lowest * coefficients_at(air, h_fall).extinction_per_m;
        tau += weight * (length_m - lowest) * coefficients_at(air, h_rise).extinction_per_m;
    }
    textureStore(optical_depth, id.xy, vec4f(tau, 0.0));
}
