// From the three bands to light as people see it, and to the screen.

// cd/m² in linear Rec. 709 R, G, B for one W/m²/sr/nm in each band. A camera set to daylight: the sun above the air,
// (1.474, 1.8504, 1.91198) W/m²/nm, is white, and sends the solar illuminance of 133 klx (ASTM E490).
const LUMINANCE_PER_RADIANCE = vec3f(90231.0, 71876.0, 69561.0);
// Luminance of linear Rec. 709.
const LUMA = vec3f(0.2126, 0.7152, 0.0722);

fn photopic_luminance(radiance: vec3f) -> f32 {
    return dot(LUMA, radiance * LUMINANCE_PER_RADIANCE);
}

// IEC 61966-2-1.
fn srgb_encode(c: vec3f) -> vec3f {
    let low = 12.92 * c;
    let high = 1.055 * pow(max(c, vec3f(0.0)), vec3f(1.0 / 2.4)) - 0.055;
    return select(high, low, c <= vec3f(0.0031308));
}

fn reinhard(c: vec3f) -> vec3f {
    return c / (1.0 + c);
}

fn exponential(c: vec3f) -> vec3f {
    return 1.0 - exp(-c);
}

// ACES reference rendering and output transforms, as fitted by Hill (2016) in one rational function between the two
// changes of primaries.
fn aces(c: vec3f) -> vec3f {
    let into = mat3x3f(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    let out = mat3x3f(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    let v = into * c;
    let fitted = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return clamp(out * fitted, vec3f(0.0), vec3f(1.0));
}

// AgX (Sobotka 2022): primaries drawn in, sixteen and a half stops of log, one S-curve (Wrensch's polynomial fit),
// primaries drawn out. The curve gives display values of gamma 2.2. Its foot steepens the differences between bands, so that colour is
// added to what is bright alone: shadows under a blue sky would come out ultramarine.
const AGX_SATURATION = 0.25;

fn agx(c: vec3f) -> vec3f {
    let inset = mat3x3f(
        0.842479062253094, 0.0423282422610123, 0.0423756549057051,
        0.0784335999999992, 0.878468636469772, 0.0784336,
        0.0792237451477643, 0.0791661274605434, 0.879142973793104,
    );
    let outset = mat3x3f(
        1.19687900512017, -0.0528968517574562, -0.0529716355144438,
        -0.0980208811401368, 1.15190312990417, -0.0980434501171241,
        -0.0990297440797205, -0.0989611768448433, 1.15107367264116,
    );
    let least = -12.47393;
    let most = 4.026069;
    let x = clamp((log2(max(inset * c, vec3f(1e-10))) - least) / (most - least), vec3f(0.0), vec3f(1.0));
    let x2 = x * x;
    let x4 = x2 * x2;
    let curve = 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
    let shown = max(curve, vec3f(0.0));
    let luma = dot(LUMA, shown);
    let graded = max(mix(vec3f(luma), shown, 1.0 + AGX_SATURATION * min(2.0 * luma, 1.0)), vec3f(0.0));
    return clamp(outset * graded, vec3f(0.0), vec3f(1.0));
}

// sRGB of v^2.2: one power, and at its foot, 12.92 v^2.2 by the cubic with its value and slope at the foot's end and at
// zero (off by 0.1 of 255 at most).
fn srgb_of_gamma_22(v: vec3f) -> vec3f {
    let high = 1.055 * pow(v, vec3f(2.2 / 2.4)) - 0.055;
    let low = v * v * (6.123 + 21.05 * v);
    return select(high, low, v <= vec3f(0.07275));
}
