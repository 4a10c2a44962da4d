// A ray through the clouds. Whoever imports from here binds what `lib/cloud.wgsl` names, and then this.
import package::lib::air::Air;
import package::lib::cloud::{clouds, lowest_cloud_m};
import package::lib::geometry::{angle_of_cosine, distance_to_air, distance_to_sphere, edge_cosine, over_horizon};
import package::lib::light::View;
import package::lib::source::cosine_of_azimuth;
import package::lib::view_ray::{Observer, enter_air};

@group(0) @binding(8) var<uniform> air: Air;
// The light that counts: the sun, or at night the moon.
@group(0) @binding(9) var<uniform> view: View;

struct CloudRay {
    direction: vec3f,
    mu: f32,
    // With the light.
    nu: f32,
    azimuth: f32,
    zenith_angle: f32,
    ground: bool,
    // To the ground, or farther than anything.
    end_m: f32,
    // To what stands on it, or as far as that.
    stop_m: f32,
    // The stretch in the air.
    air_from_m: f32,
    air_length_m: f32,
    // Even over 0 to 1, from pixel to pixel.
    jitter: f32,
    // Angle that it stands for.
    spread: f32,
}

// Of heaps and gaps coarser pictures show a place of theirs, not the mean of all that they hold.
const COARSEST_PIXEL = 0.0015;
// From lower down no pixel of a final frame holds much of a cloud.
const HIGH_M = 3e4;

// The angle that a pixel of a final frame stands for.
fn spread_of_pixel(pixel_angle: f32) -> f32 {
    return select(0.0, pixel_angle, view.altitude_m > HIGH_M);
}

// A ray that nothing stops.
const ENDLESS_M = 1e12;

// `jitter` is where in each step the clouds are looked at, 0 to 1.
fn cloud_ray(observer: Observer, direction: vec3f, jitter: f32, spread: f32) -> CloudRay {
    let mu = clamp(dot(direction, view.up), -1.0, 1.0);
    let nu = clamp(dot(direction, view.sun), -1.0, 1.0);
    let met_m = distance_to_sphere(air.radius_m, view.altitude_m, mu);
    let ground = met_m >= 0.0;
    let entry = enter_air(air, observer, mu, nu, ground, met_m);
    let end_m = select(ENDLESS_M, met_m, ground);
    let azimuth = angle_of_cosine(cosine_of_azimuth(mu, view.mu_s, nu));
    let from_m = distance_to_air(air.radius_m, air.top_m, view.altitude_m, mu);
    return CloudRay(direction, mu, nu, azimuth, angle_of_cosine(mu), ground, end_m, end_m, from_m, max(entry.length_m, 0.0), jitter, spread);
}

fn place_at(t: f32, direction: vec3f) -> vec3f {
    return clouds.place_m + t * direction;
}

// Where a pixel's ray looks for clouds: from under them, a pixel that the horizon crosses looks into the sky.
fn sight_of_clouds(direction: vec3f, pixel_angle: f32) -> vec3f {
    let reach = select(0.0, 0.5 * pixel_angle, view.altitude_m < lowest_cloud_m());
    return over_horizon(direction, view.up, edge_cosine(air.radius_m, view.altitude_m), reach);
}
