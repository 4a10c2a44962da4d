//! The air that a report tells of.
//!
//! **Extinction.** A visibility V is an extinction of 3.912/V in the green band at the observer (Koschmieder 1924, 2 %
//! of contrast, as in [`Haze::visibility_m`]). Molecules have their share of it; background aerosol, which thins out
//! with height, the next; what is left, the layer of `haze`. With 5 km or more and no weather that hides the view, the
//! aerosol has all of it.
//!
//! **Where only a bound is told** (`9999`, `CAVOK`, `10SM`), the aerosol grows with humidity as (1 - RH)^-γ, γ = 0.5
//! (Kasten 1969; Hänel 1976), from an extinction at 60 % that with our scale height is an optical depth of 0.1, as of
//! clean air over land; but never so dense as to break the bound.
//!
//! **Molecules.** Their optical depth follows the pressure at the station (Hansen and Travis 1974), their density the
//! pressure and the temperature: coefficients go as P/T, the scale height as T. The pressure at the station comes from
//! that at sea level by the standard atmosphere, as altimeters are set (ICAO Doc 7488).

use super::{
    obscuration::{self, Obscuration, SHALLOW_VISIBILITY_M},
    report::{Bound, Report, Weather},
};
use crate::{
    atmosphere::{Atmosphere, Mie, Rayleigh},
    bands::Bands,
    haze::{Haze, KOSCHMIEDER},
};

/// Below this a visibility is a layer at the ground, metres.
const LAYER_BELOW_M: f64 = 5_000.0;
/// The least that a report tells: `0000` is below it, metres.
const LEAST_VISIBILITY_M: f64 = 50.0;
/// Index of the green band.
const GREEN: usize = 1;

/// Extinction of the aerosol in clean air over land at [`USUAL_HUMIDITY`], 1/m: an optical depth of 0.1 over 1200 m.
const CLEAN_PER_M: f64 = 0.1 / 1_200.0;
const USUAL_HUMIDITY: f64 = 0.6;
const GROWTH_EXPONENT: f64 = 0.5;
/// Above this the drops are mist, which has a group of its own.
const MOST_HUMIDITY: f64 = 0.99;

/// The standard atmosphere at sea level: hPa, K, lapse of temperature by metre over that, and the exponent g/(R·lapse).
const STANDARD_HPA: f64 = 1013.25;
const STANDARD_K: f64 = 288.15;
const LAPSE_PER_M: f64 = 0.0065 / STANDARD_K;
const EXPONENT: f64 = 5.255_88;
const ZERO_CELSIUS_K: f64 = 273.15;

/// Air, and what was left out of it.
pub(super) struct Air<'a> {
    pub(super) atmosphere: Atmosphere,
    pub(super) haze: Option<Haze>,
    /// There is fog, which hides the sky where the report says that it is hidden.
    pub(super) is_fogged: bool,
    /// The weather that is seen in it.
    pub(super) shown: Option<&'a Weather>,
    pub(super) notes: Vec<String>,
}

pub(super) fn air(report: &Report) -> Air<'_> {
    let mut notes = Vec::new();
    let rayleigh = molecules(report);
    let molecules_per_m = rayleigh.scattering_per_m[GREEN];
    let humid_per_m = humid_aerosol(report.relative_humidity);
    let told = obscuration::of(report);
    let is_low = |distance_m| distance_m < LAYER_BELOW_M;
    let (mut aerosol_per_m, mut layer) = (humid_per_m, None);
    match report.visibility {
        None => {
            notes.push("no visibility was reported: the air is as clear as its humidity lets expect".into())
        }
        Some(visibility) => {
            let distance_m = visibility.distance_m.max(LEAST_VISIBILITY_M);
            let rest_per_m = (KOSCHMIEDER / distance_m - molecules_per_m).max(0.0);
            if visibility.bound == Bound::AtLeast {
                aerosol_per_m = humid_per_m.min(rest_per_m);
            } else if told.is_some() || is_low(distance_m) {
                aerosol_per_m = humid_per_m.min(rest_per_m);
                let kind = told.map_or_else(|| obscuration::untold(report), |(kind, _)| kind);
                layer = Some((kind, rest_per_m - aerosol_per_m, told.map(|(_, weather)| weather)));
            } else {
                aerosol_per_m = rest_per_m;
            }
        }
    }
    if layer.is_none() {
        let shallow = obscuration::shallow(report);
        layer = shallow.map(|(kind, weather)| (kind, KOSCHMIEDER / SHALLOW_VISIBILITY_M, Some(weather)));
    }
    let layer = layer.filter(|(_, extinction_per_m, _)| *extinction_per_m > 0.0);
    if let Some((kind, _, weather)) = &layer {
        notes.push(note(kind, *weather));
    }
    let usual = Mie::default();
    let is_fogged = layer.is_some_and(|(kind, ..)| kind.is_fog());
    let asymmetry = layer.map_or(usual.asymmetry, |(kind, ..)| kind.asymmetry);
    let (haze, shown) = layer.map_or((None, None), |(kind, extinction_per_m, weather)| {
        (Some(haze(&kind, extinction_per_m)), weather)
    });
    let atmosphere = Atmosphere {
        rayleigh: Some(rayleigh),
        mie: Some(aerosol(usual, aerosol_per_m, asymmetry)),
        ..Atmosphere::default()
    };
    Air {
        atmosphere,
        haze,
        is_fogged,
        shown,
        notes,
    }
}

fn note(kind: &Obscuration, weather: Option<&Weather>) -> String {
    let (name, top_m) = (kind.name, (kind.top_m * 10.0).round() / 10.0);
    let patchy = |weather: &Weather| weather.descriptors.iter().any(|d| matches!(*d, "BC" | "PR"));
    let even = if weather.is_some_and(patchy) {
        "; patches are shown as one even layer"
    } else {
        ""
    };
    format!("{name} is shown as an even layer up to {top_m} m{even}")
}

fn haze(kind: &Obscuration, extinction_per_m: f64) -> Haze {
    Haze {
        visibility_m: None,
        extinction_per_m: Some(extinction_per_m),
        top_m: kind.top_m,
        albedo: kind.albedo,
    }
}

/// Aerosol of this extinction, with the albedo of the default.
fn aerosol(usual: Mie, extinction_per_m: f64, asymmetry: f64) -> Mie {
    let (scattering, absorption) = (
        usual.scattering_per_m.rgb()[GREEN],
        usual.absorption_per_m.rgb()[GREEN],
    );
    let albedo = scattering / (scattering + absorption);
    Mie {
        scattering_per_m: Bands::Grey(albedo * extinction_per_m),
        absorption_per_m: Bands::Grey((1.0 - albedo) * extinction_per_m),
        asymmetry,
        ..usual
    }
}

fn humid_aerosol(relative_humidity: Option<f64>) -> f64 {
    let humidity = relative_humidity
        .unwrap_or(USUAL_HUMIDITY)
        .clamp(0.0, MOST_HUMIDITY);
    CLEAN_PER_M * ((1.0 - USUAL_HUMIDITY) / (1.0 - humidity)).powf(GROWTH_EXPONENT)
}

/// The default is the standard atmosphere at sea level.
fn molecules(report: &Report) -> Rayleigh {
    let usual = Rayleigh::default();
    let elevation_m = report.place.map_or(0.0, |place| place.elevation_m);
    let pressure = report.pressure_hpa.unwrap_or(STANDARD_HPA) / STANDARD_HPA
        * (1.0 - LAPSE_PER_M * elevation_m).powf(EXPONENT);
    let temperature = report.temperature_c.map_or_else(
        || 1.0 - LAPSE_PER_M * elevation_m,
        |celsius| (celsius + ZERO_CELSIUS_K) / STANDARD_K,
    );
    Rayleigh {
        scattering_per_m: usual.scattering_per_m.map(|per_m| per_m * pressure / temperature),
        scale_height_m: usual.scale_height_m * temperature,
        ..usual
    }
}

/// Relative humidity over water from temperature and dew point, °C: Magnus' formula (Alduchov and Eskridge 1996).
pub(super) fn relative_humidity(temperature_c: f64, dew_point_c: f64) -> f64 {
    let magnus = |celsius: f64| 17.625 * celsius / (243.04 + celsius);
    (magnus(dew_point_c) - magnus(temperature_c))
        .exp()
        .clamp(0.0, 1.0)
}
