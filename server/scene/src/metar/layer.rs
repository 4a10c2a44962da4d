//! One group of cloud as a layer.
//!
//! A report tells amount and base, and of kinds only CB and TCU. The kind of all others is the usual one for height,
//! amount and rain in temperate latitudes (WMO International Cloud Atlas), as is how thick they are.

use super::report::{Amount, Cloud, Report};
use crate::clouds::{Genus, Layer, SheetLayer, VolumeLayer};

/// The WMO's étages in temperate latitudes: low clouds have their bases below 2 km, those of ice above 5 km, metres.
const MIDDLE_FROM_M: f64 = 2_000.0;
const HIGH_FROM_M: f64 = 5_000.0;
/// A closed layer so low is stratus, metres.
const STRATUS_BELOW_M: f64 = 300.0;
/// Where convective cloud begins whose base was not observed, metres.
const CONVECTIVE_BASE_M: f64 = 1_000.0;
/// Towering cumulus is this high, metres.
const TOWERING_M: f64 = 4_500.0;
/// Layers leave one another this much, metres.
const LEAST_THICKNESS_M: f64 = 150.0;

/// Types of volume.
const STRATUS: f64 = 0.0;
const NIMBOSTRATUS: f64 = 0.3;
const STRATOCUMULUS: f64 = 0.5;
const CUMULUS: f64 = 1.0;

/// What falls from a layer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rain {
    /// 0 to 1.
    pub(super) amount: f64,
    pub(super) is_shower: bool,
    /// Nothing but drizzle and snow grains, which fall from stratus.
    pub(super) is_drizzle: bool,
}

/// Height of the base above the station, where there is one, metres.
pub(super) fn base_m(cloud: &Cloud) -> Option<f64> {
    cloud
        .base_m
        .or_else(|| is_tower(cloud).then_some(CONVECTIVE_BASE_M))
}

/// It covers more than half of the sky.
pub(super) fn is_closed(cloud: &Cloud) -> bool {
    matches!(cloud.amount, Some(Amount::Broken | Amount::Overcast))
}

/// Share of the sky that the amount stands for: the middle of its eighths.
pub(super) fn coverage(cloud: &Cloud) -> f64 {
    match cloud.amount {
        Some(Amount::Few) => 1.5 / 8.0,
        Some(Amount::Scattered) | None => 3.5 / 8.0,
        Some(Amount::Broken) => 6.0 / 8.0,
        Some(Amount::Overcast) => 1.0,
    }
}

/// The layer, if the cloud has a place.
pub(super) fn layer(cloud: &Cloud, rain: Option<&Rain>, report: &Report) -> Option<Layer> {
    let base_m = base_m(cloud)?;
    let coverage = Some(coverage(cloud));
    let sheet = |genus| {
        Layer::Sheet(SheetLayer {
            height_m: base_m,
            genus,
            coverage,
            ..SheetLayer::default()
        })
    };
    let volume = |cloud_type, top_m, anvil| {
        Layer::Volume(VolumeLayer {
            base_m,
            top_m,
            cloud_type: Some(cloud_type),
            coverage,
            anvil,
            ..VolumeLayer::default()
        })
    };
    let ceiling_m = tropopause_m(report);
    if cloud.kind == Some("CB") {
        return Some(volume(CUMULUS, ceiling_m.max(base_m + TOWERING_M), 1.0));
    }
    if cloud.kind == Some("TCU") {
        return Some(volume(CUMULUS, base_m + TOWERING_M, 0.0));
    }
    if let Some(genus) = genus(cloud, base_m, rain) {
        return Some(sheet(genus));
    }
    let (cloud_type, thickness_m) = body(cloud, base_m, rain);
    let thickness_m = if rain.is_some() {
        thickness_m
    } else {
        thickness_m.min(room_m(base_m, report))
    };
    Some(volume(cloud_type, base_m + thickness_m, 0.0))
}

fn is_tower(cloud: &Cloud) -> bool {
    matches!(cloud.kind, Some("CB" | "TCU"))
}

/// Of what is high enough to be a sheet.
fn genus(cloud: &Cloud, base_m: f64, rain: Option<&Rain>) -> Option<Genus> {
    match cloud.kind {
        Some("CI") => Some(Genus::Cirrus),
        Some("CC") => Some(Genus::Cirrocumulus),
        Some("CS") => Some(Genus::Cirrostratus),
        Some("AC") => Some(Genus::Altocumulus),
        Some("AS") => Some(Genus::Altostratus),
        Some(_) => None,
        None if base_m >= HIGH_FROM_M && is_closed(cloud) => Some(Genus::Cirrostratus),
        None if base_m >= HIGH_FROM_M => Some(Genus::Cirrus),
        // What rains is thick.
        None if base_m < MIDDLE_FROM_M || rain.is_some() => None,
        None if cloud.amount == Some(Amount::Overcast) => Some(Genus::Altostratus),
        None => Some(Genus::Altocumulus),
    }
}

/// Type of a volume and how thick it is, metres.
fn body(cloud: &Cloud, base_m: f64, rain: Option<&Rain>) -> (f64, f64) {
    let is_closed = is_closed(cloud);
    match (cloud.kind, rain) {
        (Some("ST" | "SF"), _) => (STRATUS, 350.0),
        (Some("SC"), _) => (STRATOCUMULUS, 700.0),
        (Some("NS"), _) => (NIMBOSTRATUS, 3_000.0),
        (_, Some(rain)) if rain.is_drizzle && is_closed => (STRATUS, 500.0),
        (_, Some(rain)) if rain.is_shower || !is_closed => (CUMULUS, 2_500.0 + 1_500.0 * rain.amount),
        (_, Some(rain)) => (NIMBOSTRATUS, 1_000.0 + 3_500.0 * rain.amount),
        (Some("CU" | "CF"), None) => (CUMULUS, 1_000.0),
        (_, None) if is_closed && base_m < STRATUS_BELOW_M => (STRATUS, 350.0),
        (_, None) => match cloud.amount {
            Some(Amount::Few) => (CUMULUS, 600.0),
            Some(Amount::Scattered) | None => (CUMULUS, 1_000.0),
            Some(Amount::Broken) => (STRATOCUMULUS, 700.0),
            Some(Amount::Overcast) => (STRATOCUMULUS, 900.0),
        },
    }
}

/// Up to the next base above.
fn room_m(base_m: f64, report: &Report) -> f64 {
    let others = report.clouds.iter().filter_map(|cloud| cloud.base_m);
    let next = others
        .filter(|other| *other > base_m)
        .fold(f64::INFINITY, f64::min);
    (next - base_m).max(LEAST_THICKNESS_M)
}

/// Height of the tropopause above the station: about 16.5 km above the sea at the equator, 8.5 km at the poles (yearly
/// means; Hoinka 1998), metres.
fn tropopause_m(report: &Report) -> f64 {
    /// The ICAO standard atmosphere's.
    const STANDARD_M: f64 = 11_000.0;
    report.place.map_or(STANDARD_M, |place| {
        let cosine = place.latitude_deg.to_radians().cos();
        8_500.0 + 8_000.0 * cosine * cosine - place.elevation_m
    })
}
