// Light scattered towards the observer along one ray, without phase functions, for a sun of unit irradiance.
import package::lib::air::{Air, coefficients_at};
import package::lib::geometry::{altitude_after, cosine_after, shadow_stretch};
import package::lib::moments::source_per_m;
import package::lib::transmittance::optical_depth_to_top;

// A stretch of a ray inside the air.
struct AirRay {
    altitude_m: f32,
    mu: f32,
    mu_s: f32,
    nu: f32,
    length_m: f32,
}

struct Scattered {
    // Times the Rayleigh phase function.
    rayleigh: vec3f,
    // Times the Mie phase function.
    mie: vec3f,
    // Second and higher orders; no phase function.
    multiple: vec3f,
    optical_depth: vec3f,
}

// ∫ T σ_s S dt. The ray is cut at its lowest point and where the planet's shadow begins and ends, so that density,
// and light or dark, run evenly through each piece; steps grow with the square from the piece's lower end, where the
// air is densest. Within a step the source is constant and its own attenuation exact (Hillaire 2015):
// ∫ S e^{-σt} dt = S (1 - e^{-σΔt}) / σ. `with_sun` false leaves the first order out,
// `with_moments` false the others.
fn scatter_along(
    air: Air,
    ray: AirRay,
    transmittance_table: texture_2d<f32>,
    multiple_table: texture_2d_array<f32>,
    linear_clamp: sampler,
    steps: u32,
    with_sun: bool,
    with_moments: bool,
) -> Scattered {
    var sum: Scattered;
    let lowest = clamp(-(air.radius_m + ray.altitude_m) * ray.mu, 0.0, ray.length_m);
    let dark = shadow_stretch(air.radius_m, ray.altitude_m, ray.mu, ray.mu_s, ray.nu, ray.length_m);
    let has_dark = dark.x < dark.y;
    let dark_from = select(ray.length_m, dark.x, has_dark);
    let dark_to = select(ray.length_m, dark.y, has_dark);
    // The cuts in order.
    let first = min(lowest, dark_from);
    let second = max(min(max(lowest, dark_from), dark_to), first);
    let third = max(lowest, dark_to);
    var cuts = array<f32, 5>(0.0, first, second, third, ray.length_m);
    var pieces = 0u;
    for (var i = 0u; i < 4u; i++) {
        pieces += u32(cuts[i + 1u] > cuts[i]);
    }
    let piece_steps = max(steps / max(pieces, 1u), 4u);
    for (var i = 0u; i < 4u; i++) {
        let from_m = cuts[i];
        let to_m = cuts[i + 1u];
        if to_m <= from_m {
            continue;
        }
        let middle = 0.5 * (from_m + to_m);
        let lit = !(has_dark && middle > dark_from && middle < dark_to);
        let rising = middle > lowest;
        for (var k = 0u; k < piece_steps; k++) {
            let a = f32(k) / f32(piece_steps);
            let b = f32(k + 1u) / f32(piece_steps);
            let m = 0.5 * (a + b);
            // Squares from the lower end, which is the near one where the ray rises.
            let near = select(1.0 - (1.0 - a) * (1.0 - a), a * a, rising);
            let far = select(1.0 - (1.0 - b) * (1.0 - b), b * b, rising);
            let at = select(1.0 - (1.0 - m) * (1.0 - m), m * m, rising);
            let dt = (far - near) * (to_m - from_m);
            let t = from_m + at * (to_m - from_m);
            let h = altitude_after(air.radius_m, ray.altitude_m, ray.mu, t);
            let mu_s = cosine_after(air.radius_m, ray.altitude_m, h, ray.mu_s, ray.nu, t);
            let c = coefficients_at(air, h);
            let tau = c.extinction_per_m * dt;
            // (1 - e^{-τ})/τ, by its series where that cancels.
            let share = select((1.0 - exp(-tau)) / max(tau, vec3f(1e-6)), 1.0 - 0.5 * tau, tau < vec3f(1e-3));
            let weight = exp(-sum.optical_depth) * share * dt;
            if lit && with_sun {
                let sun = exp(-optical_depth_to_top(air, transmittance_table, linear_clamp, h, mu_s));
                sum.rayleigh += weight * c.rayleigh_per_m * sun;
                sum.mie += weight * c.mie_per_m * sun;
            }
            if with_moments {
                let mu = cosine_after(air.radius_m, ray.altitude_m, h, ray.mu, 1.0, t);
                sum.multiple += weight * source_per_m(air, c, multiple_table, linear_clamp, h, mu, mu_s, ray.nu);
            }
            sum.optical_depth += tau;
        }
    }
    return sum;
}
