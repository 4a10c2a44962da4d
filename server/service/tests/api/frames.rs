//! What `/v1/frames` and `/v1/probe` answer.

use crate::{
    client::{call, get, json_request, post, router},
    fake::Fake,
};
use axum::{
    body::Body,
    http::{Request, header},
};
use serde_json::json;
use welkin_scene::renderer::{Output, Priority};

#[tokio::test]
async fn an_empty_object_is_a_frame_with_all_its_headers() {
    let fake = Fake::new();
    let app = router(&fake);
    let answer = post(&app, "/v1/frames", "{}").await;
    assert_eq!(answer.status, 200);
    assert!(answer.body.starts_with(b"\x89PNG"));
    assert_eq!(answer.header("content-type"), "image/png");
    assert_eq!(
        answer.header("content-disposition"),
        "inline; filename=\"welkin-sun-180-35-1280x720.png\""
    );
    assert_eq!(answer.header("cache-control"), "no-cache");
    assert_eq!(answer.header("vary"), "accept");
    assert_eq!(
        answer.header("welkin-sun"),
        "azimuth_deg=180.0000, elevation_deg=35.0000"
    );
    assert_eq!(answer.header("welkin-ev100"), "14.5000");
    assert_eq!(
        answer.header("welkin-adapter"),
        "Gradient ",
        "what no header can hold is left out"
    );
    assert_eq!(answer.header("welkin-build"), env!("CARGO_PKG_VERSION"));
    let timing = answer.header("server-timing");
    for entry in [
        "queue;dur=",
        "transmittance;dur=0.25",
        "sky;dur=0.50",
        "encode;dur=",
    ] {
        assert!(timing.contains(entry), "{timing}");
    }
    assert!(!answer.header("x-request-id").is_empty());
    let order = &fake.orders.lock().unwrap()[0];
    assert_eq!((order.width_px, order.height_px), (1280, 720));
    assert_eq!(
        (order.output, order.priority),
        (Output::Display, Priority::Interactive)
    );
}

#[tokio::test]
async fn a_timeline_is_served_at_its_time() {
    let fake = Fake::new();
    let app = router(&fake);
    let timeline = json!({"scene": {"clouds": {}}, "keyframes": [
        {"at_s": 0, "patch": {"clouds": {"coverage": 0.2}}},
        {"at_s": 10, "patch": {"clouds": {"coverage": 0.6}}},
    ]});
    let at = |at_s: f64| json!({"timeline": timeline, "at_s": at_s, "width_px": 8, "height_px": 8});
    let half = post(&app, "/v1/frames", at(5.0).to_string()).await;
    assert_eq!(half.status, 200);
    let scene = fake.orders.lock().unwrap()[0].scene.clone();
    assert_eq!(scene.time_s, 5.0);
    // Four roundings.
    assert!((scene.clouds.as_ref().unwrap().coverage - 0.4).abs() < 1e-15);
    // The tag stands for what is seen, however it was asked for.
    let plain = json!({"scene": *scene, "width_px": 8, "height_px": 8});
    let plain = post(&app, "/v1/frames", plain.to_string()).await;
    assert_eq!(plain.header("etag"), half.header("etag"));
    let later = post(&app, "/v1/frames", at(6.0).to_string()).await;
    assert_ne!(later.header("etag"), half.header("etag"));

    let mut both = at(5.0);
    both["scene"] = json!({});
    let mut wrong = at(5.0);
    wrong["timeline"]["keyframes"][1]["patch"]["clouds"]["coverage"] = json!(6);
    for (request, pointer) in [
        (both, "/scene"),
        (wrong, "/timeline/keyframes/1/patch/clouds/coverage"),
        (json!({"at_s": 5}), "/at_s"),
        (
            json!({"timeline": {"keyframes": [
                {"at_s": 0, "patch": {"clouds": {"weather_map": {"kind": "asset", "name": "none"}}}}]}}),
            "/timeline",
        ),
    ] {
        let refused = post(&app, "/v1/frames", request.to_string()).await;
        assert_eq!(refused.status, 422);
        assert_eq!(
            refused.json()["errors"][0]["pointer"],
            pointer,
            "{}",
            refused.json()
        );
    }
}

#[tokio::test]
async fn the_field_then_accept_then_png_choose_the_format() {
    let app = router(&Fake::new());
    for (field, accept, expected) in [
        (None, None, "image/png"),
        (None, Some("image/jpeg"), "image/jpeg"),
        (Some("exr"), Some("image/jpeg"), "image/x-exr"),
        (None, Some("text/html, image/*;q=0.5"), "image/png"),
        (Some("npy"), None, "application/x-npy"),
        (Some("hdr"), None, "image/vnd.radiance"),
        (Some("raw"), None, "application/octet-stream"),
    ] {
        let mut body = json!({"width_px": 32, "height_px": 16});
        if let Some(format) = field {
            body["format"] = format.into();
        }
        let mut request = json_request("/v1/frames", body.to_string());
        if let Some(accept) = accept {
            request
                .headers_mut()
                .insert(header::ACCEPT, accept.parse().unwrap());
        }
        let answer = call(&app, request).await;
        assert_eq!(answer.header("content-type"), expected, "{field:?} {accept:?}");
    }
}

#[tokio::test]
async fn raw_radiance_is_the_renderers_own() {
    let app = router(&Fake::new());
    let body = r#"{"width_px": 4, "height_px": 2, "format": "raw"}"#;
    let answer = post(&app, "/v1/frames", body).await;
    assert_eq!(answer.body.len(), 4 * 2 * 12);
    assert_eq!(
        answer.body[12..16],
        0.25_f32.to_le_bytes(),
        "red of the second pixel"
    );
    assert!(
        answer.headers.get("welkin-ev100").is_none(),
        "radiance has no exposure"
    );
}

#[tokio::test]
async fn a_frame_one_has_is_not_rendered_again() {
    let fake = Fake::new();
    let app = router(&fake);
    let first = post(&app, "/v1/frames", "{}").await;
    let tag = first.header("etag").to_owned();
    let equal = r#" {"height_px": 720, "scene": {"sun": {"disc": true}}, "quality": "final"}"#;
    for (held, expected) in [
        (tag.clone(), 304),
        (format!("\"x\", W/{tag}"), 304),
        ("\"x\"".into(), 200),
    ] {
        let mut request = json_request("/v1/frames", equal);
        request
            .headers_mut()
            .insert(header::IF_NONE_MATCH, held.parse().unwrap());
        let answer = call(&app, request).await;
        assert_eq!(answer.status, expected, "{held}");
        assert_eq!(
            answer.header("etag"),
            tag,
            "the same request in other words has the same tag"
        );
        assert_eq!(answer.body.is_empty(), expected == 304);
    }
    assert_eq!(fake.orders.lock().unwrap().len(), 1);
    let other = post(&app, "/v1/frames", r#"{"scene": {"time_s": 1}}"#).await;
    assert_ne!(other.header("etag"), tag);
}

#[tokio::test]
async fn a_copy_is_known_before_anything_is_rendered() {
    let fake = Fake::new();
    let tag = post(&router(&Fake::new()), "/v1/frames", "{}")
        .await
        .header("etag")
        .to_owned();
    let mut request = json_request("/v1/frames", "{}");
    request
        .headers_mut()
        .insert(header::IF_NONE_MATCH, tag.parse().unwrap());
    assert_eq!(call(&router(&fake), request).await.status, 304);
    assert!(fake.orders.lock().unwrap().is_empty());
}

#[tokio::test]
async fn a_query_is_a_frame_too() {
    let fake = Fake::new();
    let app = router(&fake);
    let answer = get(
        &app,
        "/v1/frames?preset=twilight&width_px=64&height_px=32&format=jpeg&quality=preview",
    )
    .await;
    assert_eq!(
        (answer.status.as_u16(), answer.header("content-type")),
        (200, "image/jpeg")
    );
    let sun = get(&app, "/v1/frames?sun_azimuth_deg=90.5&width_px=64&height_px=32").await;
    assert_eq!(
        sun.header("welkin-sun"),
        "azimuth_deg=90.5000, elevation_deg=35.0000"
    );
    let place = "time=2026-06-21T12:00:00Z&latitude_deg=60&longitude_deg=30";
    let answer = get(&app, &format!("/v1/frames?{place}&width_px=64&height_px=32")).await;
    assert_eq!(answer.status, 200);
    let orders = fake.orders.lock().unwrap();
    assert_eq!(
        orders[0].scene.sun,
        welkin_scene::preset::preset("twilight").unwrap().scene.sun
    );
    // Midsummer noon at 60° N, 30° E is at about 10:02 UTC with the sun at 53.4°; two hours later it is lower and
    // past the south.
    let sun = orders[2].scene.sun_place();
    assert!(
        (40.0..53.0).contains(&sun.elevation_deg) && (200.0..260.0).contains(&sun.azimuth_deg),
        "{sun:?}"
    );
}

#[tokio::test]
async fn a_head_request_has_the_headers_alone() {
    let app = router(&Fake::new());
    let answer = call(
        &app,
        Request::head("/v1/frames?width_px=8&height_px=8")
            .body(Body::empty())
            .unwrap(),
    )
    .await;
    assert_eq!(answer.status, 200);
    assert!(answer.body.is_empty() && !answer.header("etag").is_empty());
}

#[tokio::test]
async fn a_probe_answers_each_direction() {
    let app = router(&Fake::new());
    let body = r#"{"directions": [[0, 0, 2], {"azimuth_deg": 90, "elevation_deg": 0}]}"#;
    let answer = post(&app, "/v1/probe", body).await.json();
    assert_eq!(answer["radiance_w_m2_sr"][0], json!([0.0, 0.0, 1.0]));
    assert_eq!(answer["distance_m"], json!([null, null]));
    assert_eq!(answer["sun"]["elevation_deg"].as_f64().unwrap().round(), 35.0);
}
