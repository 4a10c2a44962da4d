//! A frame request in a query, for `<img>` and bookmarks.

use crate::error::{Error, Fault};
use serde::Deserialize;
use serde_json::{Map, Value, json};
use utoipa::IntoParams;
use welkin_scene::{Direction, Scene, SunPosition, frame::FrameRequest, preset};

/// The query of `GET /v1/frames`. Everything is text here, so that a bad value is refused by its name.
#[derive(Debug, Default, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct FrameQuery {
    /// Name of a preset; without it the scene is `{}`.
    preset: Option<String>,
    /// Where the sun stands, clockwise from north, degrees. That of the preset where not given.
    #[param(value_type = Option<f64>)]
    sun_azimuth_deg: Option<String>,
    /// Where the sun stands, up from the horizon, degrees. That of the preset where not given.
    #[param(value_type = Option<f64>)]
    sun_elevation_deg: Option<String>,
    /// A moment, RFC 3339, with latitude and longitude instead of the sun's angles.
    time: Option<String>,
    /// North is positive, degrees.
    #[param(value_type = Option<f64>)]
    latitude_deg: Option<String>,
    /// East is positive, degrees.
    #[param(value_type = Option<f64>)]
    longitude_deg: Option<String>,
    /// Width, pixels.
    #[param(value_type = Option<u32>)]
    width_px: Option<String>,
    /// Height, pixels.
    #[param(value_type = Option<u32>)]
    height_px: Option<String>,
    /// Kind of file: png, jpeg, exr, exr-float, hdr, npy, raw. Without it `Accept` decides.
    format: Option<String>,
    /// preview or final.
    quality: Option<String>,
}

/// Names of the parameters, as refusals list them.
const NAMES: [&str; 10] = [
    "preset",
    "sun_azimuth_deg",
    "sun_elevation_deg",
    "time",
    "latitude_deg",
    "longitude_deg",
    "width_px",
    "height_px",
    "format",
    "quality",
];

/// Where a parameter stands in the request, for the way back from a pointer to the parameter.
const PLACES: [(&str, &str); 9] = [
    ("/scene/sun/position/azimuth_deg", "sun_azimuth_deg"),
    ("/scene/sun/position/elevation_deg", "sun_elevation_deg"),
    ("/scene/sun/position/time", "time"),
    ("/scene/sun/position/latitude_deg", "latitude_deg"),
    ("/scene/sun/position/longitude_deg", "longitude_deg"),
    ("/width_px", "width_px"),
    ("/height_px", "height_px"),
    ("/format", "format"),
    ("/quality", "quality"),
];

/// Reads a query such as `preset=twilight&width_px=640`.
pub(crate) fn read(query: &str) -> Result<FrameRequest, Error> {
    FrameQuery::parse(query)?.request()
}

/// Says a fault of the request in the terms of the query it came from.
pub(crate) fn in_query_terms(error: Error) -> Error {
    let by_name = |mut faults: Vec<Fault>| {
        for fault in &mut faults {
            let place = PLACES
                .iter()
                .find(|(pointer, _)| fault.pointer.as_deref() == Some(pointer));
            if let Some((_, name)) = place {
                (fault.pointer, fault.parameter) = (None, Some((*name).to_owned()));
            }
        }
        faults
    };
    match error {
        Error::Invalid(faults) => Error::Invalid(by_name(faults)),
        Error::FrameTooLarge(faults) => Error::FrameTooLarge(by_name(faults)),
        other => other,
    }
}

impl FrameQuery {
    /// Serde's own message for an unknown parameter is kept out of the contract: names are compared here.
    fn parse(query: &str) -> Result<Self, Error> {
        let uri = format!("/?{query}")
            .parse()
            .map_err(|_| Error::Body("the query is not a query".into()))?;
        let pairs = axum::extract::Query::<Vec<(String, String)>>::try_from_uri(&uri);
        let axum::extract::Query(pairs) = pairs.map_err(|e| Error::Body(e.body_text()))?;
        let mut members = Map::new();
        let mut faults = Vec::new();
        for (name, value) in pairs {
            if !NAMES.contains(&name.as_str()) {
                faults.push(unknown(&name, value));
            } else if members
                .insert(name.clone(), Value::String(value.clone()))
                .is_some()
            {
                let message = format!("`{name}` stands twice in the query");
                faults.push(Fault::query(&name, value, "once".into(), message));
            }
        }
        if !faults.is_empty() {
            return Err(Error::Invalid(faults));
        }
        serde_json::from_value(Value::Object(members)).map_err(|e| Error::Internal { cause: e.to_string() })
    }

    fn request(self) -> Result<FrameRequest, Error> {
        let scene = self.scene()?;
        let mut request = Map::from_iter([("scene".to_owned(), scene)]);
        let numbers = [("width_px", &self.width_px), ("height_px", &self.height_px)];
        for (name, text) in numbers {
            if let Some(text) = text {
                request.insert(name.into(), number(text));
            }
        }
        for (name, text) in [("format", self.format), ("quality", self.quality)] {
            if let Some(text) = text {
                request.insert(name.into(), text.into());
            }
        }
        FrameRequest::from_value(&Value::Object(request)).map_err(|e| in_query_terms(e.into()))
    }

    fn scene(&self) -> Result<Value, Error> {
        let base = match &self.preset {
            None => Scene::default(),
            Some(name) => preset::preset(name)
                .map(|preset| preset.scene.clone())
                .ok_or_else(|| no_preset(name))?,
        };
        let position = self.sun_position(&base)?;
        let mut scene = serde_json::to_value(&base).map_err(|e| Error::Internal { cause: e.to_string() })?;
        if let Some(position) = position {
            scene["sun"]["position"] = position;
        }
        Ok(scene)
    }

    fn sun_position(&self, base: &Scene) -> Result<Option<Value>, Error> {
        let angles = [
            ("azimuth_deg", &self.sun_azimuth_deg),
            ("elevation_deg", &self.sun_elevation_deg),
        ];
        let place = [
            ("latitude_deg", &self.latitude_deg),
            ("longitude_deg", &self.longitude_deg),
        ];
        let given = |fields: [(_, &Option<String>); 2]| fields.iter().any(|(_, text)| text.is_some());
        let by_time = self.time.is_some() || given(place);
        let (mut position, texts) = match (given(angles), by_time) {
            (false, false) => return Ok(None),
            (true, true) => {
                let message = "give the sun by its angles or by time and place, not by both".to_owned();
                let name = if self.sun_azimuth_deg.is_some() {
                    "sun_azimuth_deg"
                } else {
                    "sun_elevation_deg"
                };
                let value = self
                    .sun_azimuth_deg
                    .clone()
                    .or_else(|| self.sun_elevation_deg.clone());
                return Err(Error::Invalid(vec![Fault::query(
                    name,
                    value,
                    "absent beside a time or place".into(),
                    message,
                )]));
            }
            (true, false) => {
                let sun = base.sun_place();
                (
                    json!(Direction::angles(sun.azimuth_deg, sun.elevation_deg)),
                    angles,
                )
            }
            (false, true) => (self.time_and_place(base)?, place),
        };
        for (name, text) in texts {
            if let Some(text) = text {
                position[name] = number(text);
            }
        }
        Ok(Some(position))
    }

    /// Time and place of the preset, where it has them, with the time given here.
    fn time_and_place(&self, base: &Scene) -> Result<Value, Error> {
        let mut position = match &base.sun.position {
            SunPosition::TimeAndPlace(position) => json!(position),
            SunPosition::Direction(_) => json!({}),
        };
        if let Some(time) = &self.time {
            position["time"] = time.as_str().into();
        }
        let given = [
            ("time", &self.time),
            ("latitude_deg", &self.latitude_deg),
            ("longitude_deg", &self.longitude_deg),
        ];
        let missing = given
            .iter()
            .filter(|(name, text)| text.is_none() && position.get(name).is_none());
        let faults: Vec<_> = missing
            .map(|(name, _)| {
                let message =
                    format!("`{name}` is missing: time, latitude_deg and longitude_deg go together");
                Fault::query(name, Value::Null, "given with the other two".into(), message)
            })
            .collect();
        if faults.is_empty() {
            Ok(position)
        } else {
            Err(Error::Invalid(faults))
        }
    }
}

/// A number where the text is one, else the text, for the scene's own refusal.
fn number(text: &str) -> Value {
    serde_json::from_str::<serde_json::Number>(text).map_or_else(|_| text.into(), Value::Number)
}

fn unknown(name: &str, value: String) -> Fault {
    let near = NAMES
        .iter()
        .max_by(|a, b| strsim::jaro_winkler(a, name).total_cmp(&strsim::jaro_winkler(b, name)));
    let hint = near.filter(|near| strsim::jaro_winkler(near, name) > 0.8);
    let hint = hint
        .map(|near| format!("; did you mean `{near}`?"))
        .unwrap_or_default();
    let shown: String = name.chars().take(64).collect();
    Fault::query(
        &shown,
        value.chars().take(80).collect::<String>(),
        NAMES.join(", "),
        format!("`{shown}` is not a parameter{hint}"),
    )
}

/// The refusal of a preset's name in a query.
fn no_preset(name: &str) -> Error {
    let names: Vec<_> = preset::presets().iter().map(|preset| preset.name).collect();
    let shown: String = name.chars().take(64).collect();
    let message = format!("there is no preset `{shown}`");
    Error::Invalid(vec![Fault::query("preset", shown, names.join(", "), message)])
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use proptest::prelude::*;

    /// What the OpenAPI document tells is what is read.
    #[test]
    fn the_names_are_those_of_the_description() {
        let described: Vec<_> = FrameQuery::into_params(|| None)
            .into_iter()
            .map(|param| param.name)
            .collect();
        assert_eq!(described, NAMES);
    }

    proptest! {
        #[test]
        fn any_query_is_answered(query in "[!-~]{0,60}") {
            let _ = read(&query);
        }

        #[test]
        fn any_value_is_answered(name in prop::sample::select(&NAMES[..]), value in "[ -~&&[^&#]]{0,20}") {
            let _ = read(&format!("{name}={value}"));
        }

        #[test]
        fn sizes_arrive(width_px in 1..=16_384_u32, height_px in 1..=16_384_u32) {
            let request = read(&format!("height_px={height_px}&width_px={width_px}")).unwrap();
            prop_assert_eq!((request.width_px, request.height_px), (width_px, height_px));
        }
    }
}
