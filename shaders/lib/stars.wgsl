// Light from beyond the air.
import package::lib::air::Air;
import package::lib::geometry::distance_to_sphere;
import package::lib::transmittance::{optical_depth_to_top, transmittance_to_space};

// Transmittance from the observer, who may stand outside the air, to space; zero where the ground is in the way.
fn light_left(air: Air, table: texture_2d<f32>, linear_clamp: sampler, altitude_m: f32, mu: f32) -> vec3f {
    if altitude_m <= air.top_m {
        return transmittance_to_space(air, table, linear_clamp, altitude_m, mu);
    }
    if distance_to_sphere(air.radius_m, altitude_m, mu) >= 0.0 {
        return vec3f(0.0);
    }
    let to_air = distance_to_sphere(air.radius_m + air.top_m, altitude_m - air.top_m, mu);
    if to_air < 0.0 {
        return vec3f(1.0);
    }
    let mu_in = ((air.radius_m + altitude_m) * mu + to_air) / (air.radius_m + air.top_m);
    return exp(-optical_depth_to_top(air, table, linear_clamp, air.top_m, clamp(mu_in, -1.0, 0.0)));
}
