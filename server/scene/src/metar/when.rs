//! The month and year that a report leaves out.

use super::read::Clock;
use chrono::{DateTime, Datelike, Days, Months, NaiveDate, NaiveTime, SecondsFormat, TimeDelta, Utc};

/// Clocks that go slow may make a new report seem to come from the future.
const SLACK: TimeDelta = TimeDelta::hours(1);
/// No two neighbouring months lack a day: if this month has not come to it and the last has none, the one before has.
const MOST_MONTHS_BACK: u32 = 2;

/// Reads a date, `2026-06-21`.
pub(super) fn date(text: &str) -> Option<NaiveDate> {
    (text.len() == 10).then(|| text.parse().ok())?
}

/// The last moment before the end of a date.
pub(super) fn end_of(date: NaiveDate) -> Option<DateTime<Utc>> {
    let next = date.checked_add_days(Days::new(1))?;
    Some(next.and_time(NaiveTime::MIN).and_utc() - TimeDelta::seconds(1))
}

/// Now, with some room for slow clocks.
pub(super) fn about(now: DateTime<Utc>) -> DateTime<Utc> {
    now.checked_add_signed(SLACK).unwrap_or(now)
}

/// The last moment of this day and time that is not after `until`.
pub(super) fn last(clock: Clock, until: DateTime<Utc>) -> Option<DateTime<Utc>> {
    let first_of_month = until.date_naive().with_day(1)?;
    (0..=MOST_MONTHS_BACK).find_map(|back| {
        let month = first_of_month.checked_sub_months(Months::new(back))?;
        let moment = month
            .with_day(clock.day)?
            .and_hms_opt(clock.hour, clock.minute, 0)?
            .and_utc();
        (moment <= until).then_some(moment)
    })
}

/// RFC 3339 as scenes have it.
pub(super) fn text(moment: DateTime<Utc>) -> String {
    moment.to_rfc3339_opts(SecondsFormat::Secs, true)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;

    #[test]
    fn the_last_day_of_that_number_is_meant() {
        let clock = |day, hour| Clock {
            day,
            hour,
            minute: 50,
        };
        for (day, hour, until, expected) in [
            (9, 20, "2018-09-09T21:00:00Z", "2018-09-09T20:50:00Z"),
            (9, 22, "2018-09-09T21:00:00Z", "2018-08-09T22:50:00Z"),
            (10, 0, "2018-09-09T21:00:00Z", "2018-08-10T00:50:00Z"),
            (31, 0, "2026-03-01T00:00:00Z", "2026-01-31T00:50:00Z"),
            (31, 23, "2026-01-01T00:10:00Z", "2025-12-31T23:50:00Z"),
            (29, 12, "2024-03-01T00:00:00Z", "2024-02-29T12:50:00Z"),
            (29, 12, "2026-03-01T00:00:00Z", "2026-01-29T12:50:00Z"),
        ] {
            let until: DateTime<Utc> = until.parse().unwrap();
            let found = last(clock(day, hour), until).unwrap();
            assert_eq!(text(found), expected, "{day} {hour}");
        }
    }

    #[test]
    fn dates_are_dates() {
        assert_eq!(
            text(end_of(date("2024-02-29").unwrap()).unwrap()),
            "2024-02-29T23:59:59Z"
        );
        for none in [
            "",
            "2023-02-29",
            "2024-2-29",
            "24-02-29",
            "2024-02-29T00",
            "2024-13-01",
            "29.02.2024",
        ] {
            assert_eq!(date(none), None, "{none}");
        }
    }
}
