//! What instruments measure: temperature and dew point, `12/M01`; pressure, `Q1013`, `A2992`, `QNH2978INS`.

use super::{Group, Outcome};
use crate::metar::scan::Scan;

/// Inch of mercury, hPa.
const INCH_HPA: f64 = 33.863_886_66;
/// Pressures at sea level between the lowest and highest ever seen, with a margin, hPa.
const PRESSURES_HPA: std::ops::RangeInclusive<f64> = 850.0..=1100.0;
/// Air temperatures at the ground, likewise, °C.
const TEMPERATURES_C: std::ops::RangeInclusive<f64> = -90.0..=60.0;
/// Both are rounded, so that a dew point may seem to be above the temperature by 1.
const ROUNDING_C: f64 = 1.0;

const TEMPERATURE: &str = "temperature and dew point are two figures each with M below zero, the dew point not the \
                           higher, from M90 to 60 °C, as 12/M01";
const HECTOPASCALS: &str = "a pressure in hPa is Q and four figures, 0850 to 1100, as Q1013";
const INCHES: &str = "a pressure in inches of mercury is A and four figures, 2511 to 3248, as A2992";
const SEA_LEVEL: &str = "a pressure at sea level is SLP and three figures, as SLP162";

pub(super) fn temperature(word: &str) -> Outcome {
    let (air, dew) = word.split_once('/')?;
    let is_like = |text: &str| {
        let figures = text.trim_start_matches('M');
        text.len() <= 4 && figures.bytes().all(|b| b.is_ascii_digit()) || matches!(text, "//" | "XX")
    };
    if air.is_empty() || air == "//" || !is_like(air) || !is_like(dew) {
        return None;
    }
    let both = degrees(air).zip(degrees(dew));
    let is_possible = |(air, dew): &(Option<f64>, Option<f64>)| {
        let each = [air, dew].into_iter().flatten();
        let is_above = air.zip(*dew).is_some_and(|(air, dew)| dew > air + ROUNDING_C);
        each.into_iter().all(|t| TEMPERATURES_C.contains(t)) && !is_above
    };
    let group = both.filter(is_possible);
    Some(
        group
            .map(|(air, dew)| Group::Temperature(air, dew))
            .ok_or(TEMPERATURE),
    )
}

/// Two figures; none where it was not measured.
fn degrees(text: &str) -> Option<Option<f64>> {
    if matches!(text, "" | "//" | "XX") {
        return Some(None);
    }
    let mut scan = Scan(text);
    let sign = if scan.tag("M") { -1.0 } else { 1.0 };
    let size = scan.digits(2)?;
    scan.is_done().then(|| Some(sign * f64::from(size)))
}

pub(super) fn pressure(word: &str) -> Outcome {
    if let Some(inches) = word.strip_prefix("QNH") {
        let inches = inches.strip_suffix("INS").unwrap_or(inches);
        return Some(in_range(inches, INCH_HPA / 100.0).ok_or(INCHES));
    }
    let begins = |rest: &str| rest.starts_with(|c: char| c.is_ascii_digit() || c == '/');
    if let Some(rest) = word.strip_prefix('Q').filter(|rest| begins(rest)) {
        return Some(in_range(rest, 1.0).ok_or(HECTOPASCALS));
    }
    if let Some(rest) = word.strip_prefix('A').filter(|rest| begins(rest)) {
        return Some(in_range(rest, INCH_HPA / 100.0).ok_or(INCHES));
    }
    let rest = word.strip_prefix("SLP")?;
    let mut scan = Scan(rest);
    let is_right = rest == "NO" || scan.digits(3).is_some() && scan.is_done();
    Some(if is_right {
        Ok(Group::Other)
    } else {
        Err(SEA_LEVEL)
    })
}

fn in_range(text: &str, unit_hpa: f64) -> Option<Group> {
    if text == "////" {
        return Some(Group::Missing);
    }
    let mut scan = Scan(text);
    let pressure = scan.digits(4).filter(|_| scan.is_done())?;
    let pressure = f64::from(pressure) * unit_hpa;
    PRESSURES_HPA
        .contains(&pressure)
        .then_some(Group::Pressure(pressure))
}
