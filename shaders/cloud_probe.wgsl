// The clouds at exact directions.
import package::lib::cloud_march::march_clouds;
import package::lib::cloud_ray::cloud_ray;
import package::lib::cloud_seen::clouds_seen;
import package::lib::shaft_lattice::Lost;
import package::lib::view_ray::Observer;

// True where more than the sphere stands on the ground.
override GROUND: bool = false;
// True where shafts fall through the air.
override SHAFTS: bool = false;

@group(0) @binding(22) var<storage, read> directions: array<vec4f>;
@group(0) @binding(23) var<uniform> observer: Observer;
// Radiance to add in R, G, B; alpha is the share of what lies behind that comes through.
@group(0) @binding(24) var<storage, read_write> answers: array<vec4f>;
// In alpha, how far away that is; else -1.
@group(0) @binding(25) var<storage, read> lit_ground: array<vec4f>;
// What each direction loses to shafts.
@group(0) @binding(26) var<storage, read> lost_to_shafts: array<Lost>;

@compute @workgroup_size(64)
fn cloud_probe(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&directions) {
        return;
    }
    // The middle of each step: an answer stands alone, no neighbour averages it.
    var ray = cloud_ray(observer, directions[id.x].xyz, 0.5, 0.0);
    if GROUND {
        let distance_m = lit_ground[id.x].w;
        ray.stop_m = select(ray.end_m, distance_m, distance_m >= 0.0);
    }
    var lost: Lost;
    if SHAFTS {
        lost = lost_to_shafts[id.x];
    }
    answers[id.x] = clouds_seen(ray, march_clouds(ray), lost);
}
