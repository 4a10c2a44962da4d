//! What scenes look like, through the renderer as others use it.
#![allow(
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::needless_range_loop,
    reason = "tests fail by panicking; three bands run side by side through several arrays"
)]

mod air;
mod cloud_probe;
mod constants;
mod disc;
mod display;
mod frames;
mod ground;
mod haze;
mod horizon;
mod lens;
mod methods;
mod moon;
mod night;
mod orders;
mod projections;
mod queue;
mod scenes;
mod sums;
mod windows;
