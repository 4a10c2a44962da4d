// Radiance of every pixel of one tile of the picture.
import package::lib::air::Air;
import package::lib::camera::{Camera, sight_at};
import package::lib::geometry::{angle_between, distance_to_sphere, edge_zenith_angle, horizon_distance_squared};
import package::lib::light::{View, ground_radiance, scattered_radiance, sun_disc};
import package::lib::scattering::Scattered;
import package::lib::tables::{SkyViewRay, sky_view_coordinate, least_zenith_angle};

struct Tile {
    origin_px: vec2u,
    size_px: vec2u,
}

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(1) var<uniform> view: View;
@group(0) @binding(2) var<uniform> camera: Camera;
@group(0) @binding(3) var<uniform> tile: Tile;
@group(0) @binding(4) var transmittance_table: texture_2d<f32>;
@group(0) @binding(5) var linear_clamp: sampler;
@group(0) @binding(6) var irradiance_table: texture_2d<f32>;
@group(0) @binding(7) var sky_view_table: texture_2d_array<f32>;
// R, G, B in W/m²/sr; alpha is 0 where the projection sees nothing, else one more than the angle from the sun.
@group(0) @binding(8) var<storage, read_write> radiance: array<vec4f>;

fn light_in_air(ray: SkyViewRay) -> Scattered {
    let at = sky_view_coordinate(air.radius_m, air.top_m, view.altitude_m, ray, textureDimensions(sky_view_table));
    let rayleigh = textureSampleLevel(sky_view_table, linear_clamp, at, 0, 0.0);
    let mie = textureSampleLevel(sky_view_table, linear_clamp, at, 1, 0.0);
    let multiple = textureSampleLevel(sky_view_table, linear_clamp, at, 2, 0.0);
    return Scattered(rayleigh.rgb, mie.rgb, multiple.rgb, vec3f(rayleigh.a, mie.a, multiple.a));
}

fn radiance_towards(direction: vec3f) -> vec3f {
    let mu = dot(direction, view.up);
    let zenith_angle = angle_between(direction, view.up);
    let nu = clamp(dot(direction, view.sun), -1.0, 1.0);
    // Azimuth from the sun, by the parts across the zenith.
    let across = direction - mu * view.up;
    let across_sun = view.sun - view.mu_s * view.up;
    // At the zenith there is no azimuth and any will do, but atan2(0, 0) is undefined.
    let azimuth = atan2(length(cross(across, across_sun)), dot(across, across_sun) + 1e-20);
    let horizon = edge_zenith_angle(air.radius_m, view.altitude_m);
    // Share of the pixel above the horizon, for an even edge.
    let above = clamp(0.5 + (horizon - zenith_angle) / camera.pixel_angle, 0.0, 1.0);
    var sum = vec3f(0.0);
    if above > 0.0 {
        let angle = min(zenith_angle, horizon);
        if angle >= least_zenith_angle(air.radius_m, air.top_m, view.altitude_m) {
            let light = light_in_air(SkyViewRay(azimuth, angle, false, 0.0));
            sum += above * (scattered_radiance(air, view, light, nu) + exp(-light.optical_depth) * sun_disc(view, direction, camera.pixel_angle));
        } else {
            sum += above * sun_disc(view, direction, camera.pixel_angle);
        }
    }
    if above < 1.0 {
        // The edge of the sphere where the pixel's centre is just above it.
        let met_m = distance_to_sphere(air.radius_m, view.altitude_m, mu);
        let edge_m = sqrt(horizon_distance_squared(air.radius_m, view.altitude_m));
        let distance_m = select(met_m, edge_m, met_m < 0.0);
        let light = light_in_air(SkyViewRay(azimuth, zenith_angle, true, distance_m));
        let ground = ground_radiance(air, view, nu, distance_m, transmittance_table, irradiance_table, linear_clamp);
        sum += (1.0 - above) * (scattered_radiance(air, view, light, nu) + exp(-light.optical_depth) * ground);
    }
    return sum;
}

@compute @workgroup_size(8, 8)
fn sky(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= tile.size_px) {
        return;
    }
    let sight = sight_at(camera, vec2f(tile.origin_px + id.xy) + 0.5);
    var value = vec4f(0.0);
    if sight.seen {
        let off_sun = angle_between(sight.direction, view.sun);
        value = vec4f(radiance_towards(sight.direction), 1.0 + off_sun);
    }
    radiance[id.y * tile.size_px.x + id.x] = value;
}
