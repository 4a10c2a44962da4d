//! What clouds do to pictures, through the renderer as others use it.
#![allow(
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::needless_range_loop,
    reason = "tests fail by panicking; three bands run side by side through several arrays"
)]

mod clear;
mod horizon;
mod layers;
mod light;
mod maps;
mod mitsuba;
mod night;
mod scenes;
mod shapes;
mod steady;
mod under;
mod wind;
