// Rays against a heightfield: bilinear patches between vertices, found by way of a pyramid of greatest heights (Tevs,
// Ihrke and Seidel 2008). A ray walks from node to node in the level it is in, rises where it enters a new parent, and
// descends where it comes lower than the node's top.
import package::lib::ground::{fall_share, finder, ground, height_at, shape};

// A walk crosses each row and column of patches once, and each crossing costs a descent at most.
const MOST_ROUNDS = 60000u;
// What rounding may lift a patch's edge over a ray, in metres and by the way.
const ROUNDING_M = 0.01;
const ROUNDING = 2e-7;

fn vertex_height(at: vec2i) -> f32 {
    let inside = vec2u(clamp(at, vec2i(0), vec2i(ground.cells)));
    return shape[inside.y * (ground.cells.x + 1u) + inside.x];
}

// Heights at the corners of a patch: south-west, south-east, north-west, north-east.
fn patch_corners(cell: vec2u) -> vec4f {
    let i = cell.y * (ground.cells.x + 1u) + cell.x;
    let j = i + ground.cells.x + 1u;
    return vec4f(shape[i], shape[i + 1u], shape[j], shape[j + 1u]);
}

// Of a level of the pyramid, where the first is 1.
fn node_count(level: u32) -> vec2u {
    return (ground.cells + (1u << level) - 1u) >> vec2u(level);
}

struct Level {
    index: u32,
    // Where it begins among the peaks.
    first: u32,
}

fn finer(level: Level) -> Level {
    if level.index <= 1u {
        return Level(0u, 0u);
    }
    let count = node_count(level.index - 1u);
    return Level(level.index - 1u, level.first - count.x * count.y);
}

fn coarser(level: Level) -> Level {
    if level.index == 0u {
        return Level(1u, 0u);
    }
    let count = node_count(level.index);
    return Level(level.index + 1u, level.first + count.x * count.y);
}

fn last_level() -> Level {
    var level = Level(0u, 0u);
    for (var k = 0u; k < ground.levels; k++) {
        level = coarser(level);
    }
    return level;
}

// The way from p at which a ray falls through a patch within `span_m`, or -1. Over the patch, ray less surface is a
// quadratic f in the way: the surface is bilinear, and the sphere's fall bends by far less than the patch. f falls where
// f' = -√(b² - 4ac), which one root alone fulfils.
fn fall_through_patch(h: vec4f, p: vec3f, d: vec3f, share: vec2f, slope: vec2f, span_m: f32) -> f32 {
    let east = h.y - h.x;
    let north = h.z - h.x;
    let twist = h.x - h.y - h.z + h.w;
    let middle = p.xy + 0.5 * span_m * d.xy;
    let k = fall_share(dot(middle, middle));
    let c = p.z + k * dot(p.xy, p.xy) - (h.x + share.x * east + share.y * north + share.x * share.y * twist);
    let b = d.z + 2.0 * k * dot(p.xy, d.xy) - (slope.x * east + slope.y * north + (share.x * slope.y + share.y * slope.x) * twist);
    let a = k * dot(d.xy, d.xy) - slope.x * slope.y * twist;
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return -1.0;
    }
    let root = sqrt(discriminant);
    let t = select((-b - root) / (2.0 * a), 2.0 * c / (root - b), b <= 0.0);
    // Between two patches a ray may round to just below both.
    if c < 0.0 && c > -ROUNDING_M && b < 0.0 {
        return 0.0;
    }
    return select(-1.0, min(t, span_m), t >= 0.0 && t <= span_m + ROUNDING_M);
}

// The stretch of a ray within the box that holds the whole field.
fn heightfield_stretch(p: vec3f, d: vec3f) -> vec2f {
    let near = ground.corner_m;
    let far = near + vec2f(ground.cells) * ground.cell_m;
    let reach = max(abs(near), abs(far));
    let squared = dot(reach, reach);
    let least = vec3f(near, ground.lowest_m - squared * fall_share(squared) - 1.0);
    let most = vec3f(far, ground.highest_m + 1.0);
    let inverse = 1.0 / select(d, vec3f(1e-12), abs(d) < vec3f(1e-12));
    let a = (least - p) * inverse;
    let b = (most - p) * inverse;
    let enter = max(max(min(a.x, b.x), min(a.y, b.y)), min(a.z, b.z));
    let leave = min(min(max(a.x, b.x), max(a.y, b.y)), max(a.z, b.z));
    return vec2f(enter, leave);
}

// The way to where a ray from p first falls through the field between two ways, or -1. Rays from below pass.
fn cast_heightfield(p: vec3f, d: vec3f, from_m: f32, to_m: f32) -> f32 {
    let stretch = heightfield_stretch(p, d);
    let begin_m = max(stretch.x, from_m);
    let end_m = min(stretch.y, to_m) - begin_m;
    if end_m <= 0.0 {
        return -1.0;
    }
    // From where it enters, so that nothing far away takes its digits.
    let start = p + begin_m * d;
    let slope = d.xy / ground.cell_m;
    let place = (start.xy - ground.corner_m) / ground.cell_m;
    // An upright ray crosses no edge, not one behind it either.
    let moving = select(slope, vec2f(1e-12), abs(slope) < vec2f(1e-12));
    let inverse = 1.0 / moving;
    let ahead = vec2i(select(vec2f(0.0), vec2f(1.0), moving > vec2f(0.0)));
    let bend = ground.bend_per_m * dot(d.xy, d.xy) * 1.02;
    let last = vec2i(ground.cells) - 1;
    var cell = clamp(vec2i(floor(place)), vec2i(0), last);
    var level = last_level();
    var t = 0.0;
    var height = height_at(start);
    var found = -1.0;
    for (var k = 0u; k < MOST_ROUNDS && t < end_m; k++) {
        let at_level = vec2u(level.index);
        let node = vec2i(vec2u(cell) >> at_level);
        let edge = min(vec2i(vec2u(node + ahead) << at_level), last + 1);
        let crossing = (vec2f(edge) - place) * inverse;
        let leave = clamp(min(crossing.x, crossing.y), t, end_m);
        let there = start + leave * d;
        let next_height = height_at(there);
        let lowest = min(height, next_height) - bend * (leave - t) * (leave - t) - ROUNDING * (begin_m + leave);
        var top: f32;
        var corners: vec4f;
        if level.index == 0u {
            corners = patch_corners(vec2u(cell));
            top = max(max(corners.x, corners.y), max(corners.z, corners.w));
        } else {
            top = bitcast<f32>(finder[level.first + u32(node.y) * node_count(level.index).x + u32(node.x)]);
        }
        if lowest <= top && level.index > 0u {
            level = finer(level);
            continue;
        }
        if lowest <= top {
            let way = fall_through_patch(corners, start + t * d, d, place + t * slope - vec2f(cell), slope, leave - t);
            if way >= 0.0 {
                found = begin_m + t + way;
                break;
            }
        }
        // Into the next node of this level; its row is known where its column is crossed, and the other way round.
        let along = clamp(vec2i(floor(place + leave * slope)), vec2i(vec2u(node) << at_level), min(vec2i(vec2u(node + 1) << at_level), last + 1) - 1);
        let beyond = edge + ahead - 1;
        let next = select(vec2i(along.x, beyond.y), vec2i(beyond.x, along.y), crossing.x < crossing.y);
        if any(next < vec2i(0)) || any(next > last) {
            break;
        }
        if level.index < ground.levels && any((vec2u(next) >> (at_level + 1u)) != (vec2u(cell) >> (at_level + 1u))) {
            level = coarser(level);
        }
        cell = next;
        t = leave;
        height = next_height;
    }
    return found;
}

// How the heights rise to the east and to the north at p, smooth from patch to patch: by the differences across as many
// vertices as `width_m` spans.
fn rise_at(p: vec3f, width_m: f32) -> vec2f {
    let place = clamp((p.xy - ground.corner_m) / ground.cell_m, vec2f(0.0), vec2f(ground.cells));
    let cell = vec2i(floor(place));
    let share = place - vec2f(cell);
    let apart = max(i32(0.5 * width_m / min(ground.cell_m.x, ground.cell_m.y)), 1);
    var rise = vec2f(0.0);
    for (var k = 0; k < 4; k++) {
        let corner = vec2i(k & 1, k >> 1u);
        let at = cell + corner;
        let east = vertex_height(at + vec2i(apart, 0)) - vertex_height(at - vec2i(apart, 0));
        let north = vertex_height(at + vec2i(0, apart)) - vertex_height(at - vec2i(0, apart));
        let weight = select(1.0 - share, share, corner == vec2i(1));
        rise += weight.x * weight.y * vec2f(east, north) / (2.0 * f32(apart) * ground.cell_m);
    }
    return rise;
}
