//! Writes the published figures of one set.

mod sets;
mod write;

use clap::Parser;
use std::{
    error::Error,
    fs,
    path::PathBuf,
    sync::atomic::{AtomicUsize, Ordering},
    thread,
};
use welkin_reference::{Effort, Medium, View, diffuse_irradiance, radiance};

/// Light in clear air by Monte Carlo, as JSON.
#[derive(Parser)]
struct Arguments {
    /// Which figures.
    set: sets::Set,
    /// Folder to write into.
    #[arg(long, default_value = "tests/oracles")]
    out: PathBuf,
    /// The figures do not depend on it.
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// Walks per view at most.
    #[arg(long, default_value_t = 6_000_000)]
    most_walks: u32,
}

/// Walks in a batch for each of the three bands.
const BATCH: u32 = 1_400;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    let set = arguments.set.plan();
    let effort = |group: usize, row: usize| Effort {
        batch: BATCH,
        relative_error: set.groups[group].relative_error,
        most_batches: (arguments.most_walks / (3 * BATCH)) as usize,
        seed: set.seed + row as u64,
    };
    let mut air = Vec::new();
    for group in &set.groups {
        air.push(Medium::from_scene(&group.scene()?).ok_or("a scene without air")?);
    }
    let jobs: Vec<(usize, View)> = set
        .groups
        .iter()
        .enumerate()
        .flat_map(|(i, group)| group.views.iter().map(move |view| (i, *view)))
        .collect();
    let rows = parallel(jobs.len(), arguments.threads, |row| {
        let (group, view) = jobs[row];
        let albedos = &set.groups[group].albedos;
        radiance(&air[group], &view, albedos, &effort(group, row))
            .map(|found| write::row(&view, albedos, &found))
    });
    let skies = parallel(set.groups.len(), arguments.threads, |group| {
        let albedos = &set.groups[group].albedos;
        set.groups[group]
            .suns()
            .into_iter()
            .enumerate()
            .map(|(i, view)| {
                let effort = effort(group, 500 + 10 * group + i);
                let found = diffuse_irradiance(&air[group], &view, albedos, &effort);
                write::sky(&view, albedos, &found)
            })
            .collect::<Vec<_>>()
    });
    // The jobs stand group by group, and so do their rows.
    let mut rows = rows.into_iter();
    let groups = set.groups.iter().zip(skies).map(|(group, skies)| {
        let rows = rows.by_ref().take(group.views.len()).flatten().collect();
        (group, rows, skies)
    });
    let text = write::document(&set, groups.collect());
    fs::create_dir_all(&arguments.out)?;
    fs::write(
        arguments.out.join(format!("reference_air_{}.json", set.name)),
        text,
    )?;
    Ok(())
}

/// `work` for each of 0..n, in order.
fn parallel<T: Send>(n: usize, threads: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let run = || {
        let mut done = Vec::new();
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            if i >= n {
                return done;
            }
            done.push((i, work(i)));
        }
    };
    let mut done: Vec<(usize, T)> = thread::scope(|scope| {
        let threads: Vec<_> = (0..threads.max(1)).map(|_| scope.spawn(run)).collect();
        let join = |thread: thread::ScopedJoinHandle<'_, _>| {
            thread
                .join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        };
        threads.into_iter().flat_map(join).collect()
    });
    done.sort_by_key(|(i, _)| *i);
    done.into_iter().map(|(_, value)| value).collect()
}
