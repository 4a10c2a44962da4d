//! The board under `/jobs`.

use crate::{
    client::{call, get, json_request},
    fake::Fake,
    jobs::{Place, small},
};
use serde_json::json;
use welkin_service::{Service, Settings, app};

#[tokio::test(flavor = "multi_thread")]
async fn the_board_shows_the_queue_and_changes_nothing() {
    let place = Place::new().await;
    place.post(&small(3)).await;
    let page = get(&place.app, "/jobs").await;
    assert_eq!(
        (page.status.as_u16(), page.header("content-type")),
        (200, "text/html; charset=utf-8")
    );
    assert!(
        page.header("content-security-policy")
            .contains("'wasm-unsafe-eval'")
    );
    // Links are relative, so that they hold behind a proxy that puts something before.
    for view in ["/jobs", "/jobs/", "/jobs/queues", "/jobs/queues/welkin/tasks"] {
        let page = get(&place.app, view).await;
        assert_eq!(page.status, 200, "{view}");
        let text = String::from_utf8(page.body.to_vec()).unwrap();
        let links = ["href=\"", "src=\""].map(|name| {
            let (_, after) = text.split_once(name).unwrap();
            after.split_once('"').unwrap().0.to_owned()
        });
        for link in links {
            assert!(!link.starts_with('/'), "{link}");
            let base: axum::http::Uri = format!("http://any{view}").parse().unwrap();
            let mut folders: Vec<_> = base.path().split('/').collect();
            folders.pop();
            for part in link.split('/') {
                match part {
                    "." => {}
                    ".." => drop(folders.pop()),
                    other => folders.push(other),
                }
            }
            let place_of_it = folders.join("/");
            assert_eq!(get(&place.app, &place_of_it).await.status, 200, "{view}: {link}");
        }
    }
    for missing in ["/jobs/nothing.js", "/jobs/api/v1/nothing"] {
        get(&place.app, missing).await.problem(404);
    }
    let tasks = get(
        &place.app,
        "/jobs/api/v1/queues/welkin/tasks?status=Pending&page=1&page_size=2",
    )
    .await
    .json();
    assert_eq!(tasks.as_array().unwrap().len(), 2, "{tasks}");
    for query in [
        "page=0",
        "page=x",
        "page_size=0",
        "page_size=201",
        "page_size=4294967295",
    ] {
        let problem = get(&place.app, &format!("/jobs/api/v1/queues/welkin/tasks?{query}"))
            .await
            .problem(422);
        assert_eq!(problem["parameter"], query.split_once('=').unwrap().0);
    }
    let task = json!({"job": "any", "part": {"frame": 0}, "queued_ms": 0});
    for method in ["PUT", "POST", "DELETE", "PATCH"] {
        let mut request = json_request("/jobs/api/v1/queues/welkin/tasks", task.to_string());
        *request.method_mut() = method.parse().unwrap();
        call(&place.app, request).await.problem(405);
    }
    let tasks = get(
        &place.app,
        "/jobs/api/v1/queues/welkin/tasks?status=Pending&page=1&page_size=200",
    )
    .await
    .json();
    assert_eq!(tasks.as_array().unwrap().len(), 3);
    let without = app(Service::new(Fake::new() as _, Settings::default())).unwrap();
    get(&without, "/jobs").await.problem(404);
}
