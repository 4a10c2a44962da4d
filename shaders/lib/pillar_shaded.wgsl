// A lamp's pillar among things that stand in its light.
import package::lib::air::Air;
import package::lib::geometry::PI;
import package::lib::pillar::{Crystals, Fan, Lamp, fan_of};
import package::lib::pillar_lamp::{ice, mirrored, support_of};
import package::lib::pillar_polar::{Polar, SHADED_ABOVE, SHADED_BELOW, gamma_of, unpack_row, widest};

@group(0) @binding(2) var<uniform> polar: Polar;
@group(0) @binding(3) var<storage, read> polar_words: array<u32>;

// The pillar's light where the plane's table lets it through.
fn through_plane(air: Air, layer: Crystals, lamp: Lamp, fan: Fan, v: vec3f, sin_least: f32, psi0: f32, ends: vec2f, first: u32) -> vec3f {
    let from_gamma = fan.beta + 2.0 * ends.x;
    let to_gamma = fan.beta + 2.0 * ends.y;
    var row = u32(clamp(f32(polar.rows) * sqrt(max(from_gamma, 0.0) / PI), 0.0, f32(polar.rows) - 1.0));
    var sum = vec3f(0.0);
    var gamma = from_gamma;
    // Where the lit stretch began that is not over yet; negative for none.
    var begun = -1.0;
    let reach = fan.d * fan.sin_beta;
    // A row may be cut in two by its jump, and each piece once where the ray leaves the light.
    for (var k = 0u; k < 2u * polar.rows; k++) {
        let here = unpack_row(polar_words[first + row]);
        let begins = gamma_of(polar, f32(row));
        let row_ends = gamma_of(polar, f32(row + 1u));
        let jump = mix(begins, row_ends, here.y);
        let past = gamma >= jump - 1e-7;
        let piece_end = min(select(jump, row_ends, past), to_gamma);
        // Past the jump the light goes as far as at the next row's beginning; without one it changes evenly.
        let next = unpack_row(polar_words[first + min(row + 1u, polar.rows)]).x;
        let even = here.y >= 1.0;
        let at_from = select(select(here.x, next, past), mix(here.x, next, (gamma - begins) / (row_ends - begins)), even);
        let at_to = select(select(here.x, next, past), mix(here.x, next, (piece_end - begins) / (row_ends - begins)), even);
        // Lit where r = b / sin(β+γ) ends before the light does.
        let spare_from = at_from * sin(fan.beta + gamma) - reach;
        let spare_to = at_to * sin(fan.beta + piece_end) - reach;
        let cross = mix(gamma, piece_end, clamp(spare_from / (spare_from - spare_to + select(1e-12, 0.0, spare_from != spare_to)), 0.0, 1.0));
        if spare_from > 0.0 && begun < 0.0 {
            begun = gamma;
        }
        if spare_from <= 0.0 && spare_to > 0.0 {
            begun = cross;
        }
        let last = piece_end >= to_gamma - 1e-7;
        var over = -1.0;
        if begun >= 0.0 && spare_to <= 0.0 {
            over = select(gamma, cross, spare_from > 0.0);
        } else if begun >= 0.0 && last {
            over = to_gamma;
        }
        if over > begun {
            sum += mirrored(air, layer, lamp, fan, v, sin_least, psi0, 0.5 * (vec2f(begun, over) - fan.beta));
        }
        if over >= 0.0 {
            begun = -1.0;
        }
        if last {
            break;
        }
        gamma = piece_end;
        if gamma >= row_ends - 1e-7 {
            row = min(row + 1u, polar.rows - 1u);
        }
    }
    return sum;
}

// As `open_pillar`, of the lamp at that place in the table.
fn shaded_pillar(air: Air, layer: Crystals, lamp: Lamp, index: u32, v: vec3f, end_m: f32, blur_m: f32) -> vec3f {
    let fan = fan_of(lamp.place_m, v, blur_m);
    let support = support_of(layer, fan, v.z, blur_m, end_m);
    if support.factor == 0.0 {
        return vec3f(0.0);
    }
    // The angle of the ray's side from the upright plane, about the axis.
    let level = vec3f(-fan.e1.y, fan.e1.x, 0.0) * inverseSqrt(max(1.0 - fan.e1.z * fan.e1.z, 1e-12));
    let upright = cross(fan.e1, level) * select(1.0, -1.0, cross(fan.e1, level).z < 0.0);
    let above = dot(fan.e2, upright) >= 0.0;
    let chi = atan2(dot(fan.e2, level), abs(dot(fan.e2, upright)));
    let base = index * polar.words;
    let is_shaded = (polar_words[base] & select(SHADED_BELOW, SHADED_ABOVE, above)) != 0u;
    let column = clamp((0.5 * chi / widest(polar, fan.e1) + 0.5) * f32(polar.columns) - 0.5, 0.0, f32(polar.columns) - 1.0);
    let left = min(u32(column), polar.columns - 2u);
    let side = base + 1u + select(polar.columns * (polar.rows + 1u), 0u, above);
    var sum = vec3f(0.0);
    for (var k = 0u; k < ice.three; k++) {
        let psi0 = fan.psi0 + (f32(k) - 1.0) * PI;
        let ends = vec2f(max(psi0 - support.reach, support.ends.x), min(psi0 + support.reach, support.ends.y));
        if ends.x >= ends.y {
            continue;
        }
        if !is_shaded {
            sum += mirrored(air, layer, lamp, fan, v, support.sin_least, psi0, ends);
            continue;
        }
        // Between the two planes nearest.
        for (var c = 0u; c < ice.two; c++) {
            let weight = select(1.0 - (column - f32(left)), column - f32(left), c == 1u);
            if weight > 0.0 {
                let first = side + (left + c) * (polar.rows + 1u);
                sum += weight * through_plane(air, layer, lamp, fan, v, support.sin_least, psi0, ends, first);
            }
        }
    }
    return sum * lamp.intensity * (layer.face_per_m * support.factor / (2.0 * fan.b));
}
