//! Reads a report word by word; every word is accounted for or refused. Groups may stand in any order that occurs, but
//! wind and visibility come before temperature and pressure, so that a pressure without its letter is not taken for a
//! visibility.
//!
//! Forms: WMO-No. 306 Volume I.1, FM 15 and FM 16; Federal Meteorological Handbook No. 1 (United States), chapter 12;
//! and what stations send.

use super::{
    fault::ReportFault,
    groups::{self, Group, cloud, visibility},
    report::Report,
    scan::Scan,
    words::Words,
};

/// Day of the month, hour and minute, UTC.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Clock {
    pub(super) day: u32,
    pub(super) hour: u32,
    pub(super) minute: u32,
}

/// A report as it was read; `report.time` waits for the month.
#[derive(Debug)]
pub(super) struct Reading {
    pub(super) report: Report,
    pub(super) clock: Clock,
    /// Groups that a scene may have no use for, in their order.
    pub(super) passed: Vec<(Part, String)>,
}

/// What of a scene a group may have a use for after all, which the whole report decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    None,
    Wind,
    /// One of the report's clouds.
    Cloud(usize),
}

const FORECAST: &str = "a report of what was observed, METAR or SPECI; TAF is a forecast";
const STATION: &str = "the station's location indicator, a letter and three letters or figures, as EGLL";
const TIME: &str = "day of the month, hour and minute in UTC, and Z, as 092050Z";
const NIL: &str = "a report with an observation; NIL says that there is none";
const BODY: &str = "at least one of wind, visibility, weather, cloud, temperature or pressure";
const TWICE: &str = "nothing, since this was told before";
const EARLIER: &str =
    "temperature and pressure come after wind and visibility; a pressure has Q or A before its figures";
const IN_TREND: &str =
    "a forecast of wind, visibility, weather or cloud, or a time as FM1300, TL1500 or AT1400";
const SHEAR: &str = "wind shear is WS and a runway, as WS R16L, WS RWY21 or WS ALL RWY";
const PROBABILITY: &str = "a probability is PROB30 or PROB40";

/// Reads a report in capital letters.
pub(super) fn read(text: &str) -> Result<Reading, ReportFault> {
    let mut reader = Reader {
        words: Words::split(text)?,
        at: 0,
        reading: Reading {
            report: Report::default(),
            clock: Clock {
                day: 0,
                hour: 0,
                minute: 0,
            },
            passed: Vec::new(),
        },
        trend_from: None,
    };
    reader.head()?;
    let body = reader.at;
    while reader.at < reader.words.len() {
        reader.group()?;
    }
    if reader.at == body {
        return Err(reader.words.refuse_end(BODY));
    }
    reader.end_trend(reader.at);
    Ok(reader.reading)
}

struct Reader<'a> {
    words: Words<'a>,
    /// The next word.
    at: usize,
    reading: Reading,
    /// The word at which the trend begins.
    trend_from: Option<usize>,
}

impl<'a> Reader<'a> {
    fn peek(&self, ahead: usize) -> &'a str {
        self.words.get(self.at + ahead).map_or("", |word| word.text)
    }

    /// Passes over one of `texts`.
    fn skip(&mut self, texts: &[&str]) -> bool {
        let is_there = texts.contains(&self.peek(0));
        self.at += usize::from(is_there);
        is_there
    }

    fn refuse<T>(&self, count: usize, expected: &str) -> Result<T, ReportFault> {
        Err(self.words.refuse(self.at, self.at + count - 1, expected))
    }

    fn head(&mut self) -> Result<(), ReportFault> {
        if self.peek(0) == "TAF" {
            return self.refuse(1, FORECAST);
        }
        let is_special = self.skip(&["SPECI"]);
        self.reading.report.is_special = is_special || (self.skip(&["METAR"]) && self.skip(&["SPECI"]));
        self.marks()?;
        let station = self.peek(0);
        let is_indicator = station.len() == 4
            && station.starts_with(|c: char| c.is_ascii_uppercase())
            && station
                .bytes()
                .all(|b| b.is_ascii_uppercase() || b.is_ascii_digit());
        if !is_indicator {
            return self.refuse(1, STATION);
        }
        self.reading.report.station = station.into();
        self.at += 1;
        self.marks()?;
        self.reading.clock = match clock(self.peek(0)) {
            Some(clock) => clock,
            None => return self.refuse(1, TIME),
        };
        self.at += 1;
        self.marks()
    }

    /// `AUTO`, `COR`, `CCA`..`CCZ`; `NIL` is refused.
    fn marks(&mut self) -> Result<(), ReportFault> {
        loop {
            let is_letter = |rest: &str| rest.len() == 1 && rest.bytes().all(|b| b.is_ascii_uppercase());
            match self.peek(0) {
                "AUTO" => self.reading.report.is_automatic = true,
                "NIL" => return self.refuse(1, NIL),
                "COR" => self.reading.report.is_corrected = true,
                mark if mark.strip_prefix("CC").is_some_and(is_letter) => {
                    self.reading.report.is_corrected = true;
                }
                _ => return Ok(()),
            }
            self.at += 1;
        }
    }

    fn group(&mut self) -> Result<(), ReportFault> {
        let word = self.peek(0);
        match word {
            "RMK" | "RMKS" => {
                self.end_trend(self.at);
                let last = self.words.len() - 1;
                self.reading.report.remarks = Some(self.words.text(self.at + 1, last).into());
                self.at = self.words.len();
            }
            "NIL" => return self.refuse(1, NIL),
            "NOSIG" => {
                self.trend_from.get_or_insert(self.at);
                self.at += 1;
                self.end_trend(self.at);
            }
            "BECMG" | "TEMPO" | "INTER" => {
                self.trend_from.get_or_insert(self.at);
                self.at += 1;
            }
            "WS" => self.shear()?,
            // The maintenance sign of stations in the United States.
            "$" => self.pass(1, Part::None),
            _ if word.starts_with("PROB") => {
                if !matches!(word, "PROB30" | "PROB40") {
                    return self.refuse(1, PROBABILITY);
                }
                self.trend_from.get_or_insert(self.at);
                self.at += 1;
            }
            _ if self.trend_from.is_some() => self.forecast()?,
            _ => self.observed()?,
        }
        Ok(())
    }

    /// Notes what use a scene may have for the next words, and passes over them.
    fn pass(&mut self, count: usize, part: Part) {
        let text = self.words.text(self.at, self.at + count - 1);
        self.reading.passed.push((part, text.into()));
        self.at += count;
    }

    fn end_trend(&mut self, end: usize) {
        if let Some(from) = self.trend_from.take() {
            let trend = self.words.text(from, end - 1);
            let told = self.reading.report.trend.get_or_insert_default();
            if !told.is_empty() {
                told.push(' ');
            }
            told.push_str(trend);
        }
    }

    /// `WS R16L`, `WS RWY21`, `WS ALL RWY`, `WS TKOF RWY09`.
    fn shear(&mut self) -> Result<(), ReportFault> {
        let (first, second) = (self.peek(1), self.peek(2));
        let is_runway = |word: &str| {
            let rest = word.strip_prefix("RWY").or_else(|| word.strip_prefix('R'));
            rest.is_some_and(|rest| {
                let mut scan = Scan(rest);
                scan.digits(2).is_some() && {
                    scan.any(&["L", "C", "R"]);
                    scan.is_done()
                }
            })
        };
        let count = match first {
            "ALL" if second == "RWY" => 3,
            "TKOF" | "LDG" if is_runway(second) => 3,
            _ if is_runway(first) => 2,
            _ => return self.refuse(if first.is_empty() { 1 } else { 2 }, SHEAR),
        };
        self.pass(count, Part::None);
        Ok(())
    }

    /// The next group, and of how many words it is.
    fn next(&self) -> Result<(Group, usize), ReportFault> {
        let (word, next) = (self.peek(0), self.peek(1));
        let (group, count) = if visibility::is_whole_miles(word, next) {
            (visibility::mixed_miles(word, next), 2)
        } else {
            (groups::read(word), 1)
        };
        match group {
            Ok(group) => Ok((group, count)),
            Err(expected) => self.refuse(count, expected),
        }
    }

    /// Read, so that a mistake is found, but kept as text only: a scene shows what was observed.
    fn forecast(&mut self) -> Result<(), ReportFault> {
        let count = if is_span(self.peek(0)) || cloud::kind(self.peek(0)).is_some() {
            1
        } else if matches!(self.peek(0), "FM" | "TL" | "AT") && is_minute(self.peek(1)) {
            2
        } else {
            let (group, count) = self.next()?;
            if matches!(group, Group::Temperature(..) | Group::Pressure(_)) {
                return self.refuse(count, IN_TREND);
            }
            count
        };
        self.at += count;
        Ok(())
    }

    fn observed(&mut self) -> Result<(), ReportFault> {
        if let Some(kind) = cloud::kind(self.peek(0)) {
            let last = self.reading.report.clouds.len().checked_sub(1);
            let untold = last.filter(|last| self.reading.report.clouds[*last].kind.is_none());
            if let Some(last) = untold {
                self.reading.report.clouds[last].kind = Some(kind);
            }
            self.pass(1, untold.map_or(Part::None, Part::Cloud));
            return Ok(());
        }
        let (group, count) = self.next()?;
        let report = &mut self.reading.report;
        let is_late = report.temperature_c.is_some() || report.pressure_hpa.is_some();
        let is_early = matches!(
            group,
            Group::Wind(_) | Group::WindRange | Group::Cavok | Group::Visibility(_) | Group::LeastVisibility
        );
        if is_late && is_early {
            return self.refuse(count, EARLIER);
        }
        // None: a scene has use for it.
        let mut passed = None;
        let mut is_told_twice = false;
        match group {
            Group::Visibility(visibility) if report.visibility.is_none() => {
                report.visibility = Some(visibility)
            }
            Group::Cavok => {
                is_told_twice = report.visibility.is_some();
                report.visibility = Some(visibility::CAVOK);
                report.is_clear = true;
            }
            Group::NoCloud => report.is_clear = true,
            // A second figure is the least visibility, whose direction was not told.
            Group::Visibility(_) => passed = Some(Part::None),
            Group::Wind(wind) => {
                is_told_twice = report.wind.is_some();
                passed = Some(Part::Wind);
                report.wind = Some(wind);
            }
            Group::Weather(weather) => report.weather.push(weather),
            Group::Cloud(cloud) => {
                passed = Some(Part::Cloud(report.clouds.len()));
                report.clouds.push(cloud);
            }
            Group::VerticalVisibility(distance) => {
                is_told_twice = report.vertical_visibility_m.is_some();
                report.vertical_visibility_m = Some(distance.unwrap_or(0.0));
            }
            Group::Temperature(air, dew) => {
                is_told_twice = report.temperature_c.is_some();
                (report.temperature_c, report.dew_point_c) = (air, dew);
            }
            // Some stations tell hPa and inches.
            Group::Pressure(pressure) => {
                passed = report.pressure_hpa.replace(pressure).map(|_| Part::None);
            }
            Group::SnowClosed => report.is_closed_by_snow = true,
            _ => passed = Some(Part::None),
        }
        if is_told_twice {
            return self.refuse(count, TWICE);
        }
        match passed {
            None => self.at += count,
            Some(part) => self.pass(count, part),
        }
        Ok(())
    }
}

/// `092050Z`
fn clock(word: &str) -> Option<Clock> {
    let mut scan = Scan(word);
    let (day, hour, minute) = (scan.digits(2)?, scan.digits(2)?, scan.digits(2)?);
    let is_right = scan.rest() == "Z" && (1..=31).contains(&day) && hour < 24 && minute < 60;
    is_right.then_some(Clock { day, hour, minute })
}

/// `FM1300`, `TL1500`, `AT1400`
fn is_span(word: &str) -> bool {
    let mut scan = Scan(word);
    scan.any(&["FM", "TL", "AT"]).is_some() && is_minute(scan.rest())
}

/// `1300`, and `2400` for the day's end.
fn is_minute(word: &str) -> bool {
    let mut scan = Scan(word);
    let (hour, minute) = (scan.digits(2), scan.digits(2));
    let is_time = |hour, minute| (hour < 24 && minute < 60) || (hour == 24 && minute == 0);
    scan.is_done()
        && hour
            .zip(minute)
            .is_some_and(|(hour, minute)| is_time(hour, minute))
}
