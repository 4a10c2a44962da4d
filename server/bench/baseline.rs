//! The programs beside which Welkin is measured, where they are there: a folder with `run.py`, which renders the
//! published shaders that Welkin started from and prints what a frame of them costs.

use super::Size;
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::{
    fmt,
    path::{Path, PathBuf},
    process::{Command, Output},
};

/// Where the baseline is, or why there is none.
#[derive(Clone, Debug)]
pub(super) enum Baseline {
    /// The folder.
    At(PathBuf),
    /// It is not there or does not run.
    Absent(String),
}

/// What `run.py` prints.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub(super) struct Measured {
    /// Milliseconds on the clock, one frame.
    pub(super) wall_ms: f64,
    /// Milliseconds of all threads, one frame.
    pub(super) cpu_ms: f64,
    /// The driver that rendered.
    pub(super) renderer: String,
}

/// How far the frame of `listing` is from what it approximates: relative RMSE of radiance against the same shader with
/// 1024 steps and about 64 light samples.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Off {
    /// Light samples over the same way.
    pub(crate) steps_error: f64,
    /// Light samples all the way out of the clouds.
    pub(crate) light_path_error: f64,
}

impl fmt::Display for Off {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            out,
            "baseline listing: error {:.2e} against its own with finer steps, {:.2e} with light followed out of the clouds",
            self.steps_error, self.light_path_error
        )
    }
}

/// Finds [`Off`].
const OFF: &str = include_str!("baseline_off.py");
/// What each pixel shows depends on its direction alone: as many as need few seconds, over the whole frame.
const OFF_SIZE: Size = Size::new(90, 60);

impl Baseline {
    pub(super) fn in_folder(folder: PathBuf) -> Self {
        if folder.join("run.py").is_file() {
            Self::At(folder)
        } else {
            Self::Absent(format!("there is no {}", folder.join("run.py").display()))
        }
    }

    /// One frame of one case. Where it does not run, the baseline is absent from then on.
    pub(super) fn measure(&mut self, case: &str, size: Size) -> Option<Measured> {
        let Self::At(folder) = self else { return None };
        let mut command = python();
        command
            .arg(folder.join("run.py"))
            .args([case, "--frames", "1"])
            .args(["--width-px", &size.width_px.to_string()])
            .args(["--height-px", &size.height_px.to_string()]);
        run(command).map_err(|reason| *self = Self::Absent(reason)).ok()
    }

    /// How far its frame is off; none where there is no baseline.
    ///
    /// # Errors
    /// The reason why that cannot be found.
    pub(super) fn off(&self) -> Result<Option<Off>, String> {
        let Self::At(folder) = self else { return Ok(None) };
        off(folder, OFF_SIZE).map(Some)
    }
}

fn off(folder: &Path, size: Size) -> Result<Off, String> {
    let mut command = python();
    command
        .args(["-c", OFF])
        .arg(folder)
        .args([size.width_px.to_string(), size.height_px.to_string()]);
    run(command)
}

fn python() -> Command {
    let mut command = Command::new("python3");
    // The folder may be read-only, and is not ours.
    command.arg("-B");
    command
}

/// What it prints.
fn run<T: DeserializeOwned>(mut command: Command) -> Result<T, String> {
    let output = command.output().map_err(|e| format!("python3: {e}"))?;
    read(&output)
}

fn read<T: DeserializeOwned>(output: &Output) -> Result<T, String> {
    if output.status.success() {
        return serde_json::from_slice(&output.stdout).map_err(|e| format!("run.py: {e}"));
    }
    let told = String::from_utf8_lossy(&output.stderr);
    let last = told.lines().last().unwrap_or_default();
    Err(format!("run.py: {}: {last}", output.status))
}

#[cfg(all(test, unix))]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;
    use std::{os::unix::process::ExitStatusExt, process::ExitStatus};

    fn output(status: i32, stdout: &str, stderr: &str) -> Output {
        Output {
            // The exit code stands in the second byte of what `wait` gives.
            status: ExitStatus::from_raw(status << 8),
            stdout: stdout.into(),
            stderr: stderr.into(),
        }
    }

    #[test]
    fn its_line_is_read_and_its_refusal_told() {
        let line = r#"{"case": "horizon-sky", "width_px": 64, "wall_ms": 6.5, "cpu_ms": 7.5, "renderer": "llvmpipe"}"#;
        let measured: Measured = read(&output(0, line, "")).unwrap();
        assert_eq!((measured.wall_ms, measured.cpu_ms), (6.5, 7.5));
        let refused = read::<Measured>(&output(
            1,
            "",
            "Traceback\nModuleNotFoundError: No module named 'numpy'\n",
        ));
        let reason = refused.unwrap_err();
        assert!(reason.ends_with("No module named 'numpy'"), "{reason}");
        assert!(read::<Measured>(&output(0, "nothing of the kind", "")).is_err());
    }
}
