// The sphere of directions as a square (Engelhardt and Dachsbacher 2008), of which blocks are kept where somebody looks.
// Values stand at the corners of cells, so that every block holds all that its cells are interpolated from.

import package::lib::geometry::over_horizon;

struct Dome {
    // Cells to a side of the square.
    cells: u32,
    // Of the discs of sun and moon, what clouds leave on average: a disc is smaller than cells.
    sun_left: f32,
    moon_left: f32,
    // 1 for an observer under all clouds.
    under_clouds: u32,
}

// Angle of a cell on the average, times their number to a side: √(4π).
const CELL_ANGLE = 3.545;

// Cells to a side of a block, and corners that it holds.
const BLOCK_CELLS = 16u;
const BLOCK_SIDE = BLOCK_CELLS + 1u;
const BLOCK_CORNERS = BLOCK_SIDE * BLOCK_SIDE;

// 0 to 1; the upper half sphere is the diamond in the middle.
fn dome_place(direction: vec3f) -> vec2f {
    let p = direction.xy / (abs(direction.x) + abs(direction.y) + abs(direction.z));
    let folded = (1.0 - abs(p.yx)) * select(vec2f(-1.0), vec2f(1.0), p >= vec2f(0.0));
    return 0.5 + 0.5 * select(p, folded, direction.z < 0.0);
}

fn dome_direction(place: vec2f) -> vec3f {
    let p = 2.0 * place - 1.0;
    let z = 1.0 - abs(p.x) - abs(p.y);
    let folded = (1.0 - abs(p.yx)) * select(vec2f(-1.0), vec2f(1.0), p >= vec2f(0.0));
    return normalize(vec3f(select(p, folded, z < 0.0), z));
}

// Blocks stand side by side in a texture, so many to a row.
const BLOCKS_IN_ROW = 32u;

// Where the texel of a block's corner is.
fn dome_texel(slot: u32, corner: vec2u) -> vec2u {
    return BLOCK_SIDE * vec2u(slot % BLOCKS_IN_ROW, slot / BLOCKS_IN_ROW) + corner;
}

// No cell reaches over so many of its sides.
const APART = 6.0;

// Where a corner looks. One that is just under the horizon looks over it instead where the sky's clouds are what is seen, so
// that they run down to the horizon itself. `up` is the observer's zenith and `horizon` the cosine of the horizon's angle
// with it.
fn dome_sight(dome: Dome, corner: vec2u, up: vec3f, horizon: f32) -> vec3f {
    let reach = select(0.0, APART / f32(dome.cells), dome.under_clouds == 1u);
    return over_horizon(dome_direction(vec2f(corner) / f32(dome.cells)), up, horizon, reach);
}

// Where the values about a direction are kept.
struct DomeCell {
    // Of the block, in the list of pages.
    page: u32,
    // The place in the block, from its first corner's centre on.
    place: vec2f,
}

// No cell is looked at that holds both sky and ground: from near the horizon one looks up or down to the next. Where corners
// under the horizon are of the sky, that is one farther down and none up.
fn dome_cell(dome: Dome, direction: vec3f, up: vec3f, horizon: f32) -> DomeCell {
    let mu = dot(direction, up);
    let apart = APART / f32(dome.cells);
    let under = f32(dome.under_clouds);
    let away = select(min(horizon - (1.0 + under) * apart - mu, 0.0), max(horizon + (1.0 - under) * apart - mu, 0.0), mu >= horizon);
    let at = dome_place(direction + away * up) * f32(dome.cells);
    let cell = min(vec2u(at), vec2u(dome.cells - 1u));
    let block = cell / BLOCK_CELLS;
    return DomeCell(block.y * (dome.cells / BLOCK_CELLS) + block.x, at - vec2f(block * BLOCK_CELLS));
}

// The texture's coordinate for a linear sampler; `size` is the texture's.
fn dome_coordinate(slot: u32, place: vec2f, size: vec2u) -> vec2f {
    return (vec2f(dome_texel(slot, vec2u(0u))) + place + 0.5) / vec2f(size);
}
