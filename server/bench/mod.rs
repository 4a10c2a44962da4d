//! `welkin bench`: what frames cost. One file a case; the rest is common to all.
//!
//! Every measurement is made in a process of its own, so that peaks of memory do not mix and each begins with a fresh
//! device. Processes of all setups, and the baseline, take turns; figures are medians over the rounds. Facts are
//! checked (which passes ran), times never.

mod air;
mod baseline;
mod clouds;
mod ground;
mod jobs;
mod page;
mod pillars;
mod plots;
mod process;
mod report;
mod rounds;
mod setup;
mod sky;
mod stopwatch;
mod table;
mod viewer;

pub(crate) use page::page;
pub(crate) use process::Device;
pub(crate) use report::Report;
pub(crate) use rounds::{Plan, measure, run};
pub(crate) use setup::{Setup, Size};

use crate::{commands::Failure, settings::Settings};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use stopwatch::Spent;
use welkin_scene::renderer::{DeviceInfo, PassTime};

/// All cases.
pub(crate) static CASES: [&dyn Case; 6] = [
    &sky::Sky,
    &air::Air,
    &clouds::CloudCase,
    &ground::Ground,
    &pillars::Pillars,
    &jobs::JobCase,
];

/// Something to measure.
pub(crate) trait Case: Sync {
    /// As the command line and the rows name it.
    fn name(&self) -> &'static str;

    /// How often its setups are measured where nobody says.
    fn rounds(&self) -> u32 {
        7
    }

    /// Whether another round can tell more of a setup.
    fn repeats(&self, _setup: &Setup) -> bool {
        true
    }

    /// What `run.py` of the baseline calls the like of a setup.
    fn baselines(&self, _setup: &Setup) -> &'static [&'static str] {
        &[]
    }

    /// How many times less processor time than a frame of a baseline a piece of work should take.
    fn target(&self, _setup: &Setup, _work: &str, _baseline: &str) -> Option<f64> {
        None
    }

    /// The setup that lacks what this one has and otherwise is the same; none where the case knows none.
    fn plainer(&self, _setup: &Setup) -> Option<Setup> {
        None
    }

    /// How near to the reference a piece of work should come, and what it may cost over the plainer setup.
    fn limits(&self, _setup: &Setup, _work: &str) -> Limits {
        Limits::default()
    }

    /// Whether beside a setup it counts how far the baseline's own frame is from what it approximates.
    fn judges_baseline(&self, _setup: &Setup) -> bool {
        false
    }

    /// The tables of which one or the other can be measured alone; the parameter `table` of a setup names its own.
    fn tables(&self) -> Vec<String> {
        Vec::new()
    }

    /// What is measured, setups of one size side by side. `sizes` are those asked for; without them, the case's own.
    fn setups(&self, sizes: Option<&[Size]>) -> Vec<Setup>;

    /// The setup over which the speed-up of this one is told; none where the case knows none.
    fn slower(&self, _setup: &Setup) -> Option<Setup> {
        None
    }

    /// Measures one setup, in its own process. Every run gives the same works in the same order.
    ///
    /// # Errors
    /// Where there is no device or it fails.
    fn measure(&self, setup: &Setup, settings: &Settings) -> Result<Account, Failure>;
}

/// How far a frame may be from the reference and what it may cost; none where nobody says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Limits {
    /// Relative RMSE of radiance.
    pub(crate) error: Option<f64>,
    /// Mean FLIP error.
    pub(crate) flip: Option<f64>,
    /// How many times what the plainer setup costs.
    pub(crate) cost: Option<f64>,
}

/// What one process measured.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Account {
    /// The device that rendered.
    pub(crate) device: DeviceInfo,
    /// What was done, in order.
    pub(crate) works: Vec<Work>,
    /// The most memory that the process held at once, bytes, while it did what a user asks for; none where the
    /// system does not tell it.
    pub(crate) peak_memory_bytes: Option<u64>,
}

/// One piece of work and what it cost.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Work {
    /// What was done.
    pub(crate) work: String,
    /// What is varied from one piece of work to the next, where it is the same otherwise.
    #[serde(default)]
    pub(crate) varied: Map<String, Value>,
    /// Its time.
    #[serde(flatten)]
    pub(crate) spent: Spent,
    /// The passes that ran.
    pub(crate) passes: Vec<Pass>,
    /// How far the result is from the reference, in the measure that the case defines.
    pub(crate) error: Option<f64>,
    /// Mean FLIP error of the picture against that of the reference.
    pub(crate) flip: Option<f64>,
    /// What is wrong with it, where it broke a promise.
    pub(crate) fault: Option<String>,
}

/// A pass that ran.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pass {
    /// As its shader is named.
    pub(crate) pass: String,
    /// Milliseconds on the device.
    pub(crate) ms: f64,
}

impl From<&PassTime> for Pass {
    fn from(time: &PassTime) -> Self {
        Self {
            pass: time.pass.to_owned(),
            ms: time.ms,
        }
    }
}
