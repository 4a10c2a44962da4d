//! Weather reports: real ones all make scenes, malformed ones name their group.

use std::time::{Duration, SystemTime};
use welkin_scene::{MetarAnswer, MetarRequest, Scene, SceneError, metar::report::Bound};

pub(crate) const DATED: &str = include_str!("../reports/dated.txt");
pub(crate) const UNDATED: &str = include_str!("../reports/undated.txt");
const MALFORMED: &str = include_str!("../reports/malformed.txt");

/// 2026-11-22T08:00:00Z
pub(crate) fn now() -> SystemTime {
    SystemTime::UNIX_EPOCH + Duration::from_secs(1_795_334_400)
}

fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.starts_with('#'))
}

/// Reports with their dates, if known.
pub(crate) fn reports() -> impl Iterator<Item = (Option<&'static str>, &'static str)> {
    let dated = lines(DATED).map(|line| line.split_once(' ').unwrap());
    dated
        .map(|(date, report)| (Some(date), report))
        .chain(lines(UNDATED).map(|report| (None, report)))
}

pub(crate) fn request(report: &str) -> MetarRequest {
    MetarRequest {
        metar: report.into(),
        ..MetarRequest::default()
    }
}

pub(crate) fn read(report: &str) -> MetarAnswer {
    request(report)
        .scene(now())
        .unwrap_or_else(|e| panic!("{report}: {e}"))
}

#[test]
fn every_real_report_makes_a_valid_scene() {
    let mut count = 0;
    for (date, report) in reports() {
        let request = MetarRequest {
            date: date.map(Into::into),
            ..request(report)
        };
        let answer = request.scene(now()).unwrap_or_else(|e| panic!("{report}: {e}"));
        let written = serde_json::to_value(&answer.scene).unwrap();
        assert_eq!(Scene::from_value(&written).unwrap(), answer.scene, "{report}");
        assert!(
            date.is_none_or(|date| answer.report.time.starts_with(date)),
            "{report}"
        );
        count += 1;
    }
    assert!(count >= 200, "{count}");
}

/// Each word of each report, made nonsense, is named: none is passed over unread. Remarks are free text.
#[test]
fn no_group_is_dropped() {
    let mut count = 0;
    for (_, report) in reports() {
        let words: Vec<_> = report.trim_end_matches('=').split(' ').collect();
        let end = words
            .iter()
            .position(|word| *word == "RMK")
            .unwrap_or(words.len());
        for at in 0..end {
            let mut spoilt = words.clone();
            spoilt[at] = "XYZZY";
            let spoilt = spoilt.join(" ");
            let Err(SceneError::Report(fault)) = request(&spoilt).scene(now()) else {
                panic!("{spoilt}");
            };
            // Half of a group of two words makes both wrong.
            assert!(
                fault.group.contains("XYZZY")
                    || words[at + 1..].first().is_some_and(|next| fault.group == *next)
                    || at > 0 && fault.group == words[at - 1],
                "{spoilt}: {fault}"
            );
            count += 1;
        }
    }
    assert!(count > 1500, "{count}");
}

#[test]
fn malformed_reports_name_the_group() {
    let mut count = 0;
    for line in lines(MALFORMED) {
        let (report, group) = line.rsplit_once(" |").unwrap();
        let Err(SceneError::Report(fault)) = request(report).scene(now()) else {
            panic!("{report}");
        };
        assert_eq!(fault.group, group.trim(), "{report}: {fault}");
        let capitals = report.to_ascii_uppercase();
        let written: String = capitals
            .chars()
            .skip(fault.start)
            .take(fault.end - fault.start)
            .collect();
        assert_eq!(written, fault.group, "{report}: {fault:?}");
        if !fault.group.is_empty() {
            let mut words = capitals.split([' ', '=']).filter(|word| !word.is_empty());
            let word = words.nth(fault.number - 1).unwrap();
            assert!(fault.group.starts_with(word), "{report}: {fault:?}");
        }
        assert!(!fault.expected.is_empty());
        count += 1;
    }
    assert!(count >= 50, "{count}");
}

#[test]
fn a_fault_is_one_clear_sentence() {
    let fault = request("METAR EGLL 092050Z 24008KT 9999 FEW18 17/12 Q1019").scene(now());
    assert_eq!(
        fault.unwrap_err().to_string(),
        "group 6 of the report, `FEW18` at character 33, is not understood: a cloud is FEW, SCT, BKN, OVC or ///, its \
         height in hundreds of feet in three figures or ///, and CB, TCU or /// if need be, as BKN012CB"
    );
    let fault = request("METAR EGLL").scene(now());
    assert_eq!(
        fault.unwrap_err().to_string(),
        "the report ends where its group 3 should be: day of the month, hour and minute in UTC, and Z, as 092050Z"
    );
}

#[test]
fn every_field_of_a_report_is_read() {
    let report = "SPECI COR EGLL 092050Z AUTO 24010G25KT 200V280 4000 1500SW R27L/P1500 -RADZ VCTS BKN012CB OVC030 \
                  17/M02 Q1003 RERA WS R27L R27L/290155 GRN TEMPO FM2100 2000 RA RMK END";
    let answer = MetarRequest {
        date: Some("2018-09-20".into()),
        ..request(report)
    }
    .scene(now())
    .unwrap();
    let knots = 1852.0 / 3600.0;
    let report = &answer.report;
    assert!(report.is_special && report.is_corrected && report.is_automatic);
    assert_eq!(
        (report.station.as_str(), report.time.as_str()),
        ("EGLL", "2018-09-09T20:50:00Z")
    );
    let wind = report.wind.unwrap();
    assert_eq!(wind.from_azimuth_deg, Some(240.0));
    assert!((wind.speed_m_s.unwrap() - 10.0 * knots).abs() < 1e-12);
    assert!((wind.gust_m_s.unwrap() - 25.0 * knots).abs() < 1e-12);
    assert_eq!(report.visibility.unwrap().distance_m, 4000.0);
    assert_eq!(report.weather[0].phenomena, ["RA", "DZ"]);
    assert!(report.weather[1].is_nearby);
    assert_eq!((report.clouds.len(), report.clouds[0].kind), (2, Some("CB")));
    assert!((report.clouds[0].base_m.unwrap() - 365.76).abs() < 1e-9);
    assert_eq!(
        (report.temperature_c, report.dew_point_c),
        (Some(17.0), Some(-2.0))
    );
    assert_eq!(report.pressure_hpa, Some(1003.0));
    // 5.28 hPa over 19.37 hPa by tables of vapour pressure over water.
    assert!((report.relative_humidity.unwrap() - 0.2725).abs() < 2e-3);
    assert_eq!(report.trend.as_deref(), Some("TEMPO FM2100 2000 RA"));
    assert_eq!(report.remarks.as_deref(), Some("END"));
    assert_eq!(
        answer.not_rendered,
        [
            "200V280",
            "1500SW",
            "R27L/P1500",
            "RERA",
            "WS R27L",
            "R27L/290155",
            "GRN",
            "VCTS"
        ]
    );
}

#[test]
fn visibilities_in_all_their_forms() {
    const MILE: f64 = 1609.344;
    for (group, distance_m, bound) in [
        ("9999", 10_000.0, Bound::AtLeast),
        ("CAVOK", 10_000.0, Bound::AtLeast),
        ("9999NDV", 10_000.0, Bound::AtLeast),
        ("0600", 600.0, Bound::Exactly),
        ("0000", 50.0, Bound::LessThan),
        ("20KM", 20_000.0, Bound::Exactly),
        ("10SM", 10.0 * MILE, Bound::AtLeast),
        ("15SM", 15.0 * MILE, Bound::Exactly),
        ("P6SM", 6.0 * MILE, Bound::AtLeast),
        ("M1/4SM", 0.25 * MILE, Bound::LessThan),
        ("3/8SM", 0.375 * MILE, Bound::Exactly),
        ("1 1/2SM", 1.5 * MILE, Bound::Exactly),
        ("11/2SM", 1.5 * MILE, Bound::Exactly),
        ("15/16SM", 0.9375 * MILE, Bound::Exactly),
    ] {
        let report = format!("KJFK 092050Z 24008KT {group} 17/12 A2992");
        let visibility = read(&report).report.visibility.unwrap();
        assert!(
            (visibility.distance_m - distance_m).abs() < 1e-9,
            "{group}: {visibility:?}"
        );
        assert_eq!(visibility.bound, bound, "{group}");
    }
}

#[test]
fn lower_case_and_white_space_do_not_matter() {
    let plain = read("METAR EGLL 092050Z 24008KT 9999 FEW018 17/12 Q1019=");
    let odd = read("\n  metar egll\t092050z 24008kt 9999\r\n few018 17/12 q1019 =\n");
    assert_eq!(plain, odd);
}

#[test]
fn requests_are_checked_field_by_field() {
    let long = format!(r#"{{"metar": "{}"}}"#, "A".repeat(5000));
    for (body, pointer) in [
        ("{}", "/metar"),
        (r#"{"metar": 1}"#, "/metar"),
        (r#"{"metar": "", "dat": 1}"#, "/dat"),
        (r#"{"metar": "", "date": "yesterday"}"#, "/date"),
        (r#"{"metar": "", "date": "1850-01-01"}"#, "/date"),
        (
            r#"{"metar": "", "latitude_deg": 91, "longitude_deg": 0}"#,
            "/latitude_deg",
        ),
        (r#"{"metar": "", "latitude_deg": 51}"#, "/longitude_deg"),
        (r#"{"metar": "", "longitude_deg": 0}"#, "/latitude_deg"),
        (&long, "/metar"),
    ] {
        let Err(SceneError::Invalid(problems)) = MetarRequest::from_json(body) else {
            panic!("{body}");
        };
        assert_eq!(problems[0].pointer, pointer, "{}", problems[0].message);
    }
    let early = MetarRequest {
        date: Some("1900-01-01".into()),
        ..request("EGLL 312050Z CAVOK 17/12 Q1019")
    };
    let Err(SceneError::Invalid(problems)) = early.scene(now()) else {
        panic!("December 1899 is too early");
    };
    assert_eq!(problems[0].pointer, "/date");
}
