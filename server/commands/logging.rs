//! What is logged, and how; and what a collector of OpenTelemetry is told.

use super::{Failure, version::build};
use crate::settings::{LogFormat, Settings};
use opentelemetry::{KeyValue, trace::TracerProvider as _};
use opentelemetry_otlp::{SpanExporter, WithExportConfig};
use opentelemetry_sdk::{Resource, trace::SdkTracerProvider};
use std::{
    io::{self, IsTerminal},
    time::Duration,
};
use tracing_subscriber::{EnvFilter, Layer, fmt, layer::SubscriberExt, util::SubscriberInitExt};

/// How long the last spans may take to reach the collector.
const LAST_SPANS: Duration = Duration::from_secs(5);

/// Spans on their way to a collector; the last are sent when it is dropped.
#[must_use]
pub(crate) struct Telemetry(Option<SdkTracerProvider>);

impl Drop for Telemetry {
    fn drop(&mut self) {
        if let Some(spans) = &self.0
            && let Err(error) = spans.shutdown_with_timeout(LAST_SPANS)
        {
            tracing::warn!(%error, "the last spans did not reach the collector");
        }
    }
}

/// For the service and for workers: as settings say, on standard error and to the collector. To be called before there
/// is a runtime, as the exporter has one of its own.
///
/// # Errors
/// Where the filter is none, or the collector's address.
pub(crate) fn start(settings: &Settings) -> Result<Telemetry, Failure> {
    let filter = EnvFilter::try_new(&settings.log)
        .map_err(|e| Failure::Usage(format!("log: {:?} is not a filter: {e}", settings.log)))?;
    let log = fmt::layer()
        .with_writer(io::stderr)
        .with_ansi(io::stderr().is_terminal());
    let log = match settings.log_format {
        LogFormat::Text => log.boxed(),
        LogFormat::Json => log.json().flatten_event(true).with_span_list(false).boxed(),
    };
    let spans = settings
        .otlp
        .as_deref()
        .filter(|url| !url.is_empty())
        .map(exporter)
        .transpose()?;
    let told = spans
        .as_ref()
        .map(|spans| tracing_opentelemetry::layer().with_tracer(spans.tracer("welkin")));
    tracing_subscriber::registry()
        .with(filter)
        .with(log)
        .with(told)
        .init();
    Ok(Telemetry(spans))
}

fn exporter(url: &str) -> Result<SdkTracerProvider, Failure> {
    let wrong = |e: &dyn std::fmt::Display| Failure::Usage(format!("otlp: {url:?}: {e}"));
    if !url.starts_with("http://") && !url.starts_with("https://") {
        return Err(wrong(&"an address begins with http:// or https://"));
    }
    let exporter = SpanExporter::builder()
        .with_http()
        .with_endpoint(format!("{}/v1/traces", url.trim_end_matches('/')))
        .build()
        .map_err(|e| wrong(&e))?;
    let resource = Resource::builder()
        .with_service_name("welkin")
        .with_attribute(KeyValue::new("service.version", build()))
        .build();
    Ok(SdkTracerProvider::builder()
        .with_batch_exporter(exporter)
        .with_resource(resource)
        .build())
}

/// For commands that answer once: only what should not be missed.
pub(crate) fn quiet() {
    tracing_subscriber::fmt()
        .with_env_filter(EnvFilter::new("warn"))
        .with_writer(io::stderr)
        .with_ansi(io::stderr().is_terminal())
        .without_time()
        .init();
}
