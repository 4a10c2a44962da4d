//! `/v1/assets`: files that scenes refer to by name.

mod conditions;
pub(crate) mod document;
mod store;

pub(crate) use store::Shelf;

use crate::{
    body,
    error::{Error, Fault},
    openapi::{Busy, Conditional, Missing, NoRoom, Refusals},
    state::Service,
};
use axum::{
    Json,
    extract::{Path, Request, State, rejection::PathRejection},
    http::{HeaderMap, StatusCode, header},
    response::{IntoResponse, Response},
};
use conditions::{Conditions, etag};
use serde::Serialize;
use std::sync::Arc;
use tokio::time::timeout;
use welkin_assets::{Asset, Kind, Limits, Name, Put, Store, Usage};

/// What a client may be told to wait while others send their files, seconds.
const UPLOAD_WAIT_S: u32 = 5;

/// A list of assets.
#[derive(Serialize)]
pub(crate) struct Listing {
    assets: Vec<Asset>,
    used: Usage,
    limits: Limits,
}

/// All assets, how full the store is, and how much it takes.
#[utoipa::path(get, path = "/v1/assets", tag = "assets", responses(
    (status = 200, description = "In the order of kinds and names", content_type = "application/json",
        body = ref("#/components/schemas/Assets")),
    Missing, Busy))]
pub(crate) async fn list_all(State(service): State<Service>) -> Result<Json<Listing>, Error> {
    listing(&service, Kind::ALL.into()).await
}

/// The assets of one kind.
#[utoipa::path(get, path = "/v1/assets/{kind}", tag = "assets",
    params(("kind" = String, Path, description = "`weather-maps`, `heightfields` or `meshes`")),
    responses(
        (status = 200, description = "In the order of their names", content_type = "application/json",
            body = ref("#/components/schemas/Assets")),
        Missing, Busy))]
pub(crate) async fn list_kind(
    State(service): State<Service>,
    kind: Result<Path<String>, PathRejection>,
) -> Result<Json<Listing>, Error> {
    let Path(kind) = kind.map_err(|e| Error::NotFound(e.body_text()))?;
    listing(&service, vec![kind_named(&kind)?]).await
}

/// An asset, byte by byte as it was sent.
#[utoipa::path(get, path = "/v1/assets/{kind}/{name}", tag = "assets",
    params(
        ("kind" = String, Path, description = "`weather-maps`, `heightfields` or `meshes`"),
        ("name" = String, Path, description = "As the list names it"),
        ("If-None-Match" = Option<String>, Header, description = "Tags of the copies one has"),
        ("If-Match" = Option<String>, Header, description = "Tags of what one wants and nothing else")),
    responses(
        (status = 200, description = "The file", content(
                (String = "image/png"), (String = "image/tiff"), (String = "application/octet-stream"),
                (String = "model/gltf-binary"), (String = "application/zip")),
            headers(("ETag" = String, description = "SHA-256 of the file"))),
        (status = 304, description = "The copy one has is the one"),
        Missing, Conditional, Refusals, Busy))]
pub(crate) async fn get_asset(
    State(service): State<Service>,
    headers: HeaderMap,
    place: Result<Path<(String, String)>, PathRejection>,
) -> Result<Response, Error> {
    let (kind, name) = placed(place)?;
    let (asset, file) = service.read_assets(move |store| store.file(kind, &name)).await?;
    let conditions = Conditions::read(&headers);
    let known = [
        (header::ETAG, etag(&asset.digest)),
        (header::CACHE_CONTROL, "no-cache".into()),
    ];
    if !conditions.match_holds(Some(&asset.digest)) {
        return Err(Error::Precondition);
    }
    if !conditions.none_match_holds(Some(&asset.digest)) {
        return Ok((StatusCode::NOT_MODIFIED, known).into_response());
    }
    Ok((known, [(header::CONTENT_TYPE, asset.form.media_type())], file).into_response())
}

/// Stores an asset, in place of the one that has the name.
///
/// A weather map is a PNG of up to 4096 x 4096 pixels, 8 or 16 bit, grey, RGB, RGBA or palette. A heightfield is a grey
/// PNG of 16 bits, a GeoTIFF or an NPY of up to 4096 x 4096 heights. A mesh is a `.glb`, or a `.zip` of an OBJ with its
/// MTL and textures, of up to a million triangles. What the file holds decides, not `Content-Type`. `If-None-Match: *` stores only where there is nothing yet, `If-Match` only in place
/// of what one has seen.
#[utoipa::path(put, path = "/v1/assets/{kind}/{name}", tag = "assets",
    params(
        ("kind" = String, Path, description = "`weather-maps`, `heightfields` or `meshes`"),
        ("name" = String, Path, description = "Up to 64 of a-z, 0-9, _ and -, the first a letter or a digit"),
        ("If-Match" = Option<String>, Header, description = "Tags of what may be replaced"),
        ("If-None-Match" = Option<String>, Header, description = "`*`: nothing may be replaced")),
    request_body(description = "The file", content(
        (String = "image/png"), (String = "image/tiff"), (String = "application/octet-stream"),
        (String = "model/gltf-binary"), (String = "application/zip"))),
    responses(
        (status = 201, description = "It is stored", content_type = "application/json",
            body = ref("#/components/schemas/Asset"),
            headers(("ETag" = String, description = "SHA-256 of the file"))),
        (status = 200, description = "It has taken the place of another, or was there already",
            content_type = "application/json", body = ref("#/components/schemas/Asset"),
            headers(("ETag" = String, description = "SHA-256 of the file"))),
        Missing, Conditional, NoRoom, Refusals, Busy))]
pub(crate) async fn put_asset(
    State(service): State<Service>,
    place: Result<Path<(String, String)>, PathRejection>,
    request: Request,
) -> Result<Response, Error> {
    let (kind, name) = placed(place)?;
    let limit_bytes = service.assets.store()?.limits().max_asset_bytes;
    let turn = timeout(
        service.settings.memory_timeout,
        Arc::clone(&service.uploads).acquire_owned(),
    );
    let busy = |_| Error::Busy {
        what: "others are sending as many files as are taken at once".into(),
        retry_after_s: UPLOAD_WAIT_S,
    };
    let turn = turn.await.map_err(busy)?.map_err(|_| Error::Stopped)?;
    let conditions = Conditions::read(request.headers());
    let file = body::read(request, limit_bytes).await?;
    let location = format!("/v1/assets/{kind}/{name}");
    let put = move |store: &Store| {
        let _turn = turn;
        store.put(kind, &name, &file, |there| conditions.hold(there))
    };
    let (asset, put) = service.change_assets(put).await?;
    let known = [(header::ETAG, etag(&asset.digest))];
    Ok(match put {
        Put::Created => (
            StatusCode::CREATED,
            known,
            [(header::LOCATION, location)],
            Json(asset),
        )
            .into_response(),
        Put::Replaced => (known, Json(asset)).into_response(),
    })
}

/// Removes an asset. Scenes that name it are refused from then on.
#[utoipa::path(delete, path = "/v1/assets/{kind}/{name}", tag = "assets",
    params(
        ("kind" = String, Path, description = "`weather-maps`, `heightfields` or `meshes`"),
        ("name" = String, Path, description = "As the list names it"),
        ("If-Match" = Option<String>, Header, description = "Tags of what may be removed")),
    responses((status = 204, description = "It is gone"), Missing, Conditional, Refusals, Busy))]
pub(crate) async fn delete_asset(
    State(service): State<Service>,
    headers: HeaderMap,
    place: Result<Path<(String, String)>, PathRejection>,
) -> Result<StatusCode, Error> {
    let (kind, name) = placed(place)?;
    let conditions = Conditions::read(&headers);
    let delete = move |store: &Store| store.delete(kind, &name, |there| conditions.hold(there));
    service.change_assets(delete).await?;
    Ok(StatusCode::NO_CONTENT)
}

async fn listing(service: &Service, kinds: Vec<Kind>) -> Result<Json<Listing>, Error> {
    let list = move |store: &Store| {
        let mut assets = Vec::new();
        for kind in kinds {
            assets.extend(store.list(kind)?);
        }
        let (used, limits) = (store.usage()?, store.limits());
        Ok(Listing { assets, used, limits })
    };
    service.read_assets(list).await.map(Json)
}

fn placed(place: Result<Path<(String, String)>, PathRejection>) -> Result<(Kind, Name), Error> {
    let Path((kind, name)) = place.map_err(|e| Error::NotFound(e.body_text()))?;
    let kind = kind_named(&kind)?;
    let refused = |error: welkin_assets::Error| {
        let shown: String = name.chars().take(80).collect();
        Error::Invalid(vec![Fault::query(
            "name",
            shown,
            Name::ALLOWED.into(),
            error.to_string(),
        )])
    };
    Ok((kind, Name::new(&name).map_err(refused)?))
}

fn kind_named(name: &str) -> Result<Kind, Error> {
    let kinds = Kind::ALL.map(Kind::name).join(", ");
    Kind::named(name)
        .ok_or_else(|| Error::NotFound(format!("/v1/assets/{name}; the kinds of asset are {kinds}")))
}
