//! The report for people.

use super::report::{Report, Row};
use serde_json::Value;
use std::fmt;

const HEAD: [&str; 10] = [
    "case",
    "size",
    "setup",
    "work",
    "wall ms",
    "CPU ms",
    "faster",
    "baseline",
    "error",
    "passes, ms",
];
/// Columns of figures, which are set to the right.
const FIGURES: std::ops::Range<usize> = 4..9;

impl fmt::Display for Report {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let device = &self.device;
        writeln!(
            out,
            "Welkin {} on {} ({}, {})",
            self.build, device.adapter, device.kind, device.driver
        )?;
        writeln!(
            out,
            "cores: {}; rounds: {}, of which the figures are medians",
            self.cores, self.rounds
        )?;
        if let Some(baseline) = &self.baseline {
            writeln!(out, "baseline on {}: its CPU time over ours", baseline.renderer)?;
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

fn cells(row: &Row) -> [String; HEAD.len()] {
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
    let ratio = row.baseline.as_ref().and_then(|baseline| baseline.cpu_ratio);
    [
        row.case.to_owned(),
        format!("{}x{}", size.width_px, size.height_px),
        parameters.collect::<Vec<_>>().join(" "),
        row.work.clone(),
        format!("{:.1}", row.spent.wall_ms),
        row.spent.cpu_ms.map_or_else(String::new, |ms| format!("{ms:.1}")),
        faster,
        ratio.map_or_else(String::new, |ratio| format!("{ratio:.1}x")),
        row.error.map_or_else(String::new, |error| format!("{error:.2e}")),
        passes.collect::<Vec<_>>().join(", "),
    ]
}
