//! What is made of all frames of a job: labels, films, the whole panorama.

use crate::{
    JobError, Jobs,
    frame::{Bench, Loaded, Trouble},
    jobs::beside,
};
use serde_json::{Value, json};
use std::{
    fs::File,
    io::{BufWriter, Write as _},
    sync::Arc,
};
use tempfile::TempDir;
use welkin_encode::file_extension;

/// The file of labels: one JSON object a line, in the frames' order.
const LABELS: &str = "labels.jsonl";

impl Bench {
    /// Makes what a job asks for. Made again, it is the same.
    pub(crate) async fn gather(&self, job: &Arc<Loaded>, jobs: &Jobs) -> Result<Value, Trouble> {
        let folder = TempDir::with_prefix("welkin-gather-")
            .map_err(JobError::file("making a folder for the files of a whole job"))?;
        let labels = folder.path().join(LABELS);
        let settled = jobs.queue.settled(job.id).await?;
        let (known, place) = (Arc::clone(job), labels.clone());
        beside(move || {
            let extension = file_extension(known.plan.request().format());
            let written = |file: std::io::Result<()>| file.map_err(JobError::file("writing labels"));
            let mut file = BufWriter::new(File::create(&place).map_err(JobError::file("writing labels"))?);
            for frame in settled {
                let planned = known.plan.frame(frame.frame)?;
                let mut line = json!({
                    "frame": frame.frame,
                    "file": format!("frames/{:06}.{extension}", frame.frame),
                    "parameters": planned.parameters,
                    "window": planned.window,
                    "scene": *planned.scene,
                });
                for name in ["sun", "sun_irradiance_w_m2", "moon", "moon_irradiance_w_m2", "ev100", "probe"] {
                    line[name] = frame.told[name].clone();
                }
                written(writeln!(file, "{line}"))?;
            }
            written(file.flush())
        })
        .await?;
        self.patiently("store", || async {
            let path = job.id.whole(LABELS);
            self.store.put_file(&path, &labels).await.map_err(Trouble::from)
        })
        .await?;
        Ok(Value::Null)
    }
}
