//! The OpenAPI document describes what is there.

use crate::{
    asset_files::{Shelf, triangle, weather_map},
    client::{call, get, router},
    fake::Fake,
};
use axum::{body::Body, http::Request};
use serde_json::Value;
use welkin_assets::Kind;

/// The routes of the contract. `/docs` is a page about the others.
const ROUTES: [(&str, &[&str]); 24] = [
    ("/", &["get"]),
    ("/v1/frames", &["get", "post"]),
    ("/v1/live", &["get"]),
    ("/v1/probe", &["post"]),
    ("/v1/scenes/from-metar", &["post"]),
    ("/v1/presets", &["get"]),
    ("/v1/presets/{name}", &["get"]),
    ("/v1/schema/scene", &["get"]),
    ("/v1/schema/frame", &["get"]),
    ("/v1/schema/probe", &["get"]),
    ("/v1/schema/timeline", &["get"]),
    ("/v1/schema/job", &["get"]),
    ("/v1/device", &["get"]),
    ("/v1/jobs", &["get", "post"]),
    ("/v1/jobs/{id}", &["delete", "get"]),
    ("/v1/jobs/{id}/events", &["get"]),
    ("/v1/jobs/{id}/results/{name}", &["get"]),
    ("/v1/assets", &["get"]),
    ("/v1/assets/{kind}", &["get"]),
    ("/v1/assets/{kind}/{name}", &["delete", "get", "put"]),
    ("/openapi.json", &["get"]),
    ("/healthz", &["get"]),
    ("/readyz", &["get"]),
    ("/metrics", &["get"]),
];

async fn document() -> Value {
    get(&router(&Fake::new()), "/openapi.json").await.json()
}

#[tokio::test]
async fn every_route_is_described_and_every_description_is_a_route() {
    let document = document().await;
    assert_eq!(document["openapi"], "3.1.0");
    let paths = document["paths"].as_object().unwrap();
    assert_eq!(paths.len(), ROUTES.len(), "{:?}", paths.keys());
    let shelf = Shelf::new();
    let app = shelf.router(&Fake::new());
    for (path, methods) in ROUTES {
        let described: Vec<_> = paths[path].as_object().unwrap().keys().collect();
        assert_eq!(described, methods, "{path}");
        for method in methods {
            let operation = &paths[path][*method];
            assert!(
                operation["summary"].is_string() && operation["responses"].is_object(),
                "{method} {path}"
            );
            let path = path.replace("{kind}", "weather-maps");
            let path = path.replace("{name}", "twilight");
            shelf.put("twilight", &weather_map(1));
            let request = Request::builder()
                .method(method.to_uppercase().as_str())
                .uri(&path);
            let status = call(&app, request.body(Body::empty()).unwrap()).await.status;
            // Jobs that there are have tests of their own.
            let may_lack = path.starts_with("/v1/jobs");
            assert!(
                status != 405 && (status != 404 || may_lack),
                "{method} {path}: {status}"
            );
        }
    }
}

#[tokio::test]
async fn every_reference_leads_somewhere() {
    fn check(value: &Value, document: &Value, count: &mut usize) {
        match value {
            Value::Object(members) => {
                if let Some(target) = members.get("$ref").and_then(Value::as_str) {
                    let pointer = target
                        .strip_prefix('#')
                        .unwrap_or_else(|| panic!("{target} leads out"));
                    assert!(document.pointer(pointer).is_some(), "{target} leads nowhere");
                    *count += 1;
                }
                members.values().for_each(|member| check(member, document, count));
            }
            Value::Array(items) => items.iter().for_each(|item| check(item, document, count)),
            _ => {}
        }
    }
    let document = document().await;
    let mut count = 0;
    check(&document, &document, &mut count);
    assert!(count > 20, "{count} references");
}

#[tokio::test]
async fn the_types_of_problems_lead_to_their_description() {
    let document = document().await;
    let app = router(&Fake::new());
    for path in ["/nowhere", "/v1/live", "/v1/frames?width_px=x"] {
        let problem = get(&app, path).await.json();
        let (file, pointer) = problem["type"].as_str().unwrap().split_once('#').unwrap();
        assert_eq!(file, "/openapi.json");
        assert_eq!(
            document.pointer(pointer).unwrap()["description"],
            problem["title"]
        );
    }
}

/// Schemas written by hand, against what is sent.
#[tokio::test]
async fn hand_written_schemas_have_the_members_that_are_sent() {
    let document = document().await;
    let shelf = Shelf::new();
    shelf.put("map", &weather_map(1));
    shelf.put_as(Kind::Heightfields, "hills", &weather_map(1));
    shelf.put_as(Kind::Meshes, "triangle", &triangle(1.0));
    shelf.put_as(Kind::Lights, "street", b"east_m,north_m\n1,2\n");
    let app = shelf.router(&Fake::new());
    let names = |value: &Value| {
        value
            .as_object()
            .unwrap()
            .keys()
            .cloned()
            .collect::<std::collections::BTreeSet<_>>()
    };
    let described = |schema: &str| names(&document["components"]["schemas"][schema]["properties"]);
    assert_eq!(names(&get(&app, "/v1/device").await.json()), described("Device"));
    let listing = get(&app, "/v1/assets").await.json();
    assert_eq!(names(&listing), described("Assets"));
    let schema = &document["components"]["schemas"]["Asset"];
    for (i, kind) in Kind::ALL.into_iter().enumerate() {
        let (asset, one) = (&listing["assets"][i], &schema["oneOf"][i]);
        assert_eq!(asset["kind"], kind.name());
        assert_eq!(names(asset), names(&one["properties"]));
        assert!(jsonschema::is_valid(schema, asset), "{asset}");
    }
    for part in ["used", "limits"] {
        let described = &document["components"]["schemas"]["Assets"]["properties"][part]["properties"];
        assert_eq!(names(&listing[part]), names(described));
    }
    assert_eq!(
        names(&get(&app, "/v1/presets").await.json()[0]),
        described("Preset")
    );
    let problem = names(&get(&app, "/v1/frames?width_px=x").await.json());
    assert!(problem.is_subset(&described("Problem")), "{problem:?}");
}

#[tokio::test]
async fn the_documentation_is_local() {
    let app = router(&Fake::new());
    assert_eq!(get(&app, "/docs").await.status, 303);
    let page = get(&app, "/docs/").await;
    let html = String::from_utf8(page.body.to_vec()).unwrap();
    assert!(!html.contains("http://") && !html.contains("https://"), "{html}");
    assert!(
        page.header("content-security-policy")
            .contains("default-src 'self'")
    );
    for file in ["swagger-ui-bundle.js", "swagger-ui.css", "swagger-initializer.js"] {
        assert_eq!(get(&app, &format!("/docs/{file}")).await.status, 200, "{file}");
    }
    let initializer = get(&app, "/docs/swagger-initializer.js").await;
    assert!(
        String::from_utf8(initializer.body.to_vec())
            .unwrap()
            .contains("/openapi.json")
    );
}
