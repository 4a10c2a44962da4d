// From radiance to the picture.
import package::lib::picture::{Exposure, Tone, picture_pixel};

// As `picture_pixel` numbers it.
override CURVE: u32 = 3u;
@group(0) @binding(0) var<uniform> tone_settings: Tone;
@group(0) @binding(1) var<storage, read> exposure: Exposure;
// Alpha as `picture_pixel` takes it.
@group(0) @binding(2) var<storage, read> radiance: array<vec4f>;
@group(0) @binding(3) var<storage, read_write> picture: array<u32>;

@compute @workgroup_size(8, 8)
fn tone(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= tone_settings.size_px) {
        return;
    }
    let i = id.y * tone_settings.size_px.x + id.x;
    picture[i] = picture_pixel(tone_settings, exposure.scale, CURVE, radiance[i], tone_settings.origin_px + tone_settings.stride_px * id.xy);
}
