// Light scattered towards the observer along one ray, without phase functions, for a sun of unit irradiance.
import package::lib::air::{Air, coefficients_at};
import package::lib::geometry::{altitude_after, cosine_after, shadow_stretch, shell_stretch};
import package::lib::source::source_function;
import package::lib::transmittance::{haze_optical_depth, integrate_optical_depth, tabled_optical_depth};

// A stretch of a ray inside the air.
struct AirRay {
    altitude_m: f32,
    mu: f32,
    mu_s: f32,
    nu: f32,
    length_m: f32,
}

// What is integrated, and how. Constant where it is called, so that nobody pays for what they do not ask for: a
// software device runs both sides of every branch.
struct March {
    // The first order; the others.
    with_sun: bool,
    with_source: bool,
    // There is haze.
    with_haze: bool,
    // The optical depth to the sun is integrated anew at every step, not read from the table.
    nested: bool,
    steps: u32,
    // Steps that share one value of the source function, which is far smoother than the air's density: 1, 2 or 4.
    group: u32,
    // Of the nested integral.
    sun_steps: u32,
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

// ∫ T σ_s S dt. The ray is cut at its lowest point, where the planet's shadow begins and ends and where the haze does,
// so that density, and light or dark, run evenly through each piece. In a piece, steps grow with the square from its
// lower end, where the air is densest; in a dense haze they are closest at the piece's near end. Within a step the
// source is constant and its own attenuation exact (Hillaire 2015): ∫ S e^{-σt} dt = S (1 - e^{-σΔt}) / σ.
fn scatter_along(
    air: Air,
    ray: AirRay,
    transmittance_table: texture_2d<f32>,
    source_table: texture_2d_array<f32>,
    linear_clamp: sampler,
    march: March,
) -> Scattered {
    var sum: Scattered;
    let lowest = clamp(-(air.radius_m + ray.altitude_m) * ray.mu, 0.0, ray.length_m);
    let dark = shadow_stretch(air.radius_m, ray.altitude_m, ray.mu, ray.mu_s, ray.nu, ray.length_m);
    let has_dark = dark.x < dark.y;
    let hazy = shell_stretch(air.radius_m + air.haze_top_m, ray.altitude_m - air.haze_top_m, ray.mu, ray.length_m);
    let has_haze = march.with_haze && hazy.x < hazy.y;
    let end = ray.length_m;
    let cuts = vec4f(select(vec2f(end), dark, has_dark), select(vec2f(end), hazy, has_haze));
    let pieces = 1u + within(lowest, end) + within(cuts.x, end) + within(cuts.y, end) + within(cuts.z, end) + within(cuts.w, end);
    let groups = max(march.steps / (pieces * march.group), LEAST_STEPS / march.group);
    let piece_steps = groups * march.group;
    var from_m = 0.0;
    // Transmittance so far: e^{-optical depth}, step by step.
    var left = vec3f(1.0);
    // At most as many rounds as there are cuts, since each goes to a farther one.
    while from_m < end {
        // The next cut.
        let far_cuts = select(vec4f(end), cuts, cuts > vec4f(from_m));
        let to_m = min(min(min(far_cuts.x, far_cuts.y), min(far_cuts.z, far_cuts.w)), select(end, lowest, lowest > from_m));
        let length_m = to_m - from_m;
        let middle = from_m + 0.5 * length_m;
        let lit = !(has_dark && middle > dark.x && middle < dark.y);
        let in_haze = has_haze && middle > hazy.x && middle < hazy.y;
        let rising = middle > lowest;
        let haze_depth = select(0.0, air.haze_extinction_per_m * length_m, in_haze);
        var near = 0.0;
        for (var g = 0u; g < groups; g++) {
            var source = vec3f(0.0);
            if march.with_source {
                let t = from_m + length_m * share_before(march.with_haze, (f32(g) + 0.5) / f32(groups), haze_depth, rising);
                let h = altitude_after(air.radius_m, ray.altitude_m, ray.mu, t);
                let mu_s = cosine_after(air.radius_m, ray.altitude_m, h, ray.mu_s, ray.nu, t);
                let mu = cosine_after(air.radius_m, ray.altitude_m, h, ray.mu, 1.0, t);
                source = source_function(air, source_table, linear_clamp, h, in_haze, mu, mu_s, ray.nu);
            }
            for (var k = g * march.group; k < (g + 1u) * march.group; k++) {
                let far = share_before(march.with_haze, f32(k + 1u) / f32(piece_steps), haze_depth, rising);
                let at = share_before(march.with_haze, (f32(k) + 0.5) / f32(piece_steps), haze_depth, rising);
                let dt = (far - near) * length_m;
                let t = from_m + at * length_m;
                let h = altitude_after(air.radius_m, ray.altitude_m, ray.mu, t);
                let c = coefficients_at(air, h, in_haze);
                let tau = c.extinction_per_m * dt;
                // (1 - e^{-τ})/τ, by its series where that cancels.
                let passed = exp(-tau);
                let share = select((1.0 - passed) / max(tau, vec3f(1e-6)), 1.0 - 0.5 * tau, tau < vec3f(1e-3));
                let weight = left * share * dt;
                if march.with_sun && lit {
                    let mu_s = cosine_after(air.radius_m, ray.altitude_m, h, ray.mu_s, ray.nu, t);
                    var depth: vec3f;
                    if march.nested {
                        depth = integrate_optical_depth(air, h, mu_s, march.sun_steps);
                    } else {
                        depth = tabled_optical_depth(air, transmittance_table, linear_clamp, h, mu_s);
                    }
                    if march.with_haze {
                        depth += haze_optical_depth(air, h, mu_s);
                    }
                    let lit_weight = weight * exp(-depth);
                    sum.rayleigh += lit_weight * c.rayleigh_per_m;
                    sum.mie += lit_weight * c.mie_per_m;
                }
                if march.with_source {
                    sum.multiple += weight * (c.rayleigh_per_m + c.mie_per_m) * source;
                }
                sum.optical_depth += tau;
                left *= passed;
                near = far;
            }
        }
        from_m = to_m;
    }
    return sum;
}

// In each piece.
const LEAST_STEPS = 4u;
// Beyond e⁻¹⁶ nothing of the haze is seen: the last step takes the rest.
const DEEPEST_HAZE = 16.0;

fn within(cut: f32, end: f32) -> u32 {
    return u32(cut > 0.0 && cut < end);
}

// Share of a piece's length that lies before the share u of its steps.
fn share_before(with_haze: bool, u: f32, haze_depth: f32, rising: bool) -> f32 {
    let squared = select(1.0 - (1.0 - u) * (1.0 - u), u * u, rising);
    if !with_haze || haze_depth <= 1.0 {
        return squared;
    }
    if u >= 1.0 {
        return 1.0;
    }
    // Steps as dense as e^{-τ/8}: closest where most is seen, but not sparse at the far end, where under a low sun light
    // may rise faster along the ray than the haze takes it away.
    let seen = 1.0 - exp(-0.125 * min(haze_depth, DEEPEST_HAZE));
    return -8.0 * log(1.0 - u * seen) / haze_depth;
}
