//! The page and its files, embedded.

use crate::{error::Error, frames::has_copy};
use axum::{
    http::{HeaderMap, HeaderValue, Method, StatusCode, Uri, header},
    response::{IntoResponse, Response},
};
use rust_embed::{Embed, EmbeddedFile};

/// What the browser loads; what the client is developed and tested with stays out.
#[derive(Embed)]
#[folder = "../../web"]
#[include = "*.html"]
#[include = "*.css"]
#[include = "*.js"]
#[include = "*.mjs"]
#[include = "*.svg"]
#[include = "*.png"]
#[include = "*.ico"]
#[include = "*.woff2"]
#[include = "*.webmanifest"]
#[include = "*LICENSE*"]
#[exclude = "node_modules/*"]
#[exclude = "test/*"]
#[exclude = "tests/*"]
#[exclude = "*.test.js"]
#[exclude = "*.config.js"]
struct Client;

/// The page may load its own files and nothing else; pictures arrive over the WebSocket and become blobs.
pub(crate) const POLICY: HeaderValue = HeaderValue::from_static(
    "default-src 'self'; img-src 'self' blob: data:; connect-src 'self' ws: wss:; object-src 'none'; \
     base-uri 'none'; form-action 'none'; frame-ancestors 'self'",
);

/// The web client.
#[utoipa::path(get, path = "/", tag = "client", responses(
    (status = 200, description = "The page", content_type = "text/html", body = String)))]
pub(crate) async fn index(headers: HeaderMap) -> Result<Response, Error> {
    file("index.html", &headers)
}

/// The files of the web client; what is none of them is not found.
pub(crate) async fn asset(method: Method, uri: Uri, headers: HeaderMap) -> Result<Response, Error> {
    let readable = method == Method::GET || method == Method::HEAD;
    let name = uri.path().trim_start_matches('/');
    if readable {
        file(name, &headers)
    } else {
        Err(Error::NotFound(uri.path().to_owned()))
    }
}

/// Files are looked up in a table, not on a disk: no path leads out of it.
fn file(path: &str, headers: &HeaderMap) -> Result<Response, Error> {
    let EmbeddedFile { data, metadata } =
        Client::get(path).ok_or_else(|| Error::NotFound(format!("/{path}")))?;
    let hash: String = metadata.sha256_hash()[..12]
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect();
    // Weak, since the same tag goes with the file and with its compressed form.
    let tag = format!("W/\"{hash}\"");
    let known = [
        (header::ETAG, tag),
        (header::CACHE_CONTROL, "no-cache".to_owned()),
    ];
    if has_copy(headers, &format!("\"{hash}\"")) {
        return Ok((StatusCode::NOT_MODIFIED, known).into_response());
    }
    let kind = [(header::CONTENT_TYPE, with_charset(metadata.mimetype()))];
    Ok((known, kind, data.into_owned()).into_response())
}

fn with_charset(media_type: &str) -> String {
    let text = media_type.starts_with("text/") || media_type.ends_with("json");
    if text {
        format!("{media_type}; charset=utf-8")
    } else {
        media_type.to_owned()
    }
}
