//! Flags of the commands that render or serve.

use super::{JobFlags, LogFormat};
use clap::Args;
use serde::Serialize;
use std::path::PathBuf;

/// Flags of the commands that render.
#[derive(Args, Clone, Debug, Default, Serialize)]
pub(crate) struct DeviceFlags {
    /// Part of the adapter's name; `welkin devices` lists them [default: the fastest]
    #[arg(long, value_name = "NAME")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) adapter: Option<String>,
    /// Refuse to render in software [default: false]
    #[arg(long, num_args = 0..=1, default_missing_value = "true", value_name = "BOOL")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) require_gpu: Option<bool>,
    /// Where the noise of clouds is kept between starts [default: welkin in the user's folder for caches]
    #[arg(long, value_name = "FOLDER")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) cache_dir: Option<PathBuf>,
    /// The most that is kept there, bytes; 0 keeps nothing [default: 268435456]
    #[arg(long, value_name = "BYTES")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) disk_cache_bytes: Option<u64>,
    /// Where the files are that scenes name, such as weather maps
    /// [default: welkin/assets in the user's folder for data]
    #[arg(long, value_name = "FOLDER")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) assets: Option<PathBuf>,
}

/// Flags of `welkin serve`.
#[derive(Args, Clone, Debug, Default, Serialize)]
pub(crate) struct ServeFlags {
    #[command(flatten)]
    #[serde(flatten)]
    pub(super) device: DeviceFlags,
    #[command(flatten)]
    #[serde(flatten)]
    pub(super) jobs: JobFlags,
    /// What jobs may take of the store of results and the queue, all together, bytes [default: 68719476736]
    #[arg(long, value_name = "BYTES")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) store_bytes: Option<u64>,
    /// How long a job is kept after its end, with its results, days; 0 for ever [default: 0]
    #[arg(long, value_name = "DAYS")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) keep_results_days: Option<u32>,
    /// Address and port [default: 127.0.0.1:8080]
    #[arg(long, value_name = "ADDRESS:PORT")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) listen: Option<String>,
    /// The largest asset, bytes [default: 67108864]
    #[arg(long, value_name = "BYTES")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) max_asset_bytes: Option<u64>,
    /// Most assets; 0 keeps none, and scenes can name none [default: 1000]
    #[arg(long, value_name = "COUNT")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) max_assets: Option<u32>,
    /// All assets together, bytes [default: 1073741824]
    #[arg(long, value_name = "BYTES")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) assets_bytes: Option<u64>,
    /// Orders that wait or are rendered at once; more are answered 503 [default: 64]
    #[arg(long, value_name = "COUNT")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) queue_places: Option<usize>,
    /// Memory for finished frames, bytes [default: 268435456]
    #[arg(long, value_name = "BYTES")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) cache_bytes: Option<u64>,
    /// Memory for the pixels of frames in work, bytes; 12 a pixel for radiance, 3 for a picture
    /// [default: 4294967296]
    #[arg(long, value_name = "BYTES")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) frame_memory_bytes: Option<u64>,
    /// The largest frame, pixels [default: 268435456]
    #[arg(long, value_name = "PIXELS")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) max_frame_pixels: Option<u64>,
    /// Live viewers at once [default: 64]
    #[arg(long, value_name = "COUNT")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) max_viewers: Option<u32>,
    /// Send spans of requests and of frames of jobs to this collector of OpenTelemetry, by OTLP over HTTP, such as
    /// http://127.0.0.1:4318 [default: nowhere]
    #[arg(long, value_name = "URL")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) otlp: Option<String>,
    /// What is logged: error, warn, info, debug, or a filter such as welkin_service=debug [default: info]
    #[arg(long, value_name = "FILTER")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) log: Option<String>,
    /// How log lines look [default: text]
    #[arg(long, value_name = "FORMAT")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) log_format: Option<LogFormat>,
}

/// Flags of `welkin worker`.
#[derive(Args, Clone, Debug, Default, Serialize)]
pub(crate) struct WorkerFlags {
    #[command(flatten)]
    #[serde(flatten)]
    pub(super) device: DeviceFlags,
    #[command(flatten)]
    #[serde(flatten)]
    pub(super) jobs: JobFlags,
    /// Send spans of requests and of frames of jobs to this collector of OpenTelemetry, by OTLP over HTTP, such as
    /// http://127.0.0.1:4318 [default: nowhere]
    #[arg(long, value_name = "URL")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) otlp: Option<String>,
    /// What is logged, as for `welkin serve` [default: info]
    #[arg(long, value_name = "FILTER")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) log: Option<String>,
    /// How log lines look [default: text]
    #[arg(long, value_name = "FORMAT")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) log_format: Option<LogFormat>,
}
