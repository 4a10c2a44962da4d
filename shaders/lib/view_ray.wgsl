// From the observer, who may stand outside the air, to the stretch of the ray inside it.
import package::lib::air::Air;
import package::lib::geometry::{distance_to_sphere, distance_to_top};
import package::lib::scattering::AirRay;

struct Observer {
    altitude_m: f32,
    // Cosine and sine of the sun's angle with the observer's zenith.
    mu_s: f32,
    sin_s: f32,
    // Along the ray of view, and along each ray to the sun where those are integrated on the way.
    steps: u32,
    sun_steps: u32,
}

// The stretch inside the air of the ray with cosines `mu` to the zenith and `nu` to the sun; it ends on the ground
// `ground_m` from the observer where `ground` is true. Its length is not positive where the ray misses the air. From
// outside, the ray starts anew where it enters: the altitude there is exact.
fn enter_air(air: Air, observer: Observer, mu: f32, nu: f32, ground: bool, ground_m: f32) -> AirRay {
    let h = observer.altitude_m;
    if h <= air.top_m {
        let length_m = select(distance_to_top(air.radius_m, air.top_m, h, mu), ground_m, ground);
        return AirRay(h, mu, observer.mu_s, nu, length_m);
    }
    let to_air = distance_to_sphere(air.radius_m + air.top_m, h - air.top_m, mu);
    if to_air < 0.0 {
        return AirRay(air.top_m, mu, observer.mu_s, nu, 0.0);
    }
    let r = air.radius_m + h;
    let r_top = air.radius_m + air.top_m;
    let mu_in = clamp((r * mu + to_air) / r_top, -1.0, 0.0);
    let mu_s_in = clamp((r * observer.mu_s + to_air * nu) / r_top, -1.0, 1.0);
    let length_m = select(-2.0 * r_top * mu_in, ground_m - to_air, ground);
    return AirRay(air.top_m, mu_in, mu_s_in, nu, length_m);
}
