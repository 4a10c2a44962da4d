// What erodes the edges of clouds, tileable: three Worley noises at rising frequency, and their mix.
import package::lib::noise::{stream_of, worley3};

struct Detail {
    seed: u32,
    // Cells to the volume's side.
    frequency: u32,
    // Cells any smaller are lost between the texels.
    finest: u32,
}

@group(0) @binding(0) var<uniform> detail: Detail;
@group(0) @binding(1) var<storage, read_write> texels: array<vec4f>;

@compute @workgroup_size(8, 8, 1)
fn cloud_detail(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let side = 8u * groups.x;
    let place = (vec3f(id) + 0.5) / f32(side);
    var w: array<f32, 5>;
    for (var k = 0u; k < 5u; k++) {
        let frequency = max(detail.frequency, min(detail.frequency << k, detail.finest));
        w[k] = worley3(place, frequency, stream_of(detail.seed, k));
    }
    let weights = vec3f(0.625, 0.25, 0.125);
    let worley = vec3f(
        dot(weights, vec3f(w[0], w[1], w[2])),
        dot(weights, vec3f(w[1], w[2], w[3])),
        dot(weights, vec3f(w[2], w[3], w[4])),
    );
    texels[(id.z * side + id.y) * side + id.x] = vec4f(worley, dot(weights, worley));
}
