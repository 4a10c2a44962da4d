//! What may go wrong, going wrong: workers killed, the database restarted, the store away, the disk full.

use crate::{
    fake::Fake,
    full::Full,
    place::{Place, assert_done, list},
    servers::{BUCKET, Postgres, S3},
};
use futures_util::TryStreamExt;
use object_store::{
    ObjectStore,
    aws::{AmazonS3, AmazonS3Builder},
    prefix::PrefixStore,
};
use std::{
    env,
    process::{Child, Command, Stdio},
    sync::Arc,
    time::{Duration, Instant},
};
use welkin_jobs::{JobError, JobId, Jobs, Queue, State, Store, Worker, WorkerSettings};

/// Set in processes that this test starts: they are workers.
const QUEUE: &str = "WELKIN_TEST_QUEUE";
const STORE: &str = "WELKIN_TEST_STORE";
/// What a frame takes.
const FRAME: Duration = Duration::from_millis(60);
const FRAMES: u32 = 500;
const KILLS: u32 = 10;
/// The time of a scene that ends the process that renders it.
const POISON: f64 = -13.0;

/// The worker that the fault test starts as a process of its own; run by itself it does nothing.
#[tokio::test(flavor = "multi_thread")]
async fn worker_process() {
    let (Ok(queue), Ok(store)) = (env::var(QUEUE), env::var(STORE)) else {
        return;
    };
    let jobs = Jobs::new(
        Queue::open(&queue).await.unwrap(),
        Store::open(&store).unwrap(),
        None,
    );
    let settings = WorkerSettings {
        frames: 2,
        heartbeat: Duration::from_secs(1),
        build: "test".into(),
    };
    let renderer = Fake::with(|order| {
        if order.scene.time_s == POISON {
            std::process::abort();
        }
        Ok(FRAME)
    });
    Worker::new(jobs, renderer, settings)
        .run(std::future::pending())
        .await;
}

/// Workers as processes.
struct Crew {
    environment: Vec<(&'static str, String)>,
    workers: Vec<Child>,
}

impl Crew {
    fn new(postgres: &Postgres, s3: &S3) -> Self {
        let places = [
            (QUEUE, postgres.address()),
            (STORE, format!("s3://{BUCKET}/tests")),
        ];
        Self {
            environment: places.into_iter().chain(s3.environment()).collect(),
            workers: Vec::new(),
        }
    }

    fn hire_up_to(&mut self, count: usize) {
        while self.workers.len() < count {
            let worker = Command::new(env::current_exe().unwrap())
                .args(["--exact", "faults::worker_process", "--nocapture"])
                .envs(self.environment.iter().cloned())
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .spawn();
            self.workers.push(worker.unwrap());
        }
    }

    /// Forgets those that have ended by themselves.
    fn bury(&mut self) {
        self.workers
            .retain_mut(|worker| worker.try_wait().unwrap().is_none());
    }

    /// kill -9
    fn kill(&mut self, which: usize) {
        let mut worker = self.workers.remove(which);
        worker.kill().unwrap();
        worker.wait().unwrap();
    }
}

impl Drop for Crew {
    fn drop(&mut self) {
        while !self.workers.is_empty() {
            self.kill(0);
        }
    }
}

/// The bucket, in this process.
fn bucket(s3: &S3) -> Arc<PrefixStore<AmazonS3>> {
    let builder = AmazonS3Builder::new()
        .with_bucket_name(BUCKET)
        .with_endpoint(s3.endpoint())
        .with_allow_http(true)
        .with_region("us-east-1")
        .with_access_key_id("any")
        .with_secret_access_key("any");
    Arc::new(PrefixStore::new(builder.build().unwrap(), "tests"))
}

/// Workers are killed at random, PostgreSQL is restarted, the store is away for five seconds: every frame is there
/// once, as one process makes it, and none failed.
#[tokio::test(flavor = "multi_thread")]
async fn no_frame_is_lost_or_spoilt_whatever_goes_down() {
    let (mut postgres, mut s3) = (Postgres::start(), S3::start());
    let document = list(FRAMES);

    let alone = Place::new().await;
    let worker = alone.worker(Fake::quick());
    let expected = alone.send(&document).await;
    assert_done(&alone.ended(expected).await, FRAMES);
    worker.stop().await;

    let (bucket, mut crew) = (bucket(&s3), Crew::new(&postgres, &s3));
    let queue = Queue::open(&postgres.address()).await.unwrap();
    let jobs = Jobs::new(queue, Store::new(bucket.clone()), None);
    let id = jobs.send(document.to_string(), None).await.unwrap().id;
    let begun = Instant::now();
    let (mut kills, mut restarted) = (0, false);
    let (mut away_since, mut was_away) = (None::<Instant>, false);
    let mut dice = 7_u32;
    let status = loop {
        crew.hire_up_to(3);
        tokio::time::sleep(Duration::from_millis(700)).await;
        if kills < KILLS && begun.elapsed() > Duration::from_secs(2) {
            // A linear congruence is random enough to choose whom to kill, and the same in every run.
            dice = dice.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            crew.kill((dice >> 16) as usize % 3);
            kills += 1;
        }
        let status = jobs.status(id).await;
        let done = status.as_ref().map_or(0, |status| status.counts.done);
        if done > FRAMES / 4 && !restarted {
            eprintln!("{:?}: PostgreSQL is restarted at {done} frames", begun.elapsed());
            postgres.restart();
            restarted = true;
        }
        if done > FRAMES / 2 && !was_away {
            eprintln!("{:?}: the store goes away at {done} frames", begun.elapsed());
            s3.stop();
            (away_since, was_away) = (Some(Instant::now()), true);
        }
        if away_since.is_some_and(|since| since.elapsed() > Duration::from_secs(5)) {
            eprintln!("{:?}: the store is back", begun.elapsed());
            s3.begin();
            away_since = None;
        }
        match status {
            Ok(status) if status.state.has_ended() => break status,
            other => assert!(begun.elapsed() < Duration::from_secs(200), "{other:?}"),
        }
    };
    eprintln!(
        "{:?}: {kills} workers were killed; {:?}",
        begun.elapsed(),
        status.counts
    );
    assert_done(&status, FRAMES);
    assert!(
        restarted && was_away && kills == KILLS,
        "the job was over before its faults"
    );
    for number in 0..FRAMES {
        let (one, many) = (
            frame(&alone.jobs, expected, number).await,
            frame(&jobs, id, number).await,
        );
        assert_eq!(one, many, "frame {number}");
    }
    let folder = object_store::path::Path::from(format!("jobs/{id}/frames"));
    let there: Vec<_> = bucket.list(Some(&folder)).try_collect().await.unwrap();
    assert_eq!(there.len(), FRAMES as usize);
}

/// A scene that takes its worker with it each time is given up after as many workers, and no other frame is.
#[tokio::test(flavor = "multi_thread")]
async fn a_scene_that_ends_its_workers_is_given_up_alone() {
    let place = Place::new().await;
    let mut crew = Crew {
        environment: vec![(QUEUE, place.queue()), (STORE, place.store())],
        workers: Vec::new(),
    };
    let mut document = list(12);
    document["frames"]["scenes"][5]["time_s"] = POISON.into();
    document["attempts"] = 2.into();
    let id = place.send(&document).await;
    let begun = Instant::now();
    let status = loop {
        crew.bury();
        crew.hire_up_to(2);
        let status = place.jobs.status(id).await.unwrap();
        if status.state.has_ended() {
            break status;
        }
        assert!(begun.elapsed() < Duration::from_secs(100), "{status:#?}");
        tokio::time::sleep(Duration::from_millis(100)).await;
    };
    assert_eq!(status.state, State::Failed);
    assert_eq!((status.counts.done, status.counts.failed), (11, 1), "{status:#?}");
    let [dead] = &status.failures[..] else {
        panic!("{status:#?}")
    };
    assert_eq!(dead.frame, Some(5));
    assert!(dead.reason.contains("given up after 2 attempts"), "{dead:?}");
}

async fn frame(jobs: &Jobs, id: JobId, number: u32) -> Vec<u8> {
    let (_, bytes) = jobs.result(id, &number.to_string()).await.unwrap();
    bytes.map_ok(|part| part.to_vec()).try_concat().await.unwrap()
}

/// A full disk: the frames that found no room fail and say so, what is there is whole, and with room all goes on.
#[tokio::test(flavor = "multi_thread")]
async fn a_full_disk_is_told_and_spoils_nothing() {
    let place = Place::new().await;
    let full = Full::new(&place.results(), 20);
    let jobs = place.with_store(Store::new(full.clone()));
    let worker = jobs.worker(Fake::quick());
    let id = jobs.send(&list(30)).await;
    let status = jobs.ended(id).await;
    assert_eq!(status.state, State::Failed);
    assert_eq!(
        (status.counts.done, status.counts.failed),
        (20, 10),
        "{status:#?}"
    );
    for failure in &status.failures {
        assert!(failure.reason.contains("No space left on device"), "{failure:?}");
    }
    for number in 0..30 {
        match jobs.jobs.result(id, &number.to_string()).await {
            Ok(_) => assert!(
                jobs.file(id, &number.to_string())
                    .await
                    .ends_with(b"IEND\xaeB`\x82")
            ),
            Err(error) => assert!(matches!(error, JobError::NoResult { .. }), "{error}"),
        }
    }
    full.make_room();
    let again = jobs.send(&list(30)).await;
    assert_done(&jobs.ended(again).await, 30);
    worker.stop().await;
}
