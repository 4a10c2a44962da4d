//! How the live socket keeps pace: the latest wins, previews are not starved, slow viewers get fewer frames.

use crate::{
    client::{PATIENCE, Viewer, server},
    deaf::{BINARY, CLOSE, Deaf, PING, PONG},
    fake::Fake,
};
use axum::body::Bytes;
use futures_util::{SinkExt, StreamExt};
use serde_json::{Value, json};
use std::{sync::atomic::Ordering, time::Duration};
use tokio::time::{sleep, timeout};
use tokio_tungstenite::tungstenite::Message;
use welkin_scene::{Quality, renderer::FrameOrder};
use welkin_service::Settings;

fn patch(seq: u32) -> Value {
    json!({"seq": seq, "patch": {"time_s": seq}})
}

fn by_quality(preview_ms: u64, final_ms: u64) -> impl Fn(&FrameOrder) -> Duration {
    move |order| match order.quality {
        Quality::Preview => Duration::from_millis(preview_ms),
        Quality::Final => Duration::from_millis(final_ms),
    }
}

const OUTPUT: &str = r#"{"seq": 0, "scene": {}, "output": {"width_px": 64, "height_px": 32}}"#;

#[tokio::test]
async fn while_one_drags_previews_keep_coming_and_the_last_is_refined() {
    let fake = Fake::slow(by_quality(40, 0));
    let server = server(&fake, Settings::default()).await;
    let mut viewer = Viewer::connect(&server).await;
    viewer.say_text(OUTPUT).await;
    let mut seen = Vec::new();
    for seq in 1..=100 {
        viewer.say(&patch(seq)).await;
        // A drag at about 60 Hz; whatever arrives meanwhile is read.
        let until_next = timeout(Duration::from_millis(16), async {
            loop {
                if let Message::Binary(bytes) = viewer.hear().await {
                    seen.push(u32::from_le_bytes(bytes[0..4].try_into().unwrap()));
                }
            }
        });
        until_next.await.unwrap_err();
    }
    assert!(seen.len() >= 5, "{seen:?}");
    assert!(seen.is_sorted(), "never an older picture after a newer: {seen:?}");
    let previews = fake.orders_of(Quality::Preview);
    assert!(
        previews < 60,
        "patches were gathered: {previews} previews for 100 of them"
    );
    let last = viewer.pictures_until_last(100).await;
    assert!(last, "the last patch was refined");
}

impl Viewer {
    /// Reads until the last pass of a message, whatever comes before it.
    async fn pictures_until_last(&mut self, seq: u32) -> bool {
        loop {
            if let Message::Binary(bytes) = self.hear().await
                && bytes[0..4] == seq.to_le_bytes()
                && bytes[4..6] == 16_u16.to_le_bytes()
            {
                return true;
            }
        }
    }
}

#[tokio::test]
async fn a_change_drops_the_refinement_in_work() {
    let fake = Fake::slow(by_quality(0, 600_000));
    let server = server(&fake, Settings::default()).await;
    let mut viewer = Viewer::connect(&server).await;
    viewer.say_text(OUTPUT).await;
    for seq in 0..3 {
        let (preview, _) = viewer.picture().await;
        assert_eq!((preview.seq, preview.pass), (seq, 0));
        let begun = async {
            while fake.orders_of(Quality::Final) <= seq as usize {
                sleep(Duration::from_millis(5)).await;
            }
        };
        let keep_reading = async { while viewer.0.next().await.is_some() {} };
        tokio::select! {
            () = begun => {}
            () = keep_reading => panic!("the connection ended"),
            () = sleep(PATIENCE) => panic!("no refinement was begun"),
        }
        assert_eq!(fake.cancelled.load(Ordering::SeqCst), seq as usize);
        viewer.say(&patch(seq + 1)).await;
    }
    viewer.picture().await;
    assert_eq!(fake.cancelled.load(Ordering::SeqCst), 3);
}

#[tokio::test]
async fn a_viewer_that_leaves_cancels_its_frame() {
    let fake = Fake::slow(|_| Duration::from_secs(600));
    let server = server(&fake, Settings::default()).await;
    let mut viewer = Viewer::connect(&server).await;
    viewer.say_text(OUTPUT).await;
    let so = |so: Box<dyn Fn() -> bool>| async move {
        while !so() {
            sleep(Duration::from_millis(5)).await;
        }
    };
    let begun = std::sync::Arc::clone(&fake);
    timeout(
        PATIENCE,
        so(Box::new(move || begun.orders_of(Quality::Preview) == 1)),
    )
    .await
    .unwrap();
    drop(viewer);
    let gone = std::sync::Arc::clone(&fake);
    timeout(
        PATIENCE,
        so(Box::new(move || gone.cancelled.load(Ordering::SeqCst) == 1)),
    )
    .await
    .unwrap();
}

#[tokio::test]
async fn the_next_picture_waits_until_the_last_is_confirmed() {
    let server = server(&Fake::new(), Settings::default()).await;
    let mut viewer = Deaf::connect(server.address).await;
    viewer.send(1, OUTPUT.as_bytes()).await;
    let mut ping = loop {
        let (opcode, data) = timeout(PATIENCE, viewer.read()).await.unwrap();
        if opcode == PING {
            break data;
        }
    };
    assert_eq!(ping, 0_u32.to_le_bytes());
    // Patches while the picture is unconfirmed: none of them is shown until it is, and then only the last.
    for seq in 1..=5 {
        viewer.send(1, patch(seq).to_string().as_bytes()).await;
    }
    assert!(
        timeout(Duration::from_millis(300), viewer.read()).await.is_err(),
        "nothing came"
    );
    let mut shown = Vec::new();
    while shown.len() < 2 {
        viewer.send(PONG, &ping).await;
        loop {
            match timeout(PATIENCE, viewer.read()).await.unwrap() {
                (BINARY, data) => shown.push((data[0], data[4])),
                (PING, data) => break ping = data,
                _ => {}
            }
        }
    }
    assert_eq!(shown, [(5, 0), (5, 16)], "seq and pass");
}

#[tokio::test]
async fn a_viewer_that_never_confirms_is_let_go() {
    let settings = Settings {
        pong_timeout: Duration::from_millis(100),
        ..Settings::default()
    };
    let server = server(&Fake::new(), settings).await;
    let mut viewer = Deaf::connect(server.address).await;
    viewer.send(1, OUTPUT.as_bytes()).await;
    let code = loop {
        let (opcode, data) = timeout(PATIENCE, viewer.read()).await.unwrap();
        if opcode == CLOSE {
            break u16::from_be_bytes([data[0], data[1]]);
        }
    };
    assert_eq!(code, 1008);
}

#[tokio::test]
async fn an_idle_viewer_costs_no_frame() {
    let fake = Fake::new();
    let server = server(&fake, Settings::default()).await;
    let mut viewer = Viewer::connect(&server).await;
    assert!(viewer.is_silent().await);
    assert!(fake.orders.lock().unwrap().is_empty());
    viewer
        .0
        .send(Message::Ping(Bytes::from_static(b"?")))
        .await
        .unwrap();
    match timeout(PATIENCE, viewer.0.next())
        .await
        .unwrap()
        .unwrap()
        .unwrap()
    {
        Message::Pong(data) => assert_eq!(&data[..], b"?"),
        other => panic!("{other:?}"),
    }
}
