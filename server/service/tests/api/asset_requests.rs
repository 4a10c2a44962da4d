//! What may be put, got and deleted, and what is refused.

use crate::{
    asset_files::{MAPS, Shelf, delete, put, send, weather_map},
    client::{Answer, call, get, router, server_of},
    fake::Fake,
};
use axum::{
    body::Body,
    http::{Request, header},
};
use futures_util::{future::join_all, stream};
use std::{io, net::SocketAddr, time::Duration};
use tokio::{
    io::{AsyncReadExt, AsyncWriteExt},
    net::TcpStream,
};
use welkin_assets::Limits;
use welkin_service::Settings;

#[tokio::test]
async fn a_file_is_put_listed_got_replaced_and_deleted() {
    let shelf = Shelf::new();
    let app = shelf.router(&Fake::new());
    let listing = get(&app, "/v1/assets").await.json();
    assert_eq!(listing["assets"].as_array().unwrap().len(), 0);
    let created = put(&app, "front", weather_map(1)).await;
    assert_eq!(
        (created.status.as_u16(), created.header("location")),
        (201, "/v1/assets/weather-maps/front")
    );
    let described = created.json();
    assert_eq!(
        (
            &described["kind"],
            &described["name"],
            &described["width_px"],
            &described["colour"]
        ),
        (&"weather-maps".into(), &"front".into(), &2.into(), &"grey".into())
    );
    assert_eq!(
        created.header("etag"),
        format!("\"{}\"", described["sha256"].as_str().unwrap())
    );
    for path in ["/v1/assets", MAPS] {
        let listing = get(&app, path).await.json();
        assert_eq!(listing["assets"], serde_json::json!([described]));
        assert_eq!(
            (&listing["used"]["count"], &listing["used"]["bytes"]),
            (&1.into(), &described["bytes"])
        );
        assert_eq!(listing["limits"]["max_assets"], Limits::default().max_assets);
    }
    let got = get(&app, &format!("{MAPS}/front")).await;
    assert_eq!((got.status.as_u16(), &got.body[..]), (200, &weather_map(1)[..]));
    assert_eq!(
        (got.header("content-type"), got.header("etag")),
        ("image/png", created.header("etag"))
    );
    assert_eq!(got.header("x-content-type-options"), "nosniff");
    let head = send(&app, "HEAD", &format!("{MAPS}/front"), &[], "").await;
    assert_eq!(
        (head.status.as_u16(), head.body.len(), head.header("etag")),
        (200, 0, got.header("etag"))
    );
    let same = put(&app, "front", weather_map(1)).await;
    assert_eq!(
        (same.status.as_u16(), same.header("etag")),
        (200, created.header("etag"))
    );
    let replaced = put(&app, "front", weather_map(2)).await;
    assert_eq!(replaced.status, 200);
    assert_ne!(replaced.header("etag"), created.header("etag"));
    let gone = delete(&app, "front").await;
    assert_eq!((gone.status.as_u16(), gone.body.len()), (204, 0));
    for answer in [
        delete(&app, "front").await,
        get(&app, &format!("{MAPS}/front")).await,
    ] {
        let problem = answer.problem(404);
        assert!(
            problem["detail"].as_str().unwrap().contains("weather-maps/front"),
            "{problem}"
        );
    }
    let metrics = get(&app, "/metrics").await;
    assert!(
        String::from_utf8(metrics.body.to_vec())
            .unwrap()
            .contains("welkin_assets_bytes ")
    );
}

#[tokio::test]
async fn tags_say_what_one_has_and_what_may_be_changed() {
    let shelf = Shelf::new();
    let app = shelf.router(&Fake::new());
    let path = format!("{MAPS}/map");
    let with = async |method: &str, name, value: &str, grey| -> Answer {
        send(&app, method, &path, &[(name, value)], weather_map(grey)).await
    };
    with("PUT", header::IF_MATCH, "*", 1).await.problem(412);
    with("DELETE", header::IF_MATCH, "*", 1).await.problem(412);
    let first = with("PUT", header::IF_NONE_MATCH, "*", 1).await;
    assert_eq!(first.status, 201);
    let tag = first.header("etag");
    with("PUT", header::IF_NONE_MATCH, "*", 2).await.problem(412);
    let kept = with("GET", header::IF_NONE_MATCH, tag, 0).await;
    assert_eq!(
        (kept.status.as_u16(), kept.body.len(), kept.header("etag")),
        (304, 0, tag)
    );
    let weak = format!("\"x\", W/{tag}");
    assert_eq!(with("GET", header::IF_NONE_MATCH, &weak, 0).await.status, 304);
    assert_eq!(with("GET", header::IF_MATCH, tag, 0).await.status, 200);
    let second = with("PUT", header::IF_MATCH, tag, 2).await;
    assert_eq!(second.status, 200);
    with("PUT", header::IF_MATCH, tag, 3).await.problem(412);
    with("DELETE", header::IF_MATCH, tag, 0).await.problem(412);
    with("GET", header::IF_MATCH, tag, 0).await.problem(412);
    assert_eq!(
        with("GET", header::IF_NONE_MATCH, tag, 0).await.body,
        weather_map(2)
    );
    assert_eq!(
        with("DELETE", header::IF_MATCH, second.header("etag"), 0)
            .await
            .status,
        204
    );
}

#[tokio::test]
async fn what_is_wrong_with_a_file_is_told() {
    let bytes = weather_map(1).len() as u64;
    let shelf = Shelf::of(Limits {
        max_asset_bytes: bytes,
        max_assets: 1,
        ..Limits::default()
    });
    let app = shelf.router(&Fake::new());
    let mut long = weather_map(1);
    long.push(0);
    let mut wide = weather_map(1);
    // The width stands 16 bytes into the file; the checksum after it is no longer right.
    wide[16..20].copy_from_slice(&5000_u32.to_be_bytes());
    let cut = weather_map(1)[..bytes as usize - 5].to_vec();
    for (file, status, told) in [
        (
            b"\xff\xd8\xff no PNG".to_vec(),
            415,
            "not a weather map: send a PNG",
        ),
        (Vec::new(), 415, "not a weather map: send a PNG"),
        (cut, 422, "cut short"),
        (wide, 422, "damaged"),
        (long, 413, "bytes at most"),
    ] {
        let problem = put(&app, "map", file).await.problem(status);
        assert!(problem["detail"].as_str().unwrap().contains(told), "{problem}");
    }
    assert_eq!(put(&app, "map", weather_map(1)).await.status, 201);
    let problem = put(&app, "other", weather_map(2)).await.problem(507);
    assert!(
        problem["detail"].as_str().unwrap().contains("1 assets"),
        "{problem}"
    );
    assert_eq!(
        put(&app, "map", weather_map(2)).await.status,
        200,
        "there is room for another in its place"
    );
}

#[tokio::test]
async fn odd_names_and_kinds_are_refused() {
    let shelf = Shelf::new();
    let app = shelf.router(&Fake::new());
    let long = "x".repeat(65);
    for name in [
        "Front",
        "-a",
        "a.png",
        "a%20b",
        "%2e%2e",
        "..%2F..%2Fx",
        "a%00",
        "a%5Cb",
        "%C3%A9",
        &long,
    ] {
        for method in ["GET", "PUT", "DELETE"] {
            let answer = send(&app, method, &format!("{MAPS}/{name}"), &[], weather_map(1)).await;
            let problem = answer.problem(422);
            assert_eq!(problem["parameter"], "name", "{problem}");
            assert!(problem["allowed"].as_str().unwrap().contains("a-z"), "{problem}");
        }
    }
    for kind in ["clouds", "..", "%2e%2e", "weather-maps%2F.."] {
        for path in [format!("/v1/assets/{kind}/map"), format!("/v1/assets/{kind}")] {
            let problem = get(&app, &path).await.problem(404);
            assert!(
                problem["detail"]
                    .as_str()
                    .unwrap()
                    .contains("the kinds of asset are"),
                "{path}: {problem}"
            );
        }
        send(
            &app,
            "PUT",
            &format!("/v1/assets/{kind}/map"),
            &[],
            weather_map(1),
        )
        .await
        .problem(404);
    }
    get(&app, &format!("{MAPS}/%ff")).await.problem(404);
    assert!(
        std::fs::read_dir(shelf.folder.path()).unwrap().next().is_none(),
        "nothing was written"
    );
}

#[tokio::test]
async fn without_a_store_every_call_says_so() {
    let app = router(&Fake::new());
    for (method, path) in [
        ("GET", "/v1/assets"),
        ("GET", MAPS),
        ("GET", "/v1/assets/weather-maps/map"),
        ("PUT", "/v1/assets/weather-maps/map"),
        ("DELETE", "/v1/assets/weather-maps/map"),
    ] {
        let problem = send(&app, method, path, &[], weather_map(1)).await.problem(404);
        assert!(
            problem["detail"].as_str().unwrap().contains("--assets"),
            "{method} {path}: {problem}"
        );
    }
}

#[tokio::test]
async fn bodies_without_an_end_are_given_up() {
    let shelf = Shelf::of(Limits {
        max_asset_bytes: 1000,
        ..Limits::default()
    });
    let body_timeout = Duration::from_millis(50);
    let settings = Settings {
        body_timeout,
        memory_timeout: Duration::from_millis(20),
        ..Settings::default()
    };
    let app = shelf.router_with(&Fake::new(), settings);
    let request = |body| Request::put(format!("{MAPS}/map")).body(body).unwrap();
    let trickle = || Body::from_stream(stream::pending::<io::Result<Vec<u8>>>());
    call(&app, request(trickle())).await.problem(408);
    let flood = Body::from_stream(stream::repeat_with(|| Ok::<_, io::Error>(vec![0; 100])));
    let problem = call(&app, request(flood)).await.problem(413);
    assert!(problem["detail"].as_str().unwrap().contains("1000"), "{problem}");
    // Four are taken in at once.
    let answers = join_all((0..6).map(|_| call(&app, request(trickle())))).await;
    let mut statuses: Vec<_> = answers.iter().map(|answer| answer.status.as_u16()).collect();
    statuses.sort_unstable();
    assert_eq!(statuses, [408, 408, 408, 408, 503, 503]);
}

/// Sends bytes as they are, and gives back all that comes.
async fn raw(address: SocketAddr, request: &[u8]) -> String {
    let mut stream = TcpStream::connect(address).await.unwrap();
    stream.write_all(request).await.unwrap();
    let mut answer = Vec::new();
    stream.read_to_end(&mut answer).await.unwrap();
    String::from_utf8_lossy(&answer).into_owned()
}

/// Clients tidy paths up; an attacker's do not.
#[tokio::test]
async fn raw_paths_lead_nowhere() {
    let shelf = Shelf::new();
    std::fs::create_dir(shelf.folder.path().join("weather-maps")).unwrap();
    std::fs::write(shelf.folder.path().join("secret.png"), weather_map(7)).unwrap();
    let server = server_of(shelf.service(&Fake::new(), Settings::default())).await;
    let file = weather_map(9);
    for path in [
        "/v1/assets/weather-maps/../secret",
        "/v1/assets/weather-maps/..%2fsecret",
        "/v1/assets/weather-maps/%2e%2e/secret",
        "/v1/assets/weather-maps//secret",
        "/v1/assets//secret",
        "/v1/assets/./secret",
        "/v1/assets/%2e/secret",
        "/v1/assets/weather-maps/..\\secret",
    ] {
        for method in ["GET", "PUT", "DELETE"] {
            let head = format!(
                "{method} {path} HTTP/1.1\r\nHost: welkin\r\nConnection: close\r\nContent-Length: {}\r\n\r\n",
                file.len()
            );
            let answer = raw(server.address, &[head.as_bytes(), &file].concat()).await;
            let status = answer.split_whitespace().nth(1).unwrap();
            assert!(
                ["400", "404", "405", "422"].contains(&status),
                "{method} {path}: {answer}"
            );
        }
    }
    assert_eq!(
        std::fs::read(shelf.folder.path().join("secret.png")).unwrap(),
        weather_map(7)
    );
    assert!(
        std::fs::read_dir(shelf.folder.path().join("weather-maps"))
            .unwrap()
            .next()
            .is_none()
    );
}

#[tokio::test]
async fn a_body_announced_as_too_long_is_refused_before_it_is_sent() {
    let shelf = Shelf::new();
    let server = server_of(shelf.service(&Fake::new(), Settings::default())).await;
    let head = format!(
        "PUT {MAPS}/map HTTP/1.1\r\nHost: welkin\r\nConnection: close\r\nContent-Length: 67108865\r\n\r\n"
    );
    let answer = raw(server.address, head.as_bytes()).await;
    assert!(
        answer.starts_with("HTTP/1.1 413 ") && answer.contains("67108864"),
        "{answer}"
    );
    let whole = weather_map(3);
    let head = format!(
        "PUT {MAPS}/map HTTP/1.1\r\nHost: welkin\r\nConnection: close\r\nContent-Length: {}\r\n\r\n",
        whole.len()
    );
    let answer = raw(server.address, &[head.as_bytes(), &whole].concat()).await;
    assert!(answer.starts_with("HTTP/1.1 201 "), "{answer}");
}
