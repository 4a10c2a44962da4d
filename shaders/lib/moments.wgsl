// Light from all round a point, as its moments up to the second degree in real orthonormal spherical harmonics about
// the local zenith, with the sun's azimuth as 0: the sky is even about that plane, so six of the nine suffice. A phase
// function with Legendre moments p_l turns moments c_lm of the light into the source Σ p_l c_lm Y_lm. The molecules'
// phase function has no others than p_0 = 1 and p_2 = 1/10, so for them this is exact.
import package::lib::air::{Air, Coefficients};
import package::lib::geometry::PI;
import package::lib::tables::{HeightCosine, multi_scattering_unit, unit_to_coordinate};

const MOMENTS = 6u;
const RAYLEIGH_P2 = 0.1;

// Y00, Y10, Y11, Y20, Y21, Y22 of a direction with cosines mu to the zenith and nu to the sun.
fn harmonics(mu: f32, mu_s: f32, nu: f32) -> array<f32, 6> {
    let sin_s = sqrt(max(1.0 - mu_s * mu_s, 0.0));
    let sin_squared = max(1.0 - mu * mu, 0.0);
    // Along the sun's azimuth: sin θ cos φ. With the sun at the zenith the moments that need it vanish.
    let reach = sqrt(sin_squared);
    let x = clamp((nu - mu * mu_s) / max(sin_s, 1e-4), -reach, reach);
    return array<f32, 6>(
        sqrt(1.0 / (4.0 * PI)),
        sqrt(3.0 / (4.0 * PI)) * mu,
        sqrt(3.0 / (4.0 * PI)) * x,
        sqrt(5.0 / (16.0 * PI)) * (3.0 * mu * mu - 1.0),
        sqrt(15.0 / (4.0 * PI)) * x * mu,
        sqrt(15.0 / (16.0 * PI)) * (2.0 * x * x - sin_squared),
    );
}

// Light scattered per metre into a direction, from the moments in the table.
fn source_per_m(
    air: Air,
    c: Coefficients,
    table: texture_2d_array<f32>,
    linear_clamp: sampler,
    altitude_m: f32,
    mu: f32,
    mu_s: f32,
    nu: f32,
) -> vec3f {
    let unit = multi_scattering_unit(air.top_m, HeightCosine(altitude_m, mu_s));
    let size = textureDimensions(table);
    let at = vec2f(unit_to_coordinate(unit.x, size.x), unit_to_coordinate(unit.y, size.y));
    let y = harmonics(mu, mu_s, nu);
    let even = y[0] * textureSampleLevel(table, linear_clamp, at, 0, 0.0).rgb;
    let forward = y[1] * textureSampleLevel(table, linear_clamp, at, 1, 0.0).rgb
        + y[2] * textureSampleLevel(table, linear_clamp, at, 2, 0.0).rgb;
    let stretched = y[3] * textureSampleLevel(table, linear_clamp, at, 3, 0.0).rgb
        + y[4] * textureSampleLevel(table, linear_clamp, at, 4, 0.0).rgb
        + y[5] * textureSampleLevel(table, linear_clamp, at, 5, 0.0).rgb;
    let molecules = c.rayleigh_per_m * (even + RAYLEIGH_P2 * stretched);
    let aerosols = c.mie_per_m * (even + air.mie_moments.x * forward + air.mie_moments.y * stretched);
    return max(molecules + aerosols, vec3f(0.0));
}
