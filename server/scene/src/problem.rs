//! What is wrong with a document, in words for the person who wrote it.

use crate::metar::ReportFault;
use serde::Serialize;
use serde_json::{Serializer, Value, ser::Formatter};
use std::{fmt, io};

/// Most problems that one error reports.
pub const MAX_PROBLEMS: usize = 16;
/// Longest echo of a value, characters.
const MAX_VALUE_CHARS: usize = 80;
/// Longest member name that is echoed, bytes.
const MAX_NAME_BYTES: usize = 64;

/// Why a document was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// The text is not JSON; `NaN`, `Infinity` and numbers beyond the range of 64-bit floats are not.
    #[error("not JSON at line {line}, column {column}{}: {reason}", within(.pointer))]
    Malformed {
        /// The innermost field that was being read, as a JSON pointer (RFC 6901).
        pointer: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1; 0 stands for the end of the line before.
        column: usize,
        /// What was found or expected there.
        reason: String,
    },
    /// JSON, but not what was asked for. Never empty, [`MAX_PROBLEMS`] at most.
    #[error("{}", Listed(.0))]
    Invalid(Vec<Problem>),
    /// A weather report has a group that is not understood.
    #[error("{0}")]
    Report(ReportFault),
}

impl From<ReportFault> for SceneError {
    fn from(fault: ReportFault) -> Self {
        Self::Report(fault)
    }
}

/// One thing that is wrong with a document.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Problem {
    /// The field, as a JSON pointer (RFC 6901). Of a missing field, where it should be.
    pub pointer: String,
    /// What it holds; null where it is missing. A long value is cut to a text.
    pub value: Value,
    /// What it may hold.
    pub allowed: String,
    /// The whole in one sentence.
    pub message: String,
}

impl Problem {
    /// "`roll_deg` must be (allowed), but is (value)".
    pub(crate) fn new(pointer: String, value: &Value, allowed: String) -> Self {
        let message = format!("{} must be {allowed}, but is {}", label(&pointer), words(value));
        Self {
            pointer,
            value: shortened(value),
            allowed,
            message,
        }
    }
}

/// Collects problems up to [`MAX_PROBLEMS`].
#[derive(Default)]
pub(crate) struct Problems(Vec<Problem>);

impl Problems {
    pub(crate) fn push(&mut self, problem: Problem) {
        if self.0.len() < MAX_PROBLEMS {
            self.0.push(problem);
        }
    }

    pub(crate) fn extend(&mut self, problems: Vec<Problem>) {
        problems.into_iter().for_each(|problem| self.push(problem));
    }

    pub(crate) const fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) const fn is_full(&self) -> bool {
        self.0.len() >= MAX_PROBLEMS
    }

    /// Refuses, for `reason` if for nothing else.
    pub(crate) fn refuse(mut self, reason: impl FnOnce() -> Problem) -> SceneError {
        if self.0.is_empty() {
            self.0.push(reason());
        }
        SceneError::Invalid(self.0)
    }

    /// The value, if nothing is wrong with it.
    pub(crate) fn or<T>(self, value: T) -> Result<T, SceneError> {
        if self.0.is_empty() {
            Ok(value)
        } else {
            Err(SceneError::Invalid(self.0))
        }
    }
}

fn within(pointer: &str) -> String {
    if pointer.is_empty() {
        String::new()
    } else {
        format!(", in {pointer}")
    }
}

struct Listed<'a>(&'a [Problem]);

impl fmt::Display for Listed<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.0.iter().enumerate() {
            let end = if i == 0 { "" } else { "\n" };
            let colon = if problem.pointer.is_empty() { "" } else { ": " };
            write!(f, "{end}{}{colon}{}", problem.pointer, problem.message)?;
        }
        Ok(())
    }
}

/// The pointer to a member of the object that `parent` points to.
pub(crate) fn member(parent: &str, name: &str) -> String {
    format!("{parent}/{}", name.replace('~', "~0").replace('/', "~1"))
}

/// The name, unless it is too long to be repeated.
pub(crate) fn echo(name: &str) -> Option<&str> {
    (name.len() <= MAX_NAME_BYTES).then_some(name)
}

/// How a sentence calls the field: its name, with the index of an element.
pub(crate) fn label(pointer: &str) -> String {
    let mut index = String::new();
    for segment in pointer.rsplit('/') {
        if segment.is_empty() {
            break;
        }
        if segment.bytes().all(|b| b.is_ascii_digit()) {
            index.insert_str(0, &format!("[{segment}]"));
        } else {
            return format!("`{}{index}`", segment.replace("~1", "/").replace("~0", "~"));
        }
    }
    format!("the document{index}")
}

/// The field's own name, that of the array for an element.
pub(crate) fn field_name(pointer: &str) -> &str {
    pointer
        .rsplit('/')
        .find(|s| !s.bytes().all(|b| b.is_ascii_digit()))
        .unwrap_or_default()
}

fn words(value: &Value) -> String {
    match value {
        Value::String(_) => format!("the text {}", compact(value)),
        _ => compact(value),
    }
}

fn shortened(value: &Value) -> Value {
    let text = compact(value);
    if text.ends_with('…') {
        Value::String(text)
    } else {
        value.clone()
    }
}

/// JSON, cut to [`MAX_VALUE_CHARS`] with an ellipsis. The work is bounded as well, whatever the value's size.
fn compact(value: &Value) -> String {
    let mut start = Start { bytes: Vec::new() };
    let whole = value
        .serialize(&mut Serializer::with_formatter(&mut start, Plain))
        .is_ok();
    let text = String::from_utf8_lossy(&start.bytes);
    if whole && text.chars().count() <= MAX_VALUE_CHARS {
        return text.into_owned();
    }
    text.chars().take(MAX_VALUE_CHARS - 1).chain(['…']).collect()
}

/// A number as people write it: no `.0` behind whole ones, powers of ten where there would be many zeros.
pub(crate) fn number(n: f64) -> String {
    if n != 0.0 && !(1e-3..1e6).contains(&n.abs()) {
        format!("{n:e}")
    } else {
        n.to_string()
    }
}

/// Compact JSON with [`number`]s.
struct Plain;

impl Formatter for Plain {
    fn write_f64<W: ?Sized + io::Write>(&mut self, writer: &mut W, n: f64) -> io::Result<()> {
        writer.write_all(number(n).as_bytes())
    }
}

/// Keeps the beginning of what is written and refuses the rest.
struct Start {
    bytes: Vec<u8>,
}

impl io::Write for Start {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // Four bytes are the longest character of UTF-8.
        let room = (4 * MAX_VALUE_CHARS).saturating_sub(self.bytes.len());
        self.bytes.extend_from_slice(&bytes[..bytes.len().min(room)]);
        if bytes.len() > room {
            Err(io::ErrorKind::WriteZero.into())
        } else {
            Ok(bytes.len())
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
