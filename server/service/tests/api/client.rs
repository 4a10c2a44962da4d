//! Calls the router, or a server on a free port.

use crate::fake::Fake;
use axum::{
    Router,
    body::{Body, Bytes, to_bytes},
    http::{HeaderMap, Request, StatusCode, header},
};
use futures_util::{SinkExt, StreamExt};
use serde_json::Value;
use std::{net::SocketAddr, sync::Arc, time::Duration};
use tokio::{net::TcpStream, sync::oneshot, task::JoinHandle, time::timeout};
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream, connect_async, tungstenite::Message};
use tower::ServiceExt;
use welkin_service::{Service, Settings, app, listen, serve};

/// Long enough for a loaded machine; only a hang takes this long.
pub(crate) const PATIENCE: Duration = Duration::from_secs(60);

pub(crate) struct Answer {
    pub(crate) status: StatusCode,
    pub(crate) headers: HeaderMap,
    pub(crate) body: Bytes,
}

impl Answer {
    pub(crate) fn header(&self, name: &str) -> &str {
        self.headers
            .get(name)
            .unwrap_or_else(|| panic!("no header {name}"))
            .to_str()
            .unwrap()
    }

    pub(crate) fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap()
    }

    /// The problem document, after a look at what all of them have.
    pub(crate) fn problem(&self, status: u16) -> Value {
        let problem = self.json();
        assert_eq!(self.status, status, "{problem}");
        assert_eq!(self.header("content-type"), "application/problem+json");
        assert_eq!(problem["status"], status);
        for member in ["type", "title", "detail", "instance"] {
            assert!(
                !problem[member].as_str().unwrap().is_empty(),
                "{member}: {problem}"
            );
        }
        problem
    }
}

pub(crate) fn router(fake: &Arc<Fake>) -> Router {
    router_with(fake, Settings::default())
}

pub(crate) fn router_with(fake: &Arc<Fake>, settings: Settings) -> Router {
    app(Service::new(Arc::clone(fake) as _, settings)).unwrap()
}

pub(crate) async fn call(app: &Router, request: Request<Body>) -> Answer {
    let response = timeout(PATIENCE, app.clone().oneshot(request))
        .await
        .expect("an answer")
        .unwrap();
    let (parts, body) = response.into_parts();
    Answer {
        status: parts.status,
        headers: parts.headers,
        body: to_bytes(body, usize::MAX).await.unwrap(),
    }
}

pub(crate) async fn get(app: &Router, path: &str) -> Answer {
    call(app, Request::get(path).body(Body::empty()).unwrap()).await
}

pub(crate) fn json_request(path: &str, body: impl Into<Body>) -> Request<Body> {
    Request::post(path)
        .header(header::CONTENT_TYPE, "application/json")
        .body(body.into())
        .unwrap()
}

pub(crate) async fn post(app: &Router, path: &str, body: impl Into<Body>) -> Answer {
    call(app, json_request(path, body)).await
}

/// A server on a free port; it ends with the test.
pub(crate) struct Server {
    pub(crate) address: SocketAddr,
    pub(crate) stop: oneshot::Sender<()>,
    pub(crate) done: JoinHandle<()>,
}

pub(crate) async fn server(fake: &Arc<Fake>, settings: Settings) -> Server {
    server_of(Service::new(Arc::clone(fake) as _, settings)).await
}

pub(crate) async fn server_of(service: Service) -> Server {
    let listener = listen("127.0.0.1:0").await.unwrap();
    let address = listener.local_addr().unwrap();
    let (stop, stopped) = oneshot::channel();
    let stopped = async {
        // A dropped sender is a test that ended.
        let _ = stopped.await;
    };
    let done = tokio::spawn(async move { serve(service, listener, stopped).await.unwrap() });
    Server { address, stop, done }
}

pub(crate) type Socket = WebSocketStream<MaybeTlsStream<TcpStream>>;

pub(crate) struct Viewer(pub(crate) Socket);

/// A picture as it came over the socket.
#[derive(Debug)]
pub(crate) struct Picture {
    pub(crate) seq: u32,
    pub(crate) pass: u16,
    pub(crate) passes: u16,
    pub(crate) size: (u16, u16),
    pub(crate) format: u8,
    pub(crate) data: Bytes,
}

impl Picture {
    fn read(bytes: Bytes) -> Self {
        let short = |at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
        assert_eq!(bytes[13..16], [0; 3]);
        Self {
            seq: u32::from_le_bytes(bytes[0..4].try_into().unwrap()),
            pass: short(4),
            passes: short(6),
            size: (short(8), short(10)),
            format: bytes[12],
            data: bytes.slice(16..),
        }
    }

    pub(crate) fn is_last(&self) -> bool {
        self.pass + 1 == self.passes
    }
}

impl Viewer {
    pub(crate) async fn connect(server: &Server) -> Self {
        let url = format!("ws://{}/v1/live", server.address);
        Self(connect_async(url).await.unwrap().0)
    }

    pub(crate) async fn say(&mut self, message: &Value) {
        self.say_text(&message.to_string()).await;
    }

    pub(crate) async fn say_text(&mut self, text: &str) {
        self.0.send(Message::text(text)).await.unwrap();
    }

    /// The next message that is not a ping or pong. Reading answers pings.
    pub(crate) async fn hear(&mut self) -> Message {
        loop {
            match timeout(PATIENCE, self.0.next())
                .await
                .expect("a message")
                .expect("a connection")
                .unwrap()
            {
                Message::Ping(_) | Message::Pong(_) => {}
                message => return message,
            }
        }
    }

    pub(crate) async fn text(&mut self) -> Value {
        match self.hear().await {
            Message::Text(text) => serde_json::from_str(&text).unwrap(),
            other => panic!("expected text, got {other:?}"),
        }
    }

    /// The next picture with the stats that follow it.
    pub(crate) async fn picture(&mut self) -> (Picture, Value) {
        let picture = match self.hear().await {
            Message::Binary(bytes) => Picture::read(bytes),
            other => panic!("expected a picture, got {other:?}"),
        };
        let text = self.text().await;
        assert_eq!(text["seq"], picture.seq);
        (picture, text["stats"].clone())
    }

    /// Pictures up to the last one of a message.
    pub(crate) async fn pictures_until_done(&mut self, seq: u32) -> Vec<Picture> {
        let mut pictures = Vec::new();
        loop {
            let (picture, _) = self.picture().await;
            let done = picture.seq == seq && picture.is_last();
            pictures.push(picture);
            if done {
                return pictures;
            }
        }
    }

    /// True where nothing but pings comes for a while.
    pub(crate) async fn is_silent(&mut self) -> bool {
        timeout(Duration::from_millis(300), self.hear()).await.is_err()
    }
}
