//! Jobs from sending to results, on real queues and stores, over a renderer that draws a gradient.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "tests fail by panicking; their numbers are small"
)]

mod batch;
mod fake;
mod faults;
mod full;
mod place;
mod remove;
mod servers;
mod whole;
