//! The page and its files.

use crate::{
    client::{call, get, router},
    fake::Fake,
};
use axum::{
    body::Body,
    http::{Request, header},
};

#[tokio::test]
async fn the_page_is_served_under_a_strict_policy() {
    let app = router(&Fake::new());
    let page = get(&app, "/").await;
    assert_eq!(page.status, 200);
    assert_eq!(page.header("content-type"), "text/html; charset=utf-8");
    let policy = page.header("content-security-policy");
    assert!(
        policy.contains("default-src 'self'") && policy.contains("img-src 'self' blob:"),
        "{policy}"
    );
    assert!(!policy.contains("unsafe"), "{policy}");
    assert_eq!(page.header("x-content-type-options"), "nosniff");
    assert_eq!(page.header("cache-control"), "no-cache");
    let request = Request::get("/").header(header::IF_NONE_MATCH, page.header("etag"));
    assert_eq!(call(&app, request.body(Body::empty()).unwrap()).await.status, 304);
    let request = Request::get("/").header(header::ACCEPT_ENCODING, "gzip");
    let zipped = call(&app, request.body(Body::empty()).unwrap()).await;
    assert_eq!(zipped.header("content-encoding"), "gzip");
    assert!(zipped.body.starts_with(&[0x1f, 0x8b]));
}

/// Every script and style that the page names is there, with the type that browsers insist on.
#[tokio::test]
async fn what_the_page_names_is_there() {
    let app = router(&Fake::new());
    let page = String::from_utf8(get(&app, "/").await.body.to_vec()).unwrap();
    let named = page
        .split(['"', '\''])
        .filter(|text| text.ends_with(".js") || text.ends_with(".css"));
    let mut count = 0;
    for name in named {
        let file = get(&app, &format!("/{}", name.trim_start_matches(['.', '/']))).await;
        let kind = if name.ends_with(".js") {
            "text/javascript; charset=utf-8"
        } else {
            "text/css; charset=utf-8"
        };
        assert_eq!(
            (file.status.as_u16(), file.header("content-type")),
            (200, kind),
            "{name}"
        );
        count += 1;
    }
    assert!(count > 0, "the page names no script or style");
}

#[tokio::test]
async fn no_path_leads_out_of_the_page() {
    let app = router(&Fake::new());
    for path in [
        "/../Cargo.toml",
        "/%2e%2e/Cargo.toml",
        "/..%2fCargo.toml",
        "/....//Cargo.toml",
        "//etc/passwd",
        "/web/../../Cargo.toml",
        "/docs/../Cargo.toml",
        "/docs/%2e%2e/%2e%2e/Cargo.toml",
        "/package.json",
        "/node_modules/typescript/package.json",
    ] {
        get(&app, path).await.problem(404);
    }
}
