//! `/v1/jobs`: many frames at once, rendered by whoever works on the queue.

pub(crate) mod board;
pub(crate) mod document;
mod events;

#[doc(hidden)]
pub(crate) use events::__path_get_events;
pub(crate) use events::get_events;

use crate::{
    body::JobText,
    error::{Error, Fault},
    openapi::{Busy, InWork, Missing, Refusals},
    state::Service,
};
use axum::{
    Json,
    body::Body,
    extract::{Path, RawQuery, State, rejection::PathRejection},
    http::{HeaderMap, HeaderValue, StatusCode, header},
    response::{IntoResponse, Response},
};
use serde::Serialize;
use std::time::Duration;
use tokio::time::sleep;
use welkin_encode::format_from_path;
use welkin_jobs::{JobError, JobId, JobStatus, Jobs, Sent};

/// Jobs of one answer, where the query does not say.
const USUAL_PAGE: u32 = 20;
const LARGEST_PAGE: u32 = 100;
/// Longest idempotency key, bytes.
const MAX_KEY_BYTES: usize = 200;
/// How often the numbers of all jobs are looked at.
const COUNT: Duration = Duration::from_secs(5);
/// How often old jobs are looked for.
const CLEAN: Duration = Duration::from_secs(60);
/// A worker that was not heard of for three times this long is not counted, seconds.
const HEARTBEAT_S: u32 = 10;

/// Some of the jobs, the last sent first.
#[derive(Serialize)]
pub(crate) struct Page {
    jobs: Vec<JobStatus>,
    /// Gives the jobs before these as `before`; null where there are none.
    next: Option<JobId>,
}

impl Service {
    /// The same service with jobs.
    #[must_use]
    pub fn with_jobs(mut self, jobs: Jobs) -> Self {
        self.jobs = Some(jobs);
        self
    }

    pub(crate) fn jobs(&self) -> Result<&Jobs, Error> {
        self.jobs.as_ref().ok_or(Error::NoJobs)
    }

    /// Tells operators how much is in the queue, for as long as it is polled.
    pub(crate) async fn count_jobs(&self) {
        let Some(jobs) = &self.jobs else {
            return std::future::pending().await;
        };
        loop {
            if let Err(error) = jobs.tell_load(HEARTBEAT_S).await {
                tracing::debug!(%error, "the queue is not counted");
            }
            sleep(COUNT).await;
        }
    }

    /// Removes jobs that are older than they are kept, for as long as it is polled.
    pub(crate) async fn remove_old_jobs(&self) {
        let (Some(jobs), Some(kept)) = (&self.jobs, self.settings.keep_results) else {
            return std::future::pending().await;
        };
        loop {
            match jobs.remove_old(kept).await {
                Ok(0) => {}
                Ok(count) => tracing::info!(count, "old jobs are removed"),
                Err(error) => tracing::warn!(%error, "old jobs are not removed"),
            }
            sleep(CLEAN).await;
        }
    }
}

impl From<JobError> for Error {
    fn from(error: JobError) -> Self {
        match error {
            JobError::Scene(error) => error.into(),
            JobError::Assets(error) => error.into(),
            JobError::Unknown(id) => Self::NotFound(format!("/v1/jobs/{id}")),
            JobError::NoResult { job, name } => Self::NotFound(format!("/v1/jobs/{job}/results/{name}")),
            JobError::Full { .. } => Self::NoRoom(error.to_string()),
            JobError::Open { .. } => Self::StillOpen(error.to_string()),
            JobError::KeyTaken { .. } => Self::KeyTaken(error.to_string()),
            JobError::Queue(_) | JobError::Store(_) => Self::Unreachable {
                cause: error.to_string(),
            },
            JobError::Address(_) | JobError::File { .. } | JobError::Damaged(_) => Self::Internal {
                cause: error.to_string(),
            },
        }
    }
}

/// Sends a job. All of it is checked before the first frame is rendered.
///
/// With an `Idempotency-Key`, the same document sent again is the same job.
#[utoipa::path(post, path = "/v1/jobs", tag = "jobs",
    request_body(content = ref("#/components/schemas/JobRequest"), content_type = "application/json"),
    params(("Idempotency-Key" = Option<String>, Header, description = "Stands for this document, up to 200 bytes")),
    responses(
        (status = 202, description = "It is in the queue", content_type = "application/json",
            body = ref("#/components/schemas/Job"), headers(("Location" = String, description = "The job"))),
        (status = 200, description = "It was sent before", content_type = "application/json",
            body = ref("#/components/schemas/Job"), headers(("Location" = String, description = "The job"))),
        Missing, Refusals, Busy))]
pub(crate) async fn post_job(
    State(service): State<Service>,
    headers: HeaderMap,
    JobText(document): JobText,
) -> Result<Response, Error> {
    let jobs = service.jobs()?;
    let key = idempotency_key(&headers)?;
    let Sent { id, is_new } = jobs.send(document, key).await?;
    let status = if is_new {
        StatusCode::ACCEPTED
    } else {
        StatusCode::OK
    };
    let location = [(header::LOCATION, format!("/v1/jobs/{id}"))];
    Ok((status, location, Json(jobs.status(id).await?)).into_response())
}

/// Jobs, the last sent first.
#[utoipa::path(get, path = "/v1/jobs", tag = "jobs",
    params(
        ("limit" = Option<u32>, Query, minimum = 1, maximum = 100, description = "How many, 20 if left out"),
        ("before" = Option<String>, Query, description = "Only jobs sent before this one")),
    responses(
        (status = 200, description = "Some of them", content_type = "application/json",
            body = ref("#/components/schemas/Jobs")),
        Missing, Refusals, Busy))]
pub(crate) async fn list_jobs(
    State(service): State<Service>,
    RawQuery(query): RawQuery,
) -> Result<Json<Page>, Error> {
    let (before, limit) = page(query.as_deref().unwrap_or_default())?;
    let jobs = service.jobs()?.list(before, limit).await?;
    let full = u32::try_from(jobs.len()).is_ok_and(|count| count == limit);
    let next = jobs.last().map(|job| job.id).filter(|_| full);
    Ok(Json(Page { jobs, next }))
}

/// How a job is doing.
#[utoipa::path(get, path = "/v1/jobs/{id}", tag = "jobs",
    params(("id" = String, Path, description = "The job")),
    responses(
        (status = 200, description = "Counts, rate, failures and what is there", content_type = "application/json",
            body = ref("#/components/schemas/Job")),
        Missing, Busy))]
pub(crate) async fn get_job(
    State(service): State<Service>,
    id: Result<Path<String>, PathRejection>,
) -> Result<Json<JobStatus>, Error> {
    let id = named(id)?;
    Ok(Json(service.jobs()?.status(id).await?))
}

/// Stops a job: what waits is not begun, what is being rendered ends at the next tile. Results that are there stay.
///
/// With `results=true` it removes one that has ended: its results, its labels, its copies of assets, and the job.
#[utoipa::path(delete, path = "/v1/jobs/{id}", tag = "jobs",
    params(
        ("id" = String, Path, description = "The job"),
        ("results" = Option<bool>, Query, description = "`true` removes a job that has ended; `false` if left out")),
    responses(
        (status = 200, description = "It is stopped, or had ended", content_type = "application/json",
            body = ref("#/components/schemas/Job")),
        (status = 204, description = "It is gone, with its results"),
        Missing, InWork, Refusals, Busy))]
pub(crate) async fn delete_job(
    State(service): State<Service>,
    id: Result<Path<String>, PathRejection>,
    RawQuery(query): RawQuery,
) -> Result<Response, Error> {
    let (jobs, id) = (service.jobs()?, named(id)?);
    if with_results(query.as_deref().unwrap_or_default())? {
        jobs.remove(id).await?;
        return Ok(StatusCode::NO_CONTENT.into_response());
    }
    jobs.cancel(id).await?;
    Ok(Json(jobs.status(id).await?).into_response())
}

/// A result: a frame by its number from 0, or a file that is made of all frames by its name.
#[utoipa::path(get, path = "/v1/jobs/{id}/results/{name}", tag = "jobs",
    params(
        ("id" = String, Path, description = "The job"),
        ("name" = String, Path, description = "A frame's number, or a name among the job's `files`")),
    responses(
        (status = 200, description = "The file", content_type = "application/octet-stream", body = String),
        Missing, Busy))]
pub(crate) async fn get_result(
    State(service): State<Service>,
    place: Result<Path<(String, String)>, PathRejection>,
) -> Result<Response, Error> {
    let Path((id, name)) = place.map_err(|e| Error::NotFound(e.body_text()))?;
    let id: JobId = id.parse()?;
    let (file, bytes) = service.jobs()?.result(id, &name).await?;
    let mut headers = HeaderMap::new();
    headers.insert(header::CONTENT_LENGTH, file.bytes.into());
    headers.insert(
        header::CONTENT_TYPE,
        HeaderValue::from_static(media_type(&file.name)),
    );
    // A frame is written once.
    let is_frame = name.bytes().all(|byte| byte.is_ascii_digit());
    let kept = if is_frame {
        "private, max-age=31536000, immutable"
    } else {
        "no-cache"
    };
    headers.insert(header::CACHE_CONTROL, HeaderValue::from_static(kept));
    if let Ok(disposition) = HeaderValue::try_from(format!("inline; filename=\"{id}-{}\"", file.name)) {
        headers.insert(header::CONTENT_DISPOSITION, disposition);
    }
    Ok((headers, Body::from_stream(bytes)).into_response())
}

/// As HTTP names what a result holds.
fn media_type(name: &str) -> &'static str {
    match name.rsplit('.').next().unwrap_or_default() {
        "jsonl" => "application/jsonl",
        "mp4" => "video/mp4",
        "webm" => "video/webm",
        "gif" => "image/gif",
        "apng" => "image/apng",
        _ => format_from_path(name.as_ref()).map_or("application/octet-stream", welkin_encode::media_type),
    }
}

fn named(id: Result<Path<String>, PathRejection>) -> Result<JobId, Error> {
    let Path(id) = id.map_err(|e| Error::NotFound(e.body_text()))?;
    Ok(id.parse()?)
}

fn idempotency_key(headers: &HeaderMap) -> Result<Option<&str>, Error> {
    let Some(key) = headers.get("idempotency-key") else {
        return Ok(None);
    };
    let key = key
        .to_str()
        .ok()
        .filter(|key| !key.is_empty() && key.len() <= MAX_KEY_BYTES);
    key.map(Some).ok_or_else(|| {
        Error::Body(format!(
            "`Idempotency-Key` must be 1 to {MAX_KEY_BYTES} printable characters of ASCII"
        ))
    })
}

fn parameters(query: &str) -> impl Iterator<Item = (&str, &str)> {
    let pairs = query.split('&').filter(|pair| !pair.is_empty());
    pairs.map(|pair| pair.split_once('=').unwrap_or((pair, "")))
}

fn wrong(name: &str, value: &str, allowed: &str) -> Error {
    let shown: String = value.chars().take(80).collect();
    let message = format!("`{name}` must be {allowed}, but is {shown}");
    Error::Invalid(vec![Fault::query(name, shown, allowed.into(), message)])
}

fn with_results(query: &str) -> Result<bool, Error> {
    let mut results = false;
    for (name, value) in parameters(query) {
        results = match (name, value) {
            ("results", "true") => true,
            ("results", "false") => false,
            ("results", _) => return Err(wrong(name, value, "true or false")),
            _ => return Err(wrong(name, value, "left out: the parameter is `results`")),
        };
    }
    Ok(results)
}

fn page(query: &str) -> Result<(Option<JobId>, u32), Error> {
    let (mut before, mut limit) = (None, USUAL_PAGE);
    for (name, value) in parameters(query) {
        let wrong = |allowed| wrong(name, value, allowed);
        match name {
            "limit" => {
                let number = value.parse().ok().filter(|n| (1..=LARGEST_PAGE).contains(n));
                limit = number.ok_or_else(|| wrong("a whole number from 1 to 100"))?;
            }
            "before" => before = Some(value.parse().map_err(|_| wrong("the id of a job"))?),
            _ => return Err(wrong("left out: parameters are `limit` and `before`")),
        }
    }
    Ok((before, limit))
}
