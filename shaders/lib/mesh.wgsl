// Rays against a mesh: a binary tree of boxes, nearer boxes first, what is farther kept on a stack of its own.
import package::lib::ground::{finder, ground, shape};

// Deeper trees are not handed over.
const MOST_DEEP = 64u;
// Every node of the largest tree at most.
const MOST_VISITS = 60000u;
// Words of a node: the boxes of its two halves, then what they are.
const NODE_WORDS = 16u;
// Words of a triangle: a vertex, and from there to the others.
const TRIANGLE_WORDS = 9u;
// Set where half a node is a leaf; then four bits of how many triangles, and the first of them.
const LEAF = 0x80000000u;
const COUNT_SHIFT = 27u;
const FIRST_MASK = 0x07ffffffu;
// What rounding may open between two triangles, by their barycentric coordinates.
const SEAM = 1e-6;
const NEVER = 3e38;

// What the last ray met.
struct MeshHit {
    triangle: u32,
    // Shares of the second and the third vertex.
    share: vec2f,
}

var<private> mesh_hit: MeshHit;

fn box_entry(at: u32, p: vec3f, inverse: vec3f, to_m: f32) -> f32 {
    let a = (bitcast<vec3f>(vec3u(finder[at], finder[at + 1u], finder[at + 2u])) - p) * inverse;
    let b = (bitcast<vec3f>(vec3u(finder[at + 3u], finder[at + 4u], finder[at + 5u])) - p) * inverse;
    let enter = max(max(min(a.x, b.x), min(a.y, b.y)), max(min(a.z, b.z), 0.0));
    // Rounding must not close a box before its own wall.
    let leave = min(min(max(a.x, b.x), max(a.y, b.y)), min(max(a.z, b.z), to_m)) * 1.000001;
    return select(NEVER, enter, enter <= leave);
}

// Möller and Trumbore 1997, from both sides. Gives the way, or one that is never gone.
fn meet_triangle(triangle: u32, p: vec3f, d: vec3f, to_m: f32) -> f32 {
    let i = triangle * TRIANGLE_WORDS;
    let v = vec3f(shape[i], shape[i + 1u], shape[i + 2u]);
    let e1 = vec3f(shape[i + 3u], shape[i + 4u], shape[i + 5u]);
    let e2 = vec3f(shape[i + 6u], shape[i + 7u], shape[i + 8u]);
    let across = cross(d, e2);
    let volume = dot(e1, across);
    let inverse = 1.0 / select(volume, 1e-30, volume == 0.0);
    let from_vertex = p - v;
    let u = dot(from_vertex, across) * inverse;
    let over = cross(from_vertex, e1);
    let w = dot(d, over) * inverse;
    let t = dot(e2, over) * inverse;
    if volume == 0.0 || u < -SEAM || w < -SEAM || u + w > 1.0 + SEAM || t <= 0.0 || t >= to_m {
        return NEVER;
    }
    mesh_hit = MeshHit(triangle, vec2f(u, w));
    return t;
}

// The way to the first triangle between two ways, or -1.
fn cast_mesh(p: vec3f, d: vec3f, from_m: f32, to_m: f32) -> f32 {
    let inverse = 1.0 / select(d, vec3f(1e-12), abs(d) < vec3f(1e-12));
    // From where it enters the whole, so that nothing far away takes its digits.
    let a = (vec3f(ground.corner_m, ground.lowest_m) - p) * inverse;
    let b = (vec3f(ground.corner_m + vec2f(ground.cells) * ground.cell_m, ground.highest_m) - p) * inverse;
    let enter = max(max(min(a.x, b.x), min(a.y, b.y)), min(a.z, b.z));
    let leave = min(min(max(a.x, b.x), max(a.y, b.y)), max(a.z, b.z));
    let begin_m = max(enter - 1.0, from_m);
    let end_m = min(leave + 1.0, to_m) - begin_m;
    if end_m <= 0.0 {
        return -1.0;
    }
    let start = p + begin_m * d;
    var waiting: array<u32, 64>;
    var entered: array<f32, 64>;
    var deep = 0u;
    var nearest = end_m;
    var found = false;
    var word = 0u;
    for (var k = 0u; k < MOST_VISITS; k++) {
        var next = NEVER;
        if (word & LEAF) != 0u {
            let first = word & FIRST_MASK;
            let count = (word >> COUNT_SHIFT) & 15u;
            for (var i = first; i < first + count; i++) {
                let t = meet_triangle(i, start, d, nearest);
                if t < nearest {
                    nearest = t;
                    found = true;
                }
            }
        } else {
            let at = word * NODE_WORDS;
            let one = box_entry(at, start, inverse, nearest);
            let other = box_entry(at + 6u, start, inverse, nearest);
            let words = vec2u(finder[at + 12u], finder[at + 13u]);
            let swapped = other < one;
            next = min(one, other);
            word = select(words.x, words.y, swapped);
            let later = max(one, other);
            if later < NEVER && deep < MOST_DEEP {
                waiting[deep] = select(words.y, words.x, swapped);
                entered[deep] = later;
                deep += 1u;
            }
        }
        // The next that may hold something nearer.
        while next >= NEVER && deep > 0u {
            deep -= 1u;
            if entered[deep] < nearest {
                next = entered[deep];
                word = waiting[deep];
            }
        }
        if next >= NEVER {
            break;
        }
    }
    return select(-1.0, begin_m + nearest, found);
}
