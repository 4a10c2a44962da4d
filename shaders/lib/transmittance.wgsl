// Optical depth to the top of the air, from the table. The table holds optical depth, not transmittance: it is the
// smoother of the two, keeps its relative error at grazing rays, and fits half floats.
import package::lib::air::Air;
import package::lib::tables::{HeightCosine, transmittance_unit, unit_to_coordinate};

fn optical_depth_to_top(air: Air, table: texture_2d<f32>, linear_clamp: sampler, altitude_m: f32, mu: f32) -> vec3f {
    let unit = transmittance_unit(air.radius_m, air.top_m, HeightCosine(altitude_m, mu));
    let size = textureDimensions(table);
    let at = vec2f(unit_to_coordinate(unit.x, size.x), unit_to_coordinate(unit.y, size.y));
    return textureSampleLevel(table, linear_clamp, at, 0.0).rgb;
}

// Transmittance to space; zero where the ground is in the way.
fn transmittance_to_space(air: Air, table: texture_2d<f32>, linear_clamp: sampler, altitude_m: f32, mu: f32) -> vec3f {
    let rho = sqrt(max(altitude_m, 0.0) * (2.0 * air.radius_m + max(altitude_m, 0.0)));
    let hidden = mu < -rho / (air.radius_m + max(altitude_m, 0.0));
    let tau = optical_depth_to_top(air, table, linear_clamp, altitude_m, mu);
    return select(exp(-tau), vec3f(0.0), hidden);
}
