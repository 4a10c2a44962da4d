//! Wind: `24015G25KT`, `VRB02KT`, `00000MPS`, `/////KT`, and the range of its direction, `180V240`.

use super::{Group, Outcome};
use crate::metar::{report::Wind, scan::Scan};

const EXPECTED: &str = "a wind has a direction from 000 to 360 or VRB, a speed, a gust after G if there is one, and KT, \
                        MPS or KMH, as 24015G25KT";
const RANGE: &str = "a range of the wind's direction is two directions from 000 to 360, as 180V240";
/// Longest and shortest names first and last, so that `KMH` is not taken for something with `KM`.
const UNITS: [(&str, f64); 3] = [("KMH", 1.0 / 3.6), ("MPS", 1.0), ("KT", 1852.0 / 3600.0)];

pub(super) fn read(word: &str) -> Outcome {
    let Some((figures, metres)) = UNITS
        .iter()
        .find_map(|(unit, metres)| Some((word.strip_suffix(unit)?, *metres)))
    else {
        return lacks_unit(word).then_some(Err(EXPECTED));
    };
    let begins = figures.starts_with(|c: char| c.is_ascii_digit() || c == '/');
    if !begins && !figures.starts_with("VRB") && !figures.starts_with("ABV") {
        return None;
    }
    Some(wind(figures, metres).map(Group::Wind).ok_or(EXPECTED))
}

fn lacks_unit(word: &str) -> bool {
    let figures = word.strip_prefix("VRB").unwrap_or(word);
    let count = Scan(figures).leading_digits();
    let is_speed = count == if figures.len() < word.len() { 2 } else { 5 };
    is_speed && (figures.len() == count || figures.get(count..).is_some_and(|rest| rest.starts_with('G')))
}

fn wind(figures: &str, metres: f64) -> Option<Wind> {
    let mut scan = Scan(figures);
    let is_variable = scan.tag("VRB");
    let azimuth_deg = if is_variable || scan.tag("///") {
        None
    } else {
        Some(scan.digits(3).filter(|direction| *direction <= 360)?)
    };
    let speed = speed(&mut scan)?;
    let gust = if scan.tag("G") {
        self::speed(&mut scan)?
    } else {
        None
    };
    scan.is_done().then(|| Wind {
        from_azimuth_deg: azimuth_deg.map(f64::from),
        is_variable,
        speed_m_s: speed.map(|speed| speed * metres),
        gust_m_s: gust.map(|gust| gust * metres),
    })
}

/// Two or three figures, with `P` where the speed is beyond them; none where it was not measured.
fn speed(scan: &mut Scan) -> Option<Option<f64>> {
    if scan.tag("//") {
        return Some(None);
    }
    scan.tag("P");
    if scan.leading_digits() < 2 {
        return None;
    }
    scan.number(3).map(|speed| Some(f64::from(speed)))
}

/// `180V240`; the scene has no use for it.
pub(super) fn range(word: &str) -> Outcome {
    let (from, to) = word.split_once('V')?;
    let is_angle = |text: &str| text.len() <= 3 && text.bytes().all(|b| b.is_ascii_digit() || b == b'/');
    if from.is_empty() || to.is_empty() || !is_angle(from) || !is_angle(to) {
        return None;
    }
    let is_direction = |text: &str| text == "///" || Scan(text).digits(3).is_some_and(|angle| angle <= 360);
    let both = is_direction(from) && is_direction(to);
    Some(if both { Ok(Group::WindRange) } else { Err(RANGE) })
}
