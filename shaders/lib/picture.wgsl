// From radiance to a pixel of the picture: the lens' glare, exposure, white balance, tone curve, sRGB, dither.
import package::lib::colour::{LUMINANCE_PER_RADIANCE, aces, agx, exponential, reinhard, srgb_encode, srgb_of_gamma_22};

struct Tone {
    // White balance, rows of a 3×3 matrix on linear Rec. 709.
    white_r: vec3f,
    // 1 to dither.
    dither: u32,
    white_g: vec3f,
    // 1 where the meter's exposure counts.
    metered: u32,
    white_b: vec3f,
    glaring_angular_radius: f32,
    // Multiplies radiance where nothing is metered.
    gain: vec3f,
    glare: f32,
    // Irradiance of the visible disc at the observer, behind clouds: the sun's or the moon's.
    glaring_irradiance: vec3f,
    // From one pixel of the tile to the next in the frame.
    stride_px: u32,
    origin_px: vec2u,
    size_px: vec2u,
}

struct Exposure {
    scale: f32,
    ev100: f32,
}

// A hash of the pixel's place in the whole frame (PCG, O'Neill 2014), so that tiles leave no seam.
fn hash(v: vec3u) -> vec3u {
    var x = v * 1664525u + 1013904223u;
    x.x += x.y * x.z;
    x.y += x.z * x.x;
    x.z += x.x * x.y;
    x ^= x >> vec3u(16u);
    x.x += x.y * x.z;
    x.y += x.z * x.x;
    x.z += x.x * x.y;
    return x;
}

// Triangular noise of ±1 step: the mean and the noise of what is seen no longer depend on the value. The two halves of
// a word are two even noises.
fn dither_noise(pixel: vec2u) -> vec3f {
    let word = hash(vec3u(pixel, 0u));
    // Signed: processors turn these into floats in one step.
    return vec3f(vec3i(word >> vec3u(16u)) - vec3i(word & vec3u(0xffffu))) / 65536.0;
}

// Veiling luminance falls as E/θ² about a bright source and as E/θ³ farther off (CIE 146 has 10/θ³ + 5/θ² with θ in
// degrees for a healthy eye); a clean lens spreads about a thirtieth of that. Inside the disc it is even.
const LENS_VEIL = 0.35;
const VEIL_STEEPENS_DEG = 2.5;

fn lens_veil(off_deg: f32) -> f32 {
    return LENS_VEIL / (max(off_deg * off_deg, 0.01) * (1.0 + off_deg / VEIL_STEEPENS_DEG));
}

fn lens_glare(tone: Tone, angle: f32) -> vec3f {
    let off_deg = degrees(max(angle, tone.glaring_angular_radius));
    return tone.glare * lens_veil(off_deg) * tone.glaring_irradiance;
}

// R, G and B of the picture from 0 to 255, before they are dithered. `seen.a` is 0 where the projection sees nothing, else
// one more than the angle from the disc that glares. `curve`: 0 reinhard, 1 exponential, 2 aces, 3 agx; constant where it
// is called, so that no device computes all four.
fn shown_colour(tone: Tone, exposure_scale: f32, curve: u32, seen: vec4f) -> vec3f {
    let gain = select(tone.gain, LUMINANCE_PER_RADIANCE * exposure_scale, tone.metered == 1u);
    let exposed = gain * (seen.rgb + select(vec3f(0.0), lens_glare(tone, seen.a - 1.0), seen.a > 0.0));
    let balanced = max(vec3f(dot(tone.white_r, exposed), dot(tone.white_g, exposed), dot(tone.white_b, exposed)), vec3f(0.0));
    var shown: vec3f;
    switch curve {
        case 0u: { shown = srgb_encode(reinhard(balanced)); }
        case 1u: { shown = srgb_encode(exponential(balanced)); }
        case 2u: { shown = srgb_encode(aces(balanced)); }
        default: { shown = srgb_of_gamma_22(agx(balanced)); }
    }
    return 255.0 * shown;
}

// R, G, B, A bytes, from the least significant, dithered by the place in the whole frame; what is not seen is black.
fn packed_pixel(tone: Tone, shown: vec3f, is_seen: bool, pixel: vec2u) -> u32 {
    var bytes = shown;
    if tone.dither == 1u && is_seen {
        bytes += dither_noise(pixel);
    }
    // 2^23 and a number under it, as a float, is 0x4b000000 and that number, rounded, as bits. The sum of what the three put
    // into the highest byte is made 255 by the last term.
    let rounded = bitcast<vec3u>(clamp(bytes, vec3f(0.0), vec3f(255.0)) + 8388608.0);
    return rounded.r + (rounded.g << 8u) + (rounded.b << 16u) + 0xb4000000u;
}

// From what is seen to the bytes.
fn picture_pixel(tone: Tone, exposure_scale: f32, curve: u32, seen: vec4f, pixel: vec2u) -> u32 {
    return packed_pixel(tone, shown_colour(tone, exposure_scale, curve, seen), seen.a > 0.0, pixel);
}
