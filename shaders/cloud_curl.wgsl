// A flow without sources that bends the lookup of the detail, tileable.
import package::lib::noise::curl2;

struct Curl {
    seed: u32,
}

@group(0) @binding(0) var<uniform> curl: Curl;
@group(0) @binding(1) var<storage, read_write> texels: array<vec4f>;

@compute @workgroup_size(8, 8)
fn cloud_curl(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let side = 8u * groups.x;
    let place = (vec2f(id.xy) + 0.5) / f32(side);
    // Eddies of a fifth, an eleventh and a 25th of the tile; slopes go with the frequency, so that a gain of 0.25 makes the
    // smaller ones half as fast.
    texels[id.y * side + id.x] = vec4f(curl2(place, vec2i(3, 4), 3u, 0.25, curl.seed), 0.0);
}
