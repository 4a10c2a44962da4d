// Thin high clouds, tileable; the wind blows along x. Only the order of the values counts: they are spread evenly over 0
// to 1 afterwards.
import package::lib::noise::{Lattice, fbm2, hash, perlin2, stream_of, turned, worley2};

struct Sheet {
    seed: u32,
}

@group(0) @binding(0) var<uniform> sheet: Sheet;
@group(0) @binding(1) var<storage, read_write> texels: array<vec4f>;

fn stream(index: u32) -> u32 {
    return stream_of(sheet.seed, index);
}

fn warp(place: vec2f, first: vec2i, octaves: u32, length: vec2f, index: u32) -> vec2f {
    var by: vec2f;
    for (var c = 0u; c < 2u; c++) {
        by[c] = fbm2(place, first, octaves, 0.5, stream(index + c)).x;
    }
    return place + length * by;
}

// Fibres along x: three octaves of noise whose cells are long and narrow, a little aslant, and staggered, since at their
// corners the noise is zero.
fn fibres(place: vec2f, index: u32) -> f32 {
    var lattices = array<Lattice, 3>(Lattice(3, 7, 2, 23), Lattice(5, -12, 3, 47), Lattice(9, 22, -2, 95));
    var weights = vec3f(1.0, 0.6, 0.4);
    var sum = 0.0;
    for (var k = 0u; k < 3u; k++) {
        sum += weights[k] * perlin2(place, lattices[k], stream(index + k)).x;
    }
    return sum;
}

// How much ice forms at a place: small heads, in clusters.
fn heads(place: vec2f) -> f32 {
    let clusters = smoothstep(-0.2, 0.5, fbm2(place, vec2i(1, 3), 2u, 0.7, stream(10u)).x);
    let spots = worley2(place, turned(vec2i(17, 8)), stream(11u));
    // Fine across the wind, so that the tails are.
    let grain = perlin2(place, Lattice(41, 30, -8, 107), stream(12u)).x;
    return clusters * smoothstep(0.55, 0.95, spots) * max(grain, 0.0);
}

const TRAIL_STEPS: u32 = 44u;

// Mares' tails: ice falls from each head into slower wind and is left behind, first across, then along the wind: a hook and
// a long tail that fades as the ice dries up. Here backwards, from a place to the heads whose ice may be there.
fn tails(place: vec2f) -> f32 {
    let hook = 0.09 * perlin2(place, turned(vec2i(2, 1)), stream(13u)).x;
    let bend = 0.12 * perlin2(place, turned(vec2i(2, 1)), stream(14u)).x;
    let length = 0.3 + 0.08 * perlin2(place, turned(vec2i(2, 3)), stream(15u)).x;
    var sum = 0.0;
    for (var k = 0u; k < TRAIL_STEPS; k++) {
        let t = (f32(k) + 0.5) / f32(TRAIL_STEPS);
        let across = hook * (1.0 - exp(-6.0 * t)) + bend * t * t;
        sum += (1.0 - t) * heads(place + vec2f(-length * t * (0.3 + 0.7 * t), across));
    }
    return sum / f32(TRAIL_STEPS);
}

// Small clouds in rows: cells that crowd along the crests of waves.
fn ripples(place: vec2f) -> f32 {
    let bent = warp(place, vec2i(3, 4), 2u, vec2f(0.03), 20u);
    let cells = worley2(bent, Lattice(27, 10, -13, 41), stream(22u));
    let small = worley2(bent, turned(vec2i(71, 24)), stream(23u));
    // 24 and 6 waves through the tile's sides, stronger and weaker from place to place.
    let crests = cos(6.2831853 * dot(vec2f(24.0, 6.0), warp(place, vec2i(2, 1), 3u, vec2f(0.05), 24u)));
    let marked = 0.2 + 0.4 * fbm2(place, vec2i(3, 4), 2u, 0.5, stream(26u)).x;
    let patches = fbm2(warp(place, vec2i(3, 4), 2u, vec2f(0.04), 27u), vec2i(2, 1), 4u, 0.6, stream(29u)).x;
    return cells + 0.12 * small + marked * crests + 0.95 * patches;
}

@compute @workgroup_size(8, 8)
fn cloud_sheet(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let side = 8u * groups.x;
    let place = (vec2f(id.xy) + 0.5) / f32(side);
    let streaming = warp(place, vec2i(2, 1), 2u, vec2f(0.05, 0.045), 30u);
    let bands = fbm2(streaming, vec2i(2, 1), 4u, 0.6, stream(32u)).x;
    let cirrus = 8.0 * tails(place) + (0.06 + 0.1 * bands) * fibres(streaming, 33u) + 0.15 * bands;
    let veil = fbm2(warp(place, vec2i(1, 1), 2u, vec2f(0.06), 40u), vec2i(2, 1), 4u, 0.42, stream(42u)).x
        + 0.06 * fibres(streaming, 43u);
    // Wisps that fray where the air is stirred.
    let torn = warp(streaming, vec2i(3, 4), 4u, vec2f(0.03, 0.01), 50u);
    let wisps = perlin2(torn, Lattice(7, -16, 3, 59), stream(52u)).x
        + 0.8 * perlin2(torn, Lattice(17, 38, 6, 151), stream(53u)).x
        + 0.8 * fbm2(torn, vec2i(3, 4), 4u, 0.6, stream(54u)).x;
    texels[id.y * side + id.x] = vec4f(cirrus, ripples(place), veil, wisps);
}
