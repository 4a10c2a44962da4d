// The ray through the clouds in one direction. Whoever imports from here binds what `lib/cloud_source.wgsl` names.
import package::lib::cloud_light::forward_lobes;
import package::lib::cloud_source::{CloudRay, air, view};
import package::lib::geometry::{angle_of_cosine, distance_to_sphere};
import package::lib::source::cosine_of_azimuth;
import package::lib::view_ray::{Observer, enter_air};

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
    let to_top_m = distance_to_sphere(air.radius_m + air.top_m, view.altitude_m - air.top_m, mu);
    let from_m = select(0.0, to_top_m, view.altitude_m > air.top_m);
    return CloudRay(direction, mu, nu, azimuth, angle_of_cosine(mu), ground, end_m, end_m, from_m, max(entry.length_m, 0.0), jitter, spread, forward_lobes(nu));
}
