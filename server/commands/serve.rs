//! `welkin serve`

use super::{Failure, assets, logging, version::build, worker};
use crate::settings::{ServeFlags, Settings};
use std::{io, path::Path, sync::Arc};
use tokio::sync::oneshot;
use welkin_jobs::{Jobs, Worker};
use welkin_service::{Service, listen, serve};

/// Arguments of `welkin serve`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    flags: ServeFlags,
}

/// Serves until it is interrupted.
///
/// # Errors
/// Where the address is taken or there is no device.
pub(crate) fn run(args: &Args, config: Option<&Path>) -> Result<(), Failure> {
    let settings = Settings::load(config, &args.flags)?;
    let _telemetry = logging::start(&settings)?;
    let runtime = tokio::runtime::Runtime::new().map_err(Failure::file("starting"))?;
    let served = runtime.block_on(until_stopped(&settings));
    // An encoder in the middle of a file for nobody is not waited for.
    runtime.shutdown_background();
    served
}

async fn until_stopped(settings: &Settings) -> Result<(), Failure> {
    let store = tokio::task::block_in_place(|| assets::store(settings))?.map(Arc::new);
    let jobs = jobs(settings, store.clone()).await?;
    let listener = listen(&settings.listen).await?;
    let address = listener.local_addr().map_err(Failure::file("listening"))?;
    let renderer = tokio::task::block_in_place(|| crate::open_renderer(settings))?;
    let (build, adapter) = (build(), renderer.device().adapter);
    tracing::info!(build, "Welkin is at http://{address} (adapter {adapter})");
    let service = Service::new(Arc::clone(&renderer), settings.service(build));
    let service = match store {
        Some(store) => service.with_assets(store),
        None => service,
    };
    let stop = stopped().map_err(Failure::file("waiting for signals"))?;
    let Some(jobs) = jobs else {
        return Ok(serve(service, listener, stop).await?);
    };
    let service = service.with_jobs(jobs.clone());
    if settings.job_frames == 0 {
        return Ok(serve(service, listener, stop).await?);
    }
    let worker = Worker::new(jobs, renderer, worker::worker_settings(settings)).with_calm(service.calm());
    let (stop_worker, worker_stops) = oneshot::channel::<()>();
    let working = worker.run(async {
        // Told, or the service has gone without a word.
        drop(worker_stops.await);
    });
    let serving = async {
        let served = serve(service, listener, stop).await;
        drop(stop_worker);
        served
    };
    Ok(tokio::join!(serving, working).0?)
}

/// Jobs, where they can be had. A queue that nobody asked for by name is done without.
async fn jobs(
    settings: &Settings,
    assets: Option<Arc<welkin_assets::Store>>,
) -> Result<Option<Jobs>, Failure> {
    match worker::open_with(settings, assets).await {
        Ok(jobs) => Ok(Some(jobs)),
        Err(failure) if settings.names_job_places() => Err(failure),
        Err(failure) => {
            tracing::warn!("no jobs are taken: {failure}");
            Ok(None)
        }
    }
}

/// Ready at the first interrupt or termination; the second ends the process at once.
#[cfg(unix)]
pub(super) fn stopped() -> io::Result<impl Future<Output = ()>> {
    use tokio::signal::unix::{SignalKind, signal};
    let (mut interrupt, mut terminate) = (signal(SignalKind::interrupt())?, signal(SignalKind::terminate())?);
    Ok(async move {
        tokio::select! {
            _ = interrupt.recv() => {}
            _ = terminate.recv() => {}
        }
        tokio::spawn(async move {
            interrupt.recv().await;
            std::process::exit(130);
        });
    })
}

/// Ready at the first interrupt.
#[cfg(not(unix))]
pub(super) fn stopped() -> io::Result<impl Future<Output = ()>> {
    Ok(async {
        if let Err(error) = tokio::signal::ctrl_c().await {
            tracing::warn!(%error, "interrupts cannot be heard");
            std::future::pending::<()>().await;
        }
    })
}
