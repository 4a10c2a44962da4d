//! `/v1/jobs` as clients call it, with a worker beside the service.

use crate::{
    client::{Answer, call, get, json_request},
    fake::Fake,
};
use axum::{Router, body::Body, http::Request};
use serde_json::{Value, json};
use std::{sync::Arc, time::Duration};
use tempfile::TempDir;
use welkin_jobs::{Jobs, Limits, Queue, Store, Worker, WorkerSettings};
use welkin_service::{Service, Settings, app};

pub(crate) struct Place {
    pub(crate) app: Router,
    service: Service,
    jobs: Jobs,
    fake: Arc<Fake>,
    _folder: TempDir,
}

impl Place {
    pub(crate) async fn new() -> Self {
        Self::of(Fake::new()).await
    }

    async fn of(fake: Arc<Fake>) -> Self {
        let folder = TempDir::new().unwrap();
        let queue = format!("sqlite:{}", folder.path().join("jobs.db").display());
        let store = Store::folder(&folder.path().join("results")).unwrap();
        let limits = Limits {
            store_bytes: 40 << 20,
            max_frame_pixels: 640 * 360,
        };
        let jobs = Jobs::new(Queue::open(&queue).await.unwrap(), store, None).with_limits(limits);
        let service = Service::new(Arc::clone(&fake) as _, Settings::default()).with_jobs(jobs.clone());
        Self {
            app: app(service.clone()).unwrap(),
            service,
            jobs,
            fake,
            _folder: folder,
        }
    }

    fn work(&self) {
        let settings = WorkerSettings {
            frames: 2,
            heartbeat: Duration::from_secs(1),
            build: "test".into(),
        };
        let worker = Worker::new(self.jobs.clone(), Arc::clone(&self.fake) as _, settings);
        tokio::spawn(worker.with_calm(self.service.calm()).run(std::future::pending()));
    }

    pub(crate) async fn post(&self, document: &Value) -> Answer {
        call(&self.app, json_request("/v1/jobs", document.to_string())).await
    }

    async fn ended(&self, path: &str) -> Value {
        loop {
            let job = get(&self.app, path).await.json();
            if !job["ended_at"].is_null() {
                return job;
            }
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
    }
}

pub(crate) fn small(count: u32) -> Value {
    let scenes: Vec<_> = (0..count).map(|n| json!({"clouds": null, "time_s": n})).collect();
    json!({"name": "small", "frames": {"kind": "list", "scenes": scenes}, "width_px": 8, "height_px": 4})
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_is_sent_watched_and_fetched() {
    let place = Place::new().await;
    place.work();
    let sent = place.post(&small(5)).await;
    assert_eq!(sent.status, 202, "{}", sent.json());
    let path = sent.header("location").to_owned();
    let job = sent.json();
    assert_eq!(path, format!("/v1/jobs/{}", job["id"].as_str().unwrap()));
    assert_eq!(
        (&job["name"], &job["kind"], &job["frames"]),
        (&json!("small"), &json!("list"), &json!(5))
    );

    let news = get(&place.app, &format!("{path}/events")).await;
    assert_eq!(news.header("content-type"), "text/event-stream");
    let news = String::from_utf8(news.body.to_vec()).unwrap();
    let last = news.trim().rsplit("\n\n").next().unwrap();
    let data = last.strip_prefix("event: end\ndata: ").expect(last);
    let told: Value = serde_json::from_str(data).unwrap();
    assert_eq!(
        (&told["state"], &told["counts"]["done"]),
        (&json!("done"), &json!(5))
    );

    let job = place.ended(&path).await;
    assert_eq!(job["files"][0]["name"], "labels.jsonl", "{job}");
    assert_eq!(job["latest"].as_array().unwrap().len(), 4, "{job}");
    for number in 0..5 {
        let frame = get(&place.app, &format!("{path}/results/{number}")).await;
        assert_eq!(
            (frame.status.as_u16(), frame.header("content-type")),
            (200, "image/png")
        );
        assert!(
            frame
                .header("content-disposition")
                .contains(&format!("{number:06}.png"))
        );
        assert!(frame.body.starts_with(b"\x89PNG"));
    }
    let labels = get(&place.app, &format!("{path}/results/labels.jsonl")).await;
    assert_eq!(
        labels.header("content-length"),
        job["files"][0]["bytes"].to_string()
    );
    assert_eq!(labels.body.iter().filter(|byte| **byte == b'\n').count(), 5);
    for missing in ["5", "nothing.mp4", "..%2f..%2fjobs.db", "frames"] {
        get(&place.app, &format!("{path}/results/{missing}"))
            .await
            .problem(404);
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn frames_of_a_job_are_those_of_frames() {
    let place = Place::new().await;
    place.work();
    let sent = place.post(&small(3)).await;
    let path = sent.header("location").to_owned();
    place.ended(&path).await;
    let scene = json!({"clouds": null, "time_s": 2});
    let alone = json!({"scene": scene, "width_px": 8, "height_px": 4, "format": "png"});
    let alone = call(&place.app, json_request("/v1/frames", alone.to_string())).await;
    let frame = get(&place.app, &format!("{path}/results/2")).await;
    let pixels = |file: &[u8]| {
        let mut reader = png::Decoder::new(std::io::Cursor::new(file.to_vec()))
            .read_info()
            .unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        pixels
    };
    assert_eq!(pixels(&frame.body), pixels(&alone.body));
}

#[tokio::test(flavor = "multi_thread")]
async fn jobs_are_listed_page_by_page_and_stopped() {
    let place = Place::new().await;
    let mut sent = Vec::new();
    for _ in 0..5 {
        sent.push(place.post(&small(2)).await.json()["id"].clone());
    }
    sent.reverse();
    let (mut seen, mut path) = (Vec::new(), "/v1/jobs?limit=2".to_owned());
    loop {
        let page = get(&place.app, &path).await.json();
        seen.extend(
            page["jobs"]
                .as_array()
                .unwrap()
                .iter()
                .map(|job| job["id"].clone()),
        );
        let Some(next) = page["next"].as_str() else { break };
        path = format!("/v1/jobs?limit=2&before={next}");
    }
    assert_eq!(seen, sent);
    for (query, parameter) in [
        ("limit=0", "limit"),
        ("limit=x", "limit"),
        ("before=x", "before"),
        ("page=2", "page"),
    ] {
        let problem = get(&place.app, &format!("/v1/jobs?{query}")).await.problem(422);
        assert_eq!(problem["parameter"], parameter);
    }
    let path = format!("/v1/jobs/{}", sent[0].as_str().unwrap());
    for _ in 0..2 {
        let request = Request::delete(&path).body(Body::empty()).unwrap();
        let stopped = call(&place.app, request).await.json();
        assert_eq!(
            (&stopped["state"], &stopped["counts"]["cancelled"]),
            (&json!("cancelled"), &json!(2))
        );
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_key_stands_for_one_document() {
    let place = Place::new().await;
    let send = async |document: Value, key: &str| {
        let mut request = json_request("/v1/jobs", document.to_string());
        request
            .headers_mut()
            .insert("idempotency-key", key.parse().unwrap());
        call(&place.app, request).await
    };
    let first = send(small(2), "mine").await;
    let again = send(small(2), "mine").await;
    assert_eq!((first.status.as_u16(), again.status.as_u16()), (202, 200));
    assert_eq!(first.json()["id"], again.json()["id"]);
    send(small(3), "mine").await.problem(422);
    send(small(2), &"x".repeat(201)).await.problem(400);
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_no_job_is_refused_with_its_place() {
    let place = Place::new().await;
    let problem = place
        .post(&json!({"frames": {"kind": "list", "scenes": [{}, {"sun": 3}]}}))
        .await
        .problem(422);
    assert_eq!(problem["pointer"], "/frames/scenes/1/sun");
    let named = json!({"frames": {"kind": "list", "scenes": [{"clouds": {"weather_map": {"kind": "asset", "name": "front"}}}]}});
    let problem = place.post(&named).await.problem(422);
    assert!(problem["detail"].as_str().unwrap().contains("front"), "{problem}");
    for id in ["x", "01ARZ3NDEKTSV4RRFFQ69G5FAV", "01arz3ndektsv4rrffq69g5fav"] {
        get(&place.app, &format!("/v1/jobs/{id}")).await.problem(404);
        get(&place.app, &format!("/v1/jobs/{id}/events"))
            .await
            .problem(404);
        get(&place.app, &format!("/v1/jobs/{id}/results/0"))
            .await
            .problem(404);
    }
    let without = app(Service::new(Fake::new() as _, Settings::default())).unwrap();
    let problem = get(&without, "/v1/jobs").await.problem(404);
    assert!(
        problem["detail"].as_str().unwrap().contains("--queue"),
        "{problem}"
    );
}

#[tokio::test(flavor = "multi_thread")]
async fn batch_work_waits_while_somebody_looks() {
    let place = Place::of(Fake::slow(|order| match order.scene.time_s {
        7.0 => Duration::from_secs(3),
        _ => Duration::ZERO,
    }))
    .await;
    let looking = {
        let app = place.app.clone();
        let scene = json!({"scene": {"clouds": null, "time_s": 7}, "width_px": 8, "height_px": 4});
        tokio::spawn(async move { call(&app, json_request("/v1/frames", scene.to_string())).await })
    };
    while place.fake.orders.lock().unwrap().is_empty() {
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    place.work();
    let sent = place.post(&small(2)).await;
    let path = sent.header("location").to_owned();
    assert_eq!(looking.await.unwrap().status, 200);
    let job = get(&place.app, &path).await.json();
    assert_eq!(job["counts"]["done"], 0, "{job}");
    assert_eq!(place.ended(&path).await["counts"]["done"], 2);
}

#[tokio::test(flavor = "multi_thread")]
async fn jobs_take_no_more_of_the_store_than_they_may() {
    let place = Place::new().await;
    let sized = |count: u32, width_px: u32, height_px: u32| {
        let mut document = small(count);
        document["width_px"] = json!(width_px);
        document["height_px"] = json!(height_px);
        document
    };
    let problem = place.post(&sized(1, 641, 360)).await.problem(422);
    assert_eq!(problem["pointer"], "/width_px", "{problem}");
    // 46 frames of 640 x 360 pixels at 4 bytes are more than 40 MiB.
    let problem = place.post(&sized(46, 640, 360)).await.problem(422);
    assert_eq!(problem["pointer"], "/frames", "{problem}");
    let panorama =
        json!({"frames": {"kind": "panorama", "tile_px": 16}, "width_px": 32_768, "height_px": 16_384});
    assert_eq!(place.post(&panorama).await.problem(422)["pointer"], "/frames");

    // Together they are too many until one of them turns out smaller than it might have been.
    assert_eq!(place.post(&sized(30, 640, 360)).await.status, 202);
    let second = place.post(&sized(30, 640, 360)).await;
    let problem = second.problem(507);
    assert!(
        problem["detail"].as_str().unwrap().contains("--store-bytes"),
        "{problem}"
    );
    assert_eq!(
        get(&place.app, "/v1/jobs").await.json()["jobs"]
            .as_array()
            .unwrap()
            .len(),
        1
    );
    let first = get(&place.app, "/v1/jobs").await.json()["jobs"][0]["id"].clone();
    let stop = Request::delete(format!("/v1/jobs/{}", first.as_str().unwrap()));
    call(&place.app, stop.body(Body::empty()).unwrap()).await.json();
    assert_eq!(place.post(&sized(30, 640, 360)).await.status, 202);

    // Nor is the database a place to fill: each job that has ended still weighs what its rows take.
    let mut sent = 0;
    let refused = loop {
        let answer = place.post(&small(200)).await;
        if answer.status != 202 {
            break answer;
        }
        sent += 1;
        assert!(sent < 100, "jobs are taken without end");
    };
    refused.problem(507);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_that_has_ended_is_removed_with_its_results() {
    let place = Place::new().await;
    let delete = |path: String| call(&place.app, Request::delete(path).body(Body::empty()).unwrap());
    let sent = place.post(&small(2)).await;
    let path = sent.header("location").to_owned();
    delete(format!("{path}?results=true")).await.problem(409);
    for query in ["results=yes", "results", "all=true"] {
        let problem = delete(format!("{path}?{query}")).await.problem(422);
        assert_eq!(problem["parameter"], query.split('=').next().unwrap());
    }
    place.work();
    assert_eq!(place.ended(&path).await["state"], "done");
    let stopped = delete(format!("{path}?results=false")).await;
    assert_eq!(
        (stopped.status.as_u16(), &stopped.json()["state"]),
        (200, &json!("done"))
    );
    assert_eq!(get(&place.app, &format!("{path}/results/0")).await.status, 200);
    assert_eq!(delete(format!("{path}?results=true")).await.status, 204);
    for gone in ["", "/results/0", "/results/labels.jsonl", "/events"] {
        get(&place.app, &format!("{path}{gone}")).await.problem(404);
    }
    delete(format!("{path}?results=true")).await.problem(404);
    assert_eq!(get(&place.app, "/v1/jobs").await.json()["jobs"], json!([]));
}
