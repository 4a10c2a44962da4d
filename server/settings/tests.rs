//! Tests of what sets what.
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
        let (queue, store) = load(&flags)?.job_places().unwrap();
        if cfg!(target_os = "linux") {
            assert_eq!(
                (queue.as_str(), store.as_str()),
                ("sqlite:/data/welkin/jobs.db", "file:/data/welkin/results")
            );
        }
        jail.set_env("WELKIN_QUEUE", "postgres://somewhere");
        flags.jobs.store = Some("s3://bucket".into());
        assert_eq!(
            load(&flags)?.job_places(),
            Some(("postgres://somewhere".into(), "s3://bucket".into()))
        );
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
            serde_json::Value::Null if name == "queue" => {
                "jobs.db in welkin in the user's folder for data".to_owned()
            }
            serde_json::Value::Null if name == "store" => {
                "results in welkin in the user's folder for data".to_owned()
            }
            serde_json::Value::Null if name == "otlp" => "nowhere".to_owned(),
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
