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
    time::{Duration, Instant},
};

/// A setup, or a baseline's frame, that takes longer is measured once: over so long a time the machine's unrest
/// evens out by itself.
const LONGEST_REPEATED: Duration = Duration::from_secs(5);

/// What to measure.
pub(crate) struct Plan<'a> {
    /// The cases.
    pub(crate) cases: Vec<&'static dyn Case>,
    /// Sizes instead of the cases' own.
    pub(crate) sizes: Option<&'a [Size]>,
    /// These of the cases' tables instead of all that is measured.
    pub(crate) tables: Option<&'a [String]>,
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
    /// In how many it takes part.
    rounds: u32,
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
    let mut all = planned(plan)?;
    let mut baseline = Baseline::in_folder(plan.baseline.clone());
    let bar = progress(all.iter().map(|one| u64::from(one.rounds)).sum());
    for round in 0..all.iter().map(|one| one.rounds).max().unwrap_or(0) {
        let alike = |a: &Measurements, b: &Measurements| {
            a.case.name() == b.case.name() && a.setup.size == b.setup.size
        };
        for group in all.chunk_by_mut(alike) {
            let mut measured = false;
            for one in group.iter_mut().filter(|one| round < one.rounds) {
                bar.set_message(describe(one));
                let start = Instant::now();
                let run = process::start(one.case, &one.setup, plan.settings, plan.config, &[])?;
                bar.suspend(|| eprint!("{}", run.warnings));
                one.runs.push(run);
                measured = true;
                bar.inc(1);
                if start.elapsed() > LONGEST_REPEATED {
                    bar.inc(u64::from(one.rounds - round - 1));
                    one.rounds = round + 1;
                }
            }
            if measured {
                measure_baselines(&mut baseline, group);
            }
        }
    }
    let judged = all.iter().any(|one| one.case.judges_baseline(&one.setup));
    let off = if judged { baseline.off() } else { Ok(None) };
    bar.finish_and_clear();
    let off = off.unwrap_or_else(|reason| {
        eprintln!("how far the baseline is off is not known: {reason}");
        None
    });
    Report::new(&all, &baseline, off)
}

/// All that is asked for, nothing of it measured yet.
fn planned(plan: &Plan<'_>) -> Result<Vec<Measurements>, Failure> {
    let known: Vec<_> = plan.cases.iter().flat_map(|case| case.tables()).collect();
    for name in plan.tables.unwrap_or_default() {
        if !known.contains(name) {
            let there = if known.is_empty() {
                "none"
            } else {
                &known.join(", ")
            };
            return Err(Failure::Usage(format!(
                "there is no table {name:?}; there are {there}"
            )));
        }
    }
    let wanted = |setup: &Setup| match (plan.tables, setup.parameters.get("table")) {
        (None, _) => true,
        (Some(tables), Some(Value::String(own))) => tables.contains(own),
        (Some(_), _) => false,
    };
    let mut all = Vec::new();
    for case in &plan.cases {
        for setup in case.setups(plan.sizes).into_iter().filter(wanted) {
            let rounds = plan.rounds.unwrap_or_else(|| case.rounds());
            all.push(Measurements {
                case: *case,
                rounds: if case.repeats(&setup) { rounds } else { 1 },
                setup,
                runs: Vec::new(),
                baselines: BTreeMap::new(),
            });
        }
    }
    Ok(all)
}

/// Each once for all setups of a size: the baseline knows nothing but sizes.
fn measure_baselines(baseline: &mut Baseline, group: &mut [Measurements]) {
    let wanted: BTreeSet<_> = group
        .iter()
        .flat_map(|one| one.case.baselines(&one.setup))
        .copied()
        .collect();
    for name in wanted {
        let mut known = group.iter().filter_map(|one| one.baselines.get(name)).flatten();
        if known.any(|frame| frame.wall_ms > 1e3 * LONGEST_REPEATED.as_secs_f64()) {
            continue;
        }
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
