//! Serving on a socket, and ending well.

use crate::{metrics, operations, state::Service};
use axum::{Router, routing::get};
use hyper_util::{
    rt::{TokioExecutor, TokioIo, TokioTimer},
    server::{conn::auto, graceful::GracefulShutdown},
    service::TowerToHyperService,
};
use std::{future::Future, io, sync::Arc, time::Duration};
use tokio::{
    net::TcpListener,
    sync::Semaphore,
    time::{sleep, timeout},
};

/// How long a client may take to send the head of a request.
const HEADER_TIMEOUT: Duration = Duration::from_secs(10);
/// Connections at once; more wait to be accepted.
const MAX_CONNECTIONS: usize = 1024;

/// Why the service did not start.
#[derive(Debug, thiserror::Error)]
pub enum StartError {
    /// A part could not be set up.
    #[error("the service cannot be set up: {0}")]
    Setup(String),
    /// The address is taken.
    #[error("{address} is in use: stop what listens there, or choose another with --listen")]
    Taken {
        /// The address.
        address: String,
    },
    /// The address cannot be listened on.
    #[error("cannot listen on {address}: {source}")]
    Listen {
        /// The address.
        address: String,
        /// What the system said.
        source: io::Error,
    },
}

/// Listens on an address such as `127.0.0.1:8080`.
///
/// # Errors
/// Where the address is taken or cannot be listened on.
pub async fn listen(address: &str) -> Result<TcpListener, StartError> {
    TcpListener::bind(address)
        .await
        .map_err(|source| match source.kind() {
            io::ErrorKind::AddrInUse => StartError::Taken {
                address: address.into(),
            },
            _ => StartError::Listen {
                address: address.into(),
                source,
            },
        })
}

/// Serves until `stop` is ready, then lets requests in work finish for as long as settings say; live viewers are
/// told to go.
///
/// # Errors
/// Where the routes cannot be set up.
pub async fn serve(
    service: Service,
    listener: TcpListener,
    stop: impl Future<Output = ()>,
) -> Result<(), StartError> {
    let app = crate::app(service.clone())?;
    let connections = GracefulShutdown::new();
    let mut http = auto::Builder::new(TokioExecutor::new()).http1_only();
    http.http1()
        .timer(TokioTimer::new())
        .header_read_timeout(HEADER_TIMEOUT);
    let places = Arc::new(Semaphore::new(MAX_CONNECTIONS));
    let accept = async {
        loop {
            let Ok(place) = Arc::clone(&places).acquire_owned().await else {
                return;
            };
            match listener.accept().await {
                Ok((stream, _)) => {
                    if let Err(error) = stream.set_nodelay(true) {
                        tracing::debug!(%error, "TCP_NODELAY");
                    }
                    let handler = TowerToHyperService::new(app.clone());
                    let connection = http.serve_connection_with_upgrades(TokioIo::new(stream), handler);
                    let watched = connections.watch(connection.into_owned());
                    tokio::spawn(async move {
                        let _place = place;
                        if let Err(error) = watched.await {
                            tracing::debug!(%error, "connection");
                        }
                    });
                }
                Err(error) => {
                    // Out of file descriptors, most likely: the cure is to wait until some are closed.
                    tracing::warn!(%error, "accept");
                    sleep(Duration::from_millis(100)).await;
                }
            }
        }
    };
    tokio::select! {
        () = accept => {}
        () = service.count_jobs() => {}
        () = service.remove_old_jobs() => {}
        () = stop => {}
    }
    drop(listener);
    service.stop();
    tracing::info!("shutting down");
    let ended = async { tokio::join!(connections.shutdown(), service.viewers_gone()) };
    if timeout(service.settings.shutdown_timeout, ended).await.is_err() {
        tracing::warn!("requests still in work are given up");
    }
    Ok(())
}

/// Tells `/healthz` and `/metrics` of a process that serves nothing else, for as long as it is polled.
///
/// # Errors
/// Where the process already has another recorder of metrics.
pub fn tell_operations(listener: TcpListener) -> Result<impl Future<Output = ()>, StartError> {
    metrics::recorder().map_err(|e| StartError::Setup(e.cause().unwrap_or_default().to_owned()))?;
    let routes = Router::new()
        .route("/healthz", get(operations::health))
        .route("/metrics", get(operations::numbers));
    Ok(async move {
        if let Err(error) = axum::serve(listener, routes).await {
            tracing::warn!(%error, "health and metrics are told no more");
        }
    })
}
