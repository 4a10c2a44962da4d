//! What the headers of a frame say.

use super::picture::{Asked, Picture};
use crate::metrics::Source;
use axum::http::{HeaderMap, HeaderName, HeaderValue, header};
use std::time::Duration;
use welkin_encode::{file_extension, media_type};

const SERVER_TIMING: HeaderName = HeaderName::from_static("server-timing");

/// True where `If-None-Match` names the tag. Comparison is weak, as RFC 9110 §13.1.2 asks.
pub(crate) fn has_copy(headers: &HeaderMap, etag: &str) -> bool {
    let lists = headers
        .get_all(header::IF_NONE_MATCH)
        .iter()
        .filter_map(|value| value.to_str().ok());
    lists
        .flat_map(|list| list.split(','))
        .map(str::trim)
        .any(|tag| tag == "*" || tag.trim_start_matches("W/") == etag)
}

/// What a 304 repeats of the 200.
pub(crate) fn identity(asked: &Asked, build: &str) -> HeaderMap {
    let mut headers = HeaderMap::new();
    put(&mut headers, header::ETAG, &asked.etag());
    put(&mut headers, header::CACHE_CONTROL, "no-cache");
    put(&mut headers, header::VARY, "accept");
    put(&mut headers, HeaderName::from_static("welkin-build"), build);
    headers
}

/// What the 200 tells of the file.
pub(crate) fn describe(asked: &Asked, picture: &Picture, source: Source, adapter: &str) -> HeaderMap {
    let mut headers = HeaderMap::new();
    let (request, facts) = (&asked.request, &picture.facts);
    put(&mut headers, header::CONTENT_TYPE, media_type(asked.format));
    let name = format!(
        "welkin-sun-{:.0}-{:.0}-{}x{}.{}",
        facts.sun.azimuth_deg,
        facts.sun.elevation_deg,
        request.width_px,
        request.height_px,
        file_extension(asked.format)
    );
    put(
        &mut headers,
        header::CONTENT_DISPOSITION,
        &format!("inline; filename=\"{name}\""),
    );
    put(&mut headers, SERVER_TIMING, &timing(picture, source));
    put(&mut headers, HeaderName::from_static("welkin-adapter"), adapter);
    let sun = format!(
        "azimuth_deg={:.4}, elevation_deg={:.4}",
        facts.sun.azimuth_deg, facts.sun.elevation_deg
    );
    put(&mut headers, HeaderName::from_static("welkin-sun"), &sun);
    let [red, green, blue] = facts.sun_irradiance_w_m2;
    put(
        &mut headers,
        HeaderName::from_static("welkin-sun-irradiance-w-m2"),
        &format!("{red}, {green}, {blue}"),
    );
    if let Some(ev100) = facts.ev100 {
        put(
            &mut headers,
            HeaderName::from_static("welkin-ev100"),
            &format!("{ev100:.4}"),
        );
    }
    headers
}

/// The times of the frame at hand; a kept one took no time now.
fn timing(picture: &Picture, source: Source) -> String {
    if !matches!(source, Source::Rendered) {
        return "cache;desc=\"kept from before\"".into();
    }
    let passes_ms: f64 = picture.passes.iter().map(|pass| pass.ms).sum();
    let queue_ms = (ms(picture.rendering) - passes_ms).max(0.0);
    let entry = |name: &str, ms: f64| format!("{name};dur={ms:.2}");
    let first = std::iter::once(format!(
        "queue;dur={queue_ms:.2};desc=\"waiting and what no pass counts\""
    ));
    let passes = picture.passes.iter().map(|pass| entry(pass.pass, pass.ms));
    first
        .chain(passes)
        .chain([entry("encode", ms(picture.encoding))])
        .collect::<Vec<_>>()
        .join(", ")
}

fn ms(duration: Duration) -> f64 {
    duration.as_secs_f64() * 1e3
}

/// A value that cannot stand in a header, such as an adapter's name with odd characters, is written without those.
fn put(headers: &mut HeaderMap, name: HeaderName, value: &str) {
    let plain: String = value
        .chars()
        .filter(|c| c.is_ascii() && !c.is_ascii_control())
        .collect();
    if let Ok(value) = HeaderValue::try_from(plain) {
        headers.insert(name, value);
    }
}
