//! The air, the ground and the sun that a weather report tells of.

use crate::metar::{now, read, reports, request};
use welkin_scene::{Bands, MetarRequest, Scene, SunPosition, metar::report::Bound};

/// Extinction in green at the ground, 1/m: molecules, aerosol, haze.
fn extinctions(scene: &Scene) -> [f64; 3] {
    let air = scene.atmosphere.as_ref().unwrap();
    let mie = air.mie.as_ref().unwrap();
    [
        air.rayleigh.as_ref().unwrap().scattering_per_m[1],
        mie.scattering_per_m.rgb()[1] + mie.absorption_per_m.rgb()[1],
        scene.haze.as_ref().map_or(0.0, |haze| haze.extinction()),
    ]
}

/// Visibility is what the three extinctions make together; a bound is kept.
#[test]
fn extinction_is_what_the_visibility_tells() {
    let (mut exact, mut bounds) = (0, 0);
    for (_, report) in reports() {
        let answer = read(report);
        let Some(visibility) = answer.report.visibility else {
            continue;
        };
        let total: f64 = extinctions(&answer.scene).iter().sum();
        let told = 3.912 / visibility.distance_m;
        let eye_m = answer.scene.camera.position_m[2];
        if answer.scene.haze.as_ref().is_some_and(|haze| haze.top_m < eye_m) {
            continue;
        }
        if visibility.bound == Bound::AtLeast {
            // Roundings of sums.
            assert!(total <= told * (1.0 + 1e-12), "{report}: {total} over {told}");
            bounds += 1;
        } else {
            assert!(
                (total / told - 1.0).abs() < 1e-12,
                "{report}: {total} is not {told}"
            );
            exact += 1;
        }
    }
    assert!(exact > 50 && bounds > 50, "{exact} {bounds}");
}

#[test]
fn what_hides_the_view_has_its_colour_and_height() {
    let haze = |groups: &str| {
        read(&format!("EGLL 092050Z 24008KT {groups} 17/12 Q1019"))
            .scene
            .haze
    };
    for (groups, top_m, is_grey) in [
        ("0200 FG", 150.0, true),
        ("0200 FG VV001", 200.0, true),
        ("0100 FG VV001", 150.0, true),
        ("3000 BR", 300.0, true),
        ("3000 RA BR BKN010", 304.8, true),
        ("3000 SN BKN010 OVC005", 152.4, true),
        ("3000 SN", 1500.0, true),
        ("3000 HZ", 1500.0, false),
        ("3000 FU", 1500.0, false),
        ("3000 DU", 2000.0, false),
        ("0600 +SS", 2000.0, false),
        ("0600 BLSA", 100.0, false),
        ("3000 VA", 3000.0, false),
        ("9999 MIFG", 1.5, true),
        ("6000 DRSA", 1.5, false),
    ] {
        let haze = haze(groups).unwrap_or_else(|| panic!("{groups}"));
        assert!((haze.top_m - top_m).abs() < 1e-9, "{groups}: {haze:?}");
        assert_eq!(haze.albedo == Bands::Grey(1.0), is_grey, "{groups}: {haze:?}");
    }
    for groups in ["9999", "CAVOK", "7000", "9999 -RA", "9999 VCFG", "6000 TS"] {
        assert_eq!(haze(groups), None, "{groups}");
    }
    let [red, _, blue] = haze("3000 DU").unwrap().albedo.rgb();
    assert!(red > blue, "dust takes from the blue");
    let [red, _, blue] = haze("3000 FU").unwrap().albedo.rgb();
    assert!(
        red < blue && blue < 0.92,
        "smoke takes from all, and most from the red"
    );
    // Without a word for it: mist where it is damp, haze where it is dry.
    assert_eq!(haze("3000").unwrap().top_m, 1500.0);
    let damp = read("EGLL 092050Z 24008KT 3000 13/12 Q1019").scene.haze.unwrap();
    assert_eq!((damp.top_m, damp.albedo), (300.0, Bands::Grey(1.0)));
}

#[test]
fn damp_air_is_hazier_where_only_a_bound_is_told() {
    let aerosol = |temperatures: &str| {
        let report = format!("EGLL 092050Z 24008KT 9999 {temperatures} Q1013");
        extinctions(&read(&report).scene)[1]
    };
    assert!(aerosol("20/00") < aerosol("20/10") && aerosol("20/10") < aerosol("20/18"));
    // Saturated air would hide what stands at 10 km; the bound says that it does not.
    let total: f64 = extinctions(&read("EGLL 092050Z 9999 20/20 Q1013").scene)
        .iter()
        .sum();
    assert!(total <= 3.912e-4);
}

#[test]
fn molecules_follow_pressure_temperature_and_height() {
    let molecules = |report: &str| {
        let air = read(report).scene.atmosphere.unwrap().rayleigh.unwrap();
        (air.scattering_per_m[1], air.scale_height_m)
    };
    let (usual, height_m) = (13.75e-6, 8000.0);
    // Heathrow is 25 m above the sea: 0.3 % of the pressure.
    let (standard, standard_m) = molecules("EGLL 092050Z CAVOK 15/10 Q1013");
    assert!((standard / usual - 1.0).abs() < 0.004 && (standard_m / height_m - 1.0).abs() < 1e-3);
    let (cold, cold_m) = molecules("EGLL 092050Z CAVOK M23/M25 Q1013");
    assert!(
        (cold / standard - 288.15 / 250.15).abs() < 1e-9,
        "density goes as 1/T"
    );
    assert!(
        (cold * cold_m - standard * standard_m).abs() < 1e-9,
        "the optical depth does not"
    );
    let (high, high_m) = molecules("EGLL 092050Z CAVOK 15/10 Q1043");
    assert!((high * high_m / (standard * standard_m) - 1043.0 / 1013.0).abs() < 1e-9);
    // La Paz lies 4060 m high, where a standard atmosphere has 610 hPa.
    let (thin, thin_m) = molecules("SLLP 092050Z CAVOK 15/M05 Q1013");
    assert!((thin * thin_m / (usual * height_m) - 610.0 / 1013.25).abs() < 0.01);
}

#[test]
fn snow_lies_where_it_blows_or_falls_in_frost() {
    let albedo = |groups: &str| {
        let answer = read(&format!("EGXC 180250Z 08019KT {groups} Q1011"));
        answer.scene.planet.ground_albedo[0]
    };
    assert_eq!(albedo("1600 BLSN M02/M04"), 0.8);
    assert_eq!(albedo("9999 M02/M04 Q1011 R/SNOCLO"), 0.8);
    assert_eq!(albedo("1600 -SN M02/M04"), 0.5);
    for none in [
        "1600 -SN 02/M04",
        "9999 M02/M04",
        "9999 VCSN M02/M04",
        "3000 RA 02/01",
    ] {
        assert_eq!(albedo(none), 0.1, "{none}");
    }
}

#[test]
fn the_sun_stands_where_and_when_the_report_says() {
    let answer = read("METAR EGLL 211150Z 24008KT CAVOK 17/12 Q1019");
    assert_eq!(
        answer.report.time, "2026-11-21T11:50:00Z",
        "the last 21st before the clock"
    );
    let SunPosition::TimeAndPlace(at) = &answer.scene.sun.position else {
        panic!("{:?}", answer.scene.sun);
    };
    assert!(at.refraction && at.time == answer.report.time);
    // At London's noon in late November: 90° - 51.5° - 20°.
    assert!((answer.scene.sun_place().elevation_deg - 18.5).abs() < 0.5);

    let report = "METAR ENLA 092050Z 24008KT CAVOK 17/12 Q1019";
    let unknown = read(report);
    assert_eq!(unknown.scene.sun, Scene::default().sun);
    assert!(unknown.report.place.is_none() && unknown.notes[0].contains("`latitude_deg`"));
    let given = MetarRequest {
        latitude_deg: Some(57.0),
        longitude_deg: Some(3.0),
        ..request(report)
    };
    let given = given.scene(now()).unwrap();
    assert!(matches!(given.scene.sun.position, SunPosition::TimeAndPlace(at) if at.latitude_deg == 57.0));
}
