//! Weather maps made for the tests, and a service that keeps them in a folder of its own.

use crate::{
    client::{Answer, call},
    fake::Fake,
};
use axum::{
    Router,
    body::Body,
    http::{HeaderName, Request},
};
use std::sync::Arc;
use tempfile::TempDir;
use welkin_assets::{Kind, Limits, Name, Store};
use welkin_service::{Service, Settings, app};

pub(crate) const MAPS: &str = "/v1/assets/weather-maps";

/// A PNG of 2 x 2 pixels, all of one grey.
pub(crate) fn weather_map(grey: u8) -> Vec<u8> {
    let mut file = Vec::new();
    let mut writer = png::Encoder::new(&mut file, 2, 2).write_header().unwrap();
    writer.write_image_data(&[grey; 4]).unwrap();
    writer.finish().unwrap();
    file
}

/// A binary glTF of one triangle, `size` wide and high.
pub(crate) fn triangle(size: f32) -> Vec<u8> {
    let document = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"byteLength":36}],
        "bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,
        "type":"VEC3","min":[0,0,0],"max":[9,9,0]}]}"#;
    let document = format!("{document:<width$}", width = document.len().next_multiple_of(4));
    let corners = [0.0, 0.0, 0.0, size, 0.0, 0.0, 0.0, size, 0.0_f32];
    let blob: Vec<u8> = corners.iter().flat_map(|number| number.to_le_bytes()).collect();
    let length = |bytes: usize| u32::try_from(bytes).unwrap().to_le_bytes();
    [
        b"glTF".as_slice(),
        &2_u32.to_le_bytes(),
        &length(28 + document.len() + blob.len()),
        &length(document.len()),
        b"JSON",
        document.as_bytes(),
        &length(blob.len()),
        b"BIN\0",
        &blob,
    ]
    .concat()
}

/// A folder for assets; it goes with the test.
pub(crate) struct Shelf {
    pub(crate) folder: TempDir,
    limits: Limits,
}

impl Shelf {
    pub(crate) fn new() -> Self {
        Self::of(Limits::default())
    }

    pub(crate) fn of(limits: Limits) -> Self {
        let folder = tempfile::tempdir().unwrap();
        Self { folder, limits }
    }

    pub(crate) fn store(&self) -> Store {
        Store::open(self.folder.path(), self.limits).unwrap()
    }

    /// Puts a weather map past the service.
    pub(crate) fn put(&self, name: &str, file: &[u8]) {
        self.put_as(Kind::WeatherMaps, name, file);
    }

    pub(crate) fn put_as(&self, kind: Kind, name: &str, file: &[u8]) {
        let name = Name::new(name).unwrap();
        self.store().put(kind, &name, file, |_| true).unwrap();
    }

    pub(crate) fn service(&self, fake: &Arc<Fake>, settings: Settings) -> Service {
        Service::new(Arc::clone(fake) as _, settings).with_assets(self.store())
    }

    pub(crate) fn router(&self, fake: &Arc<Fake>) -> Router {
        self.router_with(fake, Settings::default())
    }

    pub(crate) fn router_with(&self, fake: &Arc<Fake>, settings: Settings) -> Router {
        app(self.service(fake, settings)).unwrap()
    }
}

pub(crate) async fn send(
    app: &Router,
    method: &str,
    path: &str,
    headers: &[(HeaderName, &str)],
    body: impl Into<Body>,
) -> Answer {
    let mut request = Request::builder().method(method).uri(path);
    for (name, value) in headers {
        request = request.header(name, *value);
    }
    call(app, request.body(body.into()).unwrap()).await
}

pub(crate) async fn put(app: &Router, name: &str, file: Vec<u8>) -> Answer {
    send(app, "PUT", &format!("{MAPS}/{name}"), &[], file).await
}

pub(crate) async fn delete(app: &Router, name: &str) -> Answer {
    send(app, "DELETE", &format!("{MAPS}/{name}"), &[], "").await
}
