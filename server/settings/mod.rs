//! Settings: flags go before the environment (`WELKIN_…`), that before a TOML file, that before defaults.

mod flags;
mod jobs;

pub(crate) use flags::{DeviceFlags, ServeFlags, WorkerFlags};
pub(crate) use jobs::JobFlags;

use clap::ValueEnum;
use etcetera::BaseStrategy;
use figment::{
    Figment,
    providers::{Env, Format, Serialized, Toml},
};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use welkin_assets::Limits;

/// Looked for in the working directory when no other file is named.
const DEFAULT_FILE: &str = "welkin.toml";

/// All that may be set.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Settings {
    pub(crate) adapter: Option<String>,
    pub(crate) require_gpu: bool,
    pub(crate) cache_dir: Option<PathBuf>,
    pub(crate) disk_cache_bytes: u64,
    pub(crate) assets: Option<PathBuf>,
    pub(crate) max_asset_bytes: u64,
    pub(crate) max_assets: u32,
    pub(crate) assets_bytes: u64,
    pub(crate) queue_places: usize,
    pub(crate) queue: Option<String>,
    pub(crate) store: Option<String>,
    pub(crate) job_frames: usize,
    pub(crate) heartbeat_s: u32,
    pub(crate) store_bytes: u64,
    pub(crate) keep_results_days: u32,
    pub(crate) listen: String,
    pub(crate) cache_bytes: u64,
    pub(crate) frame_memory_bytes: u64,
    pub(crate) max_frame_pixels: u64,
    pub(crate) max_viewers: u32,
    pub(crate) otlp: Option<String>,
    pub(crate) log: String,
    pub(crate) log_format: LogFormat,
}

/// Names of the settings, as the environment has them after `WELKIN_` (in capitals).
const NAMES: [&str; 23] = [
    "adapter",
    "require_gpu",
    "cache_dir",
    "disk_cache_bytes",
    "assets",
    "max_asset_bytes",
    "max_assets",
    "assets_bytes",
    "queue_places",
    "queue",
    "store",
    "job_frames",
    "heartbeat_s",
    "store_bytes",
    "keep_results_days",
    "listen",
    "cache_bytes",
    "frame_memory_bytes",
    "max_frame_pixels",
    "max_viewers",
    "otlp",
    "log",
    "log_format",
];

/// How log lines look.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum LogFormat {
    /// For people.
    #[default]
    Text,
    /// One JSON object a line.
    Json,
}

impl Default for Settings {
    fn default() -> Self {
        let service = welkin_service::Settings::default();
        let assets = Limits::default();
        Self {
            adapter: None,
            require_gpu: false,
            cache_dir: None,
            disk_cache_bytes: 268_435_456,
            assets: None,
            max_asset_bytes: assets.max_asset_bytes,
            max_assets: assets.max_assets,
            assets_bytes: assets.assets_bytes,
            queue_places: 64,
            queue: None,
            store: None,
            job_frames: 2,
            heartbeat_s: 5,
            store_bytes: 68_719_476_736,
            keep_results_days: 0,
            listen: "127.0.0.1:8080".into(),
            cache_bytes: service.cache_bytes,
            frame_memory_bytes: service.frame_memory_bytes,
            max_frame_pixels: service.max_frame_pixels,
            max_viewers: service.max_viewers,
            otlp: None,
            log: "info".into(),
            log_format: LogFormat::Text,
        }
    }
}

impl Settings {
    /// Merges all sources. Unknown names in the file are refused; the environment may hold others.
    ///
    /// # Errors
    /// Names the setting and where its value came from.
    pub(crate) fn load(file: Option<&Path>, flags: &impl Serialize) -> Result<Self, Box<figment::Error>> {
        let file = file.or_else(|| Some(Path::new(DEFAULT_FILE)).filter(|file| file.exists()));
        let mut merged = Figment::from(Serialized::defaults(Self::default()));
        if let Some(file) = file {
            merged = merged.merge(Toml::file_exact(file));
        }
        let merged = merged
            .merge(Env::prefixed("WELKIN_").only(&NAMES))
            .merge(Serialized::defaults(flags));
        merged.extract().map_err(Box::new)
    }

    /// Where files are kept between starts; none where nothing shall be, or the user has no such folder.
    pub(crate) fn cache_folder(&self) -> Option<PathBuf> {
        if self.disk_cache_bytes == 0 {
            return None;
        }
        let users_own = || Some(etcetera::choose_base_strategy().ok()?.cache_dir().join("welkin"));
        let named = self.cache_dir.clone().filter(|dir| !dir.as_os_str().is_empty());
        named.or_else(users_own)
    }

    /// The folder for assets that was asked for by name.
    pub(crate) fn named_assets_folder(&self) -> Option<&Path> {
        self.assets.as_deref().filter(|dir| !dir.as_os_str().is_empty())
    }

    /// Where assets are kept; none where none shall be, or the user has no such folder.
    pub(crate) fn assets_folder(&self) -> Option<PathBuf> {
        if self.max_assets == 0 {
            return None;
        }
        let users_own = || {
            Some(
                etcetera::choose_base_strategy()
                    .ok()?
                    .data_dir()
                    .join("welkin/assets"),
            )
        };
        self.named_assets_folder().map(Path::to_owned).or_else(users_own)
    }

    /// How much the store of assets takes.
    pub(crate) const fn asset_limits(&self) -> Limits {
        Limits {
            max_asset_bytes: self.max_asset_bytes,
            max_assets: self.max_assets,
            assets_bytes: self.assets_bytes,
        }
    }

    /// The part that the service knows.
    pub(crate) fn service(&self, build: String) -> welkin_service::Settings {
        welkin_service::Settings {
            build,
            cache_bytes: self.cache_bytes,
            frame_memory_bytes: self.frame_memory_bytes,
            max_frame_pixels: self.max_frame_pixels,
            max_viewers: self.max_viewers,
            keep_results: self.keep_results(),
            ..welkin_service::Settings::default()
        }
    }
}

#[cfg(test)]
mod tests;
