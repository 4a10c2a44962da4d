//! Where jobs wait, where their results lie, and how they are worked on.

use super::Settings;
use clap::Args;
use etcetera::BaseStrategy;
use serde::Serialize;
use std::time::Duration;

/// Flags of the commands that know jobs.
#[derive(Args, Clone, Debug, Default, Serialize)]
pub(crate) struct JobFlags {
    /// Where jobs wait: sqlite:FILE on one machine, postgres://USER:PASSWORD@HOST/DATABASE for many
    /// [default: jobs.db in welkin in the user's folder for data]
    #[arg(long, value_name = "ADDRESS")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) queue: Option<String>,
    /// Where results lie: file:FOLDER, or s3://BUCKET/FOLDER with AWS_ACCESS_KEY_ID and so on in the environment
    /// [default: results in welkin in the user's folder for data]
    #[arg(long, value_name = "ADDRESS")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) store: Option<String>,
    /// Frames of jobs in work here at once: one is rendered while others are encoded and stored; 0 leaves all to
    /// other workers [default: 2]
    #[arg(long, value_name = "COUNT")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) job_frames: Option<usize>,
    /// How often a worker shows that it lives, seconds; three times this long after the last, its frames go to others
    /// [default: 5]
    #[arg(long, value_name = "SECONDS", value_parser = clap::value_parser!(u32).range(1..=3600))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) heartbeat_s: Option<u32>,
}

impl Settings {
    /// Addresses of the queue and of the store of results; none where one is not named and the user has no folder for
    /// data.
    pub(crate) fn job_places(&self) -> Option<(String, String)> {
        let data = || Some(etcetera::choose_base_strategy().ok()?.data_dir().join("welkin"));
        let named = |address: &Option<String>| address.clone().filter(|address| !address.is_empty());
        let queue =
            named(&self.queue).or_else(|| Some(format!("sqlite:{}", data()?.join("jobs.db").display())));
        let store =
            named(&self.store).or_else(|| Some(format!("file:{}", data()?.join("results").display())));
        queue.zip(store)
    }

    /// How long jobs are kept after their end; none for ever.
    pub(crate) fn keep_results(&self) -> Option<Duration> {
        let kept = Duration::from_secs(86_400 * u64::from(self.keep_results_days));
        (!kept.is_zero()).then_some(kept)
    }

    /// True where somebody asked for jobs by name.
    pub(crate) fn names_job_places(&self) -> bool {
        let named = |address: &Option<String>| address.as_ref().is_some_and(|address| !address.is_empty());
        named(&self.queue) || named(&self.store)
    }
}
