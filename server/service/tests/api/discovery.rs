//! What there is, and how it does.

use crate::{
    client::{get, post, router},
    fake::Fake,
};
use serde_json::json;

#[tokio::test]
async fn presets_are_listed_and_each_renders() {
    let fake = Fake::new();
    let app = router(&fake);
    let presets = get(&app, "/v1/presets").await.json();
    for name in [
        "clear-noon",
        "golden-hour",
        "twilight",
        "moonlit-night",
        "starry-night",
        "from-orbit",
        "fair-weather",
        "cumulonimbus",
        "cirrus",
        "complutense",
        "bauman",
    ] {
        let preset = get(&app, &format!("/v1/presets/{name}")).await.json();
        assert!(presets.as_array().unwrap().contains(&preset), "{name}");
        let request = json!({"scene": preset["scene"], "width_px": 8, "height_px": 8});
        assert_eq!(
            post(&app, "/v1/frames", request.to_string()).await.status,
            200,
            "{name}"
        );
    }
}

#[tokio::test]
async fn schemas_are_those_of_the_scene() {
    let app = router(&Fake::new());
    for (kind, schema) in [
        ("scene", welkin_scene::schema::scene_schema()),
        ("frame", welkin_scene::schema::frame_request_schema()),
        ("probe", welkin_scene::schema::probe_request_schema()),
        ("timeline", welkin_scene::schema::timeline_schema()),
    ] {
        assert_eq!(get(&app, &format!("/v1/schema/{kind}")).await.json(), schema);
    }
}

#[tokio::test]
async fn the_device_is_told() {
    let device = get(&router(&Fake::new()), "/v1/device").await.json();
    assert_eq!(
        (&device["adapter"], &device["max_side_px"]),
        (&"Gradient ™".into(), &16_384.into())
    );
    assert_eq!(device["build"], env!("CARGO_PKG_VERSION"));
}

#[tokio::test]
async fn it_is_alive_and_ready() {
    let app = router(&Fake::new());
    for path in ["/healthz", "/readyz"] {
        assert_eq!(get(&app, path).await.status, 200);
    }
}

#[tokio::test]
async fn metrics_count_requests_frames_and_passes() {
    let app = router(&Fake::new());
    for _ in 0..2 {
        get(&app, "/v1/frames?width_px=40&height_px=20&format=jpeg").await;
    }
    get(&app, "/some/made-up/path").await;
    let text = String::from_utf8(get(&app, "/metrics").await.body.to_vec()).unwrap();
    for line in [
        "welkin_frames_total{format=\"jpeg\",quality=\"final\",source=\"rendered\"}",
        "welkin_frames_total{format=\"jpeg\",quality=\"final\",source=\"cache\"}",
        "welkin_render_pass_seconds_bucket{pass=\"sky\",le=",
        "welkin_encode_seconds_count{format=\"jpeg\"}",
        "welkin_frames_in_work ",
        "axum_http_requests_total{method=\"GET\",status=\"200\",endpoint=\"/v1/frames\"}",
    ] {
        assert!(text.contains(line), "{line} is not in\n{text}");
    }
    assert!(
        !text.contains("made-up"),
        "paths of no route must not become labels"
    );
}
