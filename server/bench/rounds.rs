//! Rounds: every setup and the baseline in turn, so that whatever disturbs the machine disturbs all alike.

use super::{
    Case, Report, Setup, Size,
    baseline::{Baseline, Measured},
    process::{self, Run},
};
use crate::{commands::Failure, settings::Settings};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// What to measure.
pub(crate) struct Plan<'a> {
    /// The cases.
    pub(crate) cases: Vec<&'static dyn Case>,
    /// Sizes instead of the cases' own.
    pub(crate) sizes: Option<&'a [Size]>,
    /// How often.
    pub(crate) rounds: u32,
    /// The baseline's folder.
    pub(crate) baseline: PathBuf,
    /// Which device.
    pub(crate) settings: &'a Settings,
    /// The settings file that was named.
    pub(crate) config: Option<&'a Path>,
}

/// All that was measured of a setup.
pub(super) struct Measurements {
    pub(super) case: &'static dyn Case,
    pub(super) setup: Setup,
    pub(super) runs: Vec<Run>,
    pub(super) baseline: Vec<Measured>,
}

/// Measures one setup in this process: what [`run`] starts others for.
///
/// # Errors
/// Where there is no device or it fails.
pub(crate) fn measure(case: &dyn Case, setup: &Setup, settings: &Settings) -> Result<Value, Failure> {
    process::measure(case, setup, settings)
}

/// Measures all, a bar on the terminal meanwhile.
///
/// # Errors
/// Where there is no device or it fails.
pub(crate) fn run(plan: &Plan<'_>) -> Result<Report, Failure> {
    let mut all: Vec<Measurements> = Vec::new();
    for case in &plan.cases {
        all.extend(case.setups(plan.sizes).into_iter().map(|setup| Measurements {
            case: *case,
            setup,
            runs: Vec::new(),
            baseline: Vec::new(),
        }));
    }
    let mut baseline = Baseline::in_folder(plan.baseline.clone());
    let bar = progress(u64::from(plan.rounds) * all.len() as u64);
    for _ in 0..plan.rounds {
        let alike = |a: &Measurements, b: &Measurements| {
            a.case.name() == b.case.name() && a.setup.size == b.setup.size
        };
        for group in all.chunk_by_mut(alike) {
            for one in group.iter_mut() {
                bar.set_message(describe(one));
                let run = process::start(one.case, &one.setup, plan.settings, plan.config)?;
                bar.suspend(|| eprint!("{}", run.warnings));
                one.runs.push(run);
                bar.inc(1);
            }
            // Once for all setups of a size: the baseline knows nothing but sizes.
            let (case, size) = (group[0].case, group[0].setup.size);
            if let Some(measured) = case.baseline().and_then(|name| baseline.measure(name, size)) {
                for one in group {
                    one.baseline.push(measured.clone());
                }
            }
        }
    }
    bar.finish_and_clear();
    Report::new(plan.rounds, &all, &baseline)
}

fn describe(one: &Measurements) -> String {
    let Size { width_px, height_px } = one.setup.size;
    format!("{} {width_px}x{height_px}", one.case.name())
}

fn progress(steps: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg} ({elapsed})");
    let bar = ProgressBar::new(steps);
    bar.enable_steady_tick(std::time::Duration::from_millis(200));
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
