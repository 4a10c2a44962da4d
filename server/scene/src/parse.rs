//! Reading documents: JSON, then the schema, then what no schema can say.

use crate::{
    check::Check,
    document::Scene,
    explain::explain,
    frame::{FrameDocument, FrameRequest, Source},
    job::JobRequest,
    metar::MetarRequest,
    probe::ProbeRequest,
    problem::{Problem, Problems, SceneError, echo, member},
    schema::{
        frame_request_schema, job_request_schema, metar_request_schema, probe_request_schema, scene_schema,
        timeline_schema,
    },
    timeline::Timeline,
};
use jsonschema::Validator;
use serde::de::DeserializeOwned;
use serde_json::Value;
use serde_path_to_error::{Path, Segment};
use std::sync::LazyLock;

/// Longest pointer into a text that is not JSON, bytes.
const MAX_POINTER_BYTES: usize = 256;

struct Rules {
    schema: Value,
    validator: Validator,
}

impl Rules {
    #[allow(
        clippy::expect_used,
        reason = "the schema is derived from our types; the tests compile all of them"
    )]
    fn new(schema: Value) -> Self {
        let validator = jsonschema::draft202012::new(&schema).expect("a derived schema is valid");
        Self { schema, validator }
    }
}

static SCENE: LazyLock<Rules> = LazyLock::new(|| Rules::new(scene_schema()));
static FRAME: LazyLock<Rules> = LazyLock::new(|| Rules::new(frame_request_schema()));
static JOB: LazyLock<Rules> = LazyLock::new(|| Rules::new(job_request_schema()));
static TIMELINE: LazyLock<Rules> = LazyLock::new(|| Rules::new(timeline_schema()));
static METAR: LazyLock<Rules> = LazyLock::new(|| Rules::new(metar_request_schema()));
static PROBE: LazyLock<Rules> = LazyLock::new(|| Rules::new(probe_request_schema()));

macro_rules! readable {
    ($($document:ident by $rules:ident),*) => { $(
        impl $document {
            /// Reads and checks JSON text. Of two members of one name the last counts.
            ///
            /// # Errors
            /// [`SceneError::Malformed`] where the text is not JSON; otherwise as [`Self::from_value`].
            pub fn from_json(text: &str) -> Result<Self, SceneError> {
                Self::from_value(&value(text)?)
            }

            /// Reads and checks a JSON value. Nothing is clamped.
            ///
            /// # Errors
            /// [`SceneError::Invalid`] names every unknown or missing field, wrong type, number out of range and
            /// physical contradiction, [`MAX_PROBLEMS`](crate::problem::MAX_PROBLEMS) at most.
            pub fn from_value(value: &Value) -> Result<Self, SceneError> {
                read(&$rules, value)
            }
        }
    )* };
}

impl FrameRequest {
    /// Reads and checks JSON text, as [`Self::from_value`] does.
    ///
    /// # Errors
    /// [`SceneError::Malformed`] where the text is not JSON; otherwise as [`Self::from_value`].
    pub fn from_json(text: &str) -> Result<Self, SceneError> {
        Self::from_value(&value(text)?)
    }

    /// Reads and checks a JSON value. In place of `scene` it may have a `timeline` and `at_s`; then `scene` is what is
    /// seen at that time.
    ///
    /// # Errors
    /// [`SceneError::Invalid`], as [`Scene::from_value`].
    pub fn from_value(value: &Value) -> Result<Self, SceneError> {
        let document: FrameDocument = read(&FRAME, value)?;
        Ok(Self {
            scene: document.seen()?,
            source: match document.timeline {
                Some(_) => Source::Timeline,
                None => Source::Scene,
            },
            width_px: document.width_px,
            height_px: document.height_px,
            format: document.format,
            quality: document.quality,
        })
    }
}

readable!(Scene by SCENE, JobRequest by JOB, ProbeRequest by PROBE, MetarRequest by METAR, Timeline by TIMELINE);

fn read<T: DeserializeOwned + Check>(rules: &Rules, value: &Value) -> Result<T, SceneError> {
    if !rules.validator.is_valid(value) {
        let mut problems = Problems::default();
        explain(&rules.schema, &rules.schema, "", value, &mut problems);
        // The validator has the last word, should it ever know a keyword that `explain` does not.
        return Err(problems.refuse(|| Problem::new(String::new(), value, "as its schema says".into())));
    }
    let document: T = serde_path_to_error::deserialize(value).map_err(|e| {
        let (pointer, reason) = (pointer(e.path()), e.inner().to_string());
        let held = value.pointer(&pointer).unwrap_or(&Value::Null);
        let mut problem = Problem::new(pointer, held, "as its schema says".into());
        problem.message = reason;
        SceneError::Invalid(vec![problem])
    })?;
    let mut problems = Problems::default();
    document.check("", &mut problems);
    problems.or(document)
}

fn value(text: &str) -> Result<Value, SceneError> {
    let mut reader = serde_json::Deserializer::from_str(text);
    let malformed = |pointer, e: &serde_json::Error| SceneError::Malformed {
        pointer,
        line: e.line(),
        column: e.column(),
        reason: reason(text, e),
    };
    let value =
        serde_path_to_error::deserialize(&mut reader).map_err(|e| malformed(pointer(e.path()), e.inner()))?;
    reader.end().map_err(|e| malformed(String::new(), &e))?;
    Ok(value)
}

/// The parser's reason without its position, in plainer words where a number is the cause.
fn reason(text: &str, error: &serde_json::Error) -> String {
    let line = text
        .split('\n')
        .nth(error.line().saturating_sub(1))
        .unwrap_or_default();
    let at = line.get(error.column().saturating_sub(1)..).unwrap_or_default();
    let word: String = at.chars().take_while(char::is_ascii_alphabetic).take(8).collect();
    let message = error.to_string();
    let message = message.split(" at line ").next().unwrap_or_default();
    if matches!(word.as_str(), "NaN" | "nan" | "Infinity" | "inf") {
        format!("{word} is not a number in JSON; write a finite number")
    } else if message == "number out of range" {
        "the number is too large; write a finite number".into()
    } else {
        message.into()
    }
}

/// The path as a JSON pointer, cut at the last member that keeps it short.
fn pointer(path: &Path) -> String {
    let mut pointer = String::new();
    for segment in path {
        let longer = match segment {
            Segment::Seq { index } => format!("{pointer}/{index}"),
            Segment::Map { key } => match echo(key) {
                Some(key) => member(&pointer, key),
                None => break,
            },
            Segment::Enum { .. } | Segment::Unknown => break,
        };
        if longer.len() > MAX_POINTER_BYTES {
            break;
        }
        pointer = longer;
    }
    pointer
}
