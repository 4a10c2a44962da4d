// For each band and sheet of clouds the optical depth towards the light, by where the way to it crosses their middle.
import package::lib::cloud::{band_extinction, clouds, sheet_optical_depth};
import package::lib::cloud_shade::{CloudShade, shade_place};
import package::lib::geometry::{altitude_after, shell_stretch};

struct Shadow {
    light: vec3f,
    steps: u32,
}

@group(0) @binding(8) var<uniform> shade: CloudShade;
@group(0) @binding(9) var<uniform> shadow: Shadow;
@group(0) @binding(10) var maps: texture_storage_2d_array<rgba32float, write>;

// The ray may be no lower than this: beyond, it goes through the layer for ever.
const LEAST_COSINE = 0.03;

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
    if any(id.xy >= size) || id.z >= shade.count {
        return;
    }
    let along_m = shade_place(shade, (vec2f(id.xy) + 0.5) / vec2f(size));
    let middle_m = shade.middles_m[id.z / 4u][id.z % 4u];
    let p = place_on(along_m, middle_m);
    let up = normalize(p + vec3f(0.0, 0.0, clouds.radius_m));
    let mu = max(abs(dot(up, shadow.light)), LEAST_COSINE);
    var depth = 0.0;
    // The bands stand first.
    if id.z >= clouds.band_count {
        depth = sheet_optical_depth(clouds.sheets[id.z - clouds.band_count], p, middle_m) / mu;
    } else {
        let band = clouds.bands[id.z];
        let half_m = 0.5 * (band.top_m - band.base_m) / mu;
        for (var k = 0u; k < shadow.steps; k++) {
            let t = (2.0 * (f32(k) + 0.5) / f32(shadow.steps) - 1.0) * half_m;
            let at = p + t * shadow.light;
            let h = middle_m + t * mu;
            depth += band_extinction(band, at, h, false, 0.0).value * 2.0 * half_m / f32(shadow.steps);
        }
    }
    textureStore(maps, id.xy, id.z, vec4f(depth, 0.0, 0.0, 0.0));
}
