// For each band and sheet of clouds the optical depth towards the light, by where the way to it crosses their middle.
import package::lib::cloud::{band_at, clouds, sheet_optical_depth};
import package::lib::cloud_shade::{CloudShade, LOWER_SHARES, UPPER_SHARES, depth_to_map, light_cosine, shade_place};
import package::lib::cloud_volume::coarse_extinction;

struct Shadow {
    light: vec3f,
    // Between two heights no step is longer, unless that many do not reach.
    step_m: f32,
    most_steps: f32,
}

@group(0) @binding(8) var<uniform> shade: CloudShade;
@group(0) @binding(9) var<uniform> shadow: Shadow;
@group(0) @binding(10) var linear_clamp: sampler;
@group(0) @binding(11) var volume: texture_3d<f32>;
@group(0) @binding(12) var maps: texture_storage_2d_array<rgba32float, write>;

// The place on a sphere of altitude h, that way from the origin along the sphere.
fn place_on(along_m: vec2f, altitude_m: f32) -> vec3f {
    let way = length(along_m);
    let angle = way / clouds.radius_m;
    let r = clouds.radius_m + altitude_m;
    let towards = along_m / max(way, 1e-3);
    // r cos(angle) - R, without the difference of two large numbers.
    let half_sine = sin(0.5 * angle);
    return vec3f(towards * r * sin(angle), altitude_m - 2.0 * r * half_sine * half_sine);
}

@compute @workgroup_size(8, 8)
fn cloud_shadow(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(maps);
    if any(id.xy >= size) || id.z >= clouds.band_count + clouds.sheet_count {
        return;
    }
    let along_m = shade_place(shade, (vec2f(id.xy) + 0.5) / vec2f(size));
    let middle_m = shade.middles_m[id.z / 4u][id.z % 4u];
    let p = place_on(along_m, middle_m);
    let up = normalize(p + vec3f(0.0, 0.0, clouds.radius_m));
    let mu = light_cosine(dot(up, shadow.light));
    var upper = vec4f(0.0);
    var lower = vec4f(0.0);
    // The bands stand first.
    if id.z >= clouds.band_count {
        upper = vec4f(sheet_optical_depth(clouds.sheets[id.z - clouds.band_count], p, middle_m) / abs(mu));
        lower = upper;
    } else {
        let band = band_at(id.z);
        var h = band.top_m;
        var depth = 0.0;
        for (var k = 0u; k < 8u; k++) {
            let share = dot(select(vec4f(0.0), UPPER_SHARES, vec4u(0u, 1u, 2u, 3u) == vec4u(k)) + select(vec4f(0.0), LOWER_SHARES, vec4u(4u, 5u, 6u, 7u) == vec4u(k)), vec4f(1.0));
            let below_m = mix(band.top_m, band.base_m, share);
            let steps = clamp(ceil((h - below_m) / shadow.step_m), 1.0, shadow.most_steps);
            let step_m = (h - below_m) / steps;
            for (var i = 0.5; i < steps; i += 1.0) {
                let at_m = h - i * step_m;
                let at = p + (at_m - middle_m) / mu * shadow.light;
                depth += coarse_extinction(volume, linear_clamp, band, at, at_m) * step_m / abs(mu);
            }
            h = below_m;
            upper = select(upper, vec4f(depth), vec4u(0u, 1u, 2u, 3u) == vec4u(k));
            lower = select(lower, vec4f(depth), vec4u(4u, 5u, 6u, 7u) == vec4u(k));
        }
    }
    textureStore(maps, id.xy, 2u * id.z, depth_to_map(upper));
    textureStore(maps, id.xy, 2u * id.z + 1u, depth_to_map(lower));
}
