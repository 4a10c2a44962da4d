//! Scenes that name weather maps: frames, probes and live views of them.

use crate::{
    asset_files::{MAPS, Shelf, delete, put, send, triangle, weather_map},
    client::{Viewer, post, server_of},
    fake::Fake,
};
use serde_json::{Value, json};
use std::sync::Arc;
use welkin_service::{Settings, app};

fn scene(name: &str) -> Value {
    json!({"clouds": {"weather_map": {"kind": "asset", "name": name}}})
}

fn frame(name: &str) -> String {
    json!({"scene": scene(name), "width_px": 32, "height_px": 16}).to_string()
}

#[tokio::test]
async fn the_renderer_gets_the_picture_and_the_tag_follows_its_content() {
    let (shelf, fake) = (Shelf::new(), Fake::new());
    let app = shelf.router(&fake);
    put(&app, "front", weather_map(1)).await;
    let tag = async || {
        let answer = post(&app, "/v1/frames", frame("front")).await;
        assert_eq!(answer.status, 200);
        answer.header("etag").to_owned()
    };
    let first = tag().await;
    assert_eq!(tag().await, first);
    assert_eq!(fake.orders.lock().unwrap().len(), 1, "kept");
    put(&app, "front", weather_map(2)).await;
    let second = tag().await;
    assert_ne!(first, second);
    let seen: Vec<_> = fake
        .orders
        .lock()
        .unwrap()
        .iter()
        .map(|order| order.assets.weather_maps["front"].rgba[..4].to_vec())
        .collect();
    assert_eq!(seen, [[1, 1, 1, 255], [2, 2, 2, 255]]);
    put(&app, "other", weather_map(3)).await;
    assert_eq!(tag().await, second, "another asset is none of its business");
    // What is put into the folder by others is seen as well.
    shelf.put("front", &weather_map(1));
    assert_eq!(tag().await, first);
}

/// Heights and triangles as weather maps: put, listed, named, replaced.
#[tokio::test]
async fn terrain_from_files_reaches_the_renderer() {
    let (shelf, fake) = (Shelf::new(), Fake::new());
    let app = shelf.router(&fake);
    let upload = async |path: &str, file: Vec<u8>| send(&app, "PUT", path, &[], file).await;
    let frame = |kind: &str, name: &str| {
        let scene = json!({"terrain": {"kind": kind, "name": name}});
        json!({"scene": scene, "width_px": 32, "height_px": 16}).to_string()
    };
    for (path, kind, files) in [
        (
            "/v1/assets/heightfields/it",
            "heightfield",
            [weather_map(1), weather_map(2)],
        ),
        ("/v1/assets/meshes/it", "mesh", [triangle(1.0), triangle(2.0)]),
    ] {
        let missing = post(&app, "/v1/frames", frame(kind, "it")).await.problem(422);
        assert_eq!(missing["pointer"], "/scene/terrain/name");
        let mut tags = Vec::new();
        for file in &files {
            assert!(upload(path, file.clone()).await.status.is_success());
            let answer = post(&app, "/v1/frames", frame(kind, "it")).await;
            assert_eq!(answer.status, 200);
            tags.push(answer.header("etag").to_owned());
        }
        assert_ne!(tags[0], tags[1], "another file, another frame");
        let kept = crate::client::get(&app, path).await;
        assert_eq!(&kept.body[..], &files[1][..]);
    }
    let orders = fake.orders.lock().unwrap();
    let grids = orders
        .iter()
        .filter_map(|order| order.assets.heightfields.get("it"));
    let lowest: Vec<_> = grids.map(|grid| grid.heights[0]).collect();
    assert_eq!(lowest, [1.0 / 255.0, 2.0 / 255.0]);
    let meshes = orders.iter().filter_map(|order| order.assets.meshes.get("it"));
    let corners: Vec<_> = meshes.map(|mesh| mesh.positions[1]).collect();
    assert_eq!(corners, [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]);
}

#[tokio::test]
async fn a_probe_gets_the_picture() {
    let (shelf, fake) = (Shelf::new(), Fake::new());
    let app = shelf.router(&fake);
    put(&app, "front", weather_map(5)).await;
    let body = json!({"scene": scene("front"), "directions": [[0, 0, 1]]}).to_string();
    assert_eq!(post(&app, "/v1/probe", body).await.status, 200);
    let probes = fake.probes.lock().unwrap();
    assert_eq!(probes[0].assets.weather_maps["front"].rgba[0], 5);
}

#[tokio::test]
async fn a_name_that_stands_for_nothing_is_a_fault_of_its_field() {
    let (shelf, fake) = (Shelf::new(), Fake::new());
    let app = shelf.router(&fake);
    put(&app, "front", weather_map(5)).await;
    let blend = json!({"kind": "blend", "from": {"kind": "asset", "name": "front"},
        "to": {"kind": "asset", "name": "rear"}});
    for (map, pointer) in [
        (
            json!({"kind": "asset", "name": "rear"}),
            "/scene/clouds/weather_map/name",
        ),
        (blend, "/scene/clouds/weather_map/to/name"),
    ] {
        for path in ["/v1/frames", "/v1/probe"] {
            let body = json!({"scene": {"clouds": {"weather_map": map}}}).to_string();
            let problem = post(&app, path, body).await.problem(422);
            assert_eq!(
                (&problem["pointer"], &problem["value"]),
                (&pointer.into(), &"rear".into())
            );
            assert!(
                problem["allowed"].as_str().unwrap().contains("front"),
                "{problem}"
            );
        }
    }
    assert!(fake.orders.lock().unwrap().is_empty());
    let none = app_without_a_store(&fake);
    let problem = post(&none, "/v1/frames", frame("front")).await.problem(422);
    assert!(
        problem["detail"].as_str().unwrap().contains("--assets"),
        "{problem}"
    );
}

fn app_without_a_store(fake: &Arc<Fake>) -> axum::Router {
    crate::client::router(fake)
}

#[tokio::test]
async fn a_live_view_follows_its_assets() {
    let (shelf, fake) = (Shelf::new(), Fake::new());
    let service = shelf.service(&fake, Settings::default());
    let app = app(service.clone()).unwrap();
    let server = server_of(service).await;
    put(&app, "front", weather_map(1)).await;
    let mut viewer = Viewer::connect(&server).await;
    let output = json!({"width_px": 64, "height_px": 32});
    viewer
        .say(&json!({"seq": 1, "scene": scene("front"), "output": output}))
        .await;
    viewer.pictures_until_done(1).await;
    let last_seen = || {
        let orders = fake.orders.lock().unwrap();
        orders.last().unwrap().assets.weather_maps["front"].rgba[0]
    };
    assert_eq!(last_seen(), 1);
    put(&app, "front", weather_map(2)).await;
    viewer.pictures_until_done(1).await;
    assert_eq!(last_seen(), 2, "without a word from the viewer");
    put(&app, "other", weather_map(3)).await;
    put(&app, "front", weather_map(2)).await;
    assert!(viewer.is_silent().await, "nothing that it shows has changed");
    viewer.say(&json!({"seq": 2, "patch": scene("rear")})).await;
    let refused = viewer.text().await;
    assert_eq!(
        (
            &refused["seq"],
            &refused["error"]["status"],
            &refused["error"]["pointer"]
        ),
        (&2.into(), &422.into(), &"/scene/clouds/weather_map/name".into())
    );
    viewer.say(&json!({"seq": 3, "patch": {"time_s": 5}})).await;
    viewer.pictures_until_done(3).await;
    assert_eq!(last_seen(), 2, "the refused patch has changed nothing");
    // Put past this service: no news, but the next patch sees it.
    shelf.put("front", &weather_map(4));
    viewer.say(&json!({"seq": 4, "patch": {}})).await;
    viewer.pictures_until_done(4).await;
    assert_eq!(last_seen(), 4);
    delete(&app, "front").await;
    let told = viewer.text().await;
    assert_eq!((&told["seq"], &told["error"]["status"]), (&4.into(), &422.into()));
    send(&app, "PUT", &format!("{MAPS}/front"), &[], weather_map(6)).await;
    viewer.pictures_until_done(4).await;
    assert_eq!(last_seen(), 6);
}
