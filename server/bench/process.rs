//! The process that measures one setup.

use super::{Case, Setup, Work};
use crate::{commands::Failure, settings::Settings};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::{
    path::Path,
    process::{Command, Output},
};

/// The account of a measuring process, read.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct Run {
    pub(super) device: Device,
    pub(super) works: Vec<Work>,
    pub(super) peak_memory_bytes: Option<u64>,
    /// Warnings of drivers and of the renderer.
    #[serde(skip)]
    pub(super) warnings: String,
}

/// The device that rendered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Device {
    /// The adapter's name.
    pub(crate) adapter: String,
    /// `cpu`, `discrete-gpu` and so on.
    pub(crate) kind: String,
    /// The graphics interface.
    pub(crate) backend: String,
    /// Driver and its version.
    pub(crate) driver: String,
}

/// Measures here, and gives what [`start`] reads.
///
/// # Errors
/// Those of the case.
pub(super) fn measure(case: &dyn Case, setup: &Setup, settings: &Settings) -> Result<Value, Failure> {
    let account = case.measure(setup, settings)?;
    serde_json::to_value(account).map_err(|e| Failure::Bench(format!("the account of {}: {e}", case.name())))
}

/// Measures in a process of its own, with these variables of the environment besides.
///
/// # Errors
/// Where it cannot be started or fails.
pub(super) fn start(
    case: &dyn Case,
    setup: &Setup,
    settings: &Settings,
    config: Option<&Path>,
    variables: &[(&str, &str)],
) -> Result<Run, Failure> {
    let program = std::env::current_exe().map_err(Failure::file("finding this program"))?;
    let mut command = Command::new(program);
    command.args(["bench", case.name(), "--json"]);
    let setup = serde_json::to_string(setup).map_err(|e| Failure::Bench(e.to_string()))?;
    command.args(["--setup", &setup]);
    if let Some(config) = config {
        command.arg("--config").arg(config);
    }
    if let Some(adapter) = &settings.adapter {
        command.args(["--adapter", adapter]);
    }
    command.args(["--require-gpu", &settings.require_gpu.to_string()]);
    let output = command
        .envs(variables.iter().copied())
        .output()
        .map_err(Failure::file("starting a measuring process"))?;
    read(&output, &setup)
}

fn read(output: &Output, setup: &str) -> Result<Run, Failure> {
    let told = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        // Its last word is a problem document, unless something ended it from outside.
        let problem: Value = told
            .lines()
            .last()
            .and_then(|line| serde_json::from_str(line).ok())
            .unwrap_or_default();
        let detail = problem["detail"].as_str().unwrap_or(told.trim());
        return Err(match output.status.code() {
            Some(code) if code == i32::from(Failure::NO_DEVICE) => Failure::Device(detail.to_owned()),
            _ => Failure::Bench(format!("measuring {setup}: {}: {detail}", output.status)),
        });
    }
    let run: Run = serde_json::from_slice(&output.stdout)
        .map_err(|e| Failure::Bench(format!("measuring {setup}: {e}")))?;
    Ok(Run {
        warnings: told.into_owned(),
        ..run
    })
}
