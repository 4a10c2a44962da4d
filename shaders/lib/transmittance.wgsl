// Optical depth to the top of the air. The air without the haze is integrated, or read from a table of such integrals;
// the haze is even, so its depth is its coefficient times the length in it, exact however dense it is.
//
// The table holds optical depth, not transmittance: it is the smoother of the two, keeps its relative error at grazing
// rays, and fits half floats.
import package::lib::air::{Air, coefficients_at};
import package::lib::geometry::{altitude_after, distance_to_top};
import package::lib::tables::{HeightCosine, transmittance_unit, unit_to_coordinate};

// Midpoints of steps that grow with the square from the ray's lowest point, on either side of it.
fn integrate_optical_depth(air: Air, altitude_m: f32, mu: f32, steps: u32) -> vec3f {
    let length_m = distance_to_top(air.radius_m, air.top_m, altitude_m, mu);
    let lowest = clamp(-(air.radius_m + altitude_m) * mu, 0.0, length_m);
    var tau = vec3f(0.0);
    for (var k = 0u; k < steps; k++) {
        let m = (f32(k) + 0.5) / f32(steps);
        // b² - a² of the step's ends a and b.
        let weight = 2.0 * m / f32(steps);
        let h = altitude_after(air.radius_m, altitude_m, mu, lowest + (length_m - lowest) * m * m);
        tau += weight * (length_m - lowest) * coefficients_at(air, h, false).extinction_per_m;
    }
    // The part that falls, for those rays that do.
    for (var k = 0u; k < select(0u, steps, lowest > 0.0); k++) {
        let m = (f32(k) + 0.5) / f32(steps);
        let weight = 2.0 * m / f32(steps);
        let h = altitude_after(air.radius_m, altitude_m, mu, lowest * (1.0 - m * m));
        tau += weight * lowest * coefficients_at(air, h, false).extinction_per_m;
    }
    return tau;
}

// Length of a ray's way through the haze up to space: a root of t² + 2 r mu t + (h - h_top)(2R + h + h_top).
fn length_in_haze(air: Air, altitude_m: f32, mu: f32) -> f32 {
    if altitude_m < air.haze_top_m {
        return distance_to_top(air.radius_m, air.haze_top_m, altitude_m, mu);
    }
    let b = (air.radius_m + altitude_m) * mu;
    let c = (altitude_m - air.haze_top_m) * (2.0 * air.radius_m + altitude_m + air.haze_top_m);
    return select(0.0, 2.0 * sqrt(max(b * b - c, 0.0)), mu < 0.0);
}

fn haze_optical_depth(air: Air, altitude_m: f32, mu: f32) -> f32 {
    return air.haze_extinction_per_m * length_in_haze(air, altitude_m, mu);
}

// Without the haze.
fn tabled_optical_depth(air: Air, table: texture_2d<f32>, linear_clamp: sampler, altitude_m: f32, mu: f32) -> vec3f {
    let unit = transmittance_unit(air.radius_m, air.top_m, HeightCosine(altitude_m, mu));
    let size = textureDimensions(table);
    let at = vec2f(unit_to_coordinate(unit.x, size.x), unit_to_coordinate(unit.y, size.y));
    return textureSampleLevel(table, linear_clamp, at, 0.0).rgb;
}

fn optical_depth_to_top(air: Air, table: texture_2d<f32>, linear_clamp: sampler, altitude_m: f32, mu: f32) -> vec3f {
    return tabled_optical_depth(air, table, linear_clamp, altitude_m, mu) + haze_optical_depth(air, altitude_m, mu);
}

// Transmittance to space; zero where the ground is in the way.
fn transmittance_to_space(air: Air, table: texture_2d<f32>, linear_clamp: sampler, altitude_m: f32, mu: f32) -> vec3f {
    let rho = sqrt(max(altitude_m, 0.0) * (2.0 * air.radius_m + max(altitude_m, 0.0)));
    let hidden = mu < -rho / (air.radius_m + max(altitude_m, 0.0));
    let tau = optical_depth_to_top(air, table, linear_clamp, altitude_m, mu);
    return select(exp(-tau), vec3f(0.0), hidden);
}
