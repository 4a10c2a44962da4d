//! The command line.

mod assets;
mod bench;
mod client;
mod devices;
mod document;
mod failure;
mod jobs;
mod logging;
mod output;
mod presets;
mod probe;
mod render;
mod scene;
mod schema;
mod serve;
mod submit;
mod version;
mod waiting;
mod worker;

pub(crate) use failure::Failure;
pub(crate) use version::build;

use clap::{Parser, Subcommand};
use std::{path::PathBuf, process::ExitCode};

/// Physically based skies on request.
#[derive(Parser)]
#[command(
    name = "welkin",
    version,
    after_help = "Settings may also stand in the environment (WELKIN_LISTEN, WELKIN_ADAPTER, ...) or in a TOML file \
                  (listen, adapter, ...); flags go first, then the environment, then the file.\n\n\
                  Exit codes: 0 done; 2 wrong usage or not a scene; 3 no device to render on; 1 anything else."
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Answers and errors as JSON, for scripts; errors are problem documents (RFC 9457) on standard error
    #[arg(long, global = true)]
    json: bool,
    /// Settings file [default: welkin.toml in the working directory, where there is one]
    #[arg(long, global = true, value_name = "FILE", env = "WELKIN_CONFIG")]
    config: Option<PathBuf>,
}

#[derive(Subcommand)]
enum Command {
    /// Serve the page and the interface for programs
    Serve(serve::Args),
    /// Work on jobs from a queue, on this machine or another than the server's
    Worker(worker::Args),
    /// Send a job to a server
    Submit(submit::Args),
    /// List the jobs of a server, or watch, fetch or stop one
    Jobs(jobs::Args),
    /// Render one frame to a file
    Render(render::Args),
    /// Print radiance, transmittance and irradiance at exact directions, as JSON
    Probe(probe::Args),
    /// Print a complete scene: of a document with all defaults, or of a weather report
    Scene(scene::Args),
    /// Print the JSON Schema of a document
    Schema(schema::Args),
    /// List the presets, or print the scene of one
    Presets(presets::Args),
    /// List the devices of this machine
    Devices,
    /// Measure what frames cost
    Bench(bench::Args),
}

/// Runs what the command line says.
pub(crate) fn run() -> ExitCode {
    let Cli {
        command,
        json,
        config,
    } = Cli::parse();
    let config = config.as_deref();
    let done = match command {
        Command::Serve(args) => serve::run(&args, config),
        Command::Worker(args) => worker::run(&args, config),
        Command::Submit(args) => submit::run(&args, json),
        Command::Jobs(args) => jobs::run(&args, json),
        Command::Render(args) => render::run(&args, config),
        Command::Probe(args) => probe::run(&args, config),
        Command::Scene(args) => scene::run(&args, json),
        Command::Schema(args) => schema::run(&args),
        Command::Presets(args) => presets::run(&args, json),
        Command::Devices => devices::run(json),
        Command::Bench(args) => bench::run(&args, config, json),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            failure.tell(json);
            failure.exit_code()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
