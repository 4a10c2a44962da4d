//! Settings: flags go before the environment (`WELKIN_…`), that before a TOML file, that before defaults.

use clap::{Args, ValueEnum};
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
    pub(crate) listen: String,
    pub(crate) cache_bytes: u64,
    pub(crate) frame_memory_bytes: u64,
    pub(crate) max_frame_pixels: u64,
    pub(crate) max_viewers: u32,
    pub(crate) log: String,
    pub(crate) log_format: LogFormat,
}

/// Names of the settings, as the environment has them after `WELKIN_` (in capitals).
const NAMES: [&str; 16] = [
    "adapter",
    "require_gpu",
    "cache_dir",
    "disk_cache_bytes",
    "assets",
    "max_asset_bytes",
    "max_assets",
    "assets_bytes",
    "queue_places",
    "listen",
    "cache_bytes",
    "frame_memory_bytes",
    "max_frame_pixels",
    "max_viewers",
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
            listen: "127.0.0.1:8080".into(),
            cache_bytes: service.cache_bytes,
            frame_memory_bytes: service.frame_memory_bytes,
            max_frame_pixels: service.max_frame_pixels,
            max_viewers: service.max_viewers,
            log: "info".into(),
            log_format: LogFormat::Text,
        }
    }
}

/// Flags of the commands that render.
#[derive(Args, Clone, Debug, Default, Serialize)]
pub(crate) struct DeviceFlags {
    /// Part of the adapter's name; `welkin devices` lists them [default: the fastest]
    #[arg(long, value_name = "NAME")]
    #[serde(skip_serializing_if = "Option::is_none")]
    adapter: Option<String>,
    /// Refuse to render in software [default: false]
    #[arg(long, num_args = 0..=1, default_missing_value = "true", value_name = "BOOL")]
    #[serde(skip_serializing_if = "Option::is_none")]
    require_gpu: Option<bool>,
    /// Where the noise of clouds is kept between starts [default: welkin in the user's folder for caches]
    #[arg(long, value_name = "FOLDER")]
    #[serde(skip_serializing_if = "Option::is_none")]
    cache_dir: Option<PathBuf>,
    /// The most that is kept there, bytes; 0 keeps nothing [default: 268435456]
    #[arg(long, value_name = "BYTES")]
    #[serde(skip_serializing_if = "Option::is_none")]
    disk_cache_bytes: Option<u64>,
    /// Where the files are that scenes name, such as weather maps
    /// [default: welkin/assets in the user's folder for data]
    #[arg(long, value_name = "FOLDER")]
    #[serde(skip_serializing_if = "Option::is_none")]
    assets: Option<PathBuf>,
}

/// Flags of `welkin serve`.
#[derive(Args, Clone, Debug, Default, Serialize)]
pub(crate) struct ServeFlags {
    #[command(flatten)]
    #[serde(flatten)]
    device: DeviceFlags,
    /// Address and port [default: 127.0.0.1:8080]
    #[arg(long, value_name = "ADDRESS:PORT")]
    #[serde(skip_serializing_if = "Option::is_none")]
    listen: Option<String>,
    /// The largest asset, bytes [default: 67108864]
    #[arg(long, value_name = "BYTES")]
    #[serde(skip_serializing_if = "Option::is_none")]
    max_asset_bytes: Option<u64>,
    /// Most assets; 0 keeps none, and scenes can name none [default: 1000]
    #[arg(long, value_name = "COUNT")]
    #[serde(skip_serializing_if = "Option::is_none")]
    max_assets: Option<u32>,
    /// All assets together, bytes [default: 1073741824]
    #[arg(long, value_name = "BYTES")]
    #[serde(skip_serializing_if = "Option::is_none")]
    assets_bytes: Option<u64>,
    /// Orders that wait or are rendered at once; more are answered 503 [default: 64]
    #[arg(long, value_name = "COUNT")]
    #[serde(skip_serializing_if = "Option::is_none")]
    queue_places: Option<usize>,
    /// Memory for finished frames, bytes [default: 268435456]
    #[arg(long, value_name = "BYTES")]
    #[serde(skip_serializing_if = "Option::is_none")]
    cache_bytes: Option<u64>,
    /// Memory for the pixels of frames in work, bytes; 12 a pixel for radiance, 3 for a picture
    /// [default: 4294967296]
    #[arg(long, value_name = "BYTES")]
    #[serde(skip_serializing_if = "Option::is_none")]
    frame_memory_bytes: Option<u64>,
    /// The largest frame, pixels [default: 268435456]
    #[arg(long, value_name = "PIXELS")]
    #[serde(skip_serializing_if = "Option::is_none")]
    max_frame_pixels: Option<u64>,
    /// Live viewers at once [default: 64]
    #[arg(long, value_name = "COUNT")]
    #[serde(skip_serializing_if = "Option::is_none")]
    max_viewers: Option<u32>,
    /// What is logged: error, warn, info, debug, or a filter such as welkin_service=debug [default: info]
    #[arg(long, value_name = "FILTER")]
    #[serde(skip_serializing_if = "Option::is_none")]
    log: Option<String>,
    /// How log lines look [default: text]
    #[arg(long, value_name = "FORMAT")]
    #[serde(skip_serializing_if = "Option::is_none")]
    log_format: Option<LogFormat>,
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
            ..welkin_service::Settings::default()
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(
        clippy::unwrap_used,
        clippy::result_large_err,
        reason = "tests fail by panicking; the error is figment's"
    )]

    use super::*;
    use clap::CommandFactory;
    use figment::Jail;

    #[derive(clap::Parser)]
    struct Flags {
        #[command(flatten)]
        flags: ServeFlags,
    }

    #[test]
    fn flags_beat_the_environment_beats_the_file_beats_defaults() {
        Jail::expect_with(|jail| {
            let load = |flags: &ServeFlags| Settings::load(None, flags).map_err(|e| *e);
            assert_eq!(load(&ServeFlags::default())?, Settings::default());
            jail.create_file(
                "welkin.toml",
                "listen = \"file\"\nmax_viewers = 3\nlog_format = \"json\"",
            )?;
            jail.set_env("WELKIN_LISTEN", "environment");
            jail.set_env("WELKIN_MAX_VIEWERS", "4");
            jail.set_env("WELKIN_SOMETHING_ELSE", "is nobody's business");
            let flags = ServeFlags {
                listen: Some("flag".into()),
                ..ServeFlags::default()
            };
            let settings = load(&flags)?;
            assert_eq!(settings.listen, "flag");
            assert_eq!(settings.max_viewers, 4);
            assert_eq!(settings.log_format, LogFormat::Json);
            assert_eq!(settings.cache_bytes, Settings::default().cache_bytes);
            Ok(())
        });
    }

    #[test]
    fn files_are_kept_where_the_user_says_or_keeps_such_things() {
        Jail::expect_with(|jail| {
            let load = |flags: &ServeFlags| Settings::load(None, flags).map_err(|e| *e);
            jail.set_env("XDG_CACHE_HOME", "/caches");
            let users_own = load(&ServeFlags::default())?.cache_folder();
            if cfg!(target_os = "linux") {
                assert_eq!(users_own, Some("/caches/welkin".into()));
            }
            jail.set_env("WELKIN_CACHE_DIR", "");
            assert_eq!(load(&ServeFlags::default())?.cache_folder(), users_own);
            jail.set_env("WELKIN_CACHE_DIR", "/elsewhere");
            assert_eq!(
                load(&ServeFlags::default())?.cache_folder(),
                Some("/elsewhere".into())
            );
            let mut flags = ServeFlags::default();
            flags.device.cache_dir = Some("here".into());
            assert_eq!(load(&flags)?.cache_folder(), Some("here".into()));
            flags.device.disk_cache_bytes = Some(0);
            assert_eq!(load(&flags)?.cache_folder(), None);
            jail.set_env("XDG_DATA_HOME", "/data");
            let users_own = load(&ServeFlags::default())?.assets_folder();
            if cfg!(target_os = "linux") {
                assert_eq!(users_own, Some("/data/welkin/assets".into()));
            }
            jail.set_env("WELKIN_ASSETS", "");
            assert_eq!(load(&ServeFlags::default())?.assets_folder(), users_own);
            jail.set_env("WELKIN_ASSETS", "/maps");
            assert_eq!(
                load(&ServeFlags::default())?.assets_folder(),
                Some("/maps".into())
            );
            flags.device.assets = Some("here".into());
            assert_eq!(load(&flags)?.assets_folder(), Some("here".into()));
            jail.set_env("WELKIN_MAX_ASSETS", "0");
            assert_eq!(load(&flags)?.assets_folder(), None);
            Ok(())
        });
    }

    #[test]
    fn what_is_wrong_is_named() {
        Jail::expect_with(|jail| {
            jail.create_file("other.toml", "max_viewrs = 3")?;
            let error = Settings::load(Some(Path::new("other.toml")), &ServeFlags::default()).unwrap_err();
            assert!(error.to_string().contains("max_viewrs"), "{error}");
            assert!(Settings::load(Some(Path::new("missing.toml")), &ServeFlags::default()).is_err());
            jail.set_env("WELKIN_CACHE_BYTES", "plenty");
            let error = Settings::load(None, &ServeFlags::default()).unwrap_err();
            assert!(
                error.to_string().to_lowercase().contains("cache_bytes"),
                "{error}"
            );
            Ok(())
        });
    }

    /// The help repeats the defaults in words; this keeps it true.
    #[test]
    fn the_help_tells_the_defaults() {
        let help = Flags::command().render_long_help().to_string();
        let words = help.split_whitespace().collect::<Vec<_>>().join(" ");
        let defaults = serde_json::to_value(Settings::default()).unwrap();
        for name in NAMES {
            let flag = format!("--{}", name.replace('_', "-"));
            let value = match &defaults[name] {
                serde_json::Value::Null if name == "cache_dir" => {
                    "welkin in the user's folder for caches".to_owned()
                }
                serde_json::Value::Null if name == "assets" => {
                    "welkin/assets in the user's folder for data".to_owned()
                }
                serde_json::Value::Null => "the fastest".to_owned(),
                serde_json::Value::String(text) => text.clone(),
                other => other.to_string(),
            };
            let (_, after) = words
                .split_once(&format!("{flag} "))
                .or_else(|| words.split_once(&format!("{flag}[")))
                .unwrap();
            let (_, told) = after.split_once("[default: ").unwrap();
            assert!(
                told.starts_with(&format!("{value}]")),
                "{flag}: {value}, told {told:.40}"
            );
        }
    }
}
