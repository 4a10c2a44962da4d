//! `welkin schema`

use super::{Failure, document};
use clap::ValueEnum;
use welkin_scene::schema;

/// Arguments of `welkin schema`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Which document
    #[arg(default_value = "scene")]
    document: Document,
}

/// A document that has a schema.
#[derive(Clone, Copy, ValueEnum)]
enum Document {
    /// The scene document
    Scene,
    /// A request for a frame
    Frame,
    /// A request for a probe
    Probe,
    /// A timeline
    Timeline,
}

/// Prints a schema.
///
/// # Errors
/// Where standard output is closed.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let schema = match args.document {
        Document::Scene => schema::scene_schema(),
        Document::Frame => schema::frame_request_schema(),
        Document::Probe => schema::probe_request_schema(),
        Document::Timeline => schema::timeline_schema(),
    };
    document::print(&schema, true)
}
