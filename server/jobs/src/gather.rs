//! What is made of all frames of a job: labels, films, the whole panorama.

use crate::{
    JobError, Jobs,
    film::{Making, Shape, decoded},
    frame::{Bench, Loaded, Trouble},
    jobs::beside,
    queue::Settled,
};
use bytes::Bytes;
use serde_json::{Value, json};
use std::{
    fs::File,
    io::{BufWriter, Write as _},
    path::{Path, PathBuf},
    sync::Arc,
};
use tempfile::TempDir;
use tokio::{runtime::Handle, sync::mpsc};
use welkin_encode::{Options, Tiles, decode_exr, file_extension, write_tiled_exr};
use welkin_scene::job::{Frames, TimelineFrames};

/// The file of labels: one JSON object a line, in the frames' order.
const LABELS: &str = "labels.jsonl";
/// The file of a panorama.
const PANORAMA: &str = "panorama.exr";
/// Frames that are read ahead of the films.
const AHEAD: usize = 4;

impl Bench {
    /// Makes what a job asks for. Made again, it is the same.
    pub(crate) async fn gather(&self, job: &Arc<Loaded>, jobs: &Jobs) -> Result<Value, Trouble> {
        let folder = TempDir::with_prefix("welkin-gather-")
            .map_err(JobError::file("making a folder for the files of a whole job"))?;
        let settled: Arc<[Settled]> = jobs.queue.settled(job.id).await?.into();
        let mut files = vec![self.labels(job, &settled, folder.path()).await?];
        match &job.plan.request().frames {
            Frames::Timeline(lapse) => {
                let (films, notes) = self.films(job, lapse, &settled, folder.path()).await?;
                files.extend(films);
                jobs.queue.note(job.id, &notes).await?;
            }
            Frames::Panorama(_) => files.extend(self.panorama(job, &settled, folder.path()).await?),
            Frames::List(_) | Frames::Grid(_) | Frames::Random(_) => {}
        }
        for file in &files {
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            let path = job.id.whole(&name);
            self.patiently("store", || async {
                self.store.put_file(&path, file).await.map_err(Trouble::from)
            })
            .await?;
        }
        Ok(Value::Null)
    }

    async fn labels(
        &self,
        job: &Arc<Loaded>,
        settled: &Arc<[Settled]>,
        folder: &Path,
    ) -> Result<PathBuf, Trouble> {
        let (job, settled, place) = (Arc::clone(job), Arc::clone(settled), folder.join(LABELS));
        let written = beside(move || {
            let writing = || JobError::file("writing labels");
            let mut file = BufWriter::new(File::create(&place).map_err(writing())?);
            for frame in settled.iter() {
                writeln!(file, "{}", label(&job, frame)?).map_err(writing())?;
            }
            file.flush().map_err(writing())?;
            Ok(place)
        });
        Ok(written.await?)
    }

    /// Films of the frames that are there, and what is to be said of those that could not be made.
    async fn films(
        &self,
        job: &Loaded,
        lapse: &TimelineFrames,
        settled: &[Settled],
        folder: &Path,
    ) -> Result<(Vec<PathBuf>, Vec<String>), Trouble> {
        let request = job.plan.request();
        let shape = Shape {
            width_px: request.width_px,
            height_px: request.height_px,
            frames: u32::try_from(settled.len()).unwrap_or(u32::MAX),
            fps: lapse.fps,
            format: request.format(),
        };
        if settled.is_empty() || lapse.films.is_empty() {
            return Ok((Vec::new(), Vec::new()));
        }
        let (frames, reading) = mpsc::channel(AHEAD);
        let (films, folder) = (lapse.films.clone(), folder.to_owned());
        let making = tokio::spawn(beside(move || make(&films, &folder, shape, reading)));
        for frame in settled {
            let file = self.file(job, frame.frame).await?;
            if frames.send(file).await.is_err() {
                // It ended early, and says why below.
                break;
            }
        }
        drop(frames);
        let made = making
            .await
            .map_err(|e| Trouble::Passing(format!("a film ended early: {e}")))?;
        Ok(made?)
    }

    async fn panorama(
        &self,
        job: &Arc<Loaded>,
        settled: &[Settled],
        folder: &Path,
    ) -> Result<Option<PathBuf>, Trouble> {
        let request = job.plan.request();
        let Frames::Panorama(panorama) = &request.frames else {
            return Ok(None);
        };
        if settled.len() != job.plan.count() as usize {
            return Err(Trouble::Lasting("tiles of the panorama failed".into()));
        }
        let tiles = Tiles {
            width_px: request.width_px,
            height_px: request.height_px,
            tile_px: panorama.tile_px,
        };
        let first = job.plan.frame(0).map_err(JobError::from)?;
        let told = settled
            .first()
            .map(|frame| frame.told.clone())
            .unwrap_or_default();
        let options = Options {
            software: format!("Welkin {}", self.build),
            scene_json: serde_json::to_string(&*first.scene).ok(),
            ..Options::default()
        };
        let (store, place, known) = (self.store.clone(), folder.join(PANORAMA), Arc::clone(job));
        let (format, handle) = (request.format(), Handle::current());
        let written = beside(move || {
            let facts = serde_json::from_value(told).map_err(|e| JobError::Damaged(e.to_string()))?;
            let file = File::create(&place).map_err(JobError::file("writing a panorama"))?;
            let tile = |number: u32| {
                let path = known.id.frame(number, file_extension(format));
                let file = handle.block_on(store.get(&path)).map_err(|e| e.to_string())?;
                let file = file.ok_or_else(|| format!("{path} is not in the store"))?;
                decode_exr(&file)
                    .map(|(_, _, samples)| samples)
                    .map_err(|e| e.to_string())
            };
            write_tiled_exr(file, tiles, format, &facts, &options, tile)
                .map_err(|e| JobError::Damaged(e.to_string()))?;
            Ok(place)
        });
        Ok(Some(written.await?))
    }

    /// A frame's file.
    async fn file(&self, job: &Loaded, number: u32) -> Result<Bytes, Trouble> {
        let path = job.id.frame(number, file_extension(job.plan.request().format()));
        let found = self
            .patiently("store", || async {
                self.store.get(&path).await.map_err(Trouble::from)
            })
            .await?;
        found.ok_or_else(|| Trouble::Lasting(format!("{path} is not in the store")))
    }
}

/// What is to be known of a frame without looking at it.
fn label(job: &Loaded, frame: &Settled) -> Result<Value, JobError> {
    let planned = job.plan.frame(frame.frame)?;
    let extension = file_extension(job.plan.request().format());
    let mut label = json!({
        "frame": frame.frame,
        "file": format!("frames/{:06}.{extension}", frame.frame),
        "parameters": planned.parameters,
        "window": planned.window,
        "scene": *planned.scene,
    });
    for name in [
        "sun",
        "sun_irradiance_w_m2",
        "moon",
        "moon_irradiance_w_m2",
        "ev100",
        "probe",
    ] {
        label[name] = frame.told[name].clone();
    }
    Ok(label)
}

/// Makes all films at once, so that each frame is read and decoded once.
fn make(
    films: &[welkin_scene::job::Film],
    folder: &Path,
    shape: Shape,
    mut frames: mpsc::Receiver<Bytes>,
) -> Result<(Vec<PathBuf>, Vec<String>), JobError> {
    let (mut making, mut notes) = (Vec::new(), Vec::new());
    for film in films {
        match Making::begin(*film, folder, shape)? {
            Some(begun) => making.push(begun),
            None => notes.push(format!(
                "film.{} was not made: there is no ffmpeg where the worker ran",
                film.extension()
            )),
        }
    }
    while let Some(file) = frames.blocking_recv() {
        let rgb = decoded(&file, shape.format)?;
        for film in &mut making {
            film.add(&file, &rgb, shape)?;
        }
    }
    let made = making
        .into_iter()
        .map(|film| Ok(film.finish()?.1))
        .collect::<Result<_, JobError>>()?;
    Ok((made, notes))
}
