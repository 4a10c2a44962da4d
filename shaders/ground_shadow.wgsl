// How far towards the light the ground lies before each texel of a map.
import package::lib::ground::{ground};
import package::lib::ground_cast::cast_ground;
import package::lib::ground_shadow::{GroundShadow, texel_origin};

@group(0) @binding(1) var<uniform> shadow: GroundShadow;
// Two texels a word, each from 0 to 1 over the map's depth; 0 where nothing stands.
@group(0) @binding(2) var<storage, read_write> map: array<u32>;

fn depth_at(texel: vec2u) -> f32 {
    let depth_m = 2.0 * shadow.half_m.z;
    let t = cast_ground(texel_origin(shadow, texel), -shadow.light, 0.0, depth_m);
    return select(0.0, 1.0 - t / depth_m, t >= 0.0);
}

@compute @workgroup_size(8, 8)
fn ground_shadow(@builtin(global_invocation_id) id: vec3u) {
    let words = shadow.size_px / 2u;
    if id.x >= words || id.y >= shadow.size_px {
        return;
    }
    let texel = vec2u(2u * id.x, id.y);
    map[id.y * words + id.x] = pack2x16unorm(vec2f(depth_at(texel), depth_at(texel + vec2u(1u, 0u))));
}
