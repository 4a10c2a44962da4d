//! News of a job as it goes on.

use super::named;
use crate::{
    error::Error,
    openapi::{Busy, Missing},
    state::Service,
};
use axum::{
    extract::{Path, State, rejection::PathRejection},
    response::{
        IntoResponse,
        sse::{Event, KeepAlive, Sse},
    },
};
use futures_util::{Stream, stream};
use std::{convert::Infallible, time::Duration};
use tokio::time::sleep;
use welkin_jobs::{JobId, JobStatus, Jobs};

/// How often a job is looked at.
const LOOK: Duration = Duration::from_millis(500);

/// What a stream of news knows.
struct Watched {
    service: Service,
    jobs: Jobs,
    id: JobId,
    told: Option<JobStatus>,
    ended: bool,
}

/// A job's progress as server-sent events: `status` whenever something has changed, and `end` when it has ended. The
/// data of both are the job, as `GET /v1/jobs/{id}` answers it.
#[utoipa::path(get, path = "/v1/jobs/{id}/events", tag = "jobs",
    params(("id" = String, Path, description = "The job")),
    responses(
        (status = 200, description = "The news", content_type = "text/event-stream", body = String),
        Missing, Busy))]
pub(crate) async fn get_events(
    State(service): State<Service>,
    id: Result<Path<String>, PathRejection>,
) -> Result<impl IntoResponse, Error> {
    let id = named(id)?;
    let jobs = service.jobs()?.clone();
    // Where there is no such job, that is the answer.
    let now = jobs.status(id).await?;
    let watched = Watched {
        service,
        jobs,
        id,
        told: None,
        ended: false,
    };
    Ok(Sse::new(news(watched, now)).keep_alive(KeepAlive::default()))
}

fn news(watched: Watched, now: JobStatus) -> impl Stream<Item = Result<Event, Infallible>> {
    stream::unfold((watched, Some(now)), |(mut watched, mut now)| async move {
        if watched.ended {
            return None;
        }
        let mut stopping = watched.service.stopping();
        loop {
            if let Some(status) = now.take().filter(|status| !watched.knows(status)) {
                watched.ended = status.state.has_ended();
                let name = if watched.ended { "end" } else { "status" };
                let event = Event::default()
                    .event(name)
                    .json_data(&status)
                    .unwrap_or_default();
                watched.told = Some(status);
                return Some((Ok(event), (watched, None)));
            }
            tokio::select! {
                () = sleep(LOOK) => {}
                _ = stopping.wait_for(|stop| *stop) => return None,
            }
            // A queue that does not answer now is asked again.
            now = watched.jobs.status(watched.id).await.ok();
        }
    })
}

impl Watched {
    /// The rate alone, which never rests, is no news.
    fn knows(&self, status: &JobStatus) -> bool {
        self.told.as_ref().is_some_and(|told| {
            (told.state, told.counts, &told.notes) == (status.state, status.counts, &status.notes)
        })
    }
}
