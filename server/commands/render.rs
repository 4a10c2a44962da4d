//! `welkin render`

use super::{Failure, assets, document, document::STANDARD, logging, output::Output, waiting::wait_for};
use crate::settings::{DeviceFlags, Settings};
use serde_json::{Value, json};
use std::path::Path;
use welkin_encode::{Options, encode, format_from_path, output_for};
use welkin_scene::{
    Format, FrameRequest,
    renderer::{FrameOrder, Priority},
};

/// Arguments of `welkin render`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Scene document: a file, - for standard input, or preset:NAME; with --at-s, a timeline
    scene: String,
    /// Time in a timeline, seconds
    #[arg(long, value_name = "SECONDS", value_parser = document::seconds, allow_negative_numbers = true)]
    at_s: Option<f64>,
    /// File to write, - for standard output; its name tells the format
    #[arg(short, long, value_name = "FILE")]
    output: String,
    /// Width, pixels, 1 to 16384
    #[arg(long, value_name = "PIXELS", default_value_t = FrameRequest::default().width_px)]
    width_px: u32,
    /// Height, pixels, 1 to 16384
    #[arg(long, value_name = "PIXELS", default_value_t = FrameRequest::default().height_px)]
    height_px: u32,
    /// preview: at once; final: all detail
    #[arg(long, default_value = "final")]
    quality: String,
    /// png, jpeg, exr, exr-float, hdr, npy or raw [default: as the file's name ends]
    #[arg(long)]
    format: Option<String>,
    #[command(flatten)]
    device: DeviceFlags,
}

/// Renders a frame to a file.
///
/// # Errors
/// Where the scene, the size or the format is refused, there is no device, or the file cannot be written.
pub(crate) fn run(args: &Args, config: Option<&Path>) -> Result<(), Failure> {
    let settings = Settings::load(config, &args.device)?;
    logging::quiet();
    let (request, format) = request(args)?;
    let assets = assets::of_scene(&settings, &request.scene)?;
    let output = Output::open(&args.output)?;
    let renderer = crate::open_renderer(&settings)?;
    let order = FrameOrder {
        scene: request.scene.clone().into(),
        assets,
        width_px: request.width_px,
        height_px: request.height_px,
        quality: request.quality,
        output: output_for(format),
        priority: Priority::Interactive,
    };
    let doing = format!("rendering {} x {} pixels", request.width_px, request.height_px);
    let frame = wait_for(&doing, renderer.frame(order))?;
    let scene_json = serde_json::to_string(&request.scene).ok();
    let options = Options {
        scene_json,
        ..Options::default()
    };
    let encoding = async move { tokio::task::spawn_blocking(move || encode(&frame, format, &options)).await };
    let joined = |e: tokio::task::JoinError| Failure::file("encoding")(e.into());
    let bytes = wait_for("encoding", async {
        encoding.await.map_err(joined)?.map_err(Failure::from)
    })?;
    output.write(&bytes)
}

/// The request that the arguments make, checked as the service checks it.
fn request(args: &Args) -> Result<(FrameRequest, Format), Failure> {
    let mut rest = json!({"width_px": args.width_px, "height_px": args.height_px, "quality": args.quality});
    if let Some(format) = &args.format {
        rest["format"] = Value::from(format.as_str());
    }
    let request = FrameRequest::from_value(&rest)?;
    let format = match request.format {
        Some(format) => format,
        None if args.output == STANDARD => {
            return Err(Failure::Usage(
                "standard output has no name to tell the format: give --format".into(),
            ));
        }
        None => format_from_path(Path::new(&args.output))?,
    };
    // Once more as a whole, for what only scene and size together can get wrong.
    match args.at_s {
        Some(at_s) => {
            rest["timeline"] = json!(document::timeline(&args.scene)?);
            rest["at_s"] = at_s.into();
        }
        None => rest["scene"] = json!(document::scene(&args.scene)?),
    }
    let checked = FrameRequest::from_value(&rest)?;
    Ok((checked, format))
}
