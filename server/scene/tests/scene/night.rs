//! Moon and stars: their places against an ephemeris, and what the document says of them.

use proptest::{option, prelude::*};
use serde_json::{Value, json};
use welkin_scene::{Airglow, Direction, Moon, Orientation, Scene, Stars};

const MOON: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../tests/oracles/moon_position.json"
));
const STARS: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../tests/oracles/stars_position.json"
));

pub(crate) fn moon() -> impl Strategy<Value = Moon> {
    let position = (-360.0..=360.0, -90.0..=90.0).prop_map(|(a, e)| Direction::angles(a, e));
    let angles = (
        option::of(position),
        option::of(0.0..=180.0),
        option::of(0.0..=20.0),
    );
    (angles, 0.0..=1e6, 0.0..=1e6, any::<bool>()).prop_map(|(angles, irradiance_scale, earthshine, disc)| {
        Moon {
            position: angles.0,
            phase_angle_deg: angles.1,
            irradiance_scale,
            angular_diameter_deg: angles.2,
            earthshine,
            disc,
        }
    })
}

pub(crate) fn stars() -> impl Strategy<Value = Stars> {
    let orientation =
        (-90.0..=90.0, -360.0..=360.0).prop_map(|(latitude_deg, sidereal_time_deg)| Orientation {
            latitude_deg,
            sidereal_time_deg,
        });
    (0.0..=1e6, -2.0..=7.0, option::of(orientation)).prop_map(
        |(intensity, limiting_magnitude, orientation)| Stars {
            intensity,
            limiting_magnitude,
            orientation,
        },
    )
}

pub(crate) fn airglow() -> impl Strategy<Value = Airglow> {
    let radiance = prop::array::uniform3(0.0..=1e3);
    (radiance, 0.0..=5e5, 1.0..=5e5).prop_map(|(zenith_radiance_w_m2_sr, base_m, thickness_m)| Airglow {
        zenith_radiance_w_m2_sr,
        base_m,
        top_m: base_m + thickness_m,
    })
}

fn rows(oracle: &str) -> Vec<Value> {
    let oracle: Value = serde_json::from_str(oracle).unwrap();
    oracle["rows"].as_array().unwrap().clone()
}

fn scene(changes: Value) -> Scene {
    Scene::from_value(&changes).unwrap()
}

fn at(row: &Value) -> Scene {
    let place = json!({"time": row["time"], "latitude_deg": row["latitude_deg"], "longitude_deg": row["longitude_deg"]});
    scene(json!({"sun": {"position": place}}))
}

fn place(row: &Value) -> [f64; 3] {
    Direction::angles(
        row["azimuth_deg"].as_f64().unwrap(),
        row["elevation_deg"].as_f64().unwrap(),
    )
    .unit()
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn angle_deg(a: [f64; 3], b: [f64; 3]) -> f64 {
    let chord = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    2.0 * (chord / 2.0).asin().to_degrees()
}

#[test]
fn the_moon_is_where_the_ephemeris_has_it() {
    let rows = rows(MOON);
    assert_eq!(rows.len(), 64);
    for row in rows {
        let seen = at(&row).moon_seen().unwrap();
        // Meeus' selection of the lunar theory is good to 10" in longitude and 4" in latitude; UT1 differs from UTC by
        // up to 0.9 s, 14" of the sky's turning, and delta-T is an estimate: 0.01° in the worst case.
        let off = angle_deg(seen.direction, place(&row));
        assert!(off < 0.01, "{row}: {off}°");
        let far = seen.distance_m / row["distance_m"].as_f64().unwrap() - 1.0;
        // What the selection leaves out of the distance adds up to 60 km.
        assert!(far.abs() < 2e-4, "{row}: {far}");
        // Of the sun's place, its distance is taken as its mean: 1.7 % of the moon's parallax of 0.15°.
        let phase = seen.phase_angle_deg - row["phase_angle_deg"].as_f64().unwrap();
        assert!(phase.abs() < 0.01, "{row}: {phase}°");
    }
}

#[test]
fn the_stars_are_where_the_ephemeris_has_them() {
    let rows = rows(STARS);
    assert_eq!(rows.len(), 48);
    for row in rows {
        let [ra, dec] = ["right_ascension_deg", "declination_deg"].map(|name| row[name].as_f64().unwrap());
        // Nutation (9") and aberration (20") are left out, UT1 - UTC is 14" at most.
        let off = angle_deg(at(&row).firmament().direction(ra, dec), place(&row));
        assert!(off < 0.015, "{row}: {off}°");
    }
}

#[test]
fn the_stars_stand_as_the_scene_says() {
    let standing = |latitude_deg: f64, sidereal_time_deg: f64| {
        let orientation = json!({"latitude_deg": latitude_deg, "sidereal_time_deg": sidereal_time_deg});
        scene(json!({"stars": {"orientation": orientation}})).firmament()
    };
    // The pole stands in the north as high as the latitude, whatever the time.
    let pole = standing(52.0, 77.0).direction(0.0, 90.0);
    assert!(angle_deg(pole, Direction::angles(0.0, 52.0).unit()) < 1e-9);
    // What has the sidereal time for right ascension culminates in the south, at 90° - latitude + declination.
    let south = standing(52.0, 77.0).direction(77.0, 10.0);
    assert!(angle_deg(south, Direction::angles(180.0, 48.0).unit()) < 1e-9);
    // Six hours before that it rises in the east.
    let rising = standing(52.0, 77.0 - 90.0).direction(77.0, 0.0);
    assert!(angle_deg(rising, Direction::angles(90.0, 0.0).unit()) < 1e-9);
}

#[test]
fn refraction_lifts_moon_and_stars_as_it_lifts_the_sun() {
    let at = |refraction: bool, minutes: u32| {
        let time = format!("2026-02-03T{:02}:{:02}:00Z", 17 + minutes / 60, minutes % 60);
        let place = json!({"time": time, "latitude_deg": 48, "longitude_deg": 11, "refraction": refraction});
        scene(json!({"sun": {"position": place}}))
    };
    for minutes in (0..180).step_by(10) {
        let [bent, straight] = [true, false].map(|r| at(r, minutes).moon_place().unwrap());
        assert!((bent.azimuth_deg - straight.azimuth_deg).abs() < 1e-9);
        let lift = bent.elevation_deg - straight.elevation_deg;
        // 0.48° at the horizon, 0.09° at 10° (Meeus, ch. 16); none far below.
        let expected = if straight.elevation_deg < -0.84 {
            0.0..=0.0
        } else {
            0.01..=0.65
        };
        assert!(expected.contains(&lift), "{straight:?}: {lift}");
    }
    let frame = at(true, 0).firmament();
    let bare = at(false, 0).firmament();
    // A star at the celestial equator that stands about 1° high in one of these directions.
    let low = (0..360)
        .map(f64::from)
        .map(|ra| (frame.direction(ra, 0.0), bare.direction(ra, 0.0)));
    let mut lifted = 0;
    for (with, without) in low {
        let height = without[2].asin().to_degrees();
        if (0.0..5.0).contains(&height) {
            lifted += 1;
            assert!(
                (0.1..0.6).contains(&(with[2].asin().to_degrees() - height)),
                "{height}"
            );
        }
    }
    assert!(lifted > 2, "{lifted}");
}

#[test]
fn there_is_a_moon_where_its_place_is_known() {
    let none = scene(json!({}));
    assert_eq!(none.moon_place(), None);
    let time = json!({"time": "2026-06-21T05:00:00Z", "latitude_deg": 60, "longitude_deg": 30});
    assert!(scene(json!({"sun": {"position": time}})).moon_place().is_some());
    assert_eq!(
        scene(json!({"sun": {"position": time}, "moon": null})).moon_place(),
        None
    );
    let position = json!({"azimuth_deg": 120, "elevation_deg": 30});
    for sun in [json!({}), json!({"position": time})] {
        let said = scene(json!({"sun": sun, "moon": {"position": position}}))
            .moon_place()
            .unwrap();
        assert!(
            (said.azimuth_deg - 120.0).abs() < 1e-9 && (said.elevation_deg - 30.0).abs() < 1e-9,
            "{said:?}"
        );
    }
}

#[test]
fn the_phase_follows_sun_and_moon_unless_it_is_said() {
    let of = |moon_azimuth_deg: f64, phase: Value| {
        let sun = json!({"position": {"azimuth_deg": 0, "elevation_deg": 0}});
        let position = json!({"azimuth_deg": moon_azimuth_deg, "elevation_deg": 0});
        let moon = json!({"position": position, "phase_angle_deg": phase});
        scene(json!({"sun": sun, "moon": moon})).moon_seen().unwrap()
    };
    for (azimuth_deg, phase_deg) in [(180.0, 0.0), (90.0, 90.0), (0.0, 180.0), (45.0, 135.0)] {
        let seen = of(azimuth_deg, Value::Null);
        // The moon's own distance is 1/389 of the sun's: 0.15°.
        assert!(
            (seen.phase_angle_deg - phase_deg).abs() < 0.15,
            "{azimuth_deg}: {seen:?}"
        );
        for said in [0.0, 30.0, 90.0, 170.0, 180.0] {
            let seen = of(azimuth_deg, json!(said));
            assert!((seen.phase_angle_deg - said).abs() < 1e-9);
            // The light comes from the sun's side, at the angle said from the observer's direction.
            let away = seen.direction.map(|c| -c);
            assert!((angle_deg(seen.light, away) - said).abs() < 1e-5, "{seen:?}");
            let sun = [0.0, 1.0, 0.0];
            let side = dot(seen.light, sun) - dot(seen.light, seen.direction) * dot(seen.direction, sun);
            assert!(side > -1e-9, "{azimuth_deg} {said}: {side}");
        }
    }
}

#[test]
fn the_disc_is_as_large_as_the_distance_makes_it() {
    let time = json!({"time": "2026-06-21T05:00:00Z", "latitude_deg": 60, "longitude_deg": 30});
    let seen = scene(json!({"sun": {"position": time}})).moon_place().unwrap();
    // From perigee to apogee.
    assert!((0.48..0.57).contains(&seen.angular_diameter_deg), "{seen:?}");
    let said = json!({"sun": {"position": time}, "moon": {"angular_diameter_deg": 3}});
    assert_eq!(scene(said).moon_place().unwrap().angular_diameter_deg, 3.0);
}

#[test]
fn what_cannot_be_is_refused_by_name() {
    let pointer = |changes: Value| match Scene::from_value(&changes) {
        Err(welkin_scene::SceneError::Invalid(problems)) => problems[0].pointer.clone(),
        other => panic!("{other:?}"),
    };
    for (changes, expected) in [
        (json!({"moon": {"position": [0, 0, 0]}}), "/moon/position"),
        (json!({"moon": {"phase_angle_deg": 181}}), "/moon/phase_angle_deg"),
        (json!({"moon": {"earthshine": -1}}), "/moon/earthshine"),
        (json!({"stars": {"intensity": -1}}), "/stars/intensity"),
        (
            json!({"stars": {"orientation": {"latitude_deg": 91}}}),
            "/stars/orientation/latitude_deg",
        ),
        (
            json!({"atmosphere": {"airglow": {"base_m": 9e4, "top_m": 8e4}}}),
            "/atmosphere/airglow/top_m",
        ),
    ] {
        assert_eq!(pointer(changes), expected);
    }
    for part in ["moon", "stars"] {
        let written = serde_json::to_value(scene(json!({ part: null }))).unwrap();
        assert_eq!(written[part], Value::Null);
    }
    let dark = scene(json!({"atmosphere": {"airglow": null}}));
    assert_eq!(dark.atmosphere.unwrap().airglow, None);
}
