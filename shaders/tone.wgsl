// From radiance to the picture: the lens' glare, exposure, white balance, tone curve, sRGB, dither.
import package::lib::colour::{LUMINANCE_PER_RADIANCE, aces, agx, exponential, reinhard, srgb_encode, srgb_of_gamma_22};

// 0 reinhard, 1 exponential, 2 aces, 3 agx. A variant each, so that no device computes all four.
override CURVE: u32 = 3u;

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
    // Irradiance of the visible disc at the observer: the sun's or the moon's.
    glaring_irradiance: vec3f,
    origin_px: vec2u,
    size_px: vec2u,
}

struct Exposure {
    scale: f32,
    ev100: f32,
}

@group(0) @binding(0) var<uniform> tone_settings: Tone;
@group(0) @binding(1) var<storage, read> exposure: Exposure;
// Alpha is 0 where the projection sees nothing, else one more than the angle from the disc that glares.
@group(0) @binding(2) var<storage, read> radiance: array<vec4f>;
// R, G, B, A bytes, from the least significant.
@group(0) @binding(3) var<storage, read_write> picture: array<u32>;

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
    return (vec3f(word >> vec3u(16u)) - vec3f(word & vec3u(0xffffu))) / 65536.0;
}

// Veiling luminance falls as E/θ² about a bright source and as E/θ³ farther off (CIE 146 has 10/θ³ + 5/θ² with θ in
// degrees for a healthy eye); a clean lens spreads about a thirtieth of that. Inside the disc it is even.
const LENS_VEIL = 0.35;
const VEIL_STEEPENS_DEG = 2.5;

fn lens_glare(angle: f32) -> vec3f {
    let off_deg = degrees(max(angle, tone_settings.glaring_angular_radius));
    let veil = LENS_VEIL / (max(off_deg * off_deg, 0.01) * (1.0 + off_deg / VEIL_STEEPENS_DEG));
    return tone_settings.glare * veil * tone_settings.glaring_irradiance;
}

@compute @workgroup_size(8, 8)
fn tone(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= tone_settings.size_px) {
        return;
    }
    let i = id.y * tone_settings.size_px.x + id.x;
    let gain = select(tone_settings.gain, LUMINANCE_PER_RADIANCE * exposure.scale, tone_settings.metered == 1u);
    let pixel = radiance[i];
    let seen = pixel.a > 0.0;
    let exposed = gain * (pixel.rgb + select(vec3f(0.0), lens_glare(pixel.a - 1.0), seen));
    let balanced = max(vec3f(dot(tone_settings.white_r, exposed), dot(tone_settings.white_g, exposed), dot(tone_settings.white_b, exposed)), vec3f(0.0));
    var shown: vec3f;
    switch CURVE {
        case 0u: { shown = reinhard(balanced); }
        case 1u: { shown = exponential(balanced); }
        case 2u: { shown = aces(balanced); }
        default: { shown = agx(balanced); }
    }
    if CURVE == 3u {
        shown = srgb_of_gamma_22(shown);
    } else {
        shown = srgb_encode(shown);
    }
    var bytes = 255.0 * shown;
    if tone_settings.dither == 1u && seen {
        bytes += dither_noise(tone_settings.origin_px + id.xy);
    }
    picture[i] = pack4x8unorm(vec4f(bytes / 255.0, 1.0));
}
