//! The store in folders of its own: what it takes, what it refuses, and what it never touches.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "tests fail by panicking; their numbers are small"
)]

mod concurrent;
mod files;
mod glb;
mod heights;
mod limits;
mod meshes;
mod pictures;
mod refusals;
mod sandbox;
mod scenes;
mod thesis;
