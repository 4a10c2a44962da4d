//! Cloud: `FEW018`, `BKN012CB`, `///074///`, `SCT///TCU`; `VV002`, how far one sees upwards; `NSC` and its like.

use super::{Group, Outcome};
use crate::metar::{
    report::{Amount, Cloud},
    scan::Scan,
};

/// Heights are given in hundreds of feet.
const HUNDRED_FEET_M: f64 = 30.48;

const NONE: [&str; 4] = ["SKC", "CLR", "NSC", "NCD"];
const AMOUNTS: [&str; 5] = ["FEW", "SCT", "BKN", "OVC", "///"];
const KINDS: [&str; 14] = [
    "///", "TCU", "CB", "CU", "SC", "ST", "NS", "AC", "AS", "CI", "CS", "CC", "SF", "CF",
];

const EXPECTED: &str = "a cloud is FEW, SCT, BKN, OVC or ///, its height in hundreds of feet in three figures or ///, \
                        and CB, TCU or /// if need be, as BKN012CB";
const VERTICAL: &str = "a vertical visibility is VV and hundreds of feet in three figures or ///, as VV002";

pub(super) fn read(word: &str) -> Outcome {
    if NONE.contains(&word) {
        return Some(Ok(Group::NoCloud));
    }
    if let Some(height) = word.strip_prefix("VV") {
        let mut scan = Scan(height);
        let height = height_m(&mut scan).filter(|_| scan.is_done());
        return Some(height.map(Group::VerticalVisibility).ok_or(VERTICAL));
    }
    if word.starts_with("///") {
        // `//////` and `/////////` alone are what was not observed.
        let is_cloud = !word.trim_matches('/').is_empty();
        return is_cloud.then(|| cloud(word).map(Group::Cloud).ok_or(EXPECTED));
    }
    let begins = AMOUNTS.iter().any(|amount| word.starts_with(amount));
    begins.then(|| cloud(word).map(Group::Cloud).ok_or(EXPECTED))
}

/// The kind of the cloud before, where a space came between.
pub(in crate::metar) fn kind(word: &str) -> Option<&'static str> {
    ["CB", "TCU"].into_iter().find(|kind| *kind == word)
}

fn cloud(word: &str) -> Option<Cloud> {
    let mut scan = Scan(word);
    let amount = match scan.any(&AMOUNTS)? {
        "FEW" => Some(Amount::Few),
        "SCT" => Some(Amount::Scattered),
        "BKN" => Some(Amount::Broken),
        "OVC" => Some(Amount::Overcast),
        _ => None,
    };
    let base_m = height_m(&mut scan)?;
    let kind = scan.any(&KINDS).filter(|kind| *kind != "///");
    scan.is_done().then_some(Cloud { amount, base_m, kind })
}

fn height_m(scan: &mut Scan) -> Option<Option<f64>> {
    if scan.tag("///") {
        return Some(None);
    }
    scan.digits(3)
        .map(|hundreds| Some(f64::from(hundreds) * HUNDRED_FEET_M))
}

/// Clouds told by place after the pressure, as `CB/NE/E/W`.
pub(super) fn placed(word: &str) -> Outcome {
    let (kind, places) = word.split_once('/')?;
    let is_place = |place| {
        matches!(
            place,
            "N" | "NE" | "E" | "SE" | "S" | "SW" | "W" | "NW" | "OHD" | "ALQDS"
        )
    };
    let is_cloud = self::kind(kind).is_some() && places.split('/').all(is_place);
    is_cloud.then_some(Ok(Group::PlacedCloud))
}
