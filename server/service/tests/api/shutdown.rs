//! Ending well.

use crate::{
    client::{PATIENCE, Viewer, server},
    fake::Fake,
};
use futures_util::StreamExt;
use std::time::Duration;
use tokio::{
    io::{AsyncReadExt, AsyncWriteExt},
    net::TcpStream,
    time::{sleep, timeout},
};
use tokio_tungstenite::tungstenite::Message;
use welkin_service::{Settings, StartError, listen};

const GET: &[u8] =
    b"GET /v1/frames?width_px=8&height_px=8 HTTP/1.1\r\nHost: welkin\r\nConnection: close\r\n\r\n";

async fn ordered(fake: &Fake) {
    while fake.orders.lock().unwrap().is_empty() {
        sleep(Duration::from_millis(5)).await;
    }
}

#[tokio::test]
async fn frames_in_work_finish_and_viewers_are_told() {
    let fake = Fake::slow(|_| Duration::from_millis(300));
    let server = server(&fake, Settings::default()).await;
    let mut viewer = Viewer::connect(&server).await;
    let mut client = TcpStream::connect(server.address).await.unwrap();
    client.write_all(GET).await.unwrap();
    timeout(PATIENCE, ordered(&fake)).await.unwrap();
    server.stop.send(()).unwrap();
    match timeout(PATIENCE, viewer.0.next())
        .await
        .unwrap()
        .unwrap()
        .unwrap()
    {
        Message::Close(Some(frame)) => assert_eq!(u16::from(frame.code), 1001),
        other => panic!("{other:?}"),
    }
    let mut answer = Vec::new();
    timeout(PATIENCE, client.read_to_end(&mut answer))
        .await
        .unwrap()
        .unwrap();
    assert!(
        answer.starts_with(b"HTTP/1.1 200"),
        "{}",
        String::from_utf8_lossy(&answer)
    );
    timeout(PATIENCE, server.done).await.unwrap().unwrap();
    assert!(
        TcpStream::connect(server.address).await.is_err(),
        "nobody listens any more"
    );
}

#[tokio::test]
async fn what_does_not_finish_is_given_up() {
    let fake = Fake::slow(|_| Duration::from_secs(600));
    let settings = Settings {
        shutdown_timeout: Duration::from_millis(100),
        ..Settings::default()
    };
    let server = server(&fake, settings).await;
    let mut client = TcpStream::connect(server.address).await.unwrap();
    client.write_all(GET).await.unwrap();
    timeout(PATIENCE, ordered(&fake)).await.unwrap();
    server.stop.send(()).unwrap();
    timeout(PATIENCE, server.done).await.unwrap().unwrap();
}

#[tokio::test]
async fn a_taken_port_is_told_with_the_cure() {
    let first = listen("127.0.0.1:0").await.unwrap();
    let address = first.local_addr().unwrap().to_string();
    match listen(&address).await {
        Err(error @ StartError::Taken { .. }) => assert!(error.to_string().contains("--listen"), "{error}"),
        other => panic!("{other:?}"),
    }
    assert!(matches!(listen("nowhere").await, Err(StartError::Listen { .. })));
}
