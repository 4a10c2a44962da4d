//! Prevailing visibility: `9999`, `0600`, `4000NDV`, `20KM`, `10SM`, `1 1/2SM`, `M1/4SM`, `P6SM`, `CAVOK`; the least
//! visibility, `2000SW`, where it is given too.

use super::{Group, Outcome};
use crate::metar::{
    report::{Bound, Visibility},
    scan::Scan,
};

/// International statute mile, metres.
const STATUTE_MILE_M: f64 = 1609.344;
/// `9999` and `CAVOK`: 10 km or more (WMO-No. 306, FM 15, 15.6).
const MOST_M: f64 = 10_000.0;
/// `0000`: less than 50 m.
const LEAST_M: f64 = 50.0;
/// Greatest visibility by automatic stations in the United States: 10 miles or more.
const MOST_MILES: f64 = 10.0;

const METRES: &str = "a visibility in metres has four figures, 0000 to 9000 in steps of 25 or 9999, then NDV or a \
                      direction such as SW if need be";
const MILES: &str = "a visibility in statute miles is whole, a fraction or both, after P or M where it is more or less \
                     than that, as 10SM, 1/2SM, 1 1/2SM, M1/4SM or P6SM";
const KILOMETRES: &str = "a visibility in kilometres is one or two figures and KM";
const DIRECTIONS: [&str; 9] = ["NDV", "NE", "NW", "SE", "SW", "N", "E", "S", "W"];

/// Ten kilometres or more, no cloud below 1500 m, no weather.
pub(in crate::metar) const CAVOK: Visibility = Visibility {
    distance_m: MOST_M,
    bound: Bound::AtLeast,
};

/// A visibility in one word.
pub(super) fn read(word: &str) -> Outcome {
    if word == "CAVOK" {
        return Some(Ok(Group::Cavok));
    }
    if word == "////SM" || word == "////NDV" {
        return Some(Ok(Group::Missing));
    }
    if let Some(figures) = word.strip_suffix("SM") {
        let begins = |c: char| c.is_ascii_digit() || matches!(c, 'P' | 'M' | '/');
        return figures.starts_with(begins).then(|| miles(figures).ok_or(MILES));
    }
    let mut scan = Scan(word);
    if let Some(figures) = word.strip_suffix("KM") {
        scan = Scan(figures);
        let distance = scan.number(2).filter(|_| scan.is_done());
        let group = distance.map(|km| exactly(f64::from(km) * 1e3));
        return figures
            .starts_with(|c: char| c.is_ascii_digit())
            .then(|| group.ok_or(KILOMETRES));
    }
    let figures = scan.leading_digits();
    let side = Scan(word.get(figures..)?).any(&DIRECTIONS);
    let is_bare = word.len() == figures;
    // Figures alone, of whatever number, stand where a visibility does; `24015` and the like are named as such.
    if figures == 0 || !(is_bare || side.is_some_and(|side| figures + side.len() == word.len())) {
        return None;
    }
    Some(metres(word, figures, side).ok_or(METRES))
}

fn metres(word: &str, figures: usize, side: Option<&str>) -> Option<Group> {
    let distance = Scan(word).digits(4).filter(|_| figures == 4)?;
    if distance != 9999 && (distance % 25 != 0 || distance > 9900) {
        return None;
    }
    let visibility = match distance {
        9999 => CAVOK,
        0 => Visibility {
            distance_m: LEAST_M,
            bound: Bound::LessThan,
        },
        _ => Visibility {
            distance_m: f64::from(distance),
            bound: Bound::Exactly,
        },
    };
    Some(match side {
        None | Some("NDV") => Group::Visibility(visibility),
        Some(_) => Group::LeastVisibility,
    })
}

/// Whole miles that the next word makes a mixed number, as the `1` of `1 1/2SM`.
pub(in crate::metar) fn is_whole_miles(word: &str, next: &str) -> bool {
    let is_fraction =
        next.ends_with("SM") && next.contains('/') && next.starts_with(|c: char| c.is_ascii_digit());
    (1..=2).contains(&word.len()) && word.bytes().all(|b| b.is_ascii_digit()) && is_fraction
}

/// `1 1/2SM` in two words.
pub(in crate::metar) fn mixed_miles(whole: &str, next: &str) -> Result<Group, &'static str> {
    let whole = Scan(whole).number(2).ok_or(MILES)?;
    let part = next.strip_suffix("SM").and_then(fraction).ok_or(MILES)?;
    Ok(exactly((f64::from(whole) + part) * STATUTE_MILE_M))
}

fn miles(figures: &str) -> Option<Group> {
    let (bound, figures) = match (figures.strip_prefix('P'), figures.strip_prefix('M')) {
        (Some(rest), _) => (Bound::AtLeast, rest),
        (_, Some(rest)) => (Bound::LessThan, rest),
        _ => (Bound::Exactly, figures),
    };
    let miles = if figures.contains('/') {
        fraction(figures)?
    } else {
        let mut scan = Scan(figures);
        let whole = scan.number(2)?;
        scan.is_done().then(|| f64::from(whole))?
    };
    let bound = if miles == MOST_MILES {
        Bound::AtLeast
    } else {
        bound
    };
    Some(if miles == 0.0 {
        Group::Visibility(Visibility {
            distance_m: LEAST_M,
            bound: Bound::LessThan,
        })
    } else {
        Group::Visibility(Visibility {
            distance_m: miles * STATUTE_MILE_M,
            bound,
        })
    })
}

/// `3/8`; also `11/2`, which is one and a half where the space was lost.
fn fraction(text: &str) -> Option<f64> {
    let (above, below) = text.split_once('/')?;
    let mut below = Scan(below);
    let parts = below.number(2).filter(|n| *n > 0 && below.is_done())?;
    let lost_space = above.len() == 2 && above.parse::<u32>().is_ok_and(|n| n >= parts);
    let (whole, above) = above.split_at_checked(usize::from(lost_space))?;
    let whole = if whole.is_empty() {
        0
    } else {
        Scan(whole).number(1)?
    };
    let mut above = Scan(above);
    let share = above.number(2).filter(|n| *n < parts && above.is_done())?;
    Some(f64::from(whole) + f64::from(share) / f64::from(parts))
}

fn exactly(distance_m: f64) -> Group {
    Group::Visibility(Visibility {
        distance_m,
        bound: Bound::Exactly,
    })
}
