// What covers a heightfield: grass, rock and snow by height and slope, with edges that wander.

struct Skin {
    grass: vec3f,
    grass_line_m: f32,
    rock: vec3f,
    snow_line_m: f32,
    snow: vec3f,
    line_width_m: f32,
    // Cosines of slopes.
    grass_cosine: f32,
    snow_cosine: f32,
    // Phong's terms.
    ambient: f32,
    diffuse: f32,
    specular: f32,
    shininess: f32,
    // Of the sphere about it.
    sphere: vec3f,
    // Share of half a side over which it passes into the sphere.
    fade: f32,
    // 1 for a ground that changes from place to place, 0 for an even one.
    mottled: f32,
    // 1 where the sphere is of water.
    water: f32,
}

fn skin_hash(at: vec2i) -> f32 {
    var h = u32(at.x) * 0x9e3779b9u + u32(at.y) * 0x85ebca6bu;
    h = (h ^ (h >> 16u)) * 0x7feb352du;
    h = (h ^ (h >> 15u)) * 0x846ca68bu;
    return f32((h ^ (h >> 16u)) >> 8u) / 16777216.0;
}

// Value noise, 0 to 1.
fn skin_noise(p: vec2f) -> f32 {
    let cell = vec2i(floor(p));
    let t = fract(p);
    let s = t * t * (3.0 - 2.0 * t);
    let south = mix(skin_hash(cell), skin_hash(cell + vec2i(1, 0)), s.x);
    let north = mix(skin_hash(cell + vec2i(0, 1)), skin_hash(cell + vec2i(1, 1)), s.x);
    return mix(south, north, s.y);
}

// Octaves from waves of `longest_m` down to those that a pixel can show, -1 to 1.
fn skin_waves(at_m: vec2f, longest_m: f32, octaves: u32, pixel_m: f32) -> f32 {
    var sum = 0.0;
    var share = 0.5;
    var wave_m = longest_m;
    var at = at_m;
    for (var k = 0u; k < octaves; k++) {
        // Gone before it is finer than two pixels.
        let shown = clamp(0.5 * wave_m / max(pixel_m, 1e-3) - 1.0, 0.0, 1.0);
        sum += share * shown * (2.0 * skin_noise(at / wave_m) - 1.0);
        share *= 0.6;
        wave_m *= 0.43;
        at = vec2f(0.8 * at.x - 0.6 * at.y, 0.6 * at.x + 0.8 * at.y);
    }
    return sum;
}

// Albedo by height, by the cosine of the slope, and by place.
fn skin_albedo(skin: Skin, at_m: vec2f, height_m: f32, cosine: f32, pixel_m: f32) -> vec3f {
    let broad = skin.mottled * skin_waves(at_m, 900.0, 4u, pixel_m);
    let fine = skin.mottled * skin_waves(at_m + vec2f(371.0, 113.0), 37.0, 4u, pixel_m);
    let wander = skin.line_width_m * (0.8 * broad + 0.3 * fine);
    let half = max(0.35 * skin.line_width_m, 1.0);
    let steepness = cosine + 0.10 * broad + 0.06 * fine;
    let level = smoothstep(skin.grass_cosine - 0.06, skin.grass_cosine + 0.04, steepness);
    let low = 1.0 - smoothstep(skin.grass_line_m - half, skin.grass_line_m + half, height_m + wander);
    let high = smoothstep(skin.snow_line_m - half, skin.snow_line_m + half, height_m + wander);
    let holds = smoothstep(skin.snow_cosine - 0.08, skin.snow_cosine + 0.08, steepness);
    let rock = skin.rock * (1.0 + 0.35 * fine + 0.25 * broad);
    let grass = skin.grass * (1.0 + 0.4 * fine + 0.4 * broad);
    return clamp(mix(mix(rock, grass, low * level), skin.snow, high * holds), vec3f(0.0), vec3f(1.0));
}
