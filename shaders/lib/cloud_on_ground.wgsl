// What stands on the ground keeps light from the clouds beside and under it. Whoever imports from here binds what
// `lib/cloud_source.wgsl` names, and then this.
import package::lib::ground_shadow::{GroundShadow, map_place, passes_over, texel_word};

// True where something that stands may do so.
override SHADED: bool = false;

// By places in the scene, not in the ground's frame.
@group(0) @binding(18) var<uniform> ground_shadow: GroundShadow;
@group(0) @binding(19) var<storage, read> ground_shadow_map: array<u32>;

fn is_lit(texel: vec2i, depth: f32) -> f32 {
    let word = texel_word(ground_shadow, texel);
    if word < 0 {
        return 1.0;
    }
    return passes_over(ground_shadow_map[word], texel, depth);
}

// Share of the light that reaches a place of the scene, between four texels of the map.
fn lit_past_ground(p: vec3f) -> f32 {
    if !SHADED {
        return 1.0;
    }
    let place = map_place(ground_shadow, p);
    let at = place.at - 0.5;
    let first = vec2i(floor(at));
    let share = at - vec2f(first);
    let below = mix(is_lit(first, place.depth), is_lit(first + vec2i(1, 0), place.depth), share.x);
    let above = mix(is_lit(first + vec2i(0, 1), place.depth), is_lit(first + vec2i(1, 1), place.depth), share.x);
    return mix(below, above, share.y);
}
