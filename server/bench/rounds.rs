//! Rounds: every setup and the baseline in turn, so that whatever disturbs the machine disturbs all alike.

use super::{
    Case, Report, Setup, Size,
    baseline::{Baseline, Measured},
    process::{self, Run},
};
use crate::{commands::Failure, settings::Settings};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::Value;
use std::{
    collections::{BTreeMap, BTreeSet},
    path::{Path, PathBuf},
};

/// What to measure.
pub(crate) struct Plan<'a> {
    /// The cases.
    pub(crate) cases: Vec<&'static dyn Case>,
    /// Sizes instead of the cases' own.
    pub(crate) sizes: Option<&'a [Size]>,
    /// How often, instead of the cases' own.
    pub(crate) rounds: Option<u32>,
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
    /// Frames of the baselines at the same size, by the name of the baseline.
    pub(super) baselines: BTreeMap<&'static str, Vec<Measured>>,
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
            baselines: BTreeMap::new(),
        }));
    }
    let mut baseline = Baseline::in_folder(plan.baseline.clone());
    let rounds = |one: &Measurements| {
        let rounds = plan.rounds.unwrap_or_else(|| one.case.rounds());
        if one.case.repeats(&one.setup) { rounds } else { 1 }
    };
    let bar = progress(all.iter().map(|one| u64::from(rounds(one))).sum());
    for round in 0..all.iter().map(rounds).max().unwrap_or(0) {
        let alike = |a: &Measurements, b: &Measurements| {
            a.case.name() == b.case.name() && a.setup.size == b.setup.size
        };
        for group in all.chunk_by_mut(alike) {
            for one in group.iter_mut().filter(|one| round < rounds(one)) {
                bar.set_message(describe(one));
                let run = process::start(one.case, &one.setup, plan.settings, plan.config)?;
                bar.suspend(|| eprint!("{}", run.warnings));
                one.runs.push(run);
                bar.inc(1);
            }
            if group.iter().any(|one| round < rounds(one)) {
                measure_baselines(&mut baseline, group);
            }
        }
    }
    bar.finish_and_clear();
    Report::new(&all, &baseline)
}

/// Each once for all setups of a size: the baseline knows nothing but sizes.
fn measure_baselines(baseline: &mut Baseline, group: &mut [Measurements]) {
    let wanted: BTreeSet<_> = group
        .iter()
        .flat_map(|one| one.case.baselines(&one.setup))
        .copied()
        .collect();
    for name in wanted {
        if let Some(measured) = baseline.measure(name, group[0].setup.size) {
            for one in group.iter_mut() {
                if one.case.baselines(&one.setup).contains(&name) {
                    one.baselines.entry(name).or_default().push(measured.clone());
                }
            }
        }
    }
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
