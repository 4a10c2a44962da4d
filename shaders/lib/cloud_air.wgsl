// The air under clouds where no shafts are looked for: what it loses of the light, in a table over all directions, and what
// it gets of the light that the clouds have scattered.
import package::lib::air::{Air, coefficients_at};
import package::lib::cloud_shade::CloudShade;
import package::lib::geometry::PI;
import package::lib::light::View;
import package::lib::shaft_ray::lost_until;
import package::lib::transmittance::transmittance_to_space;

// What a ray loses. Layers of the table: light and `to_m`, then the shares.
struct LostInAir {
    // All along it, radiance.
    light: vec3f,
    // How far it was looked at, from where the air begins.
    to_m: f32,
    first: vec4f,
    second: vec4f,
}

// Rows run from the horizon up to the zenith, and then from the horizon down, with the root of the cosine's distance from it;
// columns around, the last as the first.
const LIFTED = 1e-5;

// Two level directions.
fn level_axes(up: vec3f) -> array<vec3f, 2> {
    // Duff and others 2017.
    let s = select(-1.0, 1.0, up.z >= 0.0);
    let a = -1.0 / (s + up.z);
    let b = up.x * up.y * a;
    return array<vec3f, 2>(vec3f(1.0 + s * up.x * up.x * a, s * b, -s * up.x), vec3f(b, s + up.y * up.y * a, -up.y));
}

fn cloud_air_direction(texel: vec2u, size: vec2u, up: vec3f, horizon: f32) -> vec3f {
    let rows = size.y / 2u;
    let azimuth = 2.0 * PI * f32(texel.x) / f32(size.x - 1u);
    let v = f32(texel.y % rows) / f32(rows - 1u);
    let above = horizon + LIFTED + (1.0 - horizon - LIFTED) * v * v;
    let below = horizon - LIFTED - (1.0 + horizon - LIFTED) * v * v;
    let mu = clamp(select(below, above, texel.y < rows), -1.0, 1.0);
    let axes = level_axes(up);
    return mu * up + sqrt(1.0 - mu * mu) * (cos(azimuth) * axes[0] + sin(azimuth) * axes[1]);
}

fn cloud_air_coordinate(direction: vec3f, size: vec2u, up: vec3f, horizon: f32) -> vec2f {
    let rows = f32(size.y / 2u);
    let axes = level_axes(up);
    let azimuth = atan2(dot(direction, axes[1]), dot(direction, axes[0]));
    let turn = select(azimuth, azimuth + 2.0 * PI, azimuth < 0.0) / (2.0 * PI);
    let off = dot(direction, up) - horizon;
    let v = sqrt(min(abs(off) / select(1.0 + horizon, 1.0 - horizon, off >= 0.0), 1.0));
    let row = v * (rows - 1.0) + select(rows, 0.0, off >= 0.0);
    return (vec2f(turn * f32(size.x - 1u), row) + 0.5) / vec2f(size);
}

fn lost_in_air(table: texture_2d_array<f32>, linear_clamp: sampler, direction: vec3f, up: vec3f, horizon: f32) -> LostInAir {
    let at = cloud_air_coordinate(direction, textureDimensions(table), up, horizon);
    let light = textureSampleLevel(table, linear_clamp, at, 0, 0.0);
    let first = textureSampleLevel(table, linear_clamp, at, 1, 0.0);
    let second = textureSampleLevel(table, linear_clamp, at, 2, 0.0);
    return LostInAir(light.rgb, light.a, first, second);
}

// Of what clear air sends from a place `way_m` on the ray's stretch of air.
fn lost_before(lost: LostInAir, sent: vec3f, way_m: f32) -> vec3f {
    return lost_until(way_m / max(lost.to_m, 1.0), lost.first, lost.second, sent, lost.light);
}

// What clouds have scattered comes from everywhere above, as E/π, E being its irradiance: air of albedo ω that lets `left`
// through sends ω (1 - left) E/2π of it on. What the ground sends back is among the light that is scattered more than once.
fn scattered_under_clouds(air: Air, view: View, shade: CloudShade, transmittance_table: texture_2d<f32>, linear_clamp: sampler, left: vec3f) -> vec3f {
    let h = 0.5 * shade.base_m;
    let c = coefficients_at(air, h, h < air.haze_top_m);
    let albedo = (c.rayleigh_per_m + c.mie_per_m) / max(c.extinction_per_m, vec3f(1e-12));
    let falling = max(view.mu_s, 0.0) * transmittance_to_space(air, transmittance_table, linear_clamp, shade.base_m, view.mu_s);
    return albedo * (1.0 - left) * shade.spread_left * view.sun_irradiance * falling / (2.0 * PI);
}
