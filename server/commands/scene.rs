//! `welkin scene`

use super::{Failure, document, document::STANDARD};
use serde_json::json;
use std::time::SystemTime;
use welkin_scene::{MetarAnswer, MetarRequest};

/// Arguments of `welkin scene`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Scene document: a file, - for standard input, or preset:NAME; with --at-s, a timeline
    #[arg(required_unless_present = "metar", conflicts_with = "metar")]
    scene: Option<String>,
    /// Time in a timeline, seconds
    #[arg(
        long,
        value_name = "SECONDS",
        value_parser = document::seconds,
        conflicts_with = "metar",
        allow_negative_numbers = true
    )]
    at_s: Option<f64>,
    /// Weather report (METAR or SPECI) that tells the air, the time and the place; - for standard input. With --json the
    /// answer of POST /v1/scenes/from-metar is printed, the report with the scene
    #[arg(long, value_name = "REPORT")]
    metar: Option<String>,
    /// The report is the last of its day up to the end of this date [default: up to now]
    #[arg(long, value_name = "YYYY-MM-DD", requires = "metar", conflicts_with = "scene")]
    date: Option<String>,
    /// Where the station is, north positive [default: as its indicator tells]
    #[arg(
        long,
        value_name = "DEGREES",
        requires = "metar",
        conflicts_with = "scene",
        allow_negative_numbers = true
    )]
    latitude_deg: Option<f64>,
    /// Where the station is, east positive [default: as its indicator tells]
    #[arg(
        long,
        value_name = "DEGREES",
        requires = "metar",
        conflicts_with = "scene",
        allow_negative_numbers = true
    )]
    longitude_deg: Option<f64>,
}

/// Prints a complete scene; what was assumed goes to standard error.
///
/// # Errors
/// Where the scene or the report is refused.
pub(crate) fn run(args: &Args, json: bool) -> Result<(), Failure> {
    let Some(metar) = &args.metar else {
        let name = args.scene.as_deref().unwrap_or(STANDARD);
        let scene = match args.at_s {
            Some(at_s) => document::timeline(name)?.at(at_s)?,
            None => document::scene(name)?,
        };
        return document::print(&json!(scene), !json);
    };
    let answer = request(args, metar)?.scene(SystemTime::now())?;
    if json {
        return document::print(&json!(answer), false);
    }
    tell(&answer);
    document::print(&json!(answer.scene), true)
}

/// The request that the arguments make, checked as the service checks it.
fn request(args: &Args, metar: &str) -> Result<MetarRequest, Failure> {
    let metar = if metar == STANDARD {
        document::text(metar)?
    } else {
        metar.to_owned()
    };
    let request = MetarRequest {
        metar,
        date: args.date.clone(),
        latitude_deg: args.latitude_deg,
        longitude_deg: args.longitude_deg,
    };
    Ok(MetarRequest::from_value(&json!(request))?)
}

fn tell(answer: &MetarAnswer) {
    for note in &answer.notes {
        eprintln!("note: {note}");
    }
    if !answer.not_rendered.is_empty() {
        eprintln!("note: not rendered: {}", answer.not_rendered.join(", "));
    }
}
