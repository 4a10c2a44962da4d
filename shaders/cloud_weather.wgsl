// Where clouds stand, of what type, and where it rains, tileable. Only the order of the values counts: they are spread
// evenly over 0 to 1 afterwards. Lengths in the comments are for a map of 60 km.
import package::lib::noise::{billows2, fbm2, stream_of};

struct Weather {
    seed: u32,
}

@group(0) @binding(0) var<uniform> weather: Weather;
@group(0) @binding(1) var<storage, read_write> texels: array<vec4f>;

fn stream(index: u32) -> u32 {
    return stream_of(weather.seed, index);
}

// Moved by noise, so that no shape keeps the straight edges of its cells.
fn warp(place: vec2f, first: vec2i, octaves: u32, length: f32, index: u32) -> vec2f {
    var by: vec2f;
    for (var c = 0u; c < 2u; c++) {
        by[c] = fbm2(place, first, octaves, 0.5, stream(index + c)).x;
    }
    return place + length * by;
}

@compute @workgroup_size(8, 8)
fn cloud_weather(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let side = 8u * groups.x;
    let place = (vec2f(id.xy) + 0.5) / f32(side);
    let bent = warp(place, vec2i(3, 4), 2u, 0.02, 0u);

    // Clusters and lanes of 27 to 12 km, heaps of 6 to 1 km in them, ragged at the edges.
    let clusters = fbm2(bent, vec2i(2, 1), 3u, 0.6, stream(2u)).x;
    let heaps = billows2(warp(bent, vec2i(2, 11), 1u, 0.008, 3u), vec2i(9, 4), stream(5u));
    let ragged = fbm2(bent, vec2i(9, 4), 4u, 0.65, stream(6u)).x;
    let coverage = 0.8 * clusters + 1.2 * heaps + 0.3 * ragged;

    // Types change over 27 to 10 km; large clusters grow taller.
    let slow = fbm2(warp(place, vec2i(2, 1), 2u, 0.05, 7u), vec2i(2, 1), 3u, 0.45, stream(9u)).x;
    let cloud_type = slow + 0.35 * clusters + 0.15 * ragged;

    // Rain falls from the thick of tall clouds.
    let showers = fbm2(bent, vec2i(2, 1), 4u, 0.55, stream(10u)).x;
    let rain = 0.8 * (clusters + 0.5 * heaps) + 0.8 * slow + 0.45 * showers;

    // Small heaps by themselves, 2.4 to 0.5 km.
    let fine = billows2(warp(bent, vec2i(24, 7), 1u, 0.003, 11u), vec2i(24, 7), stream(13u))
        + 0.35 * fbm2(bent, vec2i(3, 4), 4u, 0.7, stream(14u)).x;
    texels[id.y * side + id.x] = vec4f(coverage, cloud_type, rain, fine);
}
