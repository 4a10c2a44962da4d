//! `welkin probe`

use super::{Failure, assets, document, document::STANDARD, logging, waiting::wait_for};
use crate::settings::{DeviceFlags, Settings};
use serde_json::{Value, json};
use std::path::Path;
use welkin_scene::{ProbeRequest, renderer::ProbeOrder};

/// Arguments of `welkin probe`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Scene document: a file, - for standard input, or preset:NAME
    scene: String,
    /// JSON array of directions: a file, - for standard input, or the array itself, for example
    /// '[[0, 0, 1], {"azimuth_deg": 180, "elevation_deg": 10}]'
    directions: String,
    #[command(flatten)]
    device: DeviceFlags,
}

/// Prints the answer to a probe.
///
/// # Errors
/// Where scene or directions are refused, or there is no device.
pub(crate) fn run(args: &Args, config: Option<&Path>) -> Result<(), Failure> {
    let settings = Settings::load(config, &args.device)?;
    logging::quiet();
    let request = request(args)?;
    let assets = assets::of_scene(&settings, &request.scene)?;
    let renderer = crate::open_renderer(&settings)?;
    let doing = format!("probing {} directions", request.directions.len());
    let answer = wait_for(&doing, renderer.probe(ProbeOrder { request, assets }))?;
    document::print(&json!(answer), false)
}

fn request(args: &Args) -> Result<ProbeRequest, Failure> {
    let (scene, directions) = (args.scene.as_str(), args.directions.as_str());
    if scene == STANDARD && directions == STANDARD {
        return Err(Failure::Usage(
            "scene and directions cannot both come from standard input".into(),
        ));
    }
    let scene = document::scene(scene)?;
    let inline = directions.trim_start().starts_with('[');
    let text = if inline {
        directions.to_owned()
    } else {
        document::text(directions)?
    };
    let directions: Value = serde_json::from_str(&text)
        .map_err(|e| Failure::Usage(format!("the directions are not JSON: {e}")))?;
    Ok(ProbeRequest::from_value(
        &json!({"scene": scene, "directions": directions}),
    )?)
}
