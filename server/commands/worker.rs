//! `welkin worker`

use super::{Failure, assets, logging, serve::stopped, version::build};
use crate::settings::{Settings, WorkerFlags};
use std::{path::Path, sync::Arc, time::Duration};
use welkin_jobs::{Jobs, Limits, Queue, Store, Worker, WorkerSettings};
use welkin_service::{listen, tell_operations};

/// Arguments of `welkin worker`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    flags: WorkerFlags,
    /// Tell /healthz and /metrics at this address and port [default: nowhere]
    #[arg(long, value_name = "ADDRESS:PORT")]
    metrics: Option<String>,
}

/// Works until it is interrupted.
///
/// # Errors
/// Where queue, store or device cannot be opened.
pub(crate) fn run(args: &Args, config: Option<&Path>) -> Result<(), Failure> {
    let settings = Settings::load(config, &args.flags)?;
    let _telemetry = logging::start(&settings)?;
    let runtime = tokio::runtime::Runtime::new().map_err(Failure::file("starting"))?;
    let worked = runtime.block_on(until_stopped(&settings, args.metrics.as_deref()));
    // A file that is being put into the store is not waited for; another worker makes it anew.
    runtime.shutdown_background();
    worked
}

async fn until_stopped(settings: &Settings, metrics: Option<&str>) -> Result<(), Failure> {
    if settings.job_frames == 0 {
        return Err(Failure::Usage("a worker needs --job-frames of 1 or more".into()));
    }
    let told = match metrics {
        Some(address) => Some(tell_operations(listen(address).await?)?),
        None => None,
    };
    let jobs = open(settings).await?;
    let renderer = tokio::task::block_in_place(|| crate::open_renderer(settings))?;
    let (queue, store) = settings.job_places().unwrap_or_default();
    let queue = without_password(&queue);
    tracing::info!(
        adapter = renderer.device().adapter,
        queue,
        store,
        "Welkin works on jobs"
    );
    let stop = stopped().map_err(Failure::file("waiting for signals"))?;
    let worker = Worker::new(jobs, renderer, worker_settings(settings));
    let telling = async {
        match told {
            Some(telling) => telling.await,
            None => std::future::pending().await,
        }
    };
    tokio::select! {
        () = worker.run(stop) => {}
        () = telling => {}
    }
    Ok(())
}

/// The queue and the store that the settings name.
///
/// # Errors
/// Where they cannot be opened.
pub(crate) async fn open(settings: &Settings) -> Result<Jobs, Failure> {
    let assets = tokio::task::block_in_place(|| assets::store(settings))?;
    open_with(settings, assets.map(Arc::new)).await
}

/// As [`open`], with a store of assets that is open already.
///
/// # Errors
/// Where they cannot be opened.
pub(crate) async fn open_with(
    settings: &Settings,
    assets: Option<Arc<welkin_assets::Store>>,
) -> Result<Jobs, Failure> {
    let places = settings.job_places();
    let (queue, store) = places
        .ok_or_else(|| Failure::Usage("name --queue and --store: there is no folder for data".into()))?;
    if let Some(folder) = queue
        .strip_prefix("sqlite:")
        .and_then(|file| Path::new(file).parent())
    {
        let making = Failure::file(format!("making the folder {}", folder.display()));
        std::fs::create_dir_all(folder).map_err(making)?;
    }
    let store = Store::open(&store)?;
    let limits = Limits {
        store_bytes: settings.store_bytes,
        max_frame_pixels: settings.max_frame_pixels,
    };
    Ok(Jobs::new(Queue::open(&queue).await?, store, assets).with_limits(limits))
}

/// How a worker works, as settings say.
pub(crate) fn worker_settings(settings: &Settings) -> WorkerSettings {
    WorkerSettings {
        frames: settings.job_frames,
        heartbeat: Duration::from_secs(settings.heartbeat_s.into()),
        build: build(),
    }
}

/// The address of a queue as a log may tell it.
fn without_password(queue: &str) -> String {
    match (queue.split_once("://"), queue.rsplit_once('@')) {
        (Some((scheme, _)), Some((_, place))) => format!("{scheme}://…@{place}"),
        _ => queue.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::without_password;

    #[test]
    fn passwords_stay_out_of_logs() {
        assert_eq!(
            without_password("postgres://me:p@ss@host/db"),
            "postgres://…@host/db"
        );
        assert_eq!(without_password("sqlite:/a@b/jobs.db"), "sqlite:/a@b/jobs.db");
    }
}
