// The shadow of what stands on the ground, by a map that holds how far towards the light the first thing lies before each
// of its texels (Williams 1978).
import package::lib::ground::{ground, to_ground_frame};

struct GroundShadow {
    // Axes of the map and the light's direction, in the ground's frame.
    right: vec3f,
    size_px: u32,
    up: vec3f,
    // How far p is moved off its surface before it is looked up, in texels.
    lift_px: f32,
    light: vec3f,
    // The map's middle and half its size along these axes.
    middle_m: vec3f,
    half_m: vec3f,
}

struct MapPlace {
    // In texels from the corner.
    at: vec2f,
    // Towards the light, from 0 to 1 over the map's depth.
    depth: f32,
}

fn map_place(shadow: GroundShadow, p: vec3f) -> MapPlace {
    let along = vec3f(dot(p, shadow.right), dot(p, shadow.up), dot(p, shadow.light));
    let unit = 0.5 + 0.5 * (along - shadow.middle_m) / shadow.half_m;
    // Places beyond the map's depth are behind all that stands there, and behind nothing where nothing does.
    return MapPlace(unit.xy * f32(shadow.size_px), max(unit.z, 0.0));
}

// Where the light of a texel's middle enters the map's depth.
fn texel_origin(shadow: GroundShadow, texel: vec2u) -> vec3f {
    let unit = (vec2f(texel) + 0.5) / f32(shadow.size_px) * 2.0 - 1.0;
    let along = shadow.middle_m + shadow.half_m * vec3f(unit, 1.0);
    return along.x * shadow.right + along.y * shadow.up + along.z * shadow.light;
}

// The word of the map that holds a texel, if it has one.
fn texel_word(shadow: GroundShadow, texel: vec2i) -> i32 {
    let size = i32(shadow.size_px);
    let beyond = any(texel < vec2i(0)) || any(texel >= vec2i(size));
    return select(texel.y * (size / 2) + texel.x / 2, -1, beyond);
}

// 1 where the light passes over a texel, which that word holds, to that depth; else 0.
fn passes_over(word: u32, texel: vec2i, depth: f32) -> f32 {
    let depths = unpack2x16unorm(word);
    return select(0.0, 1.0, depth >= select(depths.x, depths.y, (texel.x & 1) == 1));
}

// A place on a surface is moved along the surface's normal by about as much as it may fall within a texel.
fn lifted(shadow: GroundShadow, p: vec3f, normal: vec3f) -> vec3f {
    let texel_m = 2.0 * max(shadow.half_m.x, shadow.half_m.y) / f32(shadow.size_px);
    let cosine = clamp(dot(normal, shadow.light), 0.0, 1.0);
    return p + shadow.lift_px * texel_m * sqrt(1.0 - cosine * cosine) * normal;
}
