//! Waiting for the renderer: what is shown meanwhile, and how to stop.

use super::Failure;
use indicatif::{ProgressBar, ProgressStyle};
use std::{future::Future, time::Duration};

/// Below this nothing is shown.
const PATIENCE: Duration = Duration::from_secs(1);
const TICK: Duration = Duration::from_millis(100);

/// Waits for `work`. From a second on, a terminal shows what is done and for how long; an interrupt drops the work.
///
/// # Errors
/// Those of the work; [`Failure::Interrupted`].
pub(crate) fn wait_for<T, E>(doing: &str, work: impl Future<Output = Result<T, E>>) -> Result<T, Failure>
where
    Failure: From<E>,
{
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
    runtime.map_err(Failure::file("starting"))?.block_on(async {
        let shown = async {
            tokio::time::sleep(PATIENCE).await;
            let bar = ProgressBar::new_spinner().with_message(doing.to_owned());
            let style = ProgressStyle::with_template("{spinner} {msg} ({elapsed})");
            let bar = bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
            loop {
                bar.tick();
                tokio::time::sleep(TICK).await;
            }
        };
        tokio::select! {
            done = work => Ok(done?),
            never = shown => never,
            _ = tokio::signal::ctrl_c() => Err(Failure::Interrupted),
        }
    })
}
