//! What hides the view near the ground, and how it scatters.
//!
//! Albedo and asymmetry: water drops scatter all of the light, with g about 0.85 (Hansen and Travis 1974); haze, smoke
//! and dust about as AERONET found them at Créteil, in the Cerrado (burning savanna) and at Solar Village (Dubovik et
//! al. 2002), between its wavelengths. Volcanic ash is taken for mineral dust. Heights are of our choosing, by how each
//! is mixed: fog by radiation, mist below a weak inversion, the others through the boundary layer.

use super::report::{Amount, Cloud, Report, Weather};
use crate::bands::Bands;

/// A kind of obscuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Obscuration {
    /// For the notes.
    pub(super) name: &'static str,
    pub(super) top_m: f64,
    pub(super) albedo: Bands,
    pub(super) asymmetry: f64,
    /// Made of water: it may reach up as far as the sky is hidden.
    is_water: bool,
}

impl Obscuration {
    /// Fog that one stands in.
    pub(super) fn is_fog(&self) -> bool {
        self.name == FOG.name && self.top_m > SHALLOW_TOP_M
    }
}

const DROPS: f64 = 0.85;
const FOG: Obscuration = water("fog", 150.0);
const MIST: Obscuration = water("mist", 300.0);
const HAZE: Obscuration = dry("haze", 1500.0, [0.93, 0.935, 0.94], 0.65);
const SMOKE: Obscuration = dry("smoke", 1500.0, [0.89, 0.9, 0.91], 0.63);
const DUST: Obscuration = dry("dust or sand", 2000.0, [0.96, 0.94, 0.92], 0.68);
const ASH: Obscuration = dry("volcanic ash", 3000.0, [0.96, 0.94, 0.92], 0.68);

/// Precipitation falls from the base of the clouds; this high where none is told, metres.
const PRECIPITATION_TOP_M: f64 = 1500.0;
const PRECIPITATION_TOPS_M: std::ops::RangeInclusive<f64> = 100.0..=3000.0;
/// What the wind blows up, metres.
const BLOWN_TOP_M: f64 = 100.0;
/// Shallow fog and drifting dust stay below eye level, 2 m, metres.
pub(super) const SHALLOW_TOP_M: f64 = 1.5;
/// Seen from within, shallow fog is fog: below 1000 m, metres.
pub(super) const SHALLOW_VISIBILITY_M: f64 = 500.0;
/// Where nothing tells, the air is misty from this humidity on, dry haze below it (WMO-No. 306, 4678: BR is of water).
const MIST_FROM_HUMIDITY: f64 = 0.8;
/// The highest that we let a hidden sky lift a layer, metres.
const HIDDEN_TOP_M: f64 = 1000.0;

const fn water(name: &'static str, top_m: f64) -> Obscuration {
    Obscuration {
        name,
        top_m,
        albedo: Bands::Grey(1.0),
        asymmetry: DROPS,
        is_water: true,
    }
}

const fn dry(name: &'static str, top_m: f64, albedo: [f64; 3], asymmetry: f64) -> Obscuration {
    Obscuration {
        name,
        top_m,
        albedo: Bands::Rgb(albedo),
        asymmetry,
        is_water: false,
    }
}

/// What hides most of what hides anything at the station, and the weather that tells.
pub(super) fn of(report: &Report) -> Option<(Obscuration, &Weather)> {
    let here = report
        .weather
        .iter()
        .filter(|weather| !weather.is_nearby && !is_shallow(weather));
    here.filter_map(|weather| Some((rank(weather)?, weather)))
        // Of equals the first.
        .min_by_key(|(rank, _)| *rank)
        .map(|(rank, weather)| (obscuration(rank, weather, report), weather))
}

/// Fog or drifting dust, sand or snow below eye level.
pub(super) fn shallow(report: &Report) -> Option<(Obscuration, &Weather)> {
    let mut here = report.weather.iter().filter(|weather| !weather.is_nearby);
    let weather = here.find(|weather| is_shallow(weather) && rank(weather).is_some())?;
    let kind = obscuration(rank(weather)?, weather, report);
    let top_m = SHALLOW_TOP_M;
    Some((Obscuration { top_m, ..kind }, weather))
}

/// Where the visibility is low and no weather says why.
pub(super) fn untold(report: &Report) -> Obscuration {
    let is_damp = report
        .relative_humidity
        .is_some_and(|humidity| humidity >= MIST_FROM_HUMIDITY);
    let kind = if is_damp { MIST } else { HAZE };
    lifted(kind, report)
}

fn is_shallow(weather: &Weather) -> bool {
    weather.descriptors.iter().any(|d| matches!(*d, "MI" | "DR"))
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Rank {
    Ash,
    Dust,
    Fog,
    Smoke,
    Haze,
    Snow,
    Rain,
    Mist,
}

fn rank(weather: &Weather) -> Option<Rank> {
    let of = |phenomenon: &&str| match *phenomenon {
        "VA" => Some(Rank::Ash),
        "DU" | "SA" | "DS" | "SS" => Some(Rank::Dust),
        "FG" => Some(Rank::Fog),
        "FU" => Some(Rank::Smoke),
        "HZ" => Some(Rank::Haze),
        "SN" | "SG" | "PL" | "PE" | "GS" => Some(Rank::Snow),
        "RA" | "DZ" | "GR" | "UP" | "PY" => Some(Rank::Rain),
        "BR" => Some(Rank::Mist),
        // Ice crystals are a part of the scene of their own; whirls and squalls are elsewhere.
        _ => None,
    };
    weather.phenomena.iter().filter_map(of).min()
}

fn obscuration(rank: Rank, weather: &Weather, report: &Report) -> Obscuration {
    let is_blown = weather.descriptors.contains(&"BL");
    let kind = match rank {
        Rank::Ash => ASH,
        Rank::Dust => DUST,
        Rank::Fog => FOG,
        Rank::Smoke => SMOKE,
        Rank::Haze => HAZE,
        Rank::Snow => water("snow", precipitation_top_m(&report.clouds)),
        Rank::Rain => water("rain", precipitation_top_m(&report.clouds)),
        Rank::Mist => MIST,
    };
    if is_blown {
        let top_m = BLOWN_TOP_M;
        return Obscuration { top_m, ..kind };
    }
    lifted(kind, report)
}

/// A hidden sky is one whose contrast falls below what the eye sees: an optical depth of 3.9, which a layer has that is
/// as high as one sees along the ground.
fn lifted(kind: Obscuration, report: &Report) -> Obscuration {
    let is_hidden = report.vertical_visibility_m.is_some() && kind.is_water;
    let Some(visibility) = report.visibility.filter(|_| is_hidden) else {
        return kind;
    };
    let top_m = kind.top_m.max(visibility.distance_m.min(HIDDEN_TOP_M));
    Obscuration { top_m, ..kind }
}

/// The lowest base that covers more than half of the sky, else the lowest.
fn precipitation_top_m(clouds: &[Cloud]) -> f64 {
    let base = |cloud: &Cloud| cloud.base_m;
    let covers = |cloud: &&Cloud| matches!(cloud.amount, Some(Amount::Broken | Amount::Overcast));
    let closed = clouds.iter().filter(covers).filter_map(base).reduce(f64::min);
    let lowest = closed.or_else(|| clouds.iter().filter_map(base).reduce(f64::min));
    let (least, most) = PRECIPITATION_TOPS_M.into_inner();
    lowest.unwrap_or(PRECIPITATION_TOP_M).clamp(least, most)
}
