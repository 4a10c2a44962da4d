// What a ray of view meets on the ground, packed.

struct SeenGround {
    // Negative where it meets nothing that this pass is for.
    distance_m: f32,
    // In the scene, of length 1.
    normal: vec3f,
    // Share of the sun's light that is sent back, and of the sky's.
    diffuse: vec3f,
    ambient: vec3f,
    specular: f32,
    shininess: f32,
    // Of the sun's light, past the ground.
    lit: f32,
    // Of the sky, past the ground.
    open: f32,
    water: bool,
}

struct PackedGround {
    distance_m: f32,
    normal: u32,
    // Square roots of the shares, so that eight bits serve dark ones; then `lit`, and `open`.
    diffuse: u32,
    ambient: u32,
    // Specular, and the logarithm of the shininess.
    mirror: u32,
    // 1 for water.
    water: u32,
}

// Octahedron (Meyer et al. 2010).
fn pack_direction(n: vec3f) -> u32 {
    let p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    let sign = select(vec2f(-1.0), vec2f(1.0), p >= vec2f(0.0));
    return pack2x16snorm(select(p, (1.0 - abs(p.yx)) * sign, n.z < 0.0));
}

fn unpack_direction(word: u32) -> vec3f {
    let p = unpack2x16snorm(word);
    let z = 1.0 - abs(p.x) - abs(p.y);
    let sign = select(vec2f(-1.0), vec2f(1.0), p >= vec2f(0.0));
    return normalize(vec3f(select(p, (1.0 - abs(p.yx)) * sign, z < 0.0), z));
}

// 2^10 is the sharpest mirror.
const SHARPEST = 10.0;

fn pack_ground(seen: SeenGround) -> PackedGround {
    return PackedGround(
        seen.distance_m,
        pack_direction(seen.normal),
        pack4x8unorm(vec4f(sqrt(seen.diffuse), seen.lit)),
        pack4x8unorm(vec4f(sqrt(seen.ambient), seen.open)),
        pack2x16unorm(vec2f(seen.specular, log2(max(seen.shininess, 1.0)) / SHARPEST)),
        select(0u, 1u, seen.water),
    );
}

fn unpack_ground(packed: PackedGround) -> SeenGround {
    let diffuse = unpack4x8unorm(packed.diffuse);
    let ambient = unpack4x8unorm(packed.ambient);
    let mirror = unpack2x16unorm(packed.mirror);
    return SeenGround(
        packed.distance_m,
        unpack_direction(packed.normal),
        diffuse.rgb * diffuse.rgb,
        ambient.rgb * ambient.rgb,
        mirror.x,
        exp2(SHARPEST * mirror.y),
        diffuse.a,
        ambient.a,
        packed.water == 1u,
    );
}
