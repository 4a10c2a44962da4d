//! `welkin submit`

use super::{
    Failure,
    client::{Server, ServerFlags},
    document, jobs,
};
use serde_json::json;
use std::path::PathBuf;
use welkin_scene::JobRequest;

/// Arguments of `welkin submit`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Document of the job: a file, or - for standard input
    job: String,
    #[command(flatten)]
    server: ServerFlags,
    /// Stands for this document: sent again with the same key, it is the same job
    #[arg(long, value_name = "TEXT")]
    key: Option<String>,
    /// Watch it to its end
    #[arg(long)]
    wait: bool,
    /// Watch it to its end and write its results into this folder
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
}

/// Sends a job.
///
/// # Errors
/// Where the document is no job, the server refuses it, or it ends badly while it is watched.
pub(crate) fn run(args: &Args, json: bool) -> Result<(), Failure> {
    let text = document::text(&args.job)?;
    // The same check as the server's, but for assets: what is wrong is told even where no server can be reached.
    let request = JobRequest::from_json(&text)?;
    let document = json!(request).to_string();
    let server = Server::new(&args.server)?;
    jobs::block_on(async {
        let job = server.submit(document, args.key.as_deref()).await?;
        let id = job["id"].as_str().unwrap_or_default().to_owned();
        if !args.wait && args.output.is_none() {
            return if json {
                document::print(&job, true)
            } else {
                document::print_text(&format!("{id}\n"))
            };
        }
        if !json {
            document::print_text(&format!("{id}\n"))?;
        }
        jobs::watch(&server, &id, args.output.as_deref(), json).await
    })
}
