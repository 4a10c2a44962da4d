// Whether the sun reaches a place, past what stands on the ground. Whoever imports from here binds what `lib/ground.wgsl`
// names, and this.
import package::lib::ground_cast::cast_ground;
import package::lib::ground_shadow::{GroundShadow, lifted, map_place, passes_over, texel_word};

// 0: nothing casts a shadow; 1: by the map; 2: by rays.
override SHADOW: u32 = 1u;
// 0: the nearest texel; 1: between four; 2: a bell over sixteen.
override FILTER: u32 = 2u;

@group(0) @binding(1) var<uniform> shadow: GroundShadow;
@group(0) @binding(2) var<storage, read> shadow_map: array<u32>;

// 1 where the light passes over the texel to that depth, else 0.
fn is_lit(texel: vec2i, depth: f32) -> f32 {
    let word = texel_word(shadow, texel);
    if word < 0 {
        return 1.0;
    }
    return passes_over(shadow_map[word], texel, depth);
}

// Standard deviation of the bell, texels.
const BELL = 0.9;

// Share of the light that reaches p, as the map has it (percentage-closer filtering, Reeves, Salesin and Cook 1987).
fn lit_share(p: vec3f) -> f32 {
    let place = map_place(shadow, p);
    if FILTER == 0u {
        return is_lit(vec2i(floor(place.at)), place.depth);
    }
    let at = place.at - 0.5;
    let first = vec2i(floor(at));
    let share = at - vec2f(first);
    if FILTER == 1u {
        let below = mix(is_lit(first, place.depth), is_lit(first + vec2i(1, 0), place.depth), share.x);
        let above = mix(is_lit(first + vec2i(0, 1), place.depth), is_lit(first + vec2i(1, 1), place.depth), share.x);
        return mix(below, above, share.y);
    }
    var sum = 0.0;
    var weights = 0.0;
    for (var k = 0; k < 16; k++) {
        let off = vec2i(k & 3, k >> 2u) - 1;
        let away = vec2f(off) - share;
        let weight = exp(-0.5 * dot(away, away) / (BELL * BELL));
        sum += weight * is_lit(first + off, place.depth);
        weights += weight;
    }
    return sum / weights;
}

// A ray ends here: the farthest that a shadow falls.
const FARTHEST_M = 1e6;

// Share of the sun's light that reaches a place on a surface.
fn sun_on_surface(p: vec3f, normal: vec3f, pixel_m: f32) -> f32 {
    if SHADOW == 1u {
        return lit_share(lifted(shadow, p, normal));
    }
    if SHADOW == 2u {
        // Off the surface by what a ray of view may be off.
        let start = p + (0.02 + 0.02 * pixel_m) * normal;
        return select(0.0, 1.0, cast_ground(start, shadow.light, 0.0, FARTHEST_M) < 0.0);
    }
    return 1.0;
}

// The same of a place in the air.
fn sun_in_air(p: vec3f) -> f32 {
    let place = map_place(shadow, p);
    return is_lit(vec2i(floor(place.at)), place.depth);
}
