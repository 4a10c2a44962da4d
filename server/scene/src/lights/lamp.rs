//! Kinds of lamp: their spectra, and the colours that these are.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Kinds of lamp.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Lamp {
    /// A flame of soot at 1900 K.
    Candle,
    /// A filament.
    Incandescent,
    /// The golden light of most streets: sodium's lines, broadened, with dips where the vapour takes its own light.
    #[default]
    HighPressureSodium,
    /// The pure orange of sodium's D lines.
    LowPressureSodium,
    /// The lines of mercury: bluish green.
    Mercury,
    /// Mercury with iodides that fill its spectrum up: white.
    MetalHalide,
    /// A blue diode under a phosphor.
    WhiteLed,
}

/// A line or a band of a spectrum: its middle and its width as a normal distribution, nanometres, and its share.
type Band = (f64, f64, f64);

/// After measured lamps (Elvidge et al. 2010, "Spectral identification of lighting type and character", Sensors 10):
/// the 589 nm resonance lines reversed and broadened by pressure, with the lines at 498, 569 and 616 nm beside.
const HIGH_PRESSURE_SODIUM: &[Band] = &[
    (467.0, 2.0, 0.015),
    (498.0, 2.5, 0.045),
    (515.0, 3.0, 0.02),
    (569.0, 3.0, 0.16),
    (583.0, 4.0, 0.22),
    (598.0, 9.0, 0.38),
    (616.0, 4.0, 0.08),
    (650.0, 45.0, 0.12),
];
const LOW_PRESSURE_SODIUM: &[Band] = &[(589.3, 0.5, 1.0)];
/// Radiance of the arc's visible lines, of the 546 nm line (Elenbaas 1951, the high-pressure mercury vapour discharge).
const MERCURY: &[Band] = &[
    (404.7, 1.0, 0.42),
    (435.8, 1.0, 0.78),
    (546.1, 1.0, 1.0),
    (578.0, 1.5, 1.0),
    (620.0, 60.0, 0.25),
];
/// Mercury's lines, those of sodium, thallium, indium and scandium, and what dysprosium's many lines fill in.
const METAL_HALIDE: &[Band] = &[
    (435.8, 1.5, 0.25),
    (451.0, 3.0, 0.2),
    (535.0, 2.5, 0.35),
    (546.1, 1.5, 0.25),
    (578.0, 2.0, 0.25),
    (590.0, 5.0, 0.4),
    (545.0, 75.0, 3.0),
];
/// The diode, and its phosphor.
const LED_BLUE: Band = (452.0, 10.0, 1.0);
const LED_PHOSPHOR: Band = (575.0, 55.0, 1.0);

const CANDLE_K: f64 = 1_900.0;
const INCANDESCENT_K: f64 = 2_700.0;
const LED_K: f64 = 4_000.0;

impl Lamp {
    /// Linear Rec. 709 colour of luminance 1. What no screen can show, as sodium's orange, is brought to its edge.
    #[must_use]
    pub fn colour(self, colour_temperature_k: Option<f64>) -> [f64; 3] {
        let bands = |bands: &[Band]| integrate(|nm| bands.iter().map(|&band| normal(nm, band)).sum());
        let xyz = match self {
            Self::Candle => integrate(|nm| planck(nm, CANDLE_K)),
            Self::Incandescent => {
                let kelvin = colour_temperature_k.unwrap_or(INCANDESCENT_K);
                integrate(|nm| planck(nm, kelvin))
            }
            Self::HighPressureSodium => bands(HIGH_PRESSURE_SODIUM),
            Self::LowPressureSodium => bands(LOW_PRESSURE_SODIUM),
            Self::Mercury => bands(MERCURY),
            Self::MetalHalide => bands(METAL_HALIDE),
            Self::WhiteLed => led(colour_temperature_k.unwrap_or(LED_K)),
        };
        let rgb = XYZ_TO_RGB.map(|row| row.iter().zip(xyz).map(|(m, v)| m * v).sum::<f64>().max(0.0));
        let luminance: f64 = rgb.iter().zip(LUMA).map(|(c, l)| c * l).sum();
        rgb.map(|c| c / luminance)
    }
}

/// Of linear Rec. 709, D65.
const LUMA: [f64; 3] = [0.2126, 0.7152, 0.0722];
const XYZ_TO_RGB: [[f64; 3]; 3] = [
    [3.2406, -1.5372, -0.4986],
    [-0.9689, 1.8758, 0.0415],
    [0.0557, -0.2040, 1.0570],
];

/// The mix of diode and phosphor whose ratio of blue to all that is seen is that of a black body of the temperature.
fn led(kelvin: f64) -> [f64; 3] {
    let blue = integrate(|nm| normal(nm, LED_BLUE));
    let yellow = integrate(|nm| normal(nm, LED_PHOSPHOR));
    let [_, y, z] = integrate(|nm| planck(nm, kelvin));
    // (blue Z + s yellow Z) / (blue Y + s yellow Y) = z/y; a temperature beyond the phosphor's own has no blue.
    let share = ((blue[2] - z / y * blue[1]) / (z / y * yellow[1] - yellow[2])).max(0.0);
    let share = if z / y * yellow[1] > yellow[2] { share } else { 1e6 };
    [0, 1, 2].map(|i| blue[i] + share * yellow[i])
}

fn normal(nm: f64, (middle, width, share): Band) -> f64 {
    share / width * (-0.5 * ((nm - middle) / width).powi(2)).exp()
}

/// Planck's law, in no particular unit.
fn planck(nm: f64, kelvin: f64) -> f64 {
    // hc/k in nm K.
    let x: f64 = 1.438_776_9e7 / (nm * kelvin);
    (560.0 / nm).powi(5) * ((1.438_776_9e7 / (560.0 * kelvin)).exp_m1() / x.exp_m1())
}

/// By half nanometres, over what is seen, with the colour matching functions of the CIE 1931 observer.
fn integrate(spectrum: impl Fn(f64) -> f64) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for i in 0..=800_u32 {
        let nm = 380.0 + 0.5 * f64::from(i);
        let light = spectrum(nm);
        for (sum, sensed) in sum.iter_mut().zip(observer(nm)) {
            *sum += light * sensed;
        }
    }
    sum
}

/// CIE 1931 by lobes of two halves (Wyman, Sloan and Shirley 2013, "Simple analytic approximations to the CIE XYZ color
/// matching functions", table 1).
fn observer(nm: f64) -> [f64; 3] {
    let lobe = |middle: f64, below: f64, above: f64| {
        let t = (nm - middle) * if nm < middle { below } else { above };
        (-0.5 * t * t).exp()
    };
    [
        0.362 * lobe(442.0, 0.0624, 0.0374) + 1.056 * lobe(599.8, 0.0264, 0.0323)
            - 0.065 * lobe(501.1, 0.0490, 0.0382),
        0.821 * lobe(568.8, 0.0213, 0.0247) + 0.286 * lobe(530.9, 0.0613, 0.0322),
        1.217 * lobe(437.0, 0.0845, 0.0278) + 0.681 * lobe(459.0, 0.0385, 0.0725),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_have_luminance_one_and_lie_where_the_eye_sees_them() {
        use Lamp::{
            Candle, HighPressureSodium, Incandescent, LowPressureSodium, Mercury, MetalHalide, WhiteLed,
        };
        for lamp in [
            Candle,
            Incandescent,
            HighPressureSodium,
            LowPressureSodium,
            Mercury,
            MetalHalide,
            WhiteLed,
        ] {
            let [r, g, b] = lamp.colour(None);
            // By construction, to the digits of the constants.
            assert!((0.2126 * r + 0.7152 * g + 0.0722 * b - 1.0).abs() < 1e-12);
            println!("{lamp:?} {r:.3} {g:.3} {b:.3}");
        }
        let warmth = |lamp: Lamp, kelvin| {
            let [r, _, b] = lamp.colour(kelvin);
            r / b.max(1e-3)
        };
        assert!(warmth(Candle, None) > warmth(Incandescent, None));
        for lamp in [Incandescent, WhiteLed] {
            assert!(warmth(lamp, Some(2_700.0)) > warmth(lamp, Some(4_000.0)));
            assert!(warmth(lamp, Some(4_000.0)) > warmth(lamp, Some(6_500.0)));
        }
        let [_, green, blue] = HighPressureSodium.colour(None);
        assert!(blue < 0.3 * green, "golden");
        assert_eq!(LowPressureSodium.colour(None)[2], 0.0, "no blue at all");
        let [red, green, _] = Mercury.colour(None);
        assert!(green > red, "greenish");
    }

    #[test]
    fn daylight_is_white() {
        // A black body of 6500 K is a little pinker than D65; the fitted observer is within some percent.
        for channel in Lamp::Incandescent.colour(Some(6_500.0)) {
            assert!((channel - 1.0).abs() < 0.08, "{channel}");
        }
    }
}
