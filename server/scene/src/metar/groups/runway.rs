//! What concerns runways alone: visual range, `R20R/1900D`; state, `R16R/290155`, `R88/CLRD70`, `R/SNOCLO`. Of all that
//! the scene takes one thing: that snow lies.

use super::{Group, Outcome};
use crate::metar::scan::Scan;

const EXPECTED: &str = "a runway has R, its number and L, C or R, then / and a visual range as 1200, P1500 or 0600V1200U, \
                        or six figures of its state, or CLRD and two figures";

pub(super) fn read(word: &str) -> Outcome {
    if matches!(word, "SNOCLO" | "R/SNOCLO") {
        return Some(Ok(Group::SnowClosed));
    }
    if word == "RVRNO" {
        return Some(Ok(Group::Runway));
    }
    let rest = word.strip_prefix('R')?;
    if !rest.starts_with(|c: char| c.is_ascii_digit() || c == '/') {
        return None;
    }
    Some(runway(rest).ok_or(EXPECTED))
}

fn runway(text: &str) -> Option<Group> {
    let mut scan = Scan(text);
    // 88 is all runways, 99 the state told before.
    scan.digits(2)
        .filter(|n| *n <= 36 || (50..=88).contains(n) || *n == 99)?;
    scan.any(&["LL", "RR", "L", "C", "R"]);
    if !scan.tag("/") {
        return None;
    }
    if scan.rest() == "SNOCLO" {
        return Some(Group::SnowClosed);
    }
    (is_range(scan) || is_state(scan)).then_some(Group::Runway)
}

fn is_range(mut scan: Scan) -> bool {
    let mut range = || {
        scan.any(&["P", "M"]);
        scan.tag("////") || scan.digits(4).is_some()
    };
    if !range() || (scan.tag("V") && !is_limit(&mut scan)) {
        return false;
    }
    scan.tag("FT");
    scan.tag("/");
    scan.any(&["U", "D", "N"]);
    scan.is_done()
}

fn is_limit(scan: &mut Scan) -> bool {
    scan.any(&["P", "M"]);
    scan.digits(4).is_some()
}

fn is_state(mut scan: Scan) -> bool {
    let text = scan.rest();
    let is_figure = |b: u8| b.is_ascii_digit() || b == b'/';
    if scan.tag("CLRD") {
        return scan.rest().len() == 2 && scan.rest().bytes().all(is_figure);
    }
    let is_short = text.len() == 3 && text.ends_with('D') && text.bytes().take(2).all(is_figure);
    is_short || (text.len() == 6 && text.bytes().all(is_figure))
}
