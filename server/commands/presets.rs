//! `welkin presets`

use super::{Failure, document};
use serde_json::json;
use welkin_scene::preset::presets;

/// Arguments of `welkin presets`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Print the scene document of this one
    name: Option<String>,
}

/// Lists the presets, or prints the scene of one.
///
/// # Errors
/// Where there is none of that name.
pub(crate) fn run(args: &Args, json: bool) -> Result<(), Failure> {
    match &args.name {
        Some(name) => document::print(&json!(document::named_preset(name)?.scene), true),
        None if json => document::print(&json!(presets()), true),
        None => {
            let line = |preset: &_| {
                let welkin_scene::preset::Preset {
                    name, description, ..
                } = preset;
                format!("{name:<17} {description}\n")
            };
            document::print_text(&presets().iter().map(line).collect::<String>())
        }
    }
}
