//! White balance, and what the bands mean to the eye.

/// cd/m² in linear Rec. 709 for one W/m²/sr/nm in each band; the same numbers as in `lib/colour.wgsl`.
pub(crate) const LUMINANCE_PER_RADIANCE: [f64; 3] = [90_231.0, 71_876.0, 69_561.0];

type Matrix = [[f64; 3]; 3];

/// Linear Rec. 709 to CIE XYZ (IEC 61966-2-1).
const RGB_TO_XYZ: Matrix = [
    [0.412_390_8, 0.357_584_3, 0.180_480_8],
    [0.212_639_0, 0.715_168_7, 0.072_192_3],
    [0.019_330_8, 0.119_194_8, 0.950_532_2],
];
const XYZ_TO_RGB: Matrix = [
    [3.240_969_9, -1.537_383_2, -0.498_610_8],
    [-0.969_243_6, 1.875_967_5, 0.041_555_1],
    [0.055_630_1, -0.203_977_0, 1.056_971_5],
];
/// The cone space of the Bradford transform (Lam 1985).
const XYZ_TO_CONES: Matrix = [
    [0.8951, 0.2664, -0.1614],
    [-0.7502, 1.7135, 0.0367],
    [0.0389, -0.0685, 1.0296],
];
const CONES_TO_XYZ: Matrix = [
    [0.986_992_9, -0.147_054_3, 0.159_962_7],
    [0.432_305_3, 0.518_360_3, 0.049_291_2],
    [-0.008_528_7, 0.040_042_8, 0.968_486_7],
];

fn apply(m: &Matrix, v: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2])
}

fn multiply(a: &Matrix, b: &Matrix) -> Matrix {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j]))
}

/// Chromaticity of a black body, 1667 to 25 000 K (cubic fits of Kim et al. 2002), as XYZ with Y = 1.
fn black_body(kelvin: f64) -> [f64; 3] {
    let (t1, t2, t3) = (1e3 / kelvin, 1e6 / kelvin.powi(2), 1e9 / kelvin.powi(3));
    let x = if kelvin <= 4000.0 {
        -0.266_123_9 * t3 - 0.234_358_9 * t2 + 0.877_695_6 * t1 + 0.179_910
    } else {
        -3.025_846_9 * t3 + 2.107_037_9 * t2 + 0.222_634_7 * t1 + 0.240_390
    };
    let (x2, x3) = (x * x, x * x * x);
    let y = if kelvin <= 2222.0 {
        -1.106_381_4 * x3 - 1.348_110_20 * x2 + 2.185_558_32 * x - 0.202_196_83
    } else if kelvin <= 4000.0 {
        -0.954_947_6 * x3 - 1.374_185_93 * x2 + 2.091_370_15 * x - 0.167_488_67
    } else {
        3.081_758_0 * x3 - 5.873_386_70 * x2 + 3.751_129_97 * x - 0.370_014_83
    };
    [x / y, 1.0, (1.0 - x - y) / y]
}

/// The matrix on linear Rec. 709 after which light of this colour temperature is as white as 6500 K was before it.
pub(crate) fn white_balance(kelvin: f64) -> Matrix {
    let from = apply(&XYZ_TO_CONES, black_body(kelvin));
    let to = apply(&XYZ_TO_CONES, black_body(6500.0));
    let scaled = [0, 1, 2].map(|i| XYZ_TO_CONES[i].map(|c| c * to[i] / from[i]));
    multiply(
        &XYZ_TO_RGB,
        &multiply(&CONES_TO_XYZ, &multiply(&scaled, &RGB_TO_XYZ)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_and_a_half_thousand_kelvin_changes_nothing() {
        let m = white_balance(6500.0);
        for (i, row) in m.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                // The printed matrices have seven digits.
                assert!((value - f64::from(u8::from(i == j))).abs() < 2e-5, "{m:?}");
            }
        }
    }

    #[test]
    fn a_candle_becomes_white_when_asked() {
        let candle = apply(&XYZ_TO_RGB, black_body(2000.0));
        let seen = apply(&white_balance(2000.0), candle);
        let white = apply(&XYZ_TO_RGB, black_body(6500.0));
        for i in 0..3 {
            // As above: seven printed digits, through three products.
            assert!((seen[i] - white[i]).abs() < 1e-4, "{seen:?} {white:?}");
        }
    }
}
