// How far each lamp's light goes before it meets something, about the axis from lamp to observer: `lib/pillar_polar.wgsl`
// says how.
import package::lib::ground::{ground, to_ground_frame};
import package::lib::ground_cast::cast_ground;
import package::lib::pillar::Lamp;
import package::lib::pillar_lamp::ice;
import package::lib::pillar_polar::{Polar, SEEN, SHADED_ABOVE, SHADED_BELOW, gamma_of, pack_row, widest};

// The observer's own frame, with the zenith as z.
struct Own {
    east: vec3f,
    north: vec3f,
    up: vec3f,
}

@group(0) @binding(2) var<storage, read> lamps: array<Lamp>;
@group(0) @binding(5) var<uniform> own: Own;
@group(0) @binding(7) var<uniform> polar: Polar;
@group(0) @binding(6) var<storage, read_write> words: array<atomic<u32>>;

const NOWHERE_M = 65535.0;

fn way_to(from_m: vec3f, direction: vec3f, begin_m: f32, end_m: f32) -> f32 {
    let place = from_m.x * own.east + from_m.y * own.north + from_m.z * own.up;
    let world = direction.x * own.east + direction.y * own.north + direction.z * own.up;
    let hit = cast_ground(ground.place_m + to_ground_frame(place), to_ground_frame(world), begin_m, end_m);
    return select(NOWHERE_M, hit, hit >= 0.0);
}

// In a plane about the lamp, as far as there are plates that way.
fn reach(lamp: Lamp, axis: vec3f, side: vec3f, gamma: f32) -> f32 {
    let direction = cos(gamma) * axis + sin(gamma) * side;
    var end_m = 0.0;
    for (var i = 0u; i < ice.count; i++) {
        let to = select(ice.layers[i].base_m, ice.layers[i].top_m, direction.z > 0.0);
        end_m = max(end_m, (to - lamp.place_m.z) / select(direction.z, 1e-9, abs(direction.z) < 1e-9));
    }
    // Next to the axis what lies beyond the observer is seen by nobody who looks at the lamp.
    end_m = min(end_m, select(NOWHERE_M, 1.5 * length(lamp.place_m), gamma < 0.1));
    if end_m <= 0.0 {
        return NOWHERE_M;
    }
    return way_to(lamp.place_m, direction, min(0.05 + lamp.radius_m, end_m), min(end_m, NOWHERE_M - 1.0));
}

@compute @workgroup_size(64)
fn pillar_polar(@builtin(global_invocation_id) id: vec3u) {
    let lamp_index = id.y;
    let rows = polar.rows + 1u;
    if lamp_index >= arrayLength(&lamps) || id.x >= polar.words {
        return;
    }
    let lamp = lamps[lamp_index];
    let base = lamp_index * polar.words;
    let d = length(lamp.place_m);
    let e1 = lamp.place_m / d;
    if id.x == 0u {
        if way_to(vec3f(0.0), e1, 0.0, d - min(0.1 + lamp.radius_m, 0.5 * d)) == NOWHERE_M {
            atomicOr(&words[base], SEEN);
        }
        return;
    }
    let cell = id.x - 1u;
    let row = cell % rows;
    let column = cell / rows % polar.columns;
    let below = cell / rows >= polar.columns;
    let level = vec3f(-e1.y, e1.x, 0.0) * inverseSqrt(max(1.0 - e1.z * e1.z, 1e-12));
    let turned = cross(e1, level);
    let upright = turned * select(1.0, -1.0, turned.z < 0.0) * select(1.0, -1.0, below);
    let chi = widest(polar, e1) * (2.0 * (f32(column) + 0.5) / f32(polar.columns) - 1.0);
    let side = cos(chi) * upright + sin(chi) * level;
    let from_gamma = gamma_of(polar, f32(row));
    let near = reach(lamp, -e1, side, from_gamma);
    var jump = 1.0;
    if row + 1u < rows {
        let far = reach(lamp, -e1, side, gamma_of(polar, f32(row + 1u)));
        // Not one surface that lies aslant, but the edge of one.
        if max(near, far) > 1.3 * min(near, far) + 1.0 {
            let between = sqrt(near * far);
            var low = 0.0;
            var high = 1.0;
            for (var k = 0u; k < 9u; k++) {
                let middle = 0.5 * (low + high);
                let there = reach(lamp, -e1, side, mix(from_gamma, gamma_of(polar, f32(row + 1u)), middle));
                let same = (there < between) == (near < between);
                low = select(low, middle, same);
                high = select(middle, high, same);
            }
            jump = min(0.5 * (low + high), 0.999);
        }
    }
    if near < NOWHERE_M || jump < 1.0 {
        atomicOr(&words[base], select(SHADED_ABOVE, SHADED_BELOW, below));
    }
    atomicStore(&words[base + id.x], pack_row(near, jump));
}
