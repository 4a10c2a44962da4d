//! Numbers for operators, in Prometheus' text format.

use crate::error::Error;
use axum_prometheus::{
    AXUM_HTTP_REQUESTS_DURATION_SECONDS, EndpointLabel, GenericMetricLayer, Handle,
    PrometheusMetricLayerBuilder,
    metrics::{Unit, counter, describe_counter, describe_gauge, describe_histogram, gauge, histogram},
    metrics_exporter_prometheus::{Matcher, PrometheusBuilder, PrometheusHandle},
};
use std::{borrow::Cow, sync::OnceLock};
use welkin_assets::Usage;
use welkin_scene::{
    frame::{Format, Quality},
    renderer::{Frame, RenderError},
};

const FRAMES: &str = "welkin_frames_total";
const RENDER_PASS: &str = "welkin_render_pass_seconds";
const RENDER: &str = "welkin_render_seconds";
const ENCODE: &str = "welkin_encode_seconds";
const REFUSALS: &str = "welkin_render_refusals_total";
const IN_WORK: &str = "welkin_frames_in_work";
const VIEWERS: &str = "welkin_live_viewers";
const ASSETS: &str = "welkin_assets";
const ASSETS_BYTES: &str = "welkin_assets_bytes";
/// Times of jobs begin with this.
const JOB_TIMES: &str = "welkin_job_";
const LIVE_FRAMES: &str = "welkin_live_frames_total";

/// From a tenth of a millisecond, a table pass on a GPU, to minutes, a 16k frame on a CPU.
const BUCKETS_S: [f64; 13] = [
    1e-4, 5e-4, 1e-3, 5e-3, 0.01, 0.025, 0.05, 0.1, 0.25, 1.0, 5.0, 25.0, 120.0,
];

pub(crate) type Layer = GenericMetricLayer<'static, PrometheusHandle, Handle>;

/// The recorder is one for the whole process: set at first use.
pub(crate) fn recorder() -> Result<&'static PrometheusHandle, Error> {
    static RECORDER: OnceLock<Result<PrometheusHandle, String>> = OnceLock::new();
    RECORDER
        .get_or_init(install)
        .as_ref()
        .map_err(|cause| Error::Internal { cause: cause.clone() })
}

fn install() -> Result<PrometheusHandle, String> {
    let mut builder = PrometheusBuilder::new();
    for name in [AXUM_HTTP_REQUESTS_DURATION_SECONDS, RENDER_PASS, RENDER, ENCODE] {
        let matcher = Matcher::Full(name.to_owned());
        builder = builder
            .set_buckets_for_metric(matcher, &BUCKETS_S)
            .map_err(|e| e.to_string())?;
    }
    let jobs = Matcher::Prefix(JOB_TIMES.to_owned());
    let builder = builder
        .set_buckets_for_metric(jobs, &BUCKETS_S)
        .map_err(|e| e.to_string())?;
    let handle = builder.install_recorder().map_err(|e| e.to_string())?;
    describe_counter!(
        FRAMES,
        "Frames answered, by format, quality and where they came from"
    );
    describe_counter!(LIVE_FRAMES, "Frames sent to live viewers, by quality");
    describe_counter!(REFUSALS, "Orders that the renderer refused, by reason");
    describe_histogram!(RENDER_PASS, Unit::Seconds, "Time of one pass of one frame");
    describe_histogram!(
        RENDER,
        Unit::Seconds,
        "Time from the order to the frame, the queue included"
    );
    describe_histogram!(ENCODE, Unit::Seconds, "Time to make a file of a frame");
    describe_gauge!(IN_WORK, "Frames ordered and not yet rendered");
    describe_gauge!(VIEWERS, "Live viewers");
    describe_gauge!(ASSETS, "Assets in the store, as of the last change");
    describe_gauge!(
        ASSETS_BYTES,
        Unit::Bytes,
        "Bytes of all assets, as of the last change"
    );
    Ok(handle)
}

/// Counts requests by route; paths of no route are one label, however many are tried.
pub(crate) fn layer() -> Layer {
    PrometheusMetricLayerBuilder::new()
        .with_endpoint_label_type(EndpointLabel::MatchedPathWithFallbackFn(|_| "other".to_owned()))
        .build()
}

/// Where an answered frame came from.
#[derive(Clone, Copy)]
pub(crate) enum Source {
    Rendered,
    Cache,
    Client,
}

pub(crate) fn frame_answered(format: Format, quality: Quality, source: Source) {
    let source = match source {
        Source::Rendered => "rendered",
        Source::Cache => "cache",
        Source::Client => "client",
    };
    counter!(FRAMES, "format" => name(format), "quality" => name(quality), "source" => source).increment(1);
}

pub(crate) fn live_frame_sent(quality: Quality) {
    counter!(LIVE_FRAMES, "quality" => name(quality)).increment(1);
}

pub(crate) fn rendered(frame: &Frame, seconds: f64) {
    for pass in &frame.passes {
        histogram!(RENDER_PASS, "pass" => pass.pass).record(pass.ms / 1e3);
    }
    histogram!(RENDER).record(seconds);
}

pub(crate) fn encoded(format: impl serde::Serialize, seconds: f64) {
    histogram!(ENCODE, "format" => name(format)).record(seconds);
}

pub(crate) fn refused(error: &RenderError) {
    let reason = match error {
        RenderError::Busy { .. } => "busy",
        RenderError::Size { .. } => "size",
        RenderError::Device(_) => "device",
        RenderError::Stopped => "stopped",
    };
    counter!(REFUSALS, "reason" => reason).increment(1);
}

#[allow(
    clippy::cast_precision_loss,
    reason = "2^53 bytes are more than a store holds"
)]
pub(crate) fn assets(used: Usage) {
    gauge!(ASSETS).set(f64::from(used.count));
    gauge!(ASSETS_BYTES).set(used.bytes as f64);
}

/// Counts itself in the gauge while it lives.
pub(crate) struct Counted(&'static str);

impl Counted {
    pub(crate) fn frame_in_work() -> Self {
        Self::new(IN_WORK)
    }

    pub(crate) fn viewer() -> Self {
        Self::new(VIEWERS)
    }

    fn new(name: &'static str) -> Self {
        gauge!(name).increment(1.0);
        Self(name)
    }
}

impl Drop for Counted {
    fn drop(&mut self) {
        gauge!(self.0).decrement(1.0);
    }
}

/// A vocabulary word as documents write it.
pub(crate) fn name(word: impl serde::Serialize) -> Cow<'static, str> {
    match serde_json::to_value(word) {
        Ok(serde_json::Value::String(text)) => text.into(),
        _ => "unknown".into(),
    }
}
