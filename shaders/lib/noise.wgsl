// Tileable noise. A place is a point of the unit torus: its coordinates run from 0 to 1, and 1 is 0 again. Each kind of
// noise is a lattice of cells laid on that torus; what is in a cell comes from a hash of the cell's number among those
// that differ, so that the noise closes on itself exactly. A `stream` is the key of one such noise: two with different
// streams have nothing in common.

// Wellons' "lowbias32" (Hash Prospector, 2018): every bit of the result depends evenly on every bit of x.
fn hash(x: u32) -> u32 {
    var h = x;
    h = (h ^ (h >> 16u)) * 0x7feb352du;
    h = (h ^ (h >> 15u)) * 0x846ca68bu;
    return h ^ (h >> 16u);
}

// The index-th stream of a seed.
fn stream_of(seed: u32, index: u32) -> u32 {
    return hash(hash(seed) + 0x9e3779b9u * (index + 1u));
}

// Three numbers from 0 to 1, each of 1024 values, that are never 0 or 1.
fn thousandths(h: u32) -> vec3f {
    return (vec3f(vec3u(h, h >> 10u, h >> 20u) & vec3u(1023u)) + 0.5) / 1024.0;
}

// From 0 to 1 with first and second derivatives that vanish at both ends (Perlin 2002), so that cells join smoothly.
fn fade(t: vec3f) -> vec3f {
    return t * t * t * (t * (6.0 * t - 15.0) + 10.0);
}

// Evenly distributed over the sphere.
fn direction3(h: u32) -> vec3f {
    let z = f32(h & 0xffffu) / 32767.5 - 1.0;
    let turn = f32(h >> 16u) * (6.2831853 / 65536.0);
    return vec3f(sqrt(max(1.0 - z * z, 0.0)) * vec2f(cos(turn), sin(turn)), z);
}

// The cell of a cubic lattice with `frequency` cells to a side that a point, in cells, lies in.
fn wrapped(cell: vec3f, frequency: u32) -> vec3u {
    let side = f32(frequency);
    // The half keeps the quotient off whole numbers, where its last bit would decide.
    return vec3u(cell - side * floor((cell + 0.5) / side));
}

// Gradient noise (Perlin 2002) with gradients all round: -1 to 1, mean 0, and 0 at the corners of its cells.
fn perlin3(place: vec3f, frequency: u32, stream: u32) -> f32 {
    let p = place * f32(frequency);
    let low = wrapped(floor(p), frequency);
    let high = select(low + 1u, vec3u(0u), low + 1u == vec3u(frequency));
    let t = fract(p);
    var ends: array<vec2f, 4>;
    for (var k = 0u; k < 4u; k++) {
        let upper = vec2<bool>((k & 1u) == 1u, k > 1u);
        let row = frequency * (select(low.y, high.y, upper.x) + frequency * select(low.z, high.z, upper.y));
        let yz = t.yz - vec2f(upper);
        ends[k] = vec2f(
            dot(direction3(hash(stream + row + low.x)), vec3f(t.x, yz)),
            dot(direction3(hash(stream + row + high.x)), vec3f(t.x - 1.0, yz)),
        );
    }
    let w = fade(t);
    let floors = mix(ends[0], ends[1], w.y);
    let ceilings = mix(ends[2], ends[3], w.y);
    let sides = mix(floors, ceilings, w.z);
    return mix(sides.x, sides.y, w.x);
}

// 1 - distance to the nearest of the points, one in each cell, in units of a cell; 0 where that is over 1 (Worley 1996,
// inverted). No point beyond the neighbouring cells is nearer than 1.
fn worley3(place: vec3f, frequency: u32, stream: u32) -> f32 {
    let p = place * f32(frequency);
    let home = vec3i(wrapped(floor(p), frequency));
    let within = fract(p);
    let side = i32(frequency);
    var nearest = 1.0;
    for (var z = -1; z <= 1; z++) {
        let cell_z = home.z + z;
        let plane = side * (cell_z + select(0, side, cell_z < 0) - select(0, side, cell_z == side));
        for (var y = -1; y <= 1; y++) {
            let cell_y = home.y + y;
            let row = side * (plane + cell_y + select(0, side, cell_y < 0) - select(0, side, cell_y == side));
            for (var x = -1; x <= 1; x++) {
                let cell_x = home.x + x;
                let number = row + cell_x + select(0, side, cell_x < 0) - select(0, side, cell_x == side);
                let away = thousandths(hash(stream + u32(number))) + vec3f(vec3i(x, y, z)) - within;
                nearest = min(nearest, dot(away, away));
            }
        }
    }
    return 1.0 - sqrt(nearest);
}

// A lattice on the flat torus: a place (x, y) has the coordinates (a x + b y, c x + d y) in cells, whole numbers a to d
// with b and d coprime. The cells of a tile, ad - bc of them, need not lie along its sides.
alias Lattice = vec4i;

// A square lattice of cells 1/|z| wide, turned by the angle of z, a number of parts without common factor.
fn turned(z: vec2i) -> Lattice {
    return vec4i(z.x, -z.y, z.y, z.x);
}

// √5 times as fine and turned by 27°: z (2 + i). If the parts of z are coprime these are too, unless 2 - i divides z.
fn finer(z: vec2i) -> vec2i {
    return vec2i(2 * z.x - z.y, z.x + 2 * z.y);
}

// Among those of the tile. Steps through the tile's sides, (a, c) and (b, d) in cells, lead to the same number; with b
// and d coprime no other steps do.
fn number(lattice: Lattice, cell: vec2f) -> u32 {
    let l = vec4f(lattice);
    let cells = l.x * l.w - l.y * l.z;
    let along = l.w * cell.x - l.y * cell.y;
    return u32(along - cells * floor((along + 0.5) / cells));
}

fn in_cells(lattice: Lattice, place: vec2f) -> vec2f {
    let l = vec4f(lattice);
    return vec2f(dot(l.xy, place), dot(l.zw, place));
}

// Gradient noise in two dimensions: value, and its derivatives along the place's coordinates.
fn perlin2(place: vec2f, lattice: Lattice, stream: u32) -> vec3f {
    let p = in_cells(lattice, place);
    let cell = floor(p);
    let t = p - cell;
    var corners: array<vec3f, 4>;
    for (var k = 0u; k < 4u; k++) {
        let corner = vec2f(vec2u(k & 1u, k >> 1u));
        let turn = f32(hash(stream + number(lattice, cell + corner))) * (6.2831853 / 4294967296.0);
        let gradient = vec2f(cos(turn), sin(turn));
        corners[k] = vec3f(dot(gradient, t - corner), gradient);
    }
    let w = fade(vec3f(t, 0.0)).xy;
    let slope = 30.0 * t * t * (t - 1.0) * (t - 1.0);
    let near = mix(corners[0], corners[1], w.x);
    let far = mix(corners[2], corners[3], w.x);
    let found = mix(near, far, w.y);
    let along_x = mix(corners[1].x - corners[0].x, corners[3].x - corners[2].x, w.y);
    let inner = found.yz + slope * vec2f(along_x, far.x - near.x);
    // By the chain rule.
    let l = vec4f(lattice);
    return vec3f(found.x, dot(l.xz, inner), dot(l.yw, inner));
}

// As `worley3`, in two dimensions.
fn worley2(place: vec2f, lattice: Lattice, stream: u32) -> f32 {
    let p = in_cells(lattice, place);
    let cell = floor(p);
    var nearest = 1.0;
    for (var k = 0; k < 9; k++) {
        let by = vec2f(vec2i(k % 3, k / 3) - 1);
        let away = thousandths(hash(stream + number(lattice, cell + by))).xy + by - (p - cell);
        nearest = min(nearest, dot(away, away));
    }
    return 1.0 - sqrt(nearest);
}

// Octaves of gradient noise from the lattice of z on, each `gain` times as strong as the one before; with derivatives.
fn fbm2(place: vec2f, first: vec2i, octaves: u32, gain: f32, stream: u32) -> vec3f {
    var z = first;
    var weight = 1.0;
    var sum = vec3f(0.0);
    for (var k = 0u; k < octaves; k++) {
        sum += weight * perlin2(place, turned(z), hash(stream + k));
        weight *= gain;
        z = finer(z);
    }
    return sum;
}

// Octaves of inverted Worley noise, weights summing to 1.
fn billows2(place: vec2f, first: vec2i, stream: u32) -> f32 {
    let second = finer(first);
    return 0.625 * worley2(place, turned(first), hash(stream))
        + 0.25 * worley2(place, turned(second), hash(stream + 1u))
        + 0.125 * worley2(place, turned(finer(second)), hash(stream + 2u));
}

// The curl of a vector potential that depends on two coordinates: its own divergence is zero, and so is that of its first
// two components alone (Bridson et al. 2007).
fn curl2(place: vec2f, first: vec2i, octaves: u32, gain: f32, stream: u32) -> vec3f {
    let east = fbm2(place, first, octaves, gain, stream_of(stream, 0u));
    let north = fbm2(place, first, octaves, gain, stream_of(stream, 1u));
    let up = fbm2(place, first, octaves, gain, stream_of(stream, 2u));
    return vec3f(up.z, -up.y, north.y - east.z);
}
