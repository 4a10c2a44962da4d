//! Present weather: `-SHRA`, `+TSRAGR`, `VCFG`, `BLSN`; recent weather, `RERA`; `NSW`, no significant weather.

use super::{Group, Outcome};
use crate::metar::{
    report::{Intensity, Weather},
    scan::Scan,
};

const DESCRIPTORS: [&str; 8] = ["MI", "BC", "PR", "DR", "BL", "SH", "TS", "FZ"];
const PHENOMENA: [&str; 23] = [
    "DZ", "RA", "SN", "SG", "IC", "PL", "GR", "GS", "UP", "BR", "FG", "FU", "VA", "DU", "SA", "HZ", "PY",
    "PO", "SQ", "FC", "SS", "DS", "PE",
];
/// These stand alone: a thunderstorm without precipitation, showers nearby.
const ALONE: [&str; 2] = ["TS", "SH"];
const MOST_PHENOMENA: usize = 4;

const EXPECTED: &str = "a weather has -, + or VC if need be, then descriptors (MI BC PR DR BL SH TS FZ), then phenomena \
                        (DZ RA SN SG IC PL GR GS UP BR FG FU VA DU SA HZ PY PO SQ FC SS DS), as -SHRA";
const RECENT: &str = "a recent weather is RE and a weather, as RERA, or RE// where it was not observed";

pub(super) fn read(word: &str) -> Outcome {
    if word == "NSW" {
        return Some(Ok(Group::NoWeather));
    }
    if let Some(recent) = word.strip_prefix("RE")
        && let Some(first) = recent.get(..2)
    {
        let is_weather = first == "//" || is_code(first);
        let is_right = recent == "//" || weather(recent).is_some();
        return is_weather.then_some(if is_right { Ok(Group::Recent) } else { Err(RECENT) });
    }
    let codes = word.trim_start_matches(['+', '-']);
    let codes = codes.strip_prefix("VC").unwrap_or(codes);
    let is_marked = codes.len() < word.len();
    let begins = codes.get(..2).is_some_and(is_code);
    if !begins && !is_marked {
        return None;
    }
    Some(weather(word).map(Group::Weather).ok_or(EXPECTED))
}

fn is_code(code: &str) -> bool {
    DESCRIPTORS.contains(&code) || PHENOMENA.contains(&code)
}

fn weather(word: &str) -> Option<Weather> {
    let mut scan = Scan(word);
    let intensity = match scan.any(&["-", "+"]) {
        Some("-") => Intensity::Light,
        Some(_) => Intensity::Heavy,
        None => Intensity::Moderate,
    };
    let is_nearby = scan.tag("VC");
    let descriptors: Vec<_> = std::iter::from_fn(|| scan.any(&DESCRIPTORS)).collect();
    let phenomena: Vec<_> = std::iter::from_fn(|| scan.any(&PHENOMENA)).collect();
    let says_something = !phenomena.is_empty() || descriptors.iter().any(|d| ALONE.contains(d));
    let is_short = phenomena.len() <= MOST_PHENOMENA && descriptors.len() <= 2;
    (scan.is_done() && says_something && is_short).then(|| Weather {
        text: word.into(),
        intensity,
        is_nearby,
        descriptors,
        phenomena,
    })
}
