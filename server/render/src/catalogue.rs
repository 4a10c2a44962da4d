//! The stars' catalogue: places, and what each sends in our three bands.

use std::sync::LazyLock;

/// Twelve bytes a star, as `scripts/stars.mjs` writes them.
const BYTES: &[u8] = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/stars.bin"));
const RECORD: usize = 12;
/// Marks a colour that is not known.
const UNKNOWN: i16 = i16::MIN;

/// Irradiance of a star of V = 0 at 550 nm above the air, W/m²/nm (Bessell 1979).
pub(crate) const MAGNITUDE_ZERO_W_M2: f64 = 3.63e-11;
/// Our bands' wavelengths, metres.
const WAVELENGTHS_M: [f64; 3] = [680e-9, 550e-9, 440e-9];
/// B-V of a star whose colour is not known: that of the sun.
const USUAL_COLOUR: f64 = 0.65;

/// A star; J2000.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Star {
    pub(crate) right_ascension_deg: f64,
    pub(crate) declination_deg: f64,
    pub(crate) magnitude: f64,
    /// Above the air, W/m².
    pub(crate) irradiance_w_m2: [f64; 3],
}

/// All stars, brightest first.
pub(crate) fn stars() -> &'static [Star] {
    static STARS: LazyLock<Vec<Star>> =
        LazyLock::new(|| BYTES.as_chunks::<RECORD>().0.iter().map(read).collect());
    &STARS
}

fn read(b: &[u8; RECORD]) -> Star {
    let colour = i16::from_le_bytes([b[10], b[11]]);
    let magnitude = f64::from(i16::from_le_bytes([b[8], b[9]])) * 1e-3;
    let colour = if colour == UNKNOWN {
        USUAL_COLOUR
    } else {
        f64::from(colour) * 1e-3
    };
    Star {
        right_ascension_deg: f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]])) * 1e-6,
        declination_deg: f64::from(i32::from_le_bytes([b[4], b[5], b[6], b[7]])) * 1e-6,
        magnitude,
        irradiance_w_m2: irradiance_w_m2(magnitude, colour),
    }
}

/// The magnitude fixes the band at 550 nm; the others follow a black body of the colour's temperature.
fn irradiance_w_m2(magnitude: f64, colour: f64) -> [f64; 3] {
    let kelvin = temperature_k(colour);
    let green = planck(WAVELENGTHS_M[1], kelvin);
    WAVELENGTHS_M.map(|m| MAGNITUDE_ZERO_W_M2 * 10_f64.powf(-0.4 * magnitude) * planck(m, kelvin) / green)
}

/// Temperature of the black body with a colour B-V (Ballesteros 2012), kelvin.
fn temperature_k(colour: f64) -> f64 {
    // Beyond these no star's surface follows a black body, and the formula has its pole at -0.67.
    let c = 0.92 * colour.clamp(-0.4, 2.0);
    4600.0 * (1.0 / (c + 1.7) + 1.0 / (c + 0.62))
}

/// Planck's law but for a constant factor.
fn planck(wavelength_m: f64, kelvin: f64) -> f64 {
    /// hc/k, metre kelvin.
    const SECOND_RADIATION_CONSTANT: f64 = 0.014_387_769;
    1.0 / (wavelength_m.powi(5) * (SECOND_RADIATION_CONSTANT / (wavelength_m * kelvin)).exp_m1())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nearest(right_ascension_deg: f64, declination_deg: f64) -> &'static Star {
        let off = |s: &Star| {
            let east = (s.right_ascension_deg - right_ascension_deg) * declination_deg.to_radians().cos();
            east.hypot(s.declination_deg - declination_deg)
        };
        stars().iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap()
    }

    #[test]
    fn the_catalogue_is_whole() {
        assert_eq!(stars().len(), 5044);
        assert!(stars().is_sorted_by(|a, b| a.magnitude <= b.magnitude));
        for star in stars() {
            assert!((0.0..360.0).contains(&star.right_ascension_deg), "{star:?}");
            assert!((-90.0..=90.0).contains(&star.declination_deg), "{star:?}");
            assert!((-1.5..=6.0).contains(&star.magnitude), "{star:?}");
        }
    }

    #[test]
    fn well_known_stars_are_there() {
        // Right ascension, declination (J2000), V: Sirius, Vega, Polaris, Betelgeuse, Rigel.
        for (ra, dec, magnitude) in [
            (101.2872, -16.7161, -1.44),
            (279.2347, 38.7837, 0.03),
            (37.9546, 89.2641, 1.97),
            (88.7929, 7.4071, 0.45),
            (78.6345, -8.2016, 0.18),
        ] {
            let star = nearest(ra, dec);
            // Betelgeuse changes; the others are printed to a hundredth.
            assert!((star.magnitude - magnitude).abs() < 0.1, "{star:?}");
            assert!(
                (star.right_ascension_deg - ra).abs() < 0.01 && (star.declination_deg - dec).abs() < 0.01
            );
        }
    }

    #[test]
    fn colours_are_those_of_the_stars() {
        // Effective temperatures: the sun 5772 K, Vega 9600 K (B-V 0.00), Betelgeuse 3600 K (1.85). Ballesteros'
        // black bodies come within a few percent for middling stars, 10 % at the ends.
        for (colour, kelvin) in [(0.65, 5772.0), (0.0, 9600.0), (1.85, 3300.0)] {
            let found = temperature_k(colour);
            assert!((found / kelvin - 1.0_f64).abs() < 0.1, "{colour}: {found}");
        }
        let red = nearest(88.7929, 7.4071).irradiance_w_m2;
        let blue = nearest(78.6345, -8.2016).irradiance_w_m2;
        assert!(red[0] > red[1] && red[1] > red[2], "Betelgeuse: {red:?}");
        assert!(blue[0] < blue[1] && blue[1] < blue[2], "Rigel: {blue:?}");
    }

    #[test]
    fn the_magnitude_fixes_the_green_band() {
        for star in stars() {
            let expected = 3.63e-11 * 10_f64.powf(-0.4 * star.magnitude);
            assert!(
                (star.irradiance_w_m2[1] / expected - 1.0).abs() < 1e-12,
                "{star:?}"
            );
        }
    }
}
