//! `/v1/live`: scenes in, pictures out, over a WebSocket.

pub(crate) mod document;
mod header;
mod message;
mod mixture;
mod pace;
mod refining;
mod session;
mod shot;
mod view;

use crate::{body::MAX_BODY_BYTES, error::Error, metrics::Counted, openapi::NoSocket, state::Service};
use axum::{
    extract::{
        State,
        ws::{WebSocketUpgrade, rejection::WebSocketUpgradeRejection},
    },
    response::Response,
};
use std::sync::Arc;

/// Longer messages than this end the connection; those between [`MAX_BODY_BYTES`] and this are refused.
const MAX_SOCKET_MESSAGE_BYTES: usize = 4 * MAX_BODY_BYTES;

/// A live view (WebSocket).
///
/// Text in: `LiveMessage`. Text out: `LiveAnswer`. Binary out: 16 bytes, little-endian: `seq` u32; refinement pass
/// u16, 0 for the preview; passes in all u16; `width_px` u16; `height_px` u16; format u8 (1 JPEG, 2 PNG, 3 raw
/// RGBA8); three zero bytes; then the picture. After each picture comes a ping that carries its `seq`; the next
/// picture waits for the pong. The latest message wins. When nothing changes the picture is refined to the final frame,
/// and the stream falls silent: sixteen passes, each of which computes every fourth pixel of every fourth row, in Bayer's
/// order, and none again; pixels that are not final yet are those of the preview, corrected by the difference that final
/// pixels about them have. Pictures come at least 150 ms apart and as fast as they are confirmed; passes that are done
/// meanwhile are shown together, and a frame of which the device does five tiles or fewer (8 to 30 ms each) is made in
/// one go, so that pass numbers may leave some out; the last, 16 of 17 with the preview, always comes. A change ends the
/// refinement within a tile. With `quality` `preview` there are two passes, or one where the preview is of full size. JSON Merge Patch reads `null` as "remove", so a part that has a
/// default is switched off by sending the whole `scene`. A `timeline` is sent once and played by `at_s` after `at_s`:
/// each moment that is shown comes with its scene in the stats.
#[utoipa::path(get, path = "/v1/live", tag = "frames", responses(
    (status = 101, description = "The WebSocket opens"), NoSocket))]
pub(crate) async fn live(
    State(service): State<Service>,
    upgrade: Result<WebSocketUpgrade, WebSocketUpgradeRejection>,
) -> Result<Response, Error> {
    let upgrade = upgrade.map_err(|e| Error::Upgrade(e.body_text()))?;
    if *service.stopping().borrow() {
        return Err(Error::Stopped);
    }
    let place = Arc::clone(&service.viewers).try_acquire_owned();
    let full = |_| Error::Busy {
        what: "all places for live viewers are taken".into(),
        retry_after_s: 10,
    };
    let place = place.map_err(full)?;
    let upgrade = upgrade
        .max_message_size(MAX_SOCKET_MESSAGE_BYTES)
        .max_frame_size(MAX_SOCKET_MESSAGE_BYTES);
    Ok(upgrade.on_upgrade(move |socket| async move {
        let _counted = (place, Counted::viewer());
        session::run(socket, service).await;
    }))
}
