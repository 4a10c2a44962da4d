//! The routes, and what is laid round all of them.

use crate::{
    assets,
    body::{BodyTimeout, MAX_BODY_BYTES, MAX_JOB_BYTES},
    discovery,
    error::Error,
    frames, jobs, live, metrics, openapi, operations, probe, problem, scenes,
    state::Service,
    web,
};
use axum::{
    Extension, Router,
    extract::{DefaultBodyLimit, Request},
    http::{Extensions, HeaderMap, HeaderName, HeaderValue, StatusCode, Version, header},
    middleware::from_fn,
    response::Response,
};
use std::{sync::Arc, time::Duration};
use tower::ServiceBuilder;
use tower_http::{
    catch_panic::CatchPanicLayer,
    compression::CompressionLayer,
    request_id::{MakeRequestUuid, PropagateRequestIdLayer, RequestId, SetRequestIdLayer},
    set_header::SetResponseHeaderLayer,
    timeout::RequestBodyDeadlineLayer,
    trace::TraceLayer,
};
use tracing::Span;
use utoipa::OpenApi;
use utoipa_axum::{router::OpenApiRouter, routes};
use utoipa_swagger_ui::{Config, SwaggerUi};

/// What a link must carry for a file to arrive in time, bytes/s. A slower one would keep others waiting.
const SLOWEST_UPLOAD: u64 = 1 << 20;

/// The service's routes; call it with `tower::ServiceExt::oneshot`, or serve it.
///
/// # Errors
/// Where the process already has another recorder of metrics.
pub fn app(service: Service) -> Result<Router, crate::StartError> {
    let start = |error: Error| crate::StartError::Setup(error.cause().unwrap_or_default().to_owned());
    metrics::recorder().map_err(start)?;
    service.assets.count();
    let (routes, described) = documented(&service).split_for_parts();
    let document = Arc::new(openapi::complete(&described, &service.settings.build).map_err(start)?);
    let docs: Router<Service> = SwaggerUi::new("/docs")
        .config(Config::from("/openapi.json"))
        .into();
    let docs = docs.layer(SetResponseHeaderLayer::overriding(
        header::CONTENT_SECURITY_POLICY,
        openapi::DOCS_POLICY,
    ));
    let request_id = HeaderName::from_static("x-request-id");
    let nosniff = HeaderValue::from_static("nosniff");
    Ok(routes
        .merge(docs)
        .merge(jobs::board::routes(&service))
        .fallback(web::asset)
        .layer(CompressionLayer::new().compress_when(is_text))
        .layer(
            ServiceBuilder::new()
                .layer(SetRequestIdLayer::new(request_id.clone(), MakeRequestUuid))
                .layer(
                    TraceLayer::new_for_http()
                        .make_span_with(span)
                        .on_response(log_answer)
                        .on_failure(()),
                )
                .layer(PropagateRequestIdLayer::new(request_id))
                .layer(metrics::layer())
                .layer(SetResponseHeaderLayer::if_not_present(
                    header::CONTENT_SECURITY_POLICY,
                    web::POLICY,
                ))
                .layer(SetResponseHeaderLayer::if_not_present(
                    header::X_CONTENT_TYPE_OPTIONS,
                    nosniff,
                ))
                .layer(from_fn(problem::answer))
                .layer(CatchPanicLayer::custom(problem::from_panic))
                .layer(Extension(document)),
        )
        .with_state(service))
}

fn documented(service: &Service) -> OpenApiRouter<Service> {
    let timeout = service.settings.body_timeout;
    let documents = OpenApiRouter::with_openapi(openapi::Description::openapi())
        .routes(routes!(web::index))
        .routes(routes!(frames::get_frame, frames::post_frame))
        .routes(routes!(live::live))
        .routes(routes!(probe::post_probe))
        .routes(routes!(scenes::from_metar))
        .routes(routes!(discovery::list_presets))
        .routes(routes!(discovery::get_preset))
        .routes(routes!(discovery::scene_schema))
        .routes(routes!(discovery::frame_schema))
        .routes(routes!(discovery::probe_schema))
        .routes(routes!(discovery::timeline_schema))
        .routes(routes!(discovery::job_schema))
        .routes(routes!(discovery::device))
        .routes(routes!(openapi::openapi))
        .routes(routes!(operations::health))
        .routes(routes!(operations::ready))
        .routes(routes!(operations::numbers));
    let files = OpenApiRouter::new()
        .routes(routes!(assets::list_all))
        .routes(routes!(assets::list_kind))
        .routes(routes!(
            assets::get_asset,
            assets::put_asset,
            assets::delete_asset
        ));
    let batches = OpenApiRouter::new()
        .routes(routes!(jobs::list_jobs, jobs::post_job))
        .routes(routes!(jobs::get_job, jobs::delete_job))
        .routes(routes!(jobs::get_events))
        .routes(routes!(jobs::get_result));
    let job_timeout = timeout + Duration::from_secs(MAX_JOB_BYTES as u64 / SLOWEST_UPLOAD);
    let file_bytes = service
        .assets
        .store()
        .map_or(0, |store| store.limits().max_asset_bytes);
    let file_timeout = timeout + Duration::from_secs(file_bytes / SLOWEST_UPLOAD);
    bounded(documents, timeout, MAX_BODY_BYTES as u64)
        .merge(bounded(batches, job_timeout, MAX_JOB_BYTES as u64))
        .merge(bounded(files, file_timeout, file_bytes))
}

/// Routes whose bodies are no longer than this, in bytes and in time.
fn bounded(routes: OpenApiRouter<Service>, timeout: Duration, bytes: u64) -> OpenApiRouter<Service> {
    routes.layer(
        ServiceBuilder::new()
            .layer(Extension(BodyTimeout(timeout)))
            .layer(RequestBodyDeadlineLayer::new(timeout))
            .layer(DefaultBodyLimit::max(
                usize::try_from(bytes).unwrap_or(usize::MAX),
            )),
    )
}

/// Pictures and radiance are compressed by their format or not worth the time.
fn is_text(_: StatusCode, _: Version, headers: &HeaderMap, _: &Extensions) -> bool {
    let kind = headers
        .get(header::CONTENT_TYPE)
        .and_then(|kind| kind.to_str().ok())
        .unwrap_or_default();
    kind.starts_with("text/") || kind.contains("json") || kind.contains("javascript") || kind.contains("svg")
}

fn span(request: &Request) -> Span {
    let id = request
        .extensions()
        .get::<RequestId>()
        .and_then(|id| id.header_value().to_str().ok());
    tracing::info_span!("request", id, method = %request.method(), path = request.uri().path())
}

fn log_answer<B>(response: &Response<B>, took: Duration, span: &Span) {
    let (status, ms) = (response.status().as_u16(), took.as_secs_f64() * 1e3);
    tracing::info!(parent: span, status, ms, "answered");
}
