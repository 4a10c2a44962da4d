//! One file a kind of group. A reader says `None` to a word of another kind, and what it should be to a word of its
//! own kind that is malformed.

pub(super) mod cloud;
mod measured;
mod runway;
pub(super) mod visibility;
mod weather;
mod wind;

use super::{
    report::{Cloud, Visibility, Weather, Wind},
    scan::Scan,
};

/// What a word was read as.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Group {
    /// Slashes, or `M` alone: not observed.
    Missing,
    Wind(Wind),
    WindRange,
    Cavok,
    Visibility(Visibility),
    /// In one direction only.
    LeastVisibility,
    Weather(Weather),
    NoWeather,
    Recent,
    Cloud(Cloud),
    NoCloud,
    PlacedCloud,
    /// Metres, where measured.
    VerticalVisibility(Option<f64>),
    /// Air and dew point, °C.
    Temperature(Option<f64>, Option<f64>),
    /// At sea level, hPa.
    Pressure(f64),
    Runway,
    /// Closed by snow.
    SnowClosed,
    Other,
}

/// None: a word of another kind.
pub(super) type Outcome = Option<Result<Group, &'static str>>;

const UNKNOWN: &str = "a group for wind, visibility, runway, weather, cloud, temperature, pressure or trend; RMK begins \
                       remarks in free text";
const SEA: &str = "the state of the sea is W, the water's temperature, and S or H and its figures, as W15/S4";

const READERS: [fn(&str) -> Outcome; 11] = [
    missing,
    wind::read,
    wind::range,
    visibility::read,
    runway::read,
    cloud::read,
    cloud::placed,
    measured::temperature,
    measured::pressure,
    other,
    weather::read,
];

/// Reads one word.
pub(super) fn read(word: &str) -> Result<Group, &'static str> {
    READERS.iter().find_map(|read| read(word)).unwrap_or(Err(UNKNOWN))
}

fn missing(word: &str) -> Outcome {
    let is_slashes = (2..=9).contains(&word.len()) && word.bytes().all(|b| b == b'/');
    (is_slashes || word == "M").then_some(Ok(Group::Missing))
}

/// Sea, colour states of military airports, rainfall, thunder: nothing that a scene shows.
fn other(word: &str) -> Outcome {
    if is_colour(word) {
        return Some(Ok(Group::Other));
    }
    let is_figures = |text: &str| {
        text.bytes()
            .all(|b| b.is_ascii_digit() || matches!(b, b'.' | b'/'))
    };
    if let Some(amounts) = word.strip_prefix("RF").filter(|rest| rest.contains('/')) {
        return is_figures(amounts).then_some(Ok(Group::Other));
    }
    let sea = word.strip_prefix('W').filter(|rest| rest.contains('/'))?;
    Some(if is_sea(sea) { Ok(Group::Other) } else { Err(SEA) })
}

fn is_sea(text: &str) -> bool {
    let mut scan = Scan(text);
    let has_water = scan.tag("///") || scan.tag("//") || {
        scan.tag("M");
        let water = scan.number(2).is_some();
        water && scan.tag("/")
    };
    let figures = match scan.any(&["S", "H"]) {
        Some("S") => 1,
        Some(_) => 3,
        None => return false,
    };
    let is_figure = |b: u8| b.is_ascii_digit() || b == b'/';
    has_water && (1..=figures).contains(&scan.rest().len()) && scan.rest().bytes().all(is_figure)
}

/// `BLU`, `YLO2`, `BLACK`, `BLACKGRN`.
fn is_colour(word: &str) -> bool {
    const COLOURS: [&str; 9] = ["BLU", "BLU+", "WHT", "GRN", "YLO", "YLO1", "YLO2", "AMB", "RED"];
    let colour = word.strip_prefix("BLACK").unwrap_or(word);
    (colour.is_empty() && !word.is_empty()) || COLOURS.contains(&colour)
}
