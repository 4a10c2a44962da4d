//! Requests that are wrong, each refused in the terms of what was sent.

use crate::{
    client::{call, get, post, router},
    fake::Fake,
};
use axum::{
    body::Body,
    http::{Request, header},
};
use serde_json::json;

#[tokio::test]
async fn bad_bodies_name_the_field() {
    let app = router(&Fake::new());
    for (body, status, pointer) in [
        ("", 400, ""),
        ("{", 400, ""),
        ("\"text\"", 422, ""),
        ("{\"scene\": {\"time_s\": NaN}}", 400, "/scene/time_s"),
        (r#"{"scene": {"time_s": 1e999}}"#, 400, "/scene/time_s"),
        (r#"{"scenne": {}}"#, 422, "/scenne"),
        (r#"{"scene": {"sun": {"discc": true}}}"#, 422, "/scene/sun/discc"),
        (
            r#"{"scene": {"planet": {"radius_m": "big"}}}"#,
            422,
            "/scene/planet/radius_m",
        ),
        (
            r#"{"scene": {"planet": {"radius_m": 1}}}"#,
            422,
            "/scene/planet/radius_m",
        ),
        (
            r#"{"scene": {"camera": {"position_m": [0, 0, -1]}}}"#,
            422,
            "/scene/camera/position_m",
        ),
        (
            r#"{"scene": {"camera": {"direction": [0, 0, 0]}}}"#,
            422,
            "/scene/camera/direction",
        ),
        (r#"{"width_px": 0}"#, 422, "/width_px"),
        (r#"{"width_px": 1.5}"#, 422, "/width_px"),
        (r#"{"height_px": 99999}"#, 422, "/height_px"),
        (r#"{"format": "gif"}"#, 422, "/format"),
    ] {
        let problem = post(&app, "/v1/frames", body).await.problem(status);
        if !pointer.is_empty() {
            let found = problem["pointer"].as_str().unwrap_or_default();
            assert!(found.starts_with(pointer), "{body}: {problem}");
            assert!(!problem["allowed"].as_str().unwrap().is_empty());
        }
    }
    for body in [
        r#"{"directions": [[0, 0, 0]]}"#,
        r#"{"directions": 1}"#,
        r#"{"direction": []}"#,
    ] {
        let problem = post(&app, "/v1/probe", body).await.problem(422);
        assert!(
            problem["pointer"].as_str().unwrap().starts_with("/direction"),
            "{problem}"
        );
    }
}

#[tokio::test]
async fn all_faults_are_told_and_the_first_stands_on_top() {
    let app = router(&Fake::new());
    let body = r#"{"width_px": 0, "scene": {"planet": {"radius_m": 1}}}"#;
    let problem = post(&app, "/v1/frames", body).await.problem(422);
    let errors = problem["errors"].as_array().unwrap();
    assert_eq!(errors.len(), 2, "{problem}");
    assert_eq!(errors[0]["pointer"], problem["pointer"]);
    assert_eq!(errors[0]["message"], problem["detail"]);
}

#[tokio::test]
async fn bad_queries_name_the_parameter() {
    let app = router(&Fake::new());
    for (query, parameter) in [
        ("presett=twilight", "presett"),
        ("preset=nowhere", "preset"),
        ("width_px=12px", "width_px"),
        ("width_px=", "width_px"),
        ("width_px=0", "width_px"),
        ("height_px=-1", "height_px"),
        ("width_px=1&width_px=2", "width_px"),
        ("sun_elevation_deg=91", "sun_elevation_deg"),
        ("sun_azimuth_deg=west", "sun_azimuth_deg"),
        ("sun_azimuth_deg=NaN", "sun_azimuth_deg"),
        ("sun_azimuth_deg=1&time=2026-01-01T00:00:00Z", "sun_azimuth_deg"),
        ("time=2026-06-21T12:00:00Z", "latitude_deg"),
        ("time=noon&latitude_deg=0&longitude_deg=0", "time"),
        (
            "time=2026-06-21T12:00:00Z&latitude_deg=95&longitude_deg=0",
            "latitude_deg",
        ),
        ("format=gif", "format"),
        ("quality=best", "quality"),
    ] {
        let problem = get(&app, &format!("/v1/frames?{query}")).await.problem(422);
        assert_eq!(problem["parameter"], parameter, "{query}: {problem}");
        assert!(problem["pointer"].is_null(), "{query}: {problem}");
    }
    let problem = get(&app, "/v1/frames?presett=twilight").await.problem(422);
    assert!(
        problem["detail"]
            .as_str()
            .unwrap()
            .contains("did you mean `preset`"),
        "{problem}"
    );
}

#[tokio::test]
async fn what_is_not_json_is_not_read() {
    let app = router(&Fake::new());
    for kind in [
        None,
        Some("text/plain"),
        Some("application/x-www-form-urlencoded"),
    ] {
        let mut request = Request::post("/v1/frames").body(Body::from("{}")).unwrap();
        if let Some(kind) = kind {
            request
                .headers_mut()
                .insert(header::CONTENT_TYPE, kind.parse().unwrap());
        }
        call(&app, request).await.problem(415);
    }
    for kind in [
        "application/json; charset=utf-8",
        "application/merge-patch+json",
        "APPLICATION/JSON",
    ] {
        let request = Request::post("/v1/probe")
            .header(header::CONTENT_TYPE, kind)
            .body(Body::from("{}"))
            .unwrap();
        assert_eq!(call(&app, request).await.status, 200, "{kind}");
    }
    post(&app, "/v1/frames", vec![b'"', 0xff, b'"'])
        .await
        .problem(400);
}

#[tokio::test]
async fn what_is_accepted_by_nobody_is_406_with_what_is_offered() {
    let app = router(&Fake::new());
    let request = Request::get("/v1/frames")
        .header(header::ACCEPT, "image/gif")
        .body(Body::empty())
        .unwrap();
    let problem = call(&app, request).await.problem(406);
    assert!(
        problem["detail"].as_str().unwrap().contains("image/png"),
        "{problem}"
    );
}

#[tokio::test]
async fn unknown_paths_and_methods_are_problems_too() {
    let app = router(&Fake::new());
    for path in [
        "/nowhere",
        "/v1/nowhere",
        "/v1/presets/nowhere",
        "/docs/nowhere.js",
    ] {
        get(&app, path).await.problem(404);
    }
    let answer = call(&app, Request::delete("/v1/frames").body(Body::empty()).unwrap()).await;
    answer.problem(405);
    let mut allowed: Vec<_> = answer.header("allow").split(',').collect();
    allowed.sort_unstable();
    assert_eq!(allowed, ["GET", "HEAD", "POST"]);
    call(&app, Request::post("/nowhere").body(Body::empty()).unwrap())
        .await
        .problem(404);
    get(&app, "/v1/live").await.problem(426);
}

#[tokio::test]
async fn a_long_body_is_not_read_to_its_end() {
    let app = router(&Fake::new());
    let body = format!("{{\"x\": \"{}\"}}", "x".repeat(1 << 20));
    let problem = post(&app, "/v1/frames", body).await.problem(413);
    assert!(
        problem["detail"].as_str().unwrap().contains("1048576"),
        "{problem}"
    );
}

#[tokio::test]
async fn deep_nesting_does_not_break_the_stack() {
    let app = router(&Fake::new());
    let body = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
    post(&app, "/v1/frames", body).await.problem(400);
}

#[tokio::test]
async fn a_panic_is_an_error_of_one_request() {
    let app = router(&Fake::new());
    let problem = post(&app, "/v1/frames", r#"{"scene": {"time_s": 2e8}}"#)
        .await
        .problem(500);
    assert!(
        !problem.to_string().contains("made to break"),
        "the cause is for the log: {problem}"
    );
    assert_eq!(post(&app, "/v1/frames", "{}").await.status, 200);
}

#[tokio::test]
async fn the_instance_names_path_and_request() {
    let app = router(&Fake::new());
    let answer = post(&app, "/v1/frames", "{").await;
    let instance = format!("/v1/frames#{}", answer.header("x-request-id"));
    assert_eq!(answer.problem(400)["instance"], json!(instance));
}
