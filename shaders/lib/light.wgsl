// What the observer sees in one direction, given the light in the air on the way.
import package::lib::air::Air;
import package::lib::geometry::{PI, angle_between, cosine_after};
import package::lib::phase::{rayleigh_phase, cornette_shanks_phase};
import package::lib::scattering::Scattered;
import package::lib::tables::{light_from_table, sun_cosine_unit, unit_to_coordinate};
import package::lib::transmittance::transmittance_to_space;

struct View {
    // The observer's zenith.
    up: vec3f,
    altitude_m: f32,
    sun: vec3f,
    mu_s: f32,
    sun_irradiance: vec3f,
    sun_angular_radius: f32,
    // Exponents of the limb's darkening, zero for an even disc.
    limb_exponent: vec3f,
    // 1 where the disc is shown.
    disc: f32,
}

// Radiance scattered towards the observer.
fn scattered_radiance(air: Air, view: View, light: Scattered, nu: f32) -> vec3f {
    let single = rayleigh_phase(nu) * light.rayleigh + cornette_shanks_phase(nu, air.mie_asymmetry) * light.mie;
    return view.sun_irradiance * (single + light.multiple);
}

// Radiance at an angle from the centre of a disc of angular radius α that sends the sun's irradiance: E/(π α²) ·
// (n+2)/2 · mu^n with mu = √(1-(γ/α)²) (Neckel and Labs 1994 as a power law, Hestroffer and Magnan 1998). The factor
// keeps the irradiance: ∫ mu^n over the disc is 2/(n+2).
fn disc_radiance(view: View, alpha: f32, angle: f32) -> vec3f {
    if angle > alpha {
        return vec3f(0.0);
    }
    let rim = angle / alpha;
    let mu = sqrt(max(1.0 - rim * rim, 1e-4));
    let darkening = (view.limb_exponent + 2.0) * 0.5 * pow(vec3f(mu), view.limb_exponent);
    // Solid angle of the cap, 2π(1 - cos α) = 4π sin²(α/2).
    let half_sine = sin(0.5 * alpha);
    return darkening * view.sun_irradiance / (4.0 * PI * half_sine * half_sine);
}

// Radiance of the sun's disc in one direction.
fn sun_disc(view: View, direction: vec3f) -> vec3f {
    if view.disc == 0.0 || view.sun_angular_radius <= 0.0 {
        return vec3f(0.0);
    }
    return disc_radiance(view, view.sun_angular_radius, angle_between(direction, view.sun));
}

// What clouds leave of the light on a place of the ground: of the sun's, which comes straight or scattered, and of the
// sky's.
struct Shaded {
    sun: f32,
    sky: f32,
}

const UNSHADED = Shaded(1.0, 1.0);

// Radiance of the ground where the ray meets it, before the air in front: ρ/π (E_sun + E_sky).
fn ground_radiance(
    air: Air,
    view: View,
    nu: f32,
    distance_m: f32,
    transmittance_table: texture_2d<f32>,
    irradiance_table: texture_2d<f32>,
    linear_clamp: sampler,
    shaded: Shaded,
) -> vec3f {
    let mu_s = cosine_after(air.radius_m, view.altitude_m, 0.0, view.mu_s, nu, distance_m);
    let x = unit_to_coordinate(sun_cosine_unit(mu_s), textureDimensions(irradiance_table).x);
    let sky = light_from_table(textureSampleLevel(irradiance_table, linear_clamp, vec2f(x, 0.5), 0.0).rgb);
    let sun = max(mu_s, 0.0) * transmittance_to_space(air, transmittance_table, linear_clamp, 0.0, mu_s);
    return view.sun_irradiance * air.ground_albedo / PI * (shaded.sun * sun + shaded.sky * sky);
}
