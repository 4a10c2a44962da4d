//! The life of one viewer's connection.

use super::{
    message,
    pace::Pace,
    refining::Refining,
    shot::{self, Shot, Stage},
    view::View,
};
use crate::{
    error::Error,
    metrics,
    problem::Problem,
    state::{Held, Service},
};
use axum::extract::ws::{CloseFrame, Message, WebSocket, close_code};
use bytes::Bytes;
use futures_util::{FutureExt, StreamExt, future::OptionFuture};
use serde_json::json;
use std::{future::Future, pin::Pin, sync::Arc, time::Duration};
use tokio::{
    sync::watch,
    time::{Instant, MissedTickBehavior, interval_at, sleep_until, timeout},
};
use welkin_scene::Quality;

/// How often an idle connection is shown to be alive.
const KEEPALIVE: Duration = Duration::from_secs(20);
/// A peer from which nothing came in this time is gone: it missed two keepalives.
const SILENCE: Duration = Duration::from_secs(50);
/// What the slowest link must carry, bytes/s.
const SLOWEST_LINK: u64 = 32 * 1024;
/// How long a viewer waits after a full render queue.
const BUSY_WAIT: Duration = Duration::from_millis(100);
/// Messages taken in before the next picture is begun, however many more wait.
const MOST_AT_ONCE: usize = 1000;

/// A picture, and the rest of its refinement.
type Work = Pin<Box<dyn Future<Output = Result<(Shot, Option<Refining>), Error>> + Send>>;

/// Why the connection ends, with the code that says so.
struct End(u16, &'static str);

/// The connection is gone; there is nobody to tell.
const GONE: End = End(close_code::ABNORMAL, "");

struct Session {
    service: Service,
    socket: WebSocket,
    view: View,
    /// Told when an asset changes.
    changes: watch::Receiver<()>,
    pace: Pace,
    /// What comes next for the view as it is; nothing when all is shown.
    next: Option<Stage>,
    /// What is being rendered, and for which stage.
    work: Option<(Stage, Work)>,
    /// The preview of the view, while it is refined.
    preview: Option<Arc<Held>>,
    /// The refinement of the view, between two pictures.
    refining: Option<Refining>,
    /// By when the last picture must be confirmed.
    pong_due: Option<Instant>,
    /// Not before this is the next picture begun.
    wait_until: Option<Instant>,
    /// The viewer has been told that the renderer cannot answer now; once is enough.
    told_to_wait: bool,
    last_heard: Instant,
}

/// Serves a viewer until either side ends it.
pub(crate) async fn run(socket: WebSocket, service: Service) {
    let mut stopping = service.stopping();
    let mut session = Session {
        changes: service.assets.changes(),
        service,
        socket,
        view: View::default(),
        pace: Pace::default(),
        next: None,
        work: None,
        preview: None,
        refining: None,
        pong_due: None,
        wait_until: None,
        told_to_wait: false,
        last_heard: Instant::now(),
    };
    let End(code, reason) = tokio::select! {
        end = session.serve() => end,
        _ = stopping.wait_for(|stop| *stop) => End(close_code::AWAY, "the service is shutting down"),
    };
    if code != close_code::ABNORMAL {
        let close = Message::Close(Some(CloseFrame {
            code,
            reason: reason.into(),
        }));
        // The peer may be gone or deaf; it has been told, which is all that can be done.
        let _ = timeout(Duration::from_secs(1), session.socket.send(close)).await;
    }
}

impl Session {
    async fn serve(&mut self) -> End {
        match self.until_end().await {
            Ok(never) => match never {},
            Err(end) => end,
        }
    }

    async fn until_end(&mut self) -> Result<std::convert::Infallible, End> {
        let mut keepalive = interval_at(Instant::now() + KEEPALIVE, KEEPALIVE);
        keepalive.set_missed_tick_behavior(MissedTickBehavior::Delay);
        loop {
            self.take_in_waiting().await?;
            self.begin();
            let due = |at: Option<Instant>| OptionFuture::from(at.map(sleep_until));
            let work = OptionFuture::from(self.work.as_mut().map(|(_, work)| work));
            tokio::select! {
                message = self.socket.next() => self.take_in(message).await?,
                Some(done) = work => self.finish(done).await?,
                Some(()) = due(self.pong_due) => return Err(End(close_code::POLICY, "the last picture was not confirmed")),
                Ok(()) = self.changes.changed() => self.look_again().await?,
                Some(()) = due(self.wait_until) => self.wait_until = None,
                _ = keepalive.tick() => self.keep_alive().await?,
            }
        }
    }

    /// Everything that has arrived, so that only the latest is rendered.
    async fn take_in_waiting(&mut self) -> Result<(), End> {
        for _ in 0..MOST_AT_ONCE {
            match self.socket.next().now_or_never() {
                Some(message) => self.take_in(message).await?,
                None => break,
            }
        }
        Ok(())
    }

    async fn take_in(&mut self, message: Option<Result<Message, axum::Error>>) -> Result<(), End> {
        let message = match message {
            None | Some(Ok(Message::Close(_))) => return Err(GONE),
            Some(Err(error)) => {
                tracing::debug!(%error, "live connection");
                return Err(End(
                    close_code::PROTOCOL,
                    "the message is too large or not a message",
                ));
            }
            Some(Ok(message)) => message,
        };
        self.last_heard = Instant::now();
        match message {
            Message::Text(text) => match message::read(&text) {
                Ok(message) => {
                    let seq = message.seq;
                    let view = match self.view.after(message) {
                        Ok(view) => view.with_assets(&self.service).await,
                        Err(error) => Err(error),
                    };
                    match view {
                        Ok(view) => self.look_at(view),
                        Err(error) => self.refuse(Some(seq), &error).await?,
                    }
                }
                Err((seq, error)) => self.refuse(seq, &error).await?,
            },
            Message::Binary(_) => {
                self.refuse(
                    None,
                    &Error::MediaType {
                        found: "a binary message".into(),
                    },
                )
                .await?;
            }
            Message::Pong(data) if !data.is_empty() => self.pong_due = None,
            Message::Ping(_) | Message::Pong(_) | Message::Close(_) => {}
        }
        Ok(())
    }

    /// Some asset has changed: one of this view, perhaps.
    async fn look_again(&mut self) -> Result<(), End> {
        let view = self.view.clone().with_assets(&self.service).await;
        match view {
            Ok(view) if view.assets == self.view.assets => Ok(()),
            Ok(view) => {
                self.look_at(view);
                Ok(())
            }
            Err(error) => self.refuse(Some(self.view.seq), &error).await,
        }
    }

    /// A preview in work is let finish, so that a view that never rests is still shown; a refinement is dropped.
    fn look_at(&mut self, view: View) {
        self.view = view;
        self.next = Some(Stage::Preview {
            divisor: self.pace.divisor(),
        });
        self.work.take_if(|(stage, _)| *stage == Stage::Refinement);
        (self.refining, self.preview) = (None, None);
    }

    fn begin(&mut self) {
        if self.work.is_some() || self.pong_due.is_some() || self.wait_until.is_some() {
            return;
        }
        let Some(stage) = self.next.take() else { return };
        let (service, view) = (self.service.clone(), self.view.clone());
        let in_passes = stage == Stage::Refinement && view.output.quality == Quality::Final;
        let preview = self.preview.clone().filter(|_| in_passes);
        let work: Work = match (self.refining.take(), preview) {
            (Some(refining), _) => Box::pin(refining.next()),
            (None, Some(preview)) => {
                Box::pin(async { Refining::begin(service, view, preview).await?.next().await })
            }
            (None, None) => Box::pin(async move { Ok((shot::take(service, view, stage).await?, None)) }),
        };
        self.work = Some((stage, work));
    }

    async fn finish(&mut self, done: Result<(Shot, Option<Refining>), Error>) -> Result<(), End> {
        let stage = self.work.take().map(|(stage, _)| stage);
        match done {
            Ok((shot, refining)) => {
                self.told_to_wait = false;
                // A frame that had been kept says nothing of how long others take.
                let was_made = shot
                    .held
                    .as_ref()
                    .is_some_and(|held| !held.frame.passes.is_empty());
                if let Stage::Preview { divisor } = shot.stage
                    && was_made
                {
                    self.pace.learn(divisor, shot.took);
                }
                // A change that came meanwhile has set its own next stage.
                if self.next.is_none() {
                    self.next = (!shot.is_last).then_some(Stage::Refinement);
                    self.refining = refining;
                    self.preview = shot
                        .held
                        .clone()
                        .or(self.preview.take())
                        .filter(|_| !shot.is_last);
                }
                self.show(shot).await
            }
            Err(error) => {
                let wait = match error {
                    // Places free up with every frame; the time named to others is for those who do not wait.
                    Error::Busy { .. } => Some(BUSY_WAIT),
                    _ => error.retry_after_s().map(|s| Duration::from_secs(s.into())),
                };
                if let Some(wait) = wait {
                    self.next = self.next.or(stage);
                    self.wait_until = Some(Instant::now() + wait);
                    if std::mem::replace(&mut self.told_to_wait, true) {
                        return Ok(());
                    }
                }
                self.refuse(Some(self.view.seq), &error).await
            }
        }
    }

    /// The picture, what is to say of it, and a ping that measures how the viewer keeps up.
    async fn show(&mut self, shot: Shot) -> Result<(), End> {
        let bytes = shot.message.len();
        let patience = self.patience(bytes);
        self.send(Message::Binary(shot.message), patience).await?;
        self.send(Message::text(shot.stats.to_string()), patience).await?;
        self.send(
            Message::Ping(Bytes::copy_from_slice(&shot.seq.to_le_bytes())),
            patience,
        )
        .await?;
        self.pong_due = Some(Instant::now() + patience);
        metrics::live_frame_sent(shot.quality);
        Ok(())
    }

    async fn refuse(&mut self, seq: Option<u32>, error: &Error) -> Result<(), End> {
        if let Some(cause) = error.cause() {
            tracing::error!(cause, "{error}");
        }
        let problem = Problem::new(error, None);
        self.send(
            Message::text(json!({"seq": seq, "error": problem}).to_string()),
            self.patience(0),
        )
        .await
    }

    async fn keep_alive(&mut self) -> Result<(), End> {
        if self.last_heard.elapsed() > SILENCE {
            return Err(End(close_code::POLICY, "nothing was heard for too long"));
        }
        self.send(Message::Ping(Bytes::new()), self.patience(0)).await
    }

    async fn send(&mut self, message: Message, patience: Duration) -> Result<(), End> {
        match timeout(patience, self.socket.send(message)).await {
            Ok(Ok(())) => Ok(()),
            Ok(Err(_)) | Err(_) => Err(GONE),
        }
    }

    fn patience(&self, bytes: usize) -> Duration {
        self.service.settings.pong_timeout + Duration::from_secs(bytes as u64 / SLOWEST_LINK)
    }
}
