// How high over the sphere the ground lies under each lamp.
import package::lib::ground::{ground, height_at};
import package::lib::ground_cast::cast_ground;

// In the ground's own frame.
@group(0) @binding(1) var<storage, read> places: array<vec4f>;
@group(0) @binding(2) var<storage, read_write> heights_m: array<f32>;

@compute @workgroup_size(64)
fn lamp_heights(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&places) {
        return;
    }
    let from_m = vec3f(places[id.x].xy, ground.highest_m + 10.0);
    let down = vec3f(0.0, 0.0, -1.0);
    let t = cast_ground(from_m, down, 0.0, 1e5);
    heights_m[id.x] = select(0.0, max(height_at(from_m + t * down), 0.0), t >= 0.0);
}
