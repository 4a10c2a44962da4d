//! How a picture that rests is refined.

use crate::{
    client::{PATIENCE, Picture, Viewer, call, json_request, router, server},
    deaf::{BINARY, Deaf, PING, PONG},
    fake::Fake,
};
use serde_json::json;
use std::{
    sync::{Arc, atomic::Ordering},
    time::Duration,
};
use tokio::time::{sleep, timeout};
use welkin_scene::Quality;
use welkin_service::Settings;

/// A renderer whose final frames take so long, in passes of a sixteenth.
fn slow_final(ms: u64) -> Arc<Fake> {
    Fake::slow(move |order| match order.quality {
        Quality::Preview => Duration::ZERO,
        Quality::Final => Duration::from_millis(ms),
    })
}

fn message(seq: u32) -> serde_json::Value {
    json!({"seq": seq, "scene": {}, "output": {"width_px": 64, "height_px": 32, "format": "raw"}})
}

#[tokio::test]
async fn a_picture_is_refined_in_passes_up_to_the_final_frame() {
    let fake = slow_final(1600);
    let server = server(&fake, Settings::default()).await;
    let mut viewer = Viewer::connect(&server).await;
    viewer.say(&message(3)).await;
    let pictures = viewer.pictures_until_done(3).await;
    let passes: Vec<u16> = pictures.iter().map(|picture| picture.pass).collect();
    assert!(passes.is_sorted_by(|a, b| a < b), "{passes:?}");
    assert_eq!((passes[0], passes.last()), (0, Some(&16)));
    // Passes of 100 ms, shown at most every 150 ms: eight or nine pictures where nothing else delays them.
    assert!((4..=13).contains(&passes.len()), "{passes:?}");
    assert!(
        pictures
            .iter()
            .all(|picture| (picture.seq, picture.passes) == (3, 17))
    );
    assert!(pictures[1..].iter().all(|picture| picture.size == (64, 32)));
    assert!(viewer.is_silent().await);
    assert_eq!(fake.orders_of(Quality::Final), 1, "no pixel is asked for again");

    let request = json!({"scene": {}, "width_px": 64, "height_px": 32, "format": "png"});
    let frame = call(&router(&fake), json_request("/v1/frames", request.to_string())).await;
    let mut reader = png::Decoder::new(std::io::Cursor::new(frame.body))
        .read_info()
        .unwrap();
    let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut rgb).unwrap();
    let last = pictures.last().unwrap().data.as_chunks::<4>().0;
    let last: Vec<u8> = last.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
    assert_eq!(last, rgb, "the last pass is the final frame");
}

#[tokio::test]
async fn a_patch_ends_the_refinement_between_its_passes() {
    let fake = slow_final(20_000);
    let server = server(&fake, Settings::default()).await;
    let mut viewer = Viewer::connect(&server).await;
    viewer.say(&message(1)).await;
    let next_of = |picture: Picture| (picture.seq, picture.pass);
    assert_eq!(next_of(viewer.picture().await.0), (1, 0));
    let (seq, pass) = next_of(viewer.picture().await.0);
    assert!(seq == 1 && (1..16).contains(&pass), "{pass}");
    assert_eq!(fake.cancelled.load(Ordering::SeqCst), 0);
    viewer.say(&json!({"seq": 2, "patch": {"time_s": 5}})).await;
    // A pass that was being encoded is dropped with the rest.
    assert_eq!(next_of(viewer.picture().await.0), (2, 0));
    assert_eq!(fake.cancelled.load(Ordering::SeqCst), 1);
}

#[tokio::test]
async fn a_viewer_who_is_slow_sees_fewer_passes_and_the_last() {
    let server = server(&slow_final(800), Settings::default()).await;
    let mut viewer = Deaf::connect(server.address).await;
    viewer.send(1, message(1).to_string().as_bytes()).await;
    let mut shown = Vec::new();
    while shown.last() != Some(&16) {
        let ping = loop {
            match timeout(PATIENCE, viewer.read()).await.unwrap() {
                (BINARY, data) => shown.push(u16::from_le_bytes([data[4], data[5]])),
                (PING, data) => break data,
                _ => {}
            }
        };
        if shown.len() == 2 {
            // By then the renderer has done the other passes.
            sleep(Duration::from_millis(1200)).await;
        }
        viewer.send(PONG, &ping).await;
    }
    assert_eq!((shown.len(), shown[0]), (3, 0), "{shown:?}");
}
