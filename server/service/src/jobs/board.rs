//! `/jobs`: the board of apalis, to look into the queue with.
//!
//! It is made to stand at the root of a site of its own and to change what it shows. Here it stands under `/jobs`, and
//! behind a proxy under `/anything/jobs`, so the few places where its glue touches addresses are led to where its files
//! came from; and it only looks, because a task that somebody puts into the queue is checked by nobody.

use crate::{
    error::{Error, Fault},
    state::Service,
};
use apalis_board_api::{
    framework::{ApiBuilder, RegisterRoute},
    ui::ServeUI,
};
use axum::{
    Router,
    extract::{Request, State},
    http::{HeaderValue, Method, Uri, header},
    middleware::{Next, from_fn},
    response::{
        IntoResponse, Response,
        sse::{Event, KeepAlive, Sse},
    },
    routing::get,
};
use futures_util::stream;
use std::{convert::Infallible, sync::OnceLock};
use tower_http::set_header::SetResponseHeaderLayer;
use welkin_jobs::{Board, Jobs};

/// Where it stands.
const PLACE: &str = "/jobs";
/// Names of its files in the version that is built in; a test tells where another has others.
const GLUE: &str = "apalis-board-web-5f43ae260a03616d.js";
const PROGRAM: &str = "apalis-board-web-5f43ae260a03616d_bg.wasm";
const STYLE: &str = "input-2a95b2ef12d8c39a.css";
/// Most tasks of one answer.
const LARGEST_PAGE: u32 = 200;
/// Most pages: addresses of tasks are counted with 32 bits.
const MOST_PAGES: u32 = 1_000_000;
/// The board is a program for WebAssembly and sets styles as it goes; it may reach this server and nothing else.
const POLICY: HeaderValue = HeaderValue::from_static(
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; \
     img-src 'self' data:; object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'self'",
);

/// What the glue does with addresses, and what it is to do here: `inside` leads one to the board, `outside` tells one
/// as the board knows it.
const LED: [(&str, &str, usize); 4] = [
    ("arg1.pathname;", "outside(arg1.pathname);", 2),
    (
        "undefined : getStringFromWasm0(arg4, arg5)",
        "undefined : inside(getStringFromWasm0(arg4, arg5))",
        2,
    ),
    (
        "new Request(getStringFromWasm0(arg0, arg1)",
        "new Request(inside(getStringFromWasm0(arg0, arg1))",
        2,
    ),
    (
        "new EventSource(getStringFromWasm0(arg0, arg1)",
        "new EventSource(inside(getStringFromWasm0(arg0, arg1))",
        1,
    ),
];
const LEADING: &str = "
const board = new URL('.', import.meta.url).pathname.slice(0, -1);
function inside(path) { return path.startsWith('/') && !outside.is(path) ? board + path : path; }
function outside(path) { return outside.is(path) ? path.slice(board.length) || '/' : path; }
outside.is = (path) => path === board || path.startsWith(board + '/');
";

/// The board and what it asks for; nothing where there are no jobs.
pub(crate) fn routes(service: &Service) -> Router<Service> {
    let Ok(jobs) = service.jobs() else {
        return Router::new();
    };
    let asked = ApiBuilder::new(Router::new());
    let asked: Router = match jobs.board() {
        Board::Sqlite(tasks) => asked.register(Jobs::QUEUE, tasks).build(),
        Board::Postgres(tasks) => asked.register(Jobs::QUEUE, tasks).build(),
    };
    Router::new()
        .route(PLACE, get(file))
        .route("/jobs/", get(file))
        .route("/jobs/{*file}", get(file))
        .route("/jobs/api/v1/events", get(events))
        .nest("/jobs/api/v1", asked.with_state(()))
        .layer(from_fn(only_look))
        .layer(SetResponseHeaderLayer::overriding(
            header::CONTENT_SECURITY_POLICY,
            POLICY,
        ))
}

/// Refuses what would change the queue, and pages that nobody could read.
async fn only_look(request: Request, next: Next) -> Result<Response, Error> {
    if request.method() != Method::GET && request.method() != Method::HEAD {
        return Err(Error::Method {
            method: request.method().to_string(),
        });
    }
    for (name, value) in request
        .uri()
        .query()
        .unwrap_or_default()
        .split('&')
        .filter_map(|pair| pair.split_once('='))
    {
        let most = match name {
            "page" => MOST_PAGES,
            "page_size" => LARGEST_PAGE,
            _ => continue,
        };
        if !value
            .parse::<u32>()
            .is_ok_and(|number| (1..=most).contains(&number))
        {
            let shown: String = value.chars().take(80).collect();
            let allowed = format!("a whole number from 1 to {most}");
            let message = format!("`{name}` must be {allowed}, but is {shown}");
            return Err(Error::Invalid(vec![Fault::query(name, shown, allowed, message)]));
        }
    }
    Ok(next.run(request).await)
}

/// What the board takes for the log, and the lack of it for illness: a stream that says nothing. The log is for who runs
/// the server, on its standard error.
async fn events(State(service): State<Service>) -> impl IntoResponse {
    let mut stopping = service.stopping();
    let silence = stream::once(async move {
        // Where nobody can say it any more, the end has come too.
        let _ = stopping.wait_for(|stop| *stop).await;
        Ok::<_, Infallible>(Event::default().comment("the end"))
    });
    Sse::new(silence).keep_alive(KeepAlive::default())
}

/// The page, for a view so many folders deep: it names its files from there, as a proxy may put something before.
fn page(view: &str) -> Response {
    let up = match view.strip_prefix('/') {
        None => "jobs/".to_owned(),
        Some(view) => format!("./{}", "../".repeat(view.matches('/').count())),
    };
    let kind = (header::CONTENT_TYPE, "text/html; charset=utf-8");
    let text = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Welkin: the queue</title>\
         <link rel=\"stylesheet\" href=\"{up}{STYLE}\">\
         <script type=\"module\" src=\"{up}start.js\"></script></head>\
         <body class=\"h-screen overflow-hidden bg-background-dimmed text-white\"></body></html>\n"
    );
    ([kind, (header::CACHE_CONTROL, "no-cache")], text).into_response()
}

/// A file of the board; any other path is a view that the page itself shows.
async fn file(uri: Uri) -> Result<Response, Error> {
    let view = uri.path().strip_prefix(PLACE).unwrap_or_default();
    let name = view.trim_start_matches('/');
    let text = |text: String| {
        let kind = (header::CONTENT_TYPE, "text/javascript; charset=utf-8");
        ([kind, (header::CACHE_CONTROL, "no-cache")], text).into_response()
    };
    match name {
        GLUE => Ok(text(glue().to_owned())),
        "start.js" => Ok(text(format!(
            "import init from './{GLUE}';\nawait init({{module_or_path: new URL('{PROGRAM}', import.meta.url)}});\n"
        ))),
        PROGRAM => part(PROGRAM),
        STYLE => part(STYLE),
        _ if name.contains('.') || name.starts_with("api/") => Err(Error::NotFound(uri.path().to_owned())),
        _ => Ok(page(view)),
    }
}

/// A file as it is; its name changes with what it holds.
fn part(name: &'static str) -> Result<Response, Error> {
    let file = ServeUI::get_file(name).ok_or_else(|| Error::NotFound(format!("{PLACE}/{name}")))?;
    let kind = (header::CONTENT_TYPE, ServeUI::content_type(name));
    let kept = ServeUI::cache_control(name).unwrap_or("no-cache");
    Ok(([kind, (header::CACHE_CONTROL, kept)], file.contents()).into_response())
}

/// The board's glue between the page and its program, with addresses led here.
fn glue() -> &'static str {
    static ONCE: OnceLock<String> = OnceLock::new();
    ONCE.get_or_init(|| {
        let told = ServeUI::get_file(GLUE)
            .and_then(|file| file.contents_utf8())
            .unwrap_or_default();
        let led = LED
            .iter()
            .fold(told.to_owned(), |text, (from, to, _)| text.replace(from, to));
        format!("{led}{LEADING}")
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;

    #[test]
    fn the_board_has_the_files_and_the_addresses_that_are_led_here() {
        for name in [GLUE, PROGRAM, STYLE] {
            assert!(ServeUI::get_file(name).is_some(), "{name}");
        }
        let told = ServeUI::get_file(GLUE).unwrap().contents_utf8().unwrap();
        for (from, to, count) in LED {
            assert_eq!(told.matches(from).count(), count, "{from}");
            assert_eq!(glue().matches(to).count(), count, "{to}");
        }
    }
}
