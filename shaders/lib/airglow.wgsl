// Light that the upper air gives off by itself: an even shell that shines evenly, so that its radiance goes with the
// length of the ray in it (van Rhijn 1921): brighter towards the horizon, and a thin arc over the limb from orbit.
import package::lib::geometry::{distance_to_sphere, distance_to_top};

struct Airglow {
    // Radiance per metre of ray, W/m²/sr/m.
    emission_per_m: vec3f,
    base_m: f32,
    // Radiance that air lit by the night sky alone scatters where it is thick.
    scattered: vec3f,
    top_m: f32,
    // On level ground, from the shell and the stars.
    ground_irradiance: vec3f,
    // How much of what the air takes out of a ray it gives back: 1 deep in the air, 0 far above it.
    inside: f32,
    // Optical depth straight up.
    zenith_depth: vec3f,
}

// Where a ray enters and leaves the sphere of altitude `sphere_m`; empty, both zero, where it misses.
fn stretch_inside(radius_m: f32, sphere_m: f32, altitude_m: f32, mu: f32) -> vec2f {
    if altitude_m <= sphere_m {
        return vec2f(0.0, distance_to_top(radius_m, sphere_m, altitude_m, mu));
    }
    let enters = distance_to_sphere(radius_m + sphere_m, altitude_m - sphere_m, mu);
    if enters < 0.0 {
        return vec2f(0.0);
    }
    // The product of the two roots is (h - s)(2R + h + s).
    let product = (altitude_m - sphere_m) * (2.0 * radius_m + altitude_m + sphere_m);
    return vec2f(enters, product / max(enters, 1e-3));
}

// Lengths in the shell before and behind the air under it, of a ray that ends after `length_m`.
fn lengths_in_shell(radius_m: f32, base_m: f32, top_m: f32, altitude_m: f32, mu: f32, length_m: f32) -> vec2f {
    let outer = min(stretch_inside(radius_m, top_m, altitude_m, mu), vec2f(length_m));
    let inner = min(stretch_inside(radius_m, base_m, altitude_m, mu), vec2f(length_m));
    if inner.x >= inner.y {
        return vec2f(outer.y - outer.x, 0.0);
    }
    return vec2f(max(inner.x - outer.x, 0.0), max(outer.y - inner.y, 0.0));
}

// Optical depth that counts for a sky that shines all over, seen from within the air, which scatters into a ray nearly what
// it scatters out of it: f τ₀ with f = 1.669 log10 X - 0.146 at X air masses (Noll et al. 2012 §3, for molecules).
fn depth_of_bright_sky(glow: Airglow, depth: vec3f) -> vec3f {
    let air_masses = max(depth / max(glow.zenith_depth, vec3f(1e-6)), vec3f(1.0));
    let within = glow.zenith_depth * max(1.669 / log2(10.0) * log2(air_masses) - 0.146, vec3f(0.0));
    return mix(depth, within, glow.inside);
}

// Radiance of the shell, and of what the air in front of it scatters of its light.
fn airglow_radiance(glow: Airglow, radius_m: f32, altitude_m: f32, mu: f32, length_m: f32, depth: vec3f) -> vec3f {
    let lengths = lengths_in_shell(radius_m, glow.base_m, glow.top_m, altitude_m, mu, length_m);
    let left = exp(-select(depth, depth_of_bright_sky(glow, depth), lengths.y > 0.0));
    return glow.emission_per_m * (lengths.x + left * lengths.y) + (1.0 - left) * glow.scattered;
}
