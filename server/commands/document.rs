//! Documents named on the command line.

use super::Failure;
use serde_json::Value;
use std::{
    fs,
    io::{self, Read, Write},
};
use welkin_scene::{Scene, Timeline, preset};

/// Stands for standard input or output.
pub(crate) const STANDARD: &str = "-";

/// A scene from a file, from standard input (`-`) or from the presets (`preset:NAME`).
///
/// # Errors
/// Where it cannot be read or is not a scene.
pub(crate) fn scene(name: &str) -> Result<Scene, Failure> {
    match name.strip_prefix("preset:") {
        Some(name) => Ok(named_preset(name)?.scene.clone()),
        None => Ok(Scene::from_json(&text(name)?)?),
    }
}

/// A timeline from a file or from standard input (`-`).
///
/// # Errors
/// Where it cannot be read or is not a timeline.
pub(crate) fn timeline(name: &str) -> Result<Timeline, Failure> {
    Ok(Timeline::from_json(&text(name)?)?)
}

/// A time in a timeline.
///
/// # Errors
/// Where it is no number that JSON has.
pub(crate) fn seconds(text: &str) -> Result<f64, String> {
    let seconds = text.parse().ok().filter(|seconds: &f64| seconds.is_finite());
    seconds.ok_or_else(|| "not a finite number of seconds".into())
}

/// A preset by its name.
///
/// # Errors
/// Names those that there are.
pub(crate) fn named_preset(name: &str) -> Result<&'static preset::Preset, Failure> {
    preset::preset(name).ok_or_else(|| {
        let names: Vec<_> = preset::presets().iter().map(|preset| preset.name).collect();
        Failure::Usage(format!(
            "there is no preset {name:?}; there are {}",
            names.join(", ")
        ))
    })
}

/// The text of a file, or of standard input.
///
/// # Errors
/// Where it cannot be read.
pub(crate) fn text(name: &str) -> Result<String, Failure> {
    if name != STANDARD {
        return fs::read_to_string(name).map_err(Failure::file(format!("reading {name}")));
    }
    let mut text = String::new();
    io::stdin()
        .read_to_string(&mut text)
        .map_err(Failure::file("reading standard input"))?;
    Ok(text)
}

/// Prints JSON on standard output, indented where a person reads it.
///
/// # Errors
/// Where standard output is closed.
pub(crate) fn print(value: &Value, indented: bool) -> Result<(), Failure> {
    let text = if indented {
        format!("{value:#}\n")
    } else {
        format!("{value}\n")
    };
    print_text(&text)
}

/// Prints text on standard output.
///
/// # Errors
/// Where standard output is closed.
pub(crate) fn print_text(text: &str) -> Result<(), Failure> {
    io::stdout()
        .write_all(text.as_bytes())
        .map_err(Failure::file("writing standard output"))
}
