// What a cell of 16×16 pixels sees of one layer's pillar over one lamp, as a smooth function times a sharp one.
//
// About the axis to the lamp a ray is told by β, the angle from it, and by q_z, the sine of the least tilt. Across the pillar
// the light falls as S(q_z), the sum over all plates that tilt that little or more; all the rest, L b / S, changes over
// degrees, and within a cell is a polynomial of the second order.
import package::lib::pillar::{Crystals, Lamp};

struct Share {
    // 1, x, y, x², xy, y².
    even: f32,
    by_x: f32,
    by_y: f32,
    by_xx: f32,
    by_xy: f32,
    by_yy: f32,
    // x = b x_of.x + (w·v) x_of.y, as sin(β - β0) is; y = q_z y_of.x + y_of.y.
    x_of: vec2f,
    y_of: vec2f,
    // Between which ways along the rays it shines.
    stretch_m: vec2f,
    colour: vec3f,
    // What is to be done.
    kind: u32,
}

const DARK = 0u;
const SMOOTH = 1u;
// Too much happens in the cell: each pixel is a sum of its own.
const ROUGH = 2u;

// Vectors of four in a table.
const SHARE_WORDS = 4u;

fn polynomial(share: Share, x: vec4f, y: vec4f) -> vec4f {
    return vec4f(share.even) + x * (vec4f(share.by_x) + share.by_xx * x + share.by_xy * y) + y * (vec4f(share.by_y) + share.by_yy * y);
}

// Close to the sum over the plates' density, so that the quotient is smooth: of a normal distribution the peak, times
// erf(z/√2) ≈ √(1 - e^{-2z²/π}) of it within the largest tilt; of an even one the chord.
fn across(layer: Crystals, sin_least: vec4f) -> vec4f {
    let squared = sin_least * sin_least;
    let room = layer.sin_max * layer.sin_max - squared;
    let is_even = layer.law == 1u;
    let per_square = select(1.0 / (layer.sigma * layer.sigma), 0.1 / (layer.sin_max * layer.sin_max), is_even);
    let peak = exp(squared * select(-0.5 * per_square, 0.0, is_even));
    return peak * sqrt(1.0 - exp(-0.63661977 * per_square * max(room, vec4f(0.0))));
}

// How far a lamp's image is spread to each side: half its radius, and what a pixel blurs.
fn blur_of(lamp: Lamp, pixel_angle: f32) -> f32 {
    let spread = length(lamp.place_m) * pixel_angle * 0.3;
    return sqrt(0.25 * lamp.radius_m * lamp.radius_m + spread * spread);
}

// Directions of four rays, a component at a time.
struct Rays {
    x: vec4f,
    y: vec4f,
    z: vec4f,
}

fn ray_of(rays: Rays, which: u32) -> vec3f {
    return vec3f(rays.x[which], rays.y[which], rays.z[which]);
}

// Of a share that is smooth, the radiance along four rays in units of its colour.
fn smooth_pillar(layer: Crystals, share: Share, lamp: Lamp, rays: Rays, blur_m: f32) -> vec4f {
    let w = lamp.place_m;
    let normal_x = w.y * rays.z - w.z * rays.y;
    let normal_y = w.z * rays.x - w.x * rays.z;
    let normal_z = w.x * rays.y - w.y * rays.x;
    let b = sqrt(max(normal_x * normal_x + normal_y * normal_y + normal_z * normal_z, vec4f(1e-20)));
    let wide = max(b, vec4f(blur_m));
    // As `support_of` narrows the least tilt by the blur, and the light with it.
    let spread = select(layer.sigma, 0.5 * layer.sin_max, layer.law == 1u);
    let blur = blur_m / (wide * spread);
    let narrowed = inverseSqrt(1.0 + max(1.0 - rays.z * rays.z, vec4f(0.0)) * blur * blur);
    let q_z = normal_z / b;
    let x = b * share.x_of.x + (w.x * rays.x + w.y * rays.y + w.z * rays.z) * share.x_of.y;
    // Not far beyond the rays that it was made from: what is there is dim.
    let y = clamp(q_z * share.y_of.x + share.y_of.y, vec4f(-1.3), vec4f(1.3));
    return max(polynomial(share, x, y), vec4f(0.0)) * across(layer, narrowed * q_z) * narrowed / wide;
}
