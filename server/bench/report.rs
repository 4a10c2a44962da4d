//! What was measured, as rows of medians.

use super::{
    Device, Pass, Setup,
    baseline::{Baseline, Off},
    rounds::Measurements,
    stopwatch::Spent,
};
use crate::commands::{Failure, build};
use serde::Serialize;
use serde_json::{Map, Value};

/// The answer of `welkin bench`.
#[derive(Debug, Serialize)]
pub(crate) struct Report {
    /// Version and fingerprint of the program.
    pub(crate) build: String,
    /// The device that rendered.
    #[serde(flatten)]
    pub(crate) device: Device,
    /// Processor cores that the program may use.
    pub(crate) cores: usize,
    /// What the baseline rendered with; null where it was not there.
    pub(crate) baseline: Option<BaselineDevice>,
    /// How far its frame is from what it approximates; null where it is not there or `truth` was not measured.
    pub(crate) baseline_off: Option<Off>,
    /// Why there is no baseline.
    pub(crate) baseline_absent: Option<String>,
    /// Promises broken: passes that ran and should not have.
    pub(crate) faults: Vec<String>,
    /// One row for each work under each setup.
    pub(crate) rows: Vec<Row>,
}

/// What the baseline rendered with.
#[derive(Debug, Serialize)]
pub(crate) struct BaselineDevice {
    /// The driver's name for it.
    pub(crate) renderer: String,
}

/// One piece of work under one setup.
#[derive(Debug, Serialize)]
pub(crate) struct Row {
    /// The case.
    pub(crate) case: &'static str,
    /// Its conditions.
    #[serde(flatten)]
    pub(crate) setup: Setup,
    /// What was done.
    pub(crate) work: String,
    /// What was varied from one piece of work to the next.
    #[serde(skip_serializing_if = "Map::is_empty")]
    pub(crate) varied: Map<String, Value>,
    /// Of how many runs the figures are medians.
    pub(crate) rounds: usize,
    /// Medians.
    #[serde(flatten)]
    pub(crate) spent: Spent,
    /// The setup that the case compares this one with.
    #[serde(skip)]
    pub(crate) slower: Option<Setup>,
    /// Over the same work there.
    pub(crate) speedup: Option<Speedup>,
    /// The setup that lacks what this one has.
    #[serde(skip)]
    pub(crate) plainer: Option<Setup>,
    /// What that which it has besides costs.
    pub(crate) cost: Option<Cost>,
    /// What `cost.ratio` should be at most.
    pub(crate) target_cost_ratio: Option<f64>,
    /// As the case defines it.
    pub(crate) error: Option<f64>,
    /// What `error` should be at most.
    pub(crate) target_error: Option<f64>,
    /// Mean FLIP error of the picture, where the case takes it.
    pub(crate) flip: Option<f64>,
    /// What `flip` should be at most.
    pub(crate) target_flip: Option<f64>,
    /// The passes that ran, each with its median.
    pub(crate) passes: Vec<Pass>,
    /// The most that a process of this setup held at once; the largest of the rounds.
    pub(crate) peak_memory_bytes: Option<u64>,
    /// Frames of the baselines, for work that rendered.
    pub(crate) baselines: Vec<BaselineRow>,
}

/// How many times faster than another setup of the same case.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Speedup {
    /// Its median over ours, time on the clock.
    pub(crate) wall_ratio: f64,
    /// Its median over ours, time of all threads.
    pub(crate) cpu_ratio: Option<f64>,
}

/// What a piece of work costs over the same under a plainer setup.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Cost {
    /// Of the medians, ours over its: of processor time on a software adapter, else of time on the clock.
    pub(crate) ratio: f64,
}

/// A frame of the baseline at the same size.
#[derive(Debug, Serialize)]
pub(crate) struct BaselineRow {
    /// What the baseline calls it.
    pub(crate) case: &'static str,
    /// Medians.
    #[serde(flatten)]
    pub(crate) spent: Spent,
    /// Its median over ours, time on the clock.
    pub(crate) wall_ratio: f64,
    /// Its median over ours, time of all threads.
    pub(crate) cpu_ratio: Option<f64>,
    /// What `cpu_ratio` should be at least.
    pub(crate) target_cpu_ratio: Option<f64>,
}

impl Row {
    /// Whether it misses one of its targets.
    pub(super) fn misses(&self) -> bool {
        let over =
            |found: Option<f64>, most: Option<f64>| found.zip(most).is_some_and(|(found, most)| found > most);
        over(self.error, self.target_error)
            || over(self.flip, self.target_flip)
            || over(self.cost.map(|cost| cost.ratio), self.target_cost_ratio)
            || self
                .baselines
                .iter()
                .any(|baseline| over(baseline.target_cpu_ratio, baseline.cpu_ratio))
    }
}

impl Report {
    /// What stands above the rows for people.
    pub(super) fn head(&self) -> Vec<String> {
        let device = &self.device;
        let mut lines = vec![
            format!(
                "Welkin {} on {} ({}, {})",
                self.build, device.adapter, device.kind, device.driver
            ),
            format!("cores: {}; figures are medians over the rounds", self.cores),
        ];
        if let Some(baseline) = &self.baseline {
            lines.push(format!(
                "baselines on {}: their CPU time over ours, and in brackets what it should be",
                baseline.renderer
            ));
        }
        lines.extend(self.baseline_off.map(|off| off.to_string()));
        lines
    }

    pub(super) fn new(all: &[Measurements], baseline: &Baseline, off: Option<Off>) -> Result<Self, Failure> {
        let first = all.iter().find_map(|one| one.runs.first());
        let device = first
            .ok_or_else(|| Failure::Bench("nothing was measured".to_owned()))?
            .device
            .clone();
        let baseline_absent = match baseline {
            Baseline::At(_) => None,
            Baseline::Absent(reason) => Some(reason.clone()),
        };
        let measured = all.iter().find_map(|one| one.baselines.values().flatten().next());
        let renderer = measured
            .filter(|_| baseline_absent.is_none())
            .map(|one| one.renderer.clone());
        let mut rows: Vec<Row> = all.iter().flat_map(rows).collect();
        let speedups: Vec<_> = rows.iter().map(|row| speedup(row, &rows)).collect();
        for (row, speedup) in rows.iter_mut().zip(speedups) {
            row.speedup = speedup;
        }
        let costs: Vec<_> = rows.iter().map(|row| cost(row, &rows, &device.kind)).collect();
        for (row, cost) in rows.iter_mut().zip(costs) {
            row.cost = cost;
        }
        if baseline_absent.is_some() {
            rows.iter_mut().for_each(|row| row.baselines.clear());
        }
        Ok(Self {
            build: build(),
            device,
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            baseline: renderer.map(|renderer| BaselineDevice { renderer }),
            baseline_off: off,
            baseline_absent,
            faults: all.iter().flat_map(faults).collect(),
            rows,
        })
    }
}

fn speedup(row: &Row, rows: &[Row]) -> Option<Speedup> {
    let slower = beside(row, row.slower.as_ref()?, rows)?;
    Some(Speedup {
        wall_ratio: slower.spent.wall_ms / row.spent.wall_ms,
        cpu_ratio: slower
            .spent
            .cpu_ms
            .zip(row.spent.cpu_ms)
            .map(|(other, own)| other / own),
    })
}

fn cost(row: &Row, rows: &[Row], kind: &str) -> Option<Cost> {
    let plainer = beside(row, row.plainer.as_ref()?, rows)?;
    let spent = |row: &Row| {
        if kind == "cpu" {
            row.spent.cpu_ms.unwrap_or(row.spent.wall_ms)
        } else {
            row.spent.wall_ms
        }
    };
    Some(Cost {
        ratio: spent(row) / spent(plainer),
    })
}

/// The same work of the same case under another setup.
fn beside<'a>(row: &Row, setup: &Setup, rows: &'a [Row]) -> Option<&'a Row> {
    let same = |other: &&Row| (other.case, &other.setup, &other.work) == (row.case, setup, &row.work);
    rows.iter().find(same)
}

fn rows(one: &Measurements) -> Vec<Row> {
    let count = one.runs.first().map_or(0, |run| run.works.len());
    (0..count).filter_map(|at| row(one, at)).collect()
}

/// The row of the work at one place in the order, over all runs.
fn row(one: &Measurements, at: usize) -> Option<Row> {
    let works: Vec<_> = one.runs.iter().filter_map(|run| run.works.get(at)).collect();
    let over = |value: fn(&Spent) -> Option<f64>| {
        median(works.iter().filter_map(|work| value(&work.spent))).map(whole_us)
    };
    let spent = Spent {
        wall_ms: over(|spent| Some(spent.wall_ms))?,
        cpu_ms: over(|spent| spent.cpu_ms),
    };
    let mut passes: Vec<Pass> = Vec::new();
    for pass in works.iter().flat_map(|work| &work.passes) {
        if !passes.iter().any(|known| known.pass == pass.pass) {
            passes.push(pass.clone());
        }
    }
    for pass in &mut passes {
        let all = works.iter().flat_map(|work| &work.passes);
        let times = all.filter(|other| other.pass == pass.pass).map(|other| other.ms);
        pass.ms = median(times).map(whole_us)?;
    }
    let baselines = if passes.is_empty() {
        Vec::new()
    } else {
        baseline_rows(one, &works.first()?.work, spent)
    };
    let work = &works.first()?.work;
    let limits = one.case.limits(&one.setup, work);
    Some(Row {
        case: one.case.name(),
        setup: one.setup.clone(),
        work: work.clone(),
        varied: works.first()?.varied.clone(),
        rounds: works.len(),
        spent,
        slower: one.case.slower(&one.setup),
        speedup: None,
        plainer: one.case.plainer(&one.setup),
        cost: None,
        target_cost_ratio: limits.cost,
        error: median(works.iter().filter_map(|work| work.error)),
        target_error: limits.error,
        flip: median(works.iter().filter_map(|work| work.flip)),
        target_flip: limits.flip,
        passes,
        peak_memory_bytes: one.runs.iter().filter_map(|run| run.peak_memory_bytes).max(),
        baselines,
    })
}

/// What the baselines cost beside one piece of work.
fn baseline_rows(one: &Measurements, work: &str, own: Spent) -> Vec<BaselineRow> {
    let rows = one.baselines.iter().filter_map(|(case, measured)| {
        let wall_ms = median(measured.iter().map(|measured| measured.wall_ms))?;
        let cpu_ms = median(measured.iter().map(|measured| measured.cpu_ms))?;
        Some(BaselineRow {
            case,
            spent: Spent {
                wall_ms,
                cpu_ms: Some(cpu_ms),
            },
            wall_ratio: wall_ms / own.wall_ms,
            cpu_ratio: own.cpu_ms.map(|own| cpu_ms / own),
            target_cpu_ratio: one.case.target(&one.setup, work, case),
        })
    });
    rows.collect()
}

/// Each broken promise once, however many rounds broke it.
fn faults(one: &Measurements) -> Vec<String> {
    let conditions: Vec<_> = one.setup.parameters.values().map(ToString::to_string).collect();
    let mut faults = Vec::new();
    for work in one.runs.iter().flat_map(|run| &run.works) {
        if let Some(fault) = &work.fault {
            let size = one.setup.size;
            let place = format!(
                "{} {}x{} {}",
                one.case.name(),
                size.width_px,
                size.height_px,
                conditions.join(" ")
            );
            let line = format!("{place}: {} {fault}", work.work);
            if !faults.contains(&line) {
                faults.push(line);
            }
        }
    }
    faults
}

/// The middle value; of an even count, the mean of the middle two.
fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    let upper = *sorted.get(sorted.len() / 2)?;
    let lower = *sorted.get((sorted.len() - 1) / 2)?;
    Some(0.5 * (lower + upper))
}

/// Milliseconds to the microsecond: finer means nothing.
fn whole_us(ms: f64) -> f64 {
    (1e3 * ms).round() * 1e-3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians() {
        let median = |values: &[f64]| median(values.iter().copied());
        assert_eq!(median(&[]), None);
        assert_eq!(median(&[3.0]), Some(3.0));
        assert_eq!(median(&[9.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&[9.0, 1.0, 2.0, 4.0]), Some(3.0));
    }
}
