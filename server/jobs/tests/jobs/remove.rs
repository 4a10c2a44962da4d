//! What becomes of jobs and assets that are removed, and how full the store may get.

use crate::{
    fake::Fake,
    place::{Place, assert_done, list},
    servers::Postgres,
};
use serde_json::json;
use std::{
    fs,
    path::{Path, PathBuf},
    sync::Arc,
    time::Duration,
};
use welkin_assets::Kind;
use welkin_jobs::{JobError, JobId, Jobs, Limits, Queue, State, Store};

/// All files below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let Ok(inside) = fs::read_dir(folder) else {
        return Vec::new();
    };
    let paths = inside.map(|entry| entry.unwrap().path());
    let mut found: Vec<_> = paths
        .flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] })
        .collect();
    found.sort();
    found
}

#[tokio::test(flavor = "multi_thread")]
async fn a_removed_job_is_gone_with_its_results_and_nothing_else_is() {
    let place = Place::new().await;
    let worker = place.worker(Fake::quick());
    let key = Some("the key");
    let id = place.jobs.send(list(3).to_string(), key).await.unwrap().id;
    let other = place.send(&list(5)).await;
    assert_done(&place.ended(id).await, 3);
    assert_done(&place.ended(other).await, 5);
    let folder = |id: JobId| place.results().join(format!("jobs/{id}"));
    let strange = place.results().join("jobs/README");
    fs::write(&strange, "of somebody else").unwrap();
    let kept = files(&folder(other));
    assert_eq!(files(&folder(id)).len(), 3 + 1);

    place.jobs.remove(id).await.unwrap();
    assert!(!folder(id).exists());
    assert_eq!(files(&folder(other)), kept);
    assert!(strange.exists());
    assert!(matches!(place.jobs.status(id).await, Err(JobError::Unknown(_))));
    assert!(matches!(place.jobs.remove(id).await, Err(JobError::Unknown(_))));
    assert_done(&place.jobs.status(other).await.unwrap(), 5);
    assert_eq!(place.jobs.rendering(other).await.unwrap().len(), 5);
    let listed: Vec<_> = place.jobs.list(None, 10).await.unwrap();
    assert_eq!(listed.iter().map(|job| job.id).collect::<Vec<_>>(), [other]);
    // Its tasks are gone too, or the same key could not stand for other frames.
    let again = place.jobs.send(list(2).to_string(), key).await.unwrap();
    assert!(again.is_new);
    assert_done(&place.ended(again.id).await, 2);
    worker.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_in_work_is_not_removed() {
    let place = Place::new().await;
    let id = place.send(&list(3)).await;
    let state = |done| match done {
        Err(JobError::Open { state, .. }) => state,
        other => panic!("{other:?}"),
    };
    assert_eq!(state(place.jobs.remove(id).await), State::Running.name());
    let worker = place.worker(Fake::with(|_| Ok(Duration::from_secs(600))));
    place.until(id, |status| status.counts.running > 0).await;
    place.jobs.cancel(id).await.unwrap();
    // What is still ending may put a file there.
    state(place.jobs.remove(id).await);
    place.until(id, |status| status.counts.running == 0).await;
    place.jobs.remove(id).await.unwrap();
    assert_eq!(files(&place.results()), Vec::<PathBuf>::new());
    worker.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn jobs_are_removed_when_they_are_old() {
    let place = Place::new().await;
    let worker = place.worker(Fake::quick());
    let (old, young) = (place.send(&list(2)).await, place.send(&list(1)).await);
    place.ended(old).await;
    worker.stop().await;
    let hour = Duration::from_secs(3600);
    assert_eq!(place.jobs.remove_old(hour).await.unwrap(), 0);
    let waiting = place.send(&list(1)).await;
    tokio::time::sleep(Duration::from_millis(20)).await;
    let removed = place.jobs.remove_old(Duration::from_millis(10)).await.unwrap();
    assert!((1..=2).contains(&removed), "{removed}");
    assert!(matches!(place.jobs.status(old).await, Err(JobError::Unknown(_))));
    assert!(!place.jobs.status(waiting).await.unwrap().state.has_ended());
    // The worker may have gone before or after it had ended this one.
    let left = place
        .jobs
        .status(young)
        .await
        .map(|status| status.state.has_ended());
    assert!(matches!(left, Ok(false) | Err(JobError::Unknown(_))), "{left:?}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_keeps_its_assets_when_they_are_removed() {
    let folder = tempfile::TempDir::new().unwrap();
    let assets = welkin_assets::Store::open(folder.path(), welkin_assets::Limits::default()).unwrap();
    let mut map = Vec::new();
    let mut encoder = png::Encoder::new(&mut map, 2, 2);
    encoder.set_color(png::ColorType::Grayscale);
    encoder
        .write_header()
        .unwrap()
        .write_image_data(&[0, 80, 160, 240])
        .unwrap();
    let name = welkin_assets::Name::new("front").unwrap();
    assets.put(Kind::WeatherMaps, &name, &map, |_| true).unwrap();
    let assets = Arc::new(assets);
    let place = Place::new().await.with_assets(Arc::clone(&assets));
    let map = json!({"kind": "asset", "name": "front"});
    let document = json!({"frames": {"kind": "list", "scenes": [{"clouds": {"weather_map": map}}]},
        "width_px": 8, "height_px": 4});
    let id = place.send(&document).await;
    assets.delete(Kind::WeatherMaps, &name, |_| true).unwrap();
    let refused = place.jobs.send(document.to_string(), None).await;
    assert!(refused.is_err(), "{refused:?}");
    let worker = place.worker(Fake::quick());
    assert_done(&place.ended(id).await, 1);
    worker.stop().await;
}

/// Sends from two processes' connections at once: as many are taken as there is room for, and no more.
async fn as_many_as_there_is_room_for(address: &str) {
    let folder = tempfile::TempDir::new().unwrap();
    let most = 400_000;
    let mut places = Vec::new();
    for _ in 0..2 {
        let store = Store::folder(folder.path()).unwrap();
        let limits = Limits {
            store_bytes: most,
            ..Limits::default()
        };
        places.push(Jobs::new(Queue::open(address).await.unwrap(), store, None).with_limits(limits));
    }
    let sending: Vec<_> = (0..40)
        .map(|n| {
            let place = places[n % 2].clone();
            tokio::spawn(async move { place.send(list(2).to_string(), None).await })
        })
        .collect();
    let (mut taken, mut weight) = (0, None);
    for one in sending {
        match one.await.unwrap() {
            Ok(_) => taken += 1,
            Err(JobError::Full { bytes, .. }) => weight = Some(bytes),
            Err(other) => panic!("{other}"),
        }
    }
    let room = most / weight.expect("40 jobs are too many");
    assert!(room > 1, "{weight:?}");
    assert_eq!(taken, room);
}

#[tokio::test(flavor = "multi_thread")]
async fn jobs_that_are_sent_at_once_find_room_one_after_the_other() {
    let folder = tempfile::TempDir::new().unwrap();
    as_many_as_there_is_room_for(&format!("sqlite:{}", folder.path().join("queue.db").display())).await;
    let postgres = Postgres::start();
    as_many_as_there_is_room_for(&postgres.address()).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn processes_that_start_together_make_one_queue() {
    let folder = tempfile::TempDir::new().unwrap();
    for round in 0..5 {
        let address = format!("sqlite:{}", folder.path().join(format!("{round}.db")).display());
        let opening: Vec<_> = (0..6)
            .map(|_| {
                let address = address.clone();
                tokio::spawn(async move { Queue::open(&address).await })
            })
            .collect();
        for one in opening {
            one.await.unwrap().unwrap();
        }
    }
}
