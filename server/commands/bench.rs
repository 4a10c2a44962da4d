//! `welkin bench`

use super::{Failure, document, logging};
use crate::{
    bench::{self, CASES, Case, Plan, Setup, Size},
    settings::{DeviceFlags, Settings},
};
use serde_json::json;
use std::{
    fs::File,
    io::Write as _,
    path::{Path, PathBuf},
};

/// Arguments of `welkin bench`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// What to measure: sky, air, clouds, ground, pillars, jobs [default: all]
    name: Option<String>,
    /// Of how many runs each figure is the median [default: 7; clouds, ground, pillars: 3; jobs: 1]
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..))]
    rounds: Option<u32>,
    /// Sizes of frames instead of the case's own, for example 640x360,1920x1080
    #[arg(long, value_name = "SIZES", value_delimiter = ',')]
    sizes: Option<Vec<Size>>,
    /// Only these tables, for example changes,truth; of the cases only clouds and ground have some
    #[arg(long, value_name = "TABLES", value_delimiter = ',')]
    tables: Option<Vec<String>>,
    /// Folder whose run.py measures the baseline beside it
    #[arg(long, value_name = "FOLDER", default_value = "../shared/baseline")]
    baseline: PathBuf,
    /// Write the rows and plots of them to this file as a page
    #[arg(long, value_name = "FILE.html")]
    report: Option<PathBuf>,
    /// Measure this setup in this process, for the process that asks
    #[arg(long, hide = true, requires = "name")]
    setup: Option<Setup>,
    #[command(flatten)]
    device: DeviceFlags,
}

/// Measures, and prints what it found.
///
/// # Errors
/// Where there is no device, it fails, or a pass ran that should not have.
pub(crate) fn run(args: &Args, config: Option<&Path>, json: bool) -> Result<(), Failure> {
    let settings = Settings::load(config, &args.device)?;
    logging::quiet();
    let cases = match &args.name {
        Some(name) => vec![named(name)?],
        None => CASES.to_vec(),
    };
    if let (Some(setup), [case]) = (&args.setup, cases.as_slice()) {
        return document::print(&bench::measure(*case, setup, &settings)?, false);
    }
    // Before minutes are spent on what then could not be written.
    let page = args
        .report
        .as_ref()
        .map(|path| File::create(path).map_err(Failure::file(path.display().to_string())));
    let page = page.transpose()?;
    let report = bench::run(&Plan {
        cases,
        sizes: args.sizes.as_deref(),
        tables: args.tables.as_deref(),
        rounds: args.rounds,
        baseline: args.baseline.clone(),
        settings: &settings,
        config,
    })?;
    if let Some(reason) = &report.baseline_absent {
        eprintln!("no baseline: {reason}");
    }
    if let (Some(path), Some(mut file)) = (&args.report, page) {
        let page = bench::page(&report)?;
        file.write_all(page.as_bytes())
            .map_err(Failure::file(path.display().to_string()))?;
    }
    if json {
        document::print(&json!(report), true)?;
    } else {
        document::print_text(&report.to_string())?;
    }
    if report.faults.is_empty() {
        Ok(())
    } else {
        Err(Failure::Bench(report.faults.join("\n")))
    }
}

fn named(name: &str) -> Result<&'static dyn Case, Failure> {
    CASES.into_iter().find(|case| case.name() == name).ok_or_else(|| {
        let names = CASES.map(Case::name).join(", ");
        Failure::Usage(format!("there is no benchmark {name:?}; there are {names}"))
    })
}
