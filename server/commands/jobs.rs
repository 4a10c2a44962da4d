//! `welkin jobs`

use super::{
    Failure,
    client::{Server, ServerFlags},
    document,
};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::Value;
use std::{
    fmt::Write as _,
    fs::{self, File},
    future::Future,
    io::Write as _,
    path::{Path, PathBuf},
    time::Duration,
};

/// How often a job is looked at.
const LOOK: Duration = Duration::from_millis(500);

/// Arguments of `welkin jobs`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// A job; without it, the last ones are listed
    id: Option<String>,
    #[command(flatten)]
    server: ServerFlags,
    /// Watch it to its end
    #[arg(long, requires = "id")]
    wait: bool,
    /// Watch it to its end and write its results into this folder
    #[arg(short, long, value_name = "FOLDER", requires = "id")]
    output: Option<PathBuf>,
    /// Stop it
    #[arg(long, requires = "id", conflicts_with_all = ["wait", "output"])]
    cancel: bool,
    /// Remove it with all its results, once it has ended
    #[arg(long, requires = "id", conflicts_with_all = ["wait", "output", "cancel"])]
    remove: bool,
}

/// Lists jobs, or watches, fetches, stops or removes one.
///
/// # Errors
/// Where the server refuses or cannot be reached, or the job ends badly while it is watched.
pub(crate) fn run(args: &Args, json: bool) -> Result<(), Failure> {
    let server = Server::new(&args.server)?;
    block_on(async {
        let Some(id) = &args.id else {
            let page = server.get("/v1/jobs").await?;
            return tell(&page, json, || {
                page["jobs"].as_array().into_iter().flatten().map(line).collect()
            });
        };
        if args.cancel {
            let job = server.cancel(id).await?;
            return tell(&job, json, || line(&job));
        }
        if args.remove {
            return server.remove(id).await;
        }
        if args.wait || args.output.is_some() {
            return watch(&server, id, args.output.as_deref(), json).await;
        }
        let job = server.get(&format!("/v1/jobs/{id}")).await?;
        tell(&job, json, || whole(&job))
    })
}

fn tell(document: &Value, json: bool, text: impl FnOnce() -> String) -> Result<(), Failure> {
    if json {
        document::print(document, true)
    } else {
        document::print_text(&text())
    }
}

/// Watches a job to its end; writes its results into a folder, where one is given.
///
/// # Errors
/// Where the job did not end well, or its results cannot be had.
pub(crate) async fn watch(
    server: &Server,
    id: &str,
    output: Option<&Path>,
    json: bool,
) -> Result<(), Failure> {
    let path = format!("/v1/jobs/{id}");
    let mut job = server.get(&path).await?;
    let bar = bar(frames(&job), "rendering");
    while job["ended_at"].is_null() {
        bar.set_position(job["counts"]["done"].as_u64().unwrap_or_default());
        bar.set_message(message(&job));
        tokio::time::sleep(LOOK).await;
        job = server.get(&path).await?;
    }
    bar.finish_and_clear();
    if let Some(folder) = output {
        fetch(server, &job, folder).await?;
    }
    tell(&job, json, || whole(&job))?;
    match job["state"].as_str() {
        Some("done") => Ok(()),
        state => Err(Failure::Job(format!("job {id} has {}", state.unwrap_or("ended")))),
    }
}

/// Writes all results into a folder: frames by their numbers, and what was made of them.
async fn fetch(server: &Server, job: &Value, folder: &Path) -> Result<(), Failure> {
    let id = job["id"].as_str().unwrap_or_default();
    fs::create_dir_all(folder).map_err(Failure::file(format!("making {}", folder.display())))?;
    let extension = match job["format"].as_str() {
        Some("jpeg") => "jpg",
        Some("exr" | "exr-float") => "exr",
        Some(other) => other,
        None if job["kind"] == "panorama" => "exr",
        None => "png",
    };
    let missing: Vec<_> = job["failures"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|f| f["frame"].as_u64())
        .collect();
    let numbers = (0..frames(job)).filter(|number| !missing.contains(number));
    let named = numbers.map(|number| (number.to_string(), format!("{number:06}.{extension}")));
    let files = job["files"].as_array().into_iter().flatten();
    let files = files.filter_map(|file| {
        Some((
            file["name"].as_str()?.to_owned(),
            file["name"].as_str()?.to_owned(),
        ))
    });
    let all: Vec<_> = named.chain(files).collect();
    let bar = bar(all.len() as u64, "fetching");
    for (result, name) in all {
        let place = folder.join(name);
        let writing = || Failure::file(format!("writing {}", place.display()));
        let part = place.with_extension("part");
        let mut file = File::create(&part).map_err(writing())?;
        server
            .fetch(&format!("/v1/jobs/{id}/results/{result}"), |piece| {
                file.write_all(piece)
            })
            .await?;
        fs::rename(&part, &place).map_err(writing())?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(())
}

fn frames(job: &Value) -> u64 {
    job["frames"].as_u64().unwrap_or_default()
}

fn bar(length: u64, doing: &str) -> ProgressBar {
    let style = ProgressStyle::with_template("{prefix} {wide_bar} {pos}/{len} {msg}");
    let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length)
        .with_style(style)
        .with_prefix(doing.to_owned())
}

/// What stands behind the bar.
fn message(job: &Value) -> String {
    let mut text = format!("{:.1}/s", job["rate_per_s"].as_f64().unwrap_or_default());
    if let Some(eta_s) = job["eta_s"].as_f64() {
        let _ = write!(text, ", {eta_s:.0} s left");
    }
    match job["counts"]["failed"].as_u64() {
        None | Some(0) => {}
        Some(failed) => {
            let _ = write!(text, ", {failed} failed");
        }
    }
    match job["state"].as_str() {
        Some("running") | None => {}
        Some(state) => {
            let _ = write!(text, ", {state}");
        }
    }
    text
}

/// A job in one line.
fn line(job: &Value) -> String {
    let text = |name: &str| job[name].as_str().unwrap_or_default().to_owned();
    format!(
        "{}  {:9}  {:8}  {:>6}/{:<6}  {}  {}\n",
        text("id"),
        text("state"),
        text("kind"),
        job["counts"]["done"],
        job["frames"],
        text("created_at"),
        text("name"),
    )
}

/// A job with all that is to be said of it.
fn whole(job: &Value) -> String {
    let mut text = line(job);
    for failure in job["failures"].as_array().into_iter().flatten() {
        let frame = failure["frame"]
            .as_u64()
            .map_or_else(|| "the whole".into(), |n| format!("frame {n}"));
        let reason = failure["reason"].as_str().unwrap_or_default();
        let _ = writeln!(
            text,
            "  {frame} failed after {} attempts: {reason}",
            failure["attempts"]
        );
    }
    for note in job["notes"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(Value::as_str)
    {
        let _ = writeln!(text, "  {note}");
    }
    for file in job["files"].as_array().into_iter().flatten() {
        let _ = writeln!(
            text,
            "  {} ({} bytes)",
            file["name"].as_str().unwrap_or_default(),
            file["bytes"]
        );
    }
    text
}

/// Runs to the end, or to an interrupt.
///
/// # Errors
/// Those of the work; [`Failure::Interrupted`].
pub(crate) fn block_on(work: impl Future<Output = Result<(), Failure>>) -> Result<(), Failure> {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
    runtime.map_err(Failure::file("starting"))?.block_on(async {
        tokio::select! {
            done = work => done,
            _ = tokio::signal::ctrl_c() => Err(Failure::Interrupted),
        }
    })
}
