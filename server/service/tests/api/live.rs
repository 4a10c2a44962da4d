//! What the live socket says.

use crate::{
    client::{PATIENCE, Server, Viewer, server},
    fake::Fake,
};
use futures_util::{SinkExt, StreamExt, future::join_all};
use serde_json::{Value, json};
use std::{sync::Arc, time::Duration};
use tokio_tungstenite::{
    connect_async,
    tungstenite::{Error, Message, http::StatusCode},
};
use welkin_scene::{
    Quality,
    renderer::{Priority, RenderError},
};
use welkin_service::Settings;

async fn start(fake: &Arc<Fake>) -> (Server, Viewer) {
    let server = server(fake, Settings::default()).await;
    let viewer = Viewer::connect(&server).await;
    (server, viewer)
}

fn small(seq: u32) -> Value {
    json!({"seq": seq, "scene": {}, "output": {"width_px": 64, "height_px": 32}})
}

#[tokio::test]
async fn a_preview_then_the_final_then_silence() {
    let fake = Fake::new();
    let (_server, mut viewer) = start(&fake).await;
    viewer.say(&small(7)).await;
    let (preview, stats) = viewer.picture().await;
    assert_eq!((preview.seq, preview.pass, preview.passes), (7, 0, 17));
    assert_eq!(preview.format, 1);
    assert!(preview.data.starts_with(&[0xff, 0xd8]), "JPEG");
    assert_eq!(stats["quality"], "preview");
    let (last, stats) = viewer.picture().await;
    assert_eq!(
        (last.seq, last.pass, last.passes, last.size),
        (7, 16, 17, (64, 32))
    );
    assert_eq!(
        (&stats["quality"], &stats["width_px"], &stats["height_px"]),
        (&"final".into(), &64.into(), &32.into())
    );
    assert_eq!(
        stats["passes"],
        json!([{"pass": "transmittance", "ms": 0.25}, {"pass": "sky", "ms": 0.5}])
    );
    assert_eq!(stats["bytes"], last.data.len());
    assert_eq!(
        (&stats["ev100"], &stats["adapter"]),
        (&14.5.into(), &"Gradient ™".into())
    );
    assert!(stats["render_ms"].as_f64().unwrap() >= 0.0 && stats["encode_ms"].as_f64().unwrap() > 0.0);
    assert!(stats["sun"]["elevation_deg"].is_number());
    assert!(
        stats["moon"].is_null(),
        "a sun given as a direction has no moon by itself"
    );
    assert!(viewer.is_silent().await);
    let orders = fake.orders.lock().unwrap();
    assert_eq!(orders[0].priority, Priority::Interactive);
    assert_eq!(
        (orders[1].quality, orders[1].priority),
        (Quality::Final, Priority::Batch)
    );
}

#[tokio::test]
async fn patches_change_the_document_and_scenes_replace_it() {
    let fake = Fake::new();
    let (_server, mut viewer) = start(&fake).await;
    viewer.say(&small(1)).await;
    viewer.pictures_until_done(1).await;
    let sun = json!({"azimuth_deg": 90, "elevation_deg": 10});
    viewer
        .say(&json!({"seq": 2, "patch": {"sun": {"position": sun}, "time_s": 5}}))
        .await;
    viewer.pictures_until_done(2).await;
    viewer.say(&json!({"seq": 3, "patch": {"time_s": null}})).await;
    viewer.pictures_until_done(3).await;
    viewer
        .say(&json!({"seq": 4, "scene": {"time_s": 9}, "patch": {"sun": {"disc": false}}}))
        .await;
    viewer.pictures_until_done(4).await;
    let orders = fake.orders.lock().unwrap();
    let scene = |i: usize| &orders[i].scene;
    assert_eq!(
        (scene(3).time_s, scene(3).sun_place().azimuth_deg.round()),
        (5.0, 90.0)
    );
    assert_eq!(
        (scene(5).time_s, scene(5).sun_place().azimuth_deg.round()),
        (0.0, 90.0)
    );
    assert_eq!(
        (scene(7).time_s, scene(7).sun_place().azimuth_deg.round()),
        (9.0, 180.0)
    );
    assert!(!scene(7).sun.disc);
}

#[tokio::test]
async fn what_is_wrong_is_answered_and_changes_nothing() {
    let fake = Fake::new();
    let (_server, mut viewer) = start(&fake).await;
    viewer.say(&small(1)).await;
    viewer.pictures_until_done(1).await;
    for (text, seq, status, pointer) in [
        ("{", json!(null), 400, json!("")),
        ("[]", json!(null), 422, json!("")),
        (r#"{"scene": {}}"#, json!(null), 422, json!("/seq")),
        (r#"{"seq": -1, "scene": {}}"#, json!(null), 422, json!("/seq")),
        (
            r#"{"seq": 4294967296, "scene": {}}"#,
            json!(null),
            422,
            json!("/seq"),
        ),
        (r#"{"seq": 2}"#, json!(2), 422, json!("")),
        (r#"{"seq": 2, "pach": {}}"#, json!(2), 422, json!("/pach")),
        (r#"{"seq": 2, "patch": 3}"#, json!(2), 422, json!("/patch")),
        (r#"{"seq": 2, "scene": 3}"#, json!(2), 422, json!("/scene")),
        (
            r#"{"seq": 2, "patch": {"sun": {"dics": true}}}"#,
            json!(2),
            422,
            json!("/scene/sun/dics"),
        ),
        (
            r#"{"seq": 2, "patch": {"time_s": "x"}, "output": {"width_px": 99}}"#,
            json!(2),
            422,
            json!("/scene/time_s"),
        ),
        (
            r#"{"seq": 2, "output": {"width_px": 8}}"#,
            json!(2),
            422,
            json!("/output/width_px"),
        ),
        (
            r#"{"seq": 2, "output": {"height_px": 4097}}"#,
            json!(2),
            422,
            json!("/output/height_px"),
        ),
        (
            r#"{"seq": 2, "output": {"format": "exr"}}"#,
            json!(2),
            422,
            json!("/output/format"),
        ),
        (
            r#"{"seq": 2, "output": {"size": 1}}"#,
            json!(2),
            422,
            json!("/output/size"),
        ),
    ] {
        viewer.say_text(text).await;
        let answer = viewer.text().await;
        assert_eq!(
            (&answer["seq"], &answer["error"]["status"]),
            (&seq, &json!(status)),
            "{text}: {answer}"
        );
        assert_eq!(answer["error"]["pointer"], pointer, "{text}: {answer}");
    }
    viewer.0.send(Message::binary(vec![1, 2, 3])).await.unwrap();
    assert_eq!(viewer.text().await["error"]["status"], 415);
    viewer.say_text(&format!("\"{}\"", "x".repeat(1 << 20))).await;
    assert_eq!(viewer.text().await["error"]["status"], 413);
    assert!(viewer.is_silent().await, "nothing was rendered");
    viewer
        .say(&json!({"seq": 3, "patch": {"sun": {"disc": false}}}))
        .await;
    let last = viewer.pictures_until_done(3).await.pop().unwrap();
    assert_eq!(last.size, (64, 32));
    assert_eq!(fake.orders.lock().unwrap().last().unwrap().scene.time_s, 0.0);
}

#[tokio::test]
async fn a_huge_message_ends_the_connection_and_no_other() {
    let fake = Fake::new();
    let (server, mut viewer) = start(&fake).await;
    let mut other = Viewer::connect(&server).await;
    // The server may hang up before all of it is sent.
    let _ = viewer.0.send(Message::text("x".repeat(8 << 20))).await;
    let ended = tokio::time::timeout(PATIENCE, async {
        while let Some(Ok(_)) = viewer.0.next().await {}
    })
    .await;
    assert!(ended.is_ok());
    other.say(&small(1)).await;
    other.pictures_until_done(1).await;
}

#[tokio::test]
async fn each_format_has_its_code() {
    let (_server, mut viewer) = start(&Fake::new()).await;
    viewer.say(&small(1)).await;
    viewer.pictures_until_done(1).await;
    for (seq, format, code, magic) in [
        (2, "png", 2, &b"\x89PNG"[..]),
        (3, "raw", 3, &[0, 0, 127, 255]),
        (4, "jpeg", 1, &[0xff, 0xd8]),
    ] {
        viewer
            .say(&json!({"seq": seq, "output": {"format": format}}))
            .await;
        let last = viewer.pictures_until_done(seq).await.pop().unwrap();
        assert_eq!(last.format, code);
        assert!(last.data.starts_with(magic), "{format}: {:?}", &last.data[..4]);
        if format == "raw" {
            assert_eq!(last.data.len(), 64 * 32 * 4);
        }
    }
}

#[tokio::test]
async fn preview_quality_stops_at_a_full_size_preview() {
    let fake = Fake::new();
    let (_server, mut viewer) = start(&fake).await;
    let mut message = small(1);
    message["output"]["quality"] = "preview".into();
    viewer.say(&message).await;
    let last = viewer.pictures_until_done(1).await.pop().unwrap();
    assert_eq!(last.size, (64, 32));
    assert!(viewer.is_silent().await);
    assert_eq!(fake.orders_of(Quality::Final), 0);
}

#[tokio::test]
async fn a_failing_renderer_is_told_once_and_tried_again() {
    let busy = RenderError::Busy { retry_after_s: 1 };
    let (_server, mut viewer) = start(&Fake::failing([busy.clone(), busy.clone(), busy])).await;
    viewer.say(&small(1)).await;
    let answer = viewer.text().await;
    assert_eq!(
        (&answer["seq"], &answer["error"]["status"]),
        (&json!(1), &json!(503))
    );
    assert_eq!(viewer.pictures_until_done(1).await.len(), 2);
}

#[tokio::test]
async fn a_size_that_cannot_be_is_told_and_not_tried_again() {
    let size = RenderError::Size {
        width_px: 64,
        height_px: 32,
        reason: "six squares".into(),
    };
    let fake = Fake::failing([size]);
    let (_server, mut viewer) = start(&fake).await;
    viewer.say(&small(1)).await;
    let answer = viewer.text().await;
    assert_eq!(answer["error"]["pointer"], "/output/width_px", "{answer}");
    assert!(viewer.is_silent().await);
    assert_eq!(fake.orders.lock().unwrap().len(), 1);
}

#[tokio::test]
async fn ten_viewers_each_get_their_own_frames() {
    let fake = Fake::slow(|_| Duration::from_millis(20));
    let server = server(&fake, Settings::default()).await;
    let viewers = (0..10).map(|i: u32| {
        let server = &server;
        async move {
            let mut viewer = Viewer::connect(server).await;
            let output = json!({"width_px": 64, "height_px": 32 + i, "format": "raw"});
            viewer.say(&json!({"seq": i, "scene": {"sun": {"position": {"azimuth_deg": 10 * i, "elevation_deg": 5}}}, "output": output})).await;
            let last = viewer.pictures_until_done(i).await.pop().unwrap();
            assert_eq!(last.size, (64, 32 + i as u16));
            // The gradient's blue is the sun's azimuth; one step is what rounding down may take.
            let expected = f64::from(10 * i) / 360.0 * 255.0;
            assert!((f64::from(last.data[2]) - expected).abs() <= 1.0, "viewer {i}: {}", last.data[2]);
        }
    });
    join_all(viewers).await;
}

#[tokio::test]
async fn one_viewer_too_many_is_told_to_come_back() {
    let fake = Fake::new();
    let server = server(
        &fake,
        Settings {
            max_viewers: 1,
            ..Settings::default()
        },
    )
    .await;
    let first = Viewer::connect(&server).await;
    let url = format!("ws://{}/v1/live", server.address);
    match connect_async(&url).await {
        Err(Error::Http(response)) => {
            assert_eq!(response.status(), StatusCode::SERVICE_UNAVAILABLE);
            assert_eq!(response.headers()["retry-after"], "10");
        }
        other => panic!("{other:?}"),
    }
    drop(first);
    let freed = async {
        while connect_async(&url).await.is_err() {
            tokio::time::sleep(Duration::from_millis(10)).await
        }
    };
    tokio::time::timeout(PATIENCE, freed)
        .await
        .expect("the place to be free again");
}
