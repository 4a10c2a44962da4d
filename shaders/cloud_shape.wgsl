// The shapes of clouds, tileable: Perlin-Worley noise and three Worley noises at rising frequency (Schneider 2015).
import package::lib::noise::{perlin3, stream_of, thousandths, worley3};

struct Shape {
    seed: u32,
    // Cells to the volume's side.
    perlin_frequency: u32,
    worley_frequency: u32,
    // Cells any smaller are lost between the texels.
    finest: u32,
}

@group(0) @binding(0) var<uniform> shape: Shape;
@group(0) @binding(1) var<storage, read_write> texels: array<vec4f>;

// The k-th octave of a noise; no finer than can be kept.
fn octave(frequency: u32, k: u32) -> u32 {
    return max(frequency, min(frequency << k, shape.finest));
}

fn worley_octave(place: vec3f, k: u32) -> f32 {
    return worley3(place, octave(shape.worley_frequency, k), stream_of(shape.seed, k));
}

// Near 0 on average, mostly within -1 to 1. The octaves are moved against each other: each is zero at the corners of its
// cells, and these must not meet.
fn perlin_fbm(place: vec3f) -> f32 {
    var sum = 0.0;
    var weight = 1.0;
    for (var k = 0u; k < 4u; k++) {
        let frequency = octave(shape.perlin_frequency, k);
        let stream = stream_of(shape.seed, 16u + k);
        sum += weight * perlin3(place + thousandths(stream), frequency, stream);
        weight *= 0.5;
    }
    return sum;
}

@compute @workgroup_size(8, 8, 1)
fn cloud_shape(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let side = 8u * groups.x;
    let place = (vec3f(id) + 0.5) / f32(side);
    var w: array<f32, 5>;
    for (var k = 0u; k < 4u; k++) {
        w[k] = worley_octave(place, k);
    }
    w[4] = w[3];
    if octave(shape.worley_frequency, 4u) > octave(shape.worley_frequency, 3u) {
        w[4] = worley_octave(place, 4u);
    }
    let weights = vec3f(0.625, 0.25, 0.125);
    let worley = vec3f(
        dot(weights, vec3f(w[0], w[1], w[2])),
        dot(weights, vec3f(w[1], w[2], w[3])),
        dot(weights, vec3f(w[2], w[3], w[4])),
    );
    // Perlin noise dilated by Worley: remap(perlin, 0, 1, worley, 1).
    let perlin = 0.5 + 0.5 * perlin_fbm(place);
    let perlin_worley = worley.x + perlin * (1.0 - worley.x);
    texels[(id.z * side + id.y) * side + id.x] = vec4f(perlin_worley, worley);
}
