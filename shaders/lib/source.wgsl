// Light that is scattered at a point for the second time or a later one, as a source function: the light from all
// round, averaged with the phase functions of what is there, J / σ_s. A table holds it by sun and height in each layer,
// and by the direction of view, its cosine with the zenith and its azimuth from the sun, from layer to layer. It is
// smooth in all four, since each is an integral over the sphere; the sky is even about the sun's plane.
import package::lib::air::Air;
import package::lib::geometry::PI;
import package::lib::tables::{
    HeightCosine, light_from_table, multi_scattering_unit, unit_to_coordinate, view_unit, view_zenith_angle,
};

// Azimuths of view, evenly from 0 to π.
const VIEW_AZIMUTHS = 12u;

// Cosine of the azimuth between a direction of view and the sun. Where either stands in the zenith any will do.
fn cosine_of_azimuth(mu: f32, mu_s: f32, nu: f32) -> f32 {
    let sines = sqrt(max((1.0 - mu * mu) * (1.0 - mu_s * mu_s), 1e-12));
    return clamp((nu - mu * mu_s) / sines, -1.0, 1.0);
}

fn source_function(
    air: Air,
    table: texture_2d_array<f32>,
    linear_clamp: sampler,
    altitude_m: f32,
    in_haze: bool,
    mu: f32,
    mu_s: f32,
    nu: f32,
) -> vec3f {
    let size = textureDimensions(table);
    let unit = multi_scattering_unit(air, HeightCosine(altitude_m, mu_s), in_haze, size.y);
    let at = vec2f(unit_to_coordinate(unit.x, size.x), unit.y);
    // Between two of the zenith's angles and between two azimuths, linear in the cosine, which is exact for the first
    // harmonic.
    let view_angles = textureNumLayers(table) / VIEW_AZIMUTHS;
    let row = min(u32(view_unit(acos(clamp(mu, -1.0, 1.0))) * f32(view_angles - 1u)), view_angles - 2u);
    let lower = cos(view_zenith_angle(f32(row) / f32(view_angles - 1u)));
    let upper = cos(view_zenith_angle(f32(row + 1u) / f32(view_angles - 1u)));
    let cos_azimuth = cosine_of_azimuth(mu, mu_s, nu);
    let spacing = PI / f32(VIEW_AZIMUTHS - 1u);
    let column = min(u32(acos(cos_azimuth) / spacing), VIEW_AZIMUTHS - 2u);
    let towards = cos(f32(column) * spacing);
    let away = cos(f32(column + 1u) * spacing);
    let share = vec2f((mu - lower) / (upper - lower), (cos_azimuth - towards) / (away - towards));
    let layer = i32(row * VIEW_AZIMUTHS + column);
    let row_below = mix(at_layer(table, linear_clamp, at, layer), at_layer(table, linear_clamp, at, layer + 1), share.y);
    let next = layer + i32(VIEW_AZIMUTHS);
    let row_above = mix(at_layer(table, linear_clamp, at, next), at_layer(table, linear_clamp, at, next + 1), share.y);
    return max(mix(row_below, row_above, share.x), vec3f(0.0));
}

fn at_layer(table: texture_2d_array<f32>, linear_clamp: sampler, at: vec2f, layer: i32) -> vec3f {
    return light_from_table(textureSampleLevel(table, linear_clamp, at, layer, 0.0).rgb);
}
