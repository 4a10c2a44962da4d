//! Load: what is rendered once, what is refused, what is cancelled.

use crate::{
    client::{PATIENCE, call, get, json_request, post, router, router_with, server},
    fake::Fake,
};
use axum::body::Body;
use futures_util::{future::join_all, stream};
use std::{sync::atomic::Ordering, time::Duration};
use tokio::{io::AsyncWriteExt, net::TcpStream, time::timeout};
use welkin_scene::renderer::RenderError;
use welkin_service::Settings;

const SMALL: &str = r#"{"width_px": 32, "height_px": 16}"#;

/// Waits until it is so.
async fn until(so: impl Fn() -> bool) {
    let waiting = async {
        while !so() {
            tokio::time::sleep(Duration::from_millis(5)).await;
        }
    };
    timeout(PATIENCE, waiting).await.expect("it to become so");
}

#[tokio::test]
async fn equal_requests_render_once() {
    let fake = Fake::slow(|_| Duration::from_millis(100));
    let app = router(&fake);
    let answers = join_all((0..8).map(|_| post(&app, "/v1/frames", SMALL))).await;
    assert!(
        answers
            .iter()
            .all(|answer| answer.status == 200 && answer.body == answers[0].body)
    );
    assert_eq!(fake.orders.lock().unwrap().len(), 1);
    let kept = answers
        .iter()
        .filter(|answer| answer.header("server-timing").starts_with("cache"))
        .count();
    assert_eq!(kept, 7);
}

#[tokio::test]
async fn without_a_cache_equal_requests_still_share_but_nothing_is_kept() {
    let fake = Fake::slow(|_| Duration::from_millis(100));
    let app = router_with(
        &fake,
        Settings {
            cache_bytes: 0,
            ..Settings::default()
        },
    );
    join_all((0..4).map(|_| post(&app, "/v1/frames", SMALL))).await;
    assert_eq!(fake.orders.lock().unwrap().len(), 1);
    post(&app, "/v1/frames", SMALL).await;
    assert_eq!(fake.orders.lock().unwrap().len(), 2);
}

#[tokio::test]
async fn failures_are_not_kept() {
    let fake = Fake::failing([RenderError::Device("lost".into())]);
    let app = router(&fake);
    let answer = post(&app, "/v1/frames", SMALL).await;
    assert_eq!(answer.header("retry-after"), "1");
    assert!(!answer.problem(503)["detail"].as_str().unwrap().contains("lost"));
    assert_eq!(post(&app, "/v1/frames", SMALL).await.status, 200);
}

#[tokio::test]
async fn what_the_renderer_refuses_has_its_status() {
    let size = |width_px| RenderError::Size {
        width_px,
        height_px: 9,
        reason: "a multiple of six".into(),
    };
    let fake = Fake::failing([
        RenderError::Busy { retry_after_s: 7 },
        RenderError::Stopped,
        size(10),
        size(20_000),
    ]);
    let app = router(&fake);
    let busy = post(&app, "/v1/frames", SMALL).await;
    busy.problem(503);
    assert_eq!(busy.header("retry-after"), "7");
    post(&app, "/v1/frames", SMALL).await.problem(503);
    let problem = get(&app, "/v1/frames?width_px=10&height_px=9").await.problem(422);
    assert_eq!(
        (&problem["parameter"], &problem["allowed"]),
        (&"width_px".into(), &"a multiple of six".into())
    );
    post(&app, "/v1/frames", SMALL).await.problem(413);
    let fake = Fake::failing([RenderError::Busy { retry_after_s: 3 }]);
    let probe = post(&router(&fake), "/v1/probe", "{}").await;
    probe.problem(503);
    assert_eq!(probe.header("retry-after"), "3");
}

#[tokio::test]
async fn frames_beyond_the_limits_are_told_the_largest_that_fits() {
    let settings = Settings {
        max_frame_pixels: 10_000,
        ..Settings::default()
    };
    let app = router_with(&Fake::new(), settings);
    let problem = post(&app, "/v1/frames", r#"{"width_px": 400, "height_px": 100}"#)
        .await
        .problem(413);
    assert_eq!(
        (&problem["pointer"], &problem["value"]),
        (&"/width_px".into(), &400.into())
    );
    assert!(
        problem["detail"].as_str().unwrap().contains("200 x 50"),
        "{problem}"
    );
    let problem = get(&app, "/v1/frames?width_px=400&height_px=100")
        .await
        .problem(413);
    assert_eq!(problem["parameter"], "width_px");
    assert_eq!(
        get(&app, "/v1/frames?width_px=200&height_px=50").await.status,
        200
    );
}

#[tokio::test]
async fn radiance_weighs_more_than_a_picture() {
    let settings = Settings {
        frame_memory_bytes: 64 << 10,
        ..Settings::default()
    };
    let app = router_with(&Fake::new(), settings);
    // 128 x 128 pixels take 48 KiB as a picture and 192 KiB as radiance.
    assert_eq!(
        get(&app, "/v1/frames?width_px=128&height_px=128").await.status,
        200
    );
    get(&app, "/v1/frames?width_px=128&height_px=128&format=raw")
        .await
        .problem(413);
}

#[tokio::test]
async fn frames_wait_for_memory_and_then_are_told_to_come_back() {
    let fake = Fake::slow(|_| Duration::from_secs(600));
    let (frame_memory_bytes, memory_timeout) = (64 << 10, Duration::from_millis(50));
    let app = router_with(
        &fake,
        Settings {
            frame_memory_bytes,
            memory_timeout,
            ..Settings::default()
        },
    );
    let first = tokio::spawn(call_owned(app.clone(), "/v1/frames?width_px=128&height_px=128"));
    until(|| fake.orders.lock().unwrap().len() == 1).await;
    let answer = get(&app, "/v1/frames?width_px=128&height_px=127").await;
    answer.problem(503);
    assert_eq!(answer.header("retry-after"), "5");
    assert_eq!(fake.orders.lock().unwrap().len(), 1, "the second was not ordered");
    first.abort();
}

async fn call_owned(app: axum::Router, path: &'static str) {
    get(&app, path).await;
}

#[tokio::test]
async fn a_request_that_is_given_up_is_cancelled() {
    let fake = Fake::slow(|_| Duration::from_secs(600));
    let app = router(&fake);
    let waiting = tokio::spawn(call_owned(app, "/v1/frames"));
    until(|| fake.orders.lock().unwrap().len() == 1).await;
    waiting.abort();
    until(|| fake.cancelled.load(Ordering::SeqCst) == 1).await;
}

#[tokio::test]
async fn a_client_that_goes_away_cancels_its_frame() {
    let fake = Fake::slow(|_| Duration::from_secs(600));
    let server = server(&fake, Settings::default()).await;
    let mut client = TcpStream::connect(server.address).await.unwrap();
    client
        .write_all(b"GET /v1/frames HTTP/1.1\r\nHost: welkin\r\n\r\n")
        .await
        .unwrap();
    until(|| fake.orders.lock().unwrap().len() == 1).await;
    assert_eq!(fake.cancelled.load(Ordering::SeqCst), 0);
    drop(client);
    until(|| fake.cancelled.load(Ordering::SeqCst) == 1).await;
}

#[tokio::test]
async fn who_still_waits_is_served_when_the_first_goes() {
    let fake = Fake::slow(|_| Duration::from_millis(200));
    let app = router(&fake);
    let first = tokio::spawn(call_owned(app.clone(), "/v1/frames?width_px=32&height_px=16"));
    until(|| fake.orders.lock().unwrap().len() == 1).await;
    let second = tokio::spawn(async move { get(&app, "/v1/frames?width_px=32&height_px=16").await.status });
    tokio::time::sleep(Duration::from_millis(20)).await;
    first.abort();
    assert_eq!(second.await.unwrap(), 200);
}

#[tokio::test]
async fn a_body_that_trickles_is_given_up() {
    let settings = Settings {
        body_timeout: Duration::from_millis(50),
        ..Settings::default()
    };
    let app = router_with(&Fake::new(), settings);
    let body = Body::from_stream(stream::pending::<Result<Vec<u8>, std::io::Error>>());
    call(&app, json_request("/v1/frames", body)).await.problem(408);
}
