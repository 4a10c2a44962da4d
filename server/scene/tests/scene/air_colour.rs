//! The default coefficients against spectra integrated over every 5 nm.

use welkin_scene::Atmosphere;

const WAVES: usize = 81;

fn wave_nm(i: usize) -> f64 {
    380.0 + 5.0 * i as f64
}

/// A Gaussian of unlike sides; the last two are 1/σ below and above the middle, 1/nm.
fn lobe(nm: f64, height: f64, middle: f64, below: f64, above: f64) -> f64 {
    let x = (nm - middle) * if nm < middle { below } else { above };
    height * (-0.5 * x * x).exp()
}

/// CIE 1931 by the sums of Wyman, Sloan and Shirley 2013, in linear Rec. 709.
fn responses(nm: f64) -> [f64; 3] {
    let x = lobe(nm, 0.362, 442.0, 0.0624, 0.0374) + lobe(nm, 1.056, 599.8, 0.0264, 0.0323)
        - lobe(nm, 0.065, 501.1, 0.0490, 0.0382);
    let y = lobe(nm, 0.821, 568.8, 0.0213, 0.0247) + lobe(nm, 0.286, 530.9, 0.0613, 0.0322);
    let z = lobe(nm, 1.217, 437.0, 0.0845, 0.0278) + lobe(nm, 0.681, 459.0, 0.0385, 0.0725);
    [
        3.2406 * x - 1.5372 * y - 0.4986 * z,
        -0.9689 * x + 1.8758 * y + 0.0415 * z,
        0.0557 * x - 0.2040 * y + 1.0570 * z,
    ]
}

/// Black body of 5800 K, unscaled.
fn sunlight(nm: f64) -> f64 {
    nm.powi(-5) / ((1.4388e7 / (nm * 5800.0)).exp() - 1.0)
}

/// What is seen of the share of sunlight that a spectrum leaves, relative to all of it.
fn seen(left: impl Fn(f64) -> f64) -> [f64; 3] {
    let mut sums = [[0.0; 2]; 3];
    for nm in (0..WAVES).map(wave_nm) {
        for (sum, response) in sums.iter_mut().zip(responses(nm)) {
            sum[0] += response * sunlight(nm) * left(nm);
            sum[1] += response * sunlight(nm);
        }
    }
    sums.map(|[part, whole]| part / whole)
}

/// Vertical optical depth of molecules: Bodhaine et al. 1999, as a power of the wavelength.
fn molecules(nm: f64) -> f64 {
    0.0973 * (550.0 / nm).powf(4.08)
}

/// Vertical optical depth of 300 DU of ozone: the Chappuis bands, 1e-21 cm² (Gorshelev et al. 2014), times 8.06e18/cm².
fn ozone(nm: f64) -> f64 {
    const BANDS: [(f64, f64); 23] = [
        (380.0, 0.0),
        (400.0, 0.01),
        (420.0, 0.03),
        (440.0, 0.125),
        (450.0, 0.17),
        (460.0, 0.33),
        (480.0, 0.68),
        (500.0, 1.2),
        (520.0, 1.76),
        (540.0, 2.9),
        (550.0, 3.3),
        (560.0, 3.9),
        (575.0, 4.75),
        (590.0, 4.6),
        (600.0, 5.1),
        (610.0, 4.7),
        (625.0, 3.7),
        (650.0, 2.45),
        (680.0, 1.36),
        (700.0, 0.88),
        (720.0, 0.6),
        (740.0, 0.4),
        (780.0, 0.25),
    ];
    let next = BANDS.iter().position(|(at, _)| *at >= nm).unwrap().max(1);
    let [(a, low), (b, high)] = [BANDS[next - 1], BANDS[next]];
    (low + (high - low) * (nm - a) / (b - a)) * 8.06e-3
}

/// The same by the default coefficients, in R, G and B.
fn by_default(light: [f64; 3], air: f64, of_ozone: f64) -> [f64; 3] {
    let defaults = Atmosphere::default();
    let (rayleigh, ozone) = (defaults.rayleigh.unwrap(), defaults.ozone.unwrap());
    // A tent's integral is its half width.
    std::array::from_fn(|c| {
        let depth = air * rayleigh.scattering_per_m[c] * rayleigh.scale_height_m
            + of_ozone * ozone.absorption_per_m[c] * ozone.half_width_m;
        light[c] * (-depth).exp()
    })
}

#[test]
fn the_sun_reddens_as_its_spectrum_does() {
    // Down to a sun at 2°.
    for (air, of_ozone) in [(1.0, 1.0), (5.0, 5.0), (12.0, 11.0), (20.0, 18.0)] {
        let truth = seen(|nm| (-air * molecules(nm) - of_ozone * ozone(nm)).exp());
        let ours = by_default([1.0; 3], air, of_ozone);
        // Three coefficients for whole spectra: within a tenth; single wavelengths are wrong by up to 2.06 times.
        let ratio = (ours[0] / ours[1]) / (truth[0] / truth[1]);
        assert!((0.9..1.1).contains(&ratio), "{air}: {ours:?} for {truth:?}");
        assert!(
            (ours[2] - truth[2]).abs() < 0.08 * truth[1],
            "{air}: {ours:?} for {truth:?}"
        );
    }
}

#[test]
fn molecules_and_dusk_are_as_blue_as_their_spectra() {
    let rayleigh = Atmosphere::default().rayleigh.unwrap().scattering_per_m;
    let truth = seen(|nm| molecules(nm) / 0.0973);
    for c in 0..3 {
        let ours = rayleigh[c] * 8_000.0 / 0.0973 / (13.75e-6 * 8_000.0 / 0.0987);
        // As the coefficients are rounded.
        assert!((ours / truth[c] - 1.0).abs() < 0.02, "{c}: {ours} for {truth:?}");
    }
    // At dusk light has gone through the ozone aslant. The zenith is blue, not purple: less red than green by half.
    let dusk = |air: f64, of_ozone: f64| {
        seen(|nm| molecules(nm) * (-air * molecules(nm) - of_ozone * ozone(nm)).exp())
    };
    let truth = dusk(3.0, 20.0);
    let ours = by_default(rayleigh, 3.0, 20.0);
    let red = [truth[0] / truth[1], ours[0] / ours[1]];
    // Red after ozone is less even than one coefficient tells, by a tenth of green; 680 nm gives 0.75 for 0.35.
    assert!((red[0] - red[1]).abs() < 0.12, "{red:?}");
    let blue = [truth[2] / truth[1], ours[2] / ours[1]];
    assert!((blue[0] / blue[1] - 1.0).abs() < 0.05, "{blue:?}");
}
