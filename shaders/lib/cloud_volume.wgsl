// The coarse extinction of all layers about the observer, kept in a volume: the light's way through them is followed there.
// Whoever imports from here binds what `lib/cloud.wgsl` names.
import package::lib::cloud::{COARSE, CloudBand, band_extinction, clouds, layer_at, one_or};
import package::lib::geometry::along_sphere;

// True where there is such a volume.
override VOLUME: bool = false;

// Half its side.
const VOLUME_REACH_M = 1.2e5;

// Texels stand closer by the square towards the observer.
fn volume_place(texel: vec2u, size: vec2u) -> vec2f {
    let u = 2.0 * (vec2f(texel) + 0.5) / vec2f(size) - 1.0;
    return clouds.place_m.xy + VOLUME_REACH_M * u * abs(u);
}

// The layers stand one on the other, each with as many levels. `share` is of a layer's height.
fn volume_coordinate(index: u32, count: u32, along_m: vec2f, share: f32, levels: f32) -> vec3f {
    let d = (along_m - clouds.place_m.xy) / VOLUME_REACH_M;
    let level = f32(index) * levels + clamp(share * levels, 0.5, levels - 0.5);
    return vec3f(0.5 + 0.5 * sign(d) * sqrt(abs(d)), level / (f32(count) * levels));
}

// Extinction coefficient without the detail noise at a place of a band, 1/m.
fn coarse_extinction(volume: texture_3d<f32>, linear_clamp: sampler, band: CloudBand, p: vec3f, altitude_m: f32) -> f32 {
    if VOLUME {
        let along_m = along_sphere(clouds.radius_m, p, altitude_m);
        let depth = textureDimensions(volume).z;
        let count = one_or(clouds.layer_count);
        var sum = 0.0;
        for (var i = 0u; i < one_or(band.count); i++) {
            let layer = layer_at(band.first + i);
            let share = (altitude_m - layer.base_m) * layer.inverse_thickness_per_m;
            if share > 0.0 && share < 1.0 {
                let at = volume_coordinate(band.first + i, count, along_m, share, f32(depth / count));
                sum += textureSampleLevel(volume, linear_clamp, at, 0.0).r;
            }
        }
        return sum;
    }
    return band_extinction(band, p, altitude_m, COARSE).value;
}
