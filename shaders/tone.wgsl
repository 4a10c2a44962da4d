// From radiance to the picture.
import package::lib::picture::{Exposure, Tone, picture_pixel};

// As `picture_pixel` numbers it.
override CURVE: u32 = 3u;
// True where there are clouds.
override CLOUDS: bool = false;

@group(0) @binding(0) var<uniform> tone_settings: Tone;
@group(0) @binding(1) var<storage, read> exposure: Exposure;
// Alpha as `picture_pixel` takes it.
@group(0) @binding(2) var<storage, read> radiance: array<vec4f>;
@group(0) @binding(3) var<storage, read_write> picture: array<u32>;
// What they let through of the disc that glares, in alpha.
@group(0) @binding(4) var disc_clouds: texture_2d<f32>;
@group(0) @binding(5) var linear_clamp: sampler;

@compute @workgroup_size(8, 8)
fn tone(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= tone_settings.size_px) {
        return;
    }
    let i = id.y * tone_settings.size_px.x + id.x;
    var disc = 1.0;
    if CLOUDS {
        disc = textureSampleLevel(disc_clouds, linear_clamp, vec2f(0.5), 0.0).a;
    }
    picture[i] = picture_pixel(tone_settings, exposure.scale, CURVE, disc, radiance[i], tone_settings.origin_px + id.xy);
}
