//! What a viewer says.

use super::view::LiveFormat;
use crate::{
    body::MAX_BODY_BYTES,
    error::{Error, Fault},
};
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use welkin_scene::frame::Quality;

/// Shortest side of a live picture, pixels.
pub(crate) const MIN_SIDE_PX: u16 = 16;
/// Longest side of a live picture, pixels.
pub(crate) const MAX_SIDE_PX: u16 = 4096;

/// Latest and earliest moment of a timeline, as its keyframes have them, seconds.
pub(crate) const MOST_S: f64 = 1e9;

const MEMBERS: &str = "seq, scene, patch, timeline, at_s, output";
const OUTPUT_MEMBERS: &str = "width_px, height_px, format, quality";

/// A message that is well formed; its scene has not been looked at.
#[derive(Debug, PartialEq)]
pub(crate) struct Message {
    pub(crate) seq: u32,
    pub(crate) scene: Option<Value>,
    pub(crate) patch: Option<Value>,
    pub(crate) timeline: Option<Value>,
    pub(crate) at_s: Option<f64>,
    pub(crate) output: Option<OutputChange>,
}

/// The members of `output` that were given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct OutputChange {
    pub(crate) width_px: Option<u16>,
    pub(crate) height_px: Option<u16>,
    pub(crate) format: Option<LiveFormat>,
    pub(crate) quality: Option<Quality>,
}

/// Reads a message. With a refusal comes the message's `seq`, where it could be read.
pub(crate) fn read(text: &str) -> Result<Message, (Option<u32>, Error)> {
    if text.len() > MAX_BODY_BYTES {
        return Err((
            None,
            Error::BodyTooLarge {
                limit_bytes: MAX_BODY_BYTES as u64,
            },
        ));
    }
    let value = serde_json::from_str::<Value>(text).map_err(|e| (None, malformed(&e)))?;
    let Value::Object(mut members) = value else {
        let message = "a message must be an object".to_owned();
        return Err((
            None,
            Error::Invalid(vec![Fault::field(
                "",
                value,
                format!("an object with {MEMBERS}"),
                message,
            )]),
        ));
    };
    let seq = members.remove("seq");
    let number = seq
        .as_ref()
        .and_then(Value::as_u64)
        .and_then(|seq| u32::try_from(seq).ok());
    let Some(number) = number else {
        let message = "`seq` must be an integer from 0 to 4294967295".to_owned();
        let fault = Fault::field(
            "/seq",
            seq.unwrap_or_default(),
            "an integer from 0 to 4294967295".into(),
            message,
        );
        return Err((None, Error::Invalid(vec![fault])));
    };
    rest(number, members).map_err(|error| (Some(number), error))
}

fn rest(seq: u32, mut members: Map<String, Value>) -> Result<Message, Error> {
    let [scene, patch, timeline, at_s, output] =
        ["scene", "patch", "timeline", "at_s", "output"].map(|name| members.remove(name));
    refuse_others("", &members, MEMBERS)?;
    let (is_scene, is_moment) = (
        scene.is_some() || patch.is_some(),
        timeline.is_some() || at_s.is_some(),
    );
    if !is_scene && !is_moment && output.is_none() {
        let message = "a message needs `scene`, `patch`, `timeline`, `at_s` or `output`".to_owned();
        return Err(Error::Invalid(vec![Fault::field(
            "",
            Value::Null,
            "scene, patch, timeline, at_s or output".into(),
            message,
        )]));
    }
    if is_scene && is_moment {
        let (pointer, value) = match (&timeline, &at_s) {
            (Some(timeline), _) => ("/timeline", timeline),
            (None, at_s) => ("/at_s", at_s.as_ref().unwrap_or(&Value::Null)),
        };
        return Err(wrong(
            pointer,
            value,
            "left out where `scene` or `patch` is given",
        ));
    }
    if let Some(patch) = patch.as_ref().filter(|patch| !patch.is_object()) {
        return Err(wrong("/patch", patch, "an object (RFC 7396)"));
    }
    Ok(Message {
        seq,
        scene,
        patch,
        timeline,
        at_s: at_s.as_ref().map(moment).transpose()?,
        output: output.map(read_output).transpose()?,
    })
}

fn moment(value: &Value) -> Result<f64, Error> {
    let at_s = value.as_f64().filter(|at_s| at_s.abs() <= MOST_S);
    at_s.ok_or_else(|| wrong("/at_s", value, "a number from -1e9 to 1e9 seconds"))
}

fn read_output(output: Value) -> Result<OutputChange, Error> {
    let Value::Object(mut members) = output else {
        return Err(wrong("/output", &output, "an object"));
    };
    let change = OutputChange {
        width_px: members
            .remove("width_px")
            .map(|value| side("/output/width_px", &value))
            .transpose()?,
        height_px: members
            .remove("height_px")
            .map(|value| side("/output/height_px", &value))
            .transpose()?,
        format: members
            .remove("format")
            .map(|v| word("/output/format", &v, "jpeg, png or raw"))
            .transpose()?,
        quality: members
            .remove("quality")
            .map(|v| word("/output/quality", &v, "preview or final"))
            .transpose()?,
    };
    refuse_others("/output", &members, OUTPUT_MEMBERS)?;
    Ok(change)
}

fn side(pointer: &str, value: &Value) -> Result<u16, Error> {
    let side = value.as_u64().and_then(|side| u16::try_from(side).ok());
    let side = side.filter(|side| (MIN_SIDE_PX..=MAX_SIDE_PX).contains(side));
    side.ok_or_else(|| {
        wrong(
            pointer,
            value,
            &format!("an integer from {MIN_SIDE_PX} to {MAX_SIDE_PX} pixels"),
        )
    })
}

fn word<T: DeserializeOwned>(pointer: &str, value: &Value, allowed: &str) -> Result<T, Error> {
    T::deserialize(value).map_err(|_| wrong(pointer, value, allowed))
}

fn refuse_others(parent: &str, members: &Map<String, Value>, known: &str) -> Result<(), Error> {
    let Some((name, value)) = members.iter().next() else {
        return Ok(());
    };
    let name = short(name);
    let near = known
        .split(", ")
        .find(|near| strsim::jaro_winkler(near, &name) > 0.8);
    let hint = near
        .map(|near| format!("; did you mean `{near}`?"))
        .unwrap_or_default();
    let pointer = format!("{parent}/{}", name.replace('~', "~0").replace('/', "~1"));
    let fault = Fault::field(
        pointer,
        echo(value),
        known.to_owned(),
        format!("`{name}` is not a member{hint}"),
    );
    Err(Error::Invalid(vec![fault]))
}

fn wrong(pointer: &str, value: &Value, allowed: &str) -> Error {
    let name = pointer.rsplit('/').next().unwrap_or_default();
    let message = format!("`{name}` must be {allowed}");
    Error::Invalid(vec![Fault::field(
        pointer,
        echo(value),
        allowed.to_owned(),
        message,
    )])
}

fn malformed(error: &serde_json::Error) -> Error {
    let text = error.to_string();
    let reason = text.split(" at line ").next().unwrap_or_default().to_owned();
    Error::Malformed {
        pointer: String::new(),
        line: error.line(),
        column: error.column(),
        reason,
    }
}

/// What is sent back of a value: short ones whole.
fn echo(value: &Value) -> Value {
    match value {
        Value::String(text) => short(text).into(),
        Value::Array(_) => "an array".into(),
        Value::Object(_) => "an object".into(),
        other => other.clone(),
    }
}

fn short(text: &str) -> String {
    text.chars().take(64).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use proptest::prelude::*;
    use serde_json::json;

    proptest! {
        #[test]
        fn any_text_is_answered(text in ".{0,200}") {
            let _ = read(&text);
        }

        /// Near misses: the right members with any value.
        #[test]
        fn any_member_is_answered(member in "seq|scene|patch|timeline|at_s|output|[a-z/~]{0,9}", value in "null|-?[0-9]{1,12}|\\{\\}|\"\"") {
            let _ = read(&format!("{{\"seq\": 1, {}: {value}}}", json!(member)));
        }

        #[test]
        fn what_is_said_is_heard(seq: u32, width_px in MIN_SIDE_PX..=MAX_SIDE_PX, time_s: i32) {
            let text = json!({"seq": seq, "patch": {"time_s": time_s}, "output": {"width_px": width_px}}).to_string();
            let output = OutputChange { width_px: Some(width_px), ..OutputChange::default() };
            let heard = Message { seq, scene: None, patch: Some(json!({"time_s": time_s})), timeline: None, at_s: None, output: Some(output) };
            prop_assert_eq!(read(&text).unwrap(), heard);
        }
    }
}
