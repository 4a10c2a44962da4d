// How far a lamp's light goes before it meets something: a table about the axis from lamp to observer, by the angle χ of a
// plane through the axis from the upright one, on its upper and on its lower side, and by the angle γ from the axis. A row
// of it holds how far the light goes where the row begins, and where in the row that jumps.
import package::lib::geometry::PI;

struct Polar {
    // Planes on each side, and rows.
    columns: u32,
    rows: u32,
    // Sine of the largest tilt.
    sin_max: f32,
    // For each lamp.
    words: u32,
}

// Bits of a lamp's first word: whether the observer sees the lamp, and whether something stands in its light above and below.
const SEEN = 1u;
const SHADED_ABOVE = 2u;
const SHADED_BELOW = 4u;

// How far the light goes, in sixteenths of a metre up to 65 km, and in twelve bits the row's share before its jump.
fn pack_row(reach_m: f32, jump: f32) -> u32 {
    return (u32(clamp(reach_m, 0.0, 65535.0) * 16.0) << 12u) | u32(clamp(jump, 0.0, 1.0) * 4095.0);
}

fn unpack_row(word: u32) -> vec2f {
    return vec2f(f32(word >> 12u) / 16.0, f32(word & 4095u) / 4095.0);
}

// Rows grow with the square, since what is seen of a pillar is mostly near its lamp.
fn gamma_of(polar: Polar, row: f32) -> f32 {
    let share = row / f32(polar.rows);
    return PI * share * share;
}

// The largest χ at which plates may mirror: |q_z| = |sin χ| cos(elevation) < sin δmax.
fn widest(polar: Polar, e1: vec3f) -> f32 {
    let level = sqrt(max(1.0 - e1.z * e1.z, 1e-12));
    let sine = min(polar.sin_max / level, 1.0);
    return atan2(sine, sqrt(max(1.0 - sine * sine, 0.0)));
}
