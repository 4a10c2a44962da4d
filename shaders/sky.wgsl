// Radiance of every pixel of one tile of the picture.
import package::lib::air::Air;
import package::lib::camera::{Camera, sight_at};
import package::lib::geometry::{angle_between, distance_to_sphere, edge_zenith_angle, horizon_distance_squared};
import package::lib::light::{View, disc_radiance, ground_radiance, scattered_radiance};
import package::lib::scattering::{March, Scattered, scatter_along};
import package::lib::tables::{SkyViewRay, sky_view_coordinate, least_zenith_angle};
import package::lib::view_ray::{Observer, enter_air};

// 0: light in the air from the sky-view table; 1: integrated along each pixel's ray, 2: with the optical depth to the
// sun integrated in every step of it.
override METHOD: u32 = 0u;
// False for the first order alone.
override MULTIPLE: bool = true;

struct Tile {
    origin_px: vec2u,
    size_px: vec2u,
}

@group(0) @binding(0) var<uniform> air: Air;
@group(0) @binding(1) var<uniform> view: View;
@group(0) @binding(2) var<uniform> camera: Camera;
@group(0) @binding(3) var<uniform> tile: Tile;
@group(0) @binding(4) var<uniform> observer: Observer;
@group(0) @binding(5) var transmittance_table: texture_2d<f32>;
@group(0) @binding(6) var linear_clamp: sampler;
@group(0) @binding(7) var irradiance_table: texture_2d<f32>;
// Whichever of the two the method reads.
@group(0) @binding(8) var sky_view_table: texture_2d_array<f32>;
@group(0) @binding(9) var source_table: texture_2d_array<f32>;
// R, G, B in W/m²/sr; alpha is 0 where the projection sees nothing, else one more than the angle from the sun.
@group(0) @binding(10) var<storage, read_write> radiance: array<vec4f>;

fn light_in_air(ray: SkyViewRay, mu: f32, nu: f32) -> Scattered {
    if METHOD != 0u {
        var light: Scattered;
        let entry = enter_air(air, observer, mu, nu, ray.ground, ray.distance_m);
        if entry.length_m > 0.0 {
            let march = March(true, MULTIPLE, METHOD == 2u, observer.steps, observer.sun_steps);
            light = scatter_along(air, entry, transmittance_table, source_table, linear_clamp, march);
        }
        return light;
    }
    let at = sky_view_coordinate(air.radius_m, air.top_m, view.altitude_m, ray, textureDimensions(sky_view_table));
    let rayleigh = textureSampleLevel(sky_view_table, linear_clamp, at, 0, 0.0);
    let mie = textureSampleLevel(sky_view_table, linear_clamp, at, 1, 0.0);
    let multiple = textureSampleLevel(sky_view_table, linear_clamp, at, 2, 0.0);
    return Scattered(rayleigh.rgb, mie.rgb, multiple.rgb, vec3f(rayleigh.a, mie.a, multiple.a));
}

// Places along each side of a pixel at which the disc is looked at.
const DISC_PLACES = 12;

// Mean radiance of the sun's disc over a pixel, so that a frame holds the sun's irradiance however large its pixels
// are. A disc that is smaller than a pixel is drawn as large as a pixel and as much fainter.
fn disc_in_pixel(place: vec2f, direction: vec3f) -> vec3f {
    let angle = angle_between(direction, view.sun);
    // Nowhere in any projection is a pixel far larger than at the centre.
    if view.disc == 0.0 || view.sun_angular_radius <= 0.0 || angle > view.sun_angular_radius + 4.0 * camera.pixel_angle {
        return vec3f(0.0);
    }
    // From the centre to the corners; not quite, since a cubemap's next face begins there.
    let falling = angle_between(direction, sight_at(camera, place + vec2f(0.49, 0.49)).direction);
    let rising = angle_between(direction, sight_at(camera, place + vec2f(0.49, -0.49)).direction);
    let reach = max(falling, rising);
    let alpha = max(view.sun_angular_radius, reach);
    if angle + 3.0 * reach < alpha {
        return disc_radiance(view, alpha, angle);
    }
    var sum = vec3f(0.0);
    for (var i = 0; i < DISC_PLACES * DISC_PLACES; i++) {
        let at = (vec2f(f32(i % DISC_PLACES), f32(i / DISC_PLACES)) + 0.5) / f32(DISC_PLACES) - 0.5;
        sum += disc_radiance(view, alpha, angle_between(sight_at(camera, place + at).direction, view.sun));
    }
    return sum / f32(DISC_PLACES * DISC_PLACES);
}

fn radiance_towards(direction: vec3f, disc: vec3f) -> vec3f {
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
            let light = light_in_air(SkyViewRay(azimuth, angle, false, 0.0), mu, nu);
            sum += above * (scattered_radiance(air, view, light, nu) + exp(-light.optical_depth) * disc);
        } else {
            sum += above * disc;
        }
    }
    if above < 1.0 {
        // The edge of the sphere where the pixel's centre is just above it.
        let met_m = distance_to_sphere(air.radius_m, view.altitude_m, mu);
        let edge_m = sqrt(horizon_distance_squared(air.radius_m, view.altitude_m));
        let distance_m = select(met_m, edge_m, met_m < 0.0);
        let light = light_in_air(SkyViewRay(azimuth, zenith_angle, true, distance_m), mu, nu);
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
    let place = vec2f(tile.origin_px + id.xy) + 0.5;
    let sight = sight_at(camera, place);
    var value = vec4f(0.0);
    if sight.seen {
        let off_sun = angle_between(sight.direction, view.sun);
        value = vec4f(radiance_towards(sight.direction, disc_in_pixel(place, sight.direction)), 1.0 + off_sun);
    }
    radiance[id.y * tile.size_px.x + id.x] = value;
}
