//! The report for people.

use super::report::{Report, Row};
use serde_json::Value;
use std::fmt;

pub(super) const HEAD: [&str; 13] = [
    "case",
    "size",
    "setup",
    "work",
    "wall ms",
    "CPU ms",
    "faster",
    "cost",
    "baselines",
    "error",
    "FLIP",
    "rounds",
    "passes, ms",
];
/// Columns of figures, which are set to the right.
pub(super) const FIGURES: std::ops::Range<usize> = 4..12;

impl fmt::Display for Report {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        for line in self.head() {
            writeln!(out, "{line}")?;
        }
        writeln!(out)?;
        let mut lines = vec![HEAD.map(str::to_owned)];
        lines.extend(self.rows.iter().map(cells));
        let width = |column: usize| {
            lines
                .iter()
                .map(|line| line[column].chars().count())
                .max()
                .unwrap_or(0)
        };
        let widths: [usize; HEAD.len()] = std::array::from_fn(width);
        for line in &lines {
            let cells = line
                .iter()
                .zip(widths)
                .enumerate()
                .map(|(column, (cell, width))| {
                    if FIGURES.contains(&column) {
                        format!("{cell:>width$}")
                    } else {
                        format!("{cell:<width$}")
                    }
                });
            writeln!(out, "{}", cells.collect::<Vec<_>>().join("  ").trim_end())?;
        }
        writeln!(out)?;
        for rows in self.rows.chunk_by(|a, b| a.case == b.case && a.setup == b.setup) {
            if let [row, ..] = rows
                && let Some(bytes) = row.peak_memory_bytes
            {
                let [case, size, setup, ..] = cells(row);
                writeln!(out, "{case} {size} {setup}: peak memory {} MB", bytes / 1_000_000)?;
            }
        }
        Ok(())
    }
}

fn limited(figure: Option<String>, target: Option<f64>) -> String {
    let target = target.map_or_else(String::new, |target| format!(" (≤{target})"));
    figure.map_or_else(String::new, |figure| format!("{figure}{target}"))
}

/// What stands in a row, column by column.
pub(super) fn cells(row: &Row) -> [String; HEAD.len()] {
    let size = row.setup.size;
    let parameters = row.setup.parameters.values().map(|value| match value {
        Value::String(text) => text.clone(),
        other => other.to_string(),
    });
    let passes = row
        .passes
        .iter()
        .map(|pass| format!("{} {:.1}", pass.pass, pass.ms));
    let faster = row.speedup.map_or_else(String::new, |speedup| {
        let cpu = speedup
            .cpu_ratio
            .map_or_else(String::new, |ratio| format!(" / {ratio:.1}x"));
        format!("{:.1}x{cpu}", speedup.wall_ratio)
    });
    let baselines = row.baselines.iter().filter_map(|baseline| {
        let target = baseline
            .target_cpu_ratio
            .map_or_else(String::new, |target| format!(" (≥{target}x)"));
        Some(format!("{} {:.1}x{target}", baseline.case, baseline.cpu_ratio?))
    });
    let varied = row.varied.iter().map(|(name, value)| {
        let value = value.as_f64().unwrap_or(f64::NAN);
        // Three places, without those that say nothing.
        format!(" {name} {}", (1e3 * value).round() / 1e3)
    });
    [
        row.case.to_owned(),
        format!("{}x{}", size.width_px, size.height_px),
        parameters.collect::<Vec<_>>().join(" "),
        format!("{}{}", row.work, varied.collect::<String>()),
        format!("{:.1}", row.spent.wall_ms),
        row.spent.cpu_ms.map_or_else(String::new, |ms| format!("{ms:.1}")),
        faster,
        limited(
            row.cost.map(|cost| format!("{:.2}x", cost.ratio)),
            row.target_cost_ratio,
        ),
        baselines.collect::<Vec<_>>().join(", "),
        limited(row.error.map(|error| format!("{error:.2e}")), row.target_error),
        limited(row.flip.map(|flip| format!("{flip:.3}")), row.target_flip),
        row.rounds.to_string(),
        passes.collect::<Vec<_>>().join(", "),
    ]
}
