// The pillar of a light far beyond the plates: sun or moon.
//
// With d to infinity the lamp's formula becomes L = (N A / 4) E ∫ D(δ) R(ε) T dt along the ray, with the plates' axis
// along s - v whatever the distance. Far plates lie under another zenith, so that the ray is followed.
import package::lib::air::Air;
import package::lib::geometry::{altitude_after, distance_to_top, shell_stretch};
import package::lib::pillar::{Crystals, plate_reflectance, tilted_per_sr};
import package::lib::pillar_lamp::{ice, clumped};
import package::lib::transmittance::optical_depth_to_top;

struct Distant {
    // In the observer's own frame, as all directions here.
    direction: vec3f,
    angular_radius: f32,
    // Above the air, W/m².
    irradiance: vec3f,
}

const STEPS = 8u;

// Below the altitude, from inside or outside of the sphere.
fn below(air: Air, top_m: f32, altitude_m: f32, mu: f32, end_m: f32) -> vec2f {
    return shell_stretch(air.radius_m + top_m, altitude_m - top_m, mu, end_m);
}

// Optical depth of the air between the observer and a place that lies `t` along a ray.
fn depth_to(air: Air, table: texture_2d<f32>, linear_clamp: sampler, observer_m: f32, mu: f32, place_m: f32, t: f32) -> vec3f {
    let mu_there = clamp(((air.radius_m + observer_m) * mu + t) / (air.radius_m + place_m), -1.0, 1.0);
    // Of both ends' ways to space the one that rises.
    let rises = mu_there >= 0.0;
    let near = optical_depth_to_top(air, table, linear_clamp, select(place_m, observer_m, rises), select(-mu_there, mu, rises));
    let far = optical_depth_to_top(air, table, linear_clamp, select(observer_m, place_m, rises), select(-mu, mu_there, rises));
    return max(near - far, vec3f(0.0));
}

// Share of the light's disc over the horizon of a place.
fn over_horizon(air: Air, altitude_m: f32, mu: f32, angular_radius: f32) -> f32 {
    let dip = sqrt(altitude_m * (2.0 * air.radius_m + altitude_m)) / (air.radius_m + altitude_m);
    return smoothstep(-angular_radius, max(angular_radius, 1e-5), asin(clamp(mu, -1.0, 1.0)) + asin(dip));
}

// Radiance along a ray that ends at `end_m`, W/m²/sr.
fn distant_pillar(air: Air, table: texture_2d<f32>, linear_clamp: sampler, light: Distant, v: vec3f, end_m: f32) -> vec3f {
    let s = light.direction;
    let half_way = normalize(s - v);
    let across = normalize(cross(s, v) + vec3f(0.0, 0.0, 1e-20));
    let along = cross(across, half_way);
    // The disc, half its radius to each side, turns the axis by half as much in the plane of light and ray, and across it by
    // that over |s - v|.
    let apart = max(length(s - v), 1e-6);
    let blur = 0.5 * light.angular_radius * vec2f(1.0 / apart, 0.5);
    let cos_e = 0.5 * apart;
    var found = vec3f(0.0);
    for (var i = 0u; i < ice.count; i++) {
        let layer = ice.layers[i];
        let base_m = layer.base_m + ice.altitude_m;
        let top_m = layer.top_m + ice.altitude_m;
        let spread = select(layer.sigma, 0.5 * layer.sin_max, layer.law == 1u);
        let narrowed = inverseSqrt(1.0 + blur * blur / (spread * spread));
        // No plate on the ray lies under a zenith farther off than this: beyond are no pillars.
        let whole = below(air, top_m, ice.altitude_m, v.z, end_m);
        if whole.x >= whole.y {
            continue;
        }
        let under = below(air, base_m, ice.altitude_m, v.z, end_m);
        var ends = whole;
        if under.x < under.y {
            ends = select(vec2f(whole.x, under.x), vec2f(under.y, whole.y), under.x <= whole.x);
        }
        let turned = ends.y / (air.radius_m + ice.altitude_m);
        let off = narrowed * vec2f(dot(across, vec3f(0.0, 0.0, 1.0)), dot(along, vec3f(0.0, 0.0, 1.0)));
        if ends.x >= ends.y || length(off) > layer.sin_max + turned {
            continue;
        }
        let reflected = layer.face_per_m * 0.25 * narrowed.x * narrowed.y * plate_reflectance(cos_e, layer.outer);
        let step_m = (ends.y - ends.x) / f32(STEPS);
        var sum = vec3f(0.0);
        for (var k = 0u; k < STEPS; k++) {
            let t = ends.x + (f32(k) + 0.5) * step_m;
            let zenith = normalize(vec3f(0.0, 0.0, air.radius_m + ice.altitude_m) + t * v);
            let tilt = narrowed * vec2f(dot(across, zenith), dot(along, zenith));
            let density = tilted_per_sr(layer, dot(tilt, tilt));
            if density == 0.0 {
                continue;
            }
            let h = max(altitude_after(air.radius_m, ice.altitude_m, v.z, t), 0.0);
            let mu = dot(s, zenith);
            let seen = over_horizon(air, h, mu, light.angular_radius);
            let grazing = -sqrt(h * (2.0 * air.radius_m + h)) / (air.radius_m + h);
            let in_base = below(air, base_m, h, mu, 1e9);
            let in_layer = distance_to_top(air.radius_m, top_m, min(h, top_m), mu) - max(in_base.y - in_base.x, 0.0);
            let depth = optical_depth_to_top(air, table, linear_clamp, h, max(mu, grazing))
                + depth_to(air, table, linear_clamp, ice.altitude_m, v.z, h, t)
                + layer.extinction_per_m * (max(in_layer, 0.0) + t - ends.x);
            sum += seen * density * clumped(layer, t * v) * exp(-depth);
        }
        found += reflected * step_m * sum;
    }
    return found * light.irradiance;
}
