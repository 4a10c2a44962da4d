// The clouds at exact directions.
import package::lib::cloud_march::march_clouds;
import package::lib::cloud_ray::cloud_ray;
import package::lib::cloud_seen::clouds_seen;
import package::lib::view_ray::Observer;

@group(0) @binding(18) var<storage, read> directions: array<vec4f>;
@group(0) @binding(19) var<uniform> observer: Observer;
// Radiance to add in R, G, B; alpha is the share of what lies behind that comes through.
@group(0) @binding(20) var<storage, read_write> answers: array<vec4f>;

@compute @workgroup_size(64)
fn cloud_probe(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&directions) {
        return;
    }
    // The middle of each step: an answer stands alone, no neighbour averages it.
    let ray = cloud_ray(observer, directions[id.x].xyz, 0.5, 0.0);
    answers[id.x] = clouds_seen(ray, march_clouds(ray));
}
