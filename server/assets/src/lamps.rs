//! Lamps of a town: a CSV, or a GeoJSON of points. Both say of a lamp what a scene's `lights` say, by the same names.

use crate::{Error, Form};
use serde_json::{Map, Value, json};
use welkin_scene::{Light, Scene, lights::MAX_LIGHTS};

/// The most that a list takes in memory, bytes.
pub(crate) const MOST_BYTES: u64 = (MAX_LIGHTS * size_of::<Light>()) as u64;

/// Fields of a light that are numbers; the others are words.
const NUMBERS: [&str; 3] = ["colour_temperature_k", "luminous_intensity_cd", "radius_m"];
const WORDS: [&str; 3] = ["lamp", "emission", "above"];
/// Columns that make up its place, and those of its radiant intensity.
const PLACE: [&str; 3] = ["east_m", "north_m", "height_m"];
const RADIANT: [&str; 3] = ["red_w_sr", "green_w_sr", "blue_w_sr"];
/// Of a sphere as large as the Earth is on average, for degrees of a few kilometres.
const EARTH_M: f64 = 6_371_000.0;

/// Reads a file to its end.
pub(crate) fn read(form: Form, file: &[u8]) -> Result<Vec<Light>, Error> {
    let lamps = match form {
        Form::GeoJson => of_points(file)?,
        _ => of_rows(file)?,
    };
    if lamps.len() > MAX_LIGHTS {
        return Err(Error::refused(format!(
            "it has {} lamps: {MAX_LIGHTS} at most are read",
            lamps.len()
        )));
    }
    // The scene's own rules, with its own words for what breaks them.
    let scene = Scene::from_value(&json!({ "lights": lamps })).map_err(|e| Error::refused(e.to_string()))?;
    Ok(scene.lights)
}

fn of_rows(file: &[u8]) -> Result<Vec<Value>, Error> {
    let text = std::str::from_utf8(file).map_err(|_| Error::refused("a CSV is a text in UTF-8"))?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = text
        .lines()
        .zip(1_u32..)
        .filter(|(line, _)| !line.trim().is_empty());
    let names: Vec<&str> = match lines.next() {
        Some((line, _)) => line.split(',').map(str::trim).collect(),
        None => return Err(Error::refused("it is empty: its first line names the columns")),
    };
    let known = || NUMBERS.iter().chain(&WORDS).chain(&PLACE).chain(&RADIANT);
    if let Some(stranger) = names.iter().find(|name| !known().any(|known| known == *name)) {
        let known: Vec<_> = known().copied().collect();
        return Err(Error::refused(format!(
            "its column {stranger:?} is not one of {}",
            known.join(", ")
        )));
    }
    if let Some(missing) = PLACE[..2].iter().find(|name| !names.contains(name)) {
        return Err(Error::refused(format!("it has no column {missing}")));
    }
    lines
        .map(|(line, number)| {
            let values: Vec<&str> = line.split(',').map(str::trim).collect();
            if values.len() != names.len() {
                return Err(Error::refused(format!(
                    "line {number} has {} values for {} columns",
                    values.len(),
                    names.len()
                )));
            }
            let mut row = Map::new();
            for (name, value) in names.iter().zip(values).filter(|(_, value)| !value.is_empty()) {
                let value = if WORDS.contains(name) {
                    value.into()
                } else {
                    let read = value.parse::<f64>().ok().filter(|v| v.is_finite());
                    let told = || Error::refused(format!("line {number}: {name} is {value:?}, not a number"));
                    read.ok_or_else(told)?.into()
                };
                row.insert((*name).to_owned(), value);
            }
            Ok(lamp(row))
        })
        .collect()
}

/// From columns to a light: the parts of its place and of its intensity become lists.
fn lamp(mut row: Map<String, Value>) -> Value {
    let mut list = |names: [&str; 3], light: &mut Map<String, Value>, to: &str| {
        let parts = names.map(|name| row.remove(name));
        if parts.iter().any(Option::is_some) {
            let parts = parts.map(|part| part.unwrap_or_else(|| 0.0.into()));
            light.insert(to.to_owned(), parts.to_vec().into());
        }
    };
    let mut light = Map::new();
    list(PLACE, &mut light, "position_m");
    list(RADIANT, &mut light, "radiant_intensity_w_sr");
    light.extend(row);
    light.into()
}

fn of_points(file: &[u8]) -> Result<Vec<Value>, Error> {
    let document: Value = serde_json::from_slice(file).map_err(Error::damaged)?;
    let features = document["features"].as_array();
    let features = features.ok_or_else(|| Error::refused("it is no FeatureCollection with `features`"))?;
    if features.len() > MAX_LIGHTS {
        return Err(Error::refused(format!(
            "it has {} features: {MAX_LIGHTS} at most are read",
            features.len()
        )));
    }
    let mut points = Vec::new();
    for (i, feature) in features.iter().enumerate() {
        let geometry = &feature["geometry"];
        let place = |axis: usize| geometry["coordinates"][axis].as_f64();
        let (Some("Point"), Some(longitude), Some(latitude)) =
            (geometry["type"].as_str(), place(0), place(1))
        else {
            return Err(Error::refused(format!(
                "feature {i} is no Point with longitude and latitude"
            )));
        };
        points.push((longitude, latitude, place(2), &feature["properties"]));
    }
    #[allow(clippy::cast_precision_loss, reason = "a few thousand")]
    let count = points.len().max(1) as f64;
    // The file's origin is the mean of its points.
    let east_deg = points.iter().map(|point| point.0).sum::<f64>() / count;
    let north_deg = points.iter().map(|point| point.1).sum::<f64>() / count;
    Ok(points
        .iter()
        .map(|(longitude, latitude, height_m, properties)| {
            let mut row = properties.as_object().cloned().unwrap_or_default();
            // Maps say much of their points that is nothing to a sky.
            row.retain(|name, _| {
                NUMBERS
                    .iter()
                    .chain(&WORDS)
                    .chain(&RADIANT)
                    .any(|known| known == name)
            });
            let east_m = (longitude - east_deg).to_radians() * EARTH_M * north_deg.to_radians().cos();
            let north_m = (latitude - north_deg).to_radians() * EARTH_M;
            row.insert("east_m".into(), east_m.into());
            row.insert("north_m".into(), north_m.into());
            row.insert("height_m".into(), height_m.unwrap_or(0.0).into());
            lamp(row)
        })
        .collect())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use proptest::prelude::*;
    use welkin_scene::{Bands, lights::Lamp};

    #[test]
    fn rows_and_points_become_lamps() {
        let csv = "east_m,north_m,height_m,lamp,luminous_intensity_cd\n\n 10, 20,9,mercury,400\n-1,-2,,,\n";
        let lamps = read(Form::Csv, csv.as_bytes()).unwrap();
        assert_eq!(lamps.len(), 2);
        assert_eq!(lamps[0].position_m, [10.0, 20.0, 9.0]);
        assert_eq!(lamps[0].lamp, Some(Lamp::Mercury));
        assert_eq!(
            lamps[1],
            Light {
                position_m: [-1.0, -2.0, 0.0],
                ..Light::default()
            }
        );
        let csv = "east_m,north_m,red_w_sr,green_w_sr\n1,2,3,4\n";
        let lamps = read(Form::Csv, csv.as_bytes()).unwrap();
        assert_eq!(lamps[0].radiant_intensity_w_sr, Some(Bands::Rgb([3.0, 4.0, 0.0])));
        let point = |longitude: f64, latitude: f64| {
            json!({"type": "Feature", "geometry": {"type": "Point", "coordinates": [longitude, latitude]},
                   "properties": {"highway": "street_lamp", "lamp": "white-led"}})
        };
        let json = json!({"type": "FeatureCollection", "features": [point(18.99, 60.0), point(19.01, 60.0)]});
        let lamps = read(Form::GeoJson, json.to_string().as_bytes()).unwrap();
        // 0.01° of a circle of latitude at 60°, half as long as the equator.
        assert!((lamps[1].position_m[0] - 0.01_f64.to_radians() * EARTH_M / 2.0).abs() < 1e-6);
        assert_eq!(lamps[1].position_m[0], -lamps[0].position_m[0]);
        assert_eq!(lamps[0].lamp, Some(Lamp::WhiteLed));
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (text, said) in [
            ("", "names the columns"),
            ("east_m,north_m,watts\n", "\"watts\""),
            ("east_m\n1\n", "north_m"),
            ("east_m,north_m\n1,2,3\n", "line 2"),
            ("east_m,north_m\n1,x\n", "\"x\""),
            ("east_m,north_m,lamp\n1,2,torch\n", "/lights/0/lamp"),
            ("east_m,north_m,radius_m\n1,2,-1\n", "/lights/0/radius_m"),
        ] {
            let error = read(Form::Csv, text.as_bytes()).unwrap_err().to_string();
            assert!(error.contains(said), "{text:?}: {error}");
        }
        for text in [
            "{",
            "{}",
            r#"{"features": [{"geometry": {"type": "LineString"}}]}"#,
        ] {
            assert!(read(Form::GeoJson, text.as_bytes()).is_err(), "{text}");
        }
    }

    proptest! {
        #[test]
        fn no_text_is_too_much(text in "[-a-z_0-9,.\n{}\"]{0,200}") {
            drop(read(Form::Csv, text.as_bytes()));
            drop(read(Form::GeoJson, text.as_bytes()));
        }
    }
}
