//! Snow on the ground, which a report does not tell but lets expect.

use super::report::{Report, Weather};

/// Share of light that lying snow sends back: fresh or wind-blown snow in visible light (Warren 1982).
const SNOW: f64 = 0.8;
/// Where it may lie thin or in patches.
const THIN_SNOW: f64 = 0.5;

/// The ground's albedo, the weather that tells, and a note; none where nothing tells of snow.
pub(super) fn snow(report: &Report) -> Option<(f64, Option<&Weather>, String)> {
    let lies = |weather: &&Weather| {
        weather.phenomena.contains(&"SN") && weather.descriptors.iter().any(|d| matches!(*d, "BL" | "DR"))
    };
    let weather = report.weather.iter().find(lies);
    if weather.is_some() || report.is_closed_by_snow {
        let note = format!("snow lies on the ground: its albedo is {SNOW}");
        return Some((SNOW, weather, note));
    }
    let freezes = report.temperature_c.is_some_and(|temperature| temperature <= 0.0);
    let falls = |weather: &&Weather| {
        let is_snow = weather.phenomena.iter().any(|p| matches!(*p, "SN" | "SG"));
        is_snow && !weather.is_nearby
    };
    let weather = report.weather.iter().find(falls).filter(|_| freezes)?;
    let note = format!("snow falls in frost and may lie: the ground's albedo is {THIN_SNOW}");
    Some((THIN_SNOW, Some(weather), note))
}
