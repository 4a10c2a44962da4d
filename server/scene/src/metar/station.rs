//! Where weather stations are. The table is made by `scripts/stations.mjs` from the station table of the US National
//! Weather Service and from OurAirports, both in the public domain.

use super::report::Place;

static STATIONS: &str = include_str!("stations.txt");

/// The place of a station, to a hundredth of a degree.
pub(super) fn place(indicator: &str) -> Option<Place> {
    let line = STATIONS
        .lines()
        .find_map(|line| line.strip_prefix(indicator)?.strip_prefix(' '))?;
    let mut numbers = line.split(' ').map(str::parse);
    let mut number = || numbers.next()?.ok();
    Some(Place {
        latitude_deg: number()?,
        longitude_deg: number()?,
        elevation_m: number()?,
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;

    #[test]
    fn every_line_is_a_place_on_the_earth() {
        let mut before = "";
        for line in STATIONS.lines() {
            let (indicator, _) = line.split_once(' ').unwrap();
            assert!(indicator.len() == 4 && before < indicator, "{line}");
            before = indicator;
            let place = place(indicator).unwrap();
            assert!(
                place.latitude_deg.abs() <= 90.0 && place.longitude_deg.abs() <= 180.0,
                "{line}"
            );
            // From the shore of the Dead Sea to the highest airports of Tibet.
            assert!((-430.0..5000.0).contains(&place.elevation_m), "{line}");
        }
        assert!(STATIONS.lines().count() > 8000);
    }

    #[test]
    fn known_stations_are_where_they_are() {
        // Heathrow, Quito, Wellington, the South Pole: one in each quarter, and one on the edge.
        for (indicator, latitude_deg, longitude_deg, elevation_m) in [
            ("EGLL", 51.47, -0.46, 25.0),
            ("SEQM", -0.13, -78.36, 2400.0),
            ("NZWN", -41.33, 174.81, 12.0),
            ("NZSP", -90.0, 0.0, 2835.0),
        ] {
            let place = place(indicator).unwrap();
            // The table has hundredths; its two sources differ by some.
            assert!(
                (place.latitude_deg - latitude_deg).abs() < 0.03,
                "{indicator}: {place:?}"
            );
            assert!(
                (place.longitude_deg - longitude_deg).abs() < 0.03,
                "{indicator}: {place:?}"
            );
            assert!(
                (place.elevation_m - elevation_m).abs() < 30.0,
                "{indicator}: {place:?}"
            );
        }
        for none in ["", "E", "EGL", "EGLL 51.47", "QQQQ", "egll", "Ü"] {
            assert_eq!(place(none), None, "{none}");
        }
    }
}
