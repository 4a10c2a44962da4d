//! The service called as its clients call it, over a renderer that draws a gradient.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "tests fail by panicking; their numbers are small"
)]

mod asset_files;
mod asset_requests;
mod asset_scenes;
mod board;
mod client;
mod deaf;
mod discovery;
mod fake;
mod frames;
mod hostile;
mod jobs;
mod limits;
mod live;
mod live_flow;
mod live_refining;
mod live_timeline;
mod metar;
mod openapi;
mod shutdown;
mod static_files;
