//! Light in clear air, computed a second time: a test tool in f64 on the CPU that judges the renderer and shares
//! nothing with it but the scene document.
//!
//! A spherical planet with a grey matt ground; molecules, aerosols, ozone and haze on it; the sun a parallel beam.
//! Light scattered once comes from adaptive quadrature, and so does sunlight off the ground; the rest from backward
//! random walks with next-event estimation. No refraction, no polarisation, no disc of the sun.
//!
//! `cargo run --release -p welkin-reference -- SET` writes the figures in `tests/oracles/reference_air_*.json`.

mod cells;
pub mod estimate;
mod gauss;
mod line;
pub mod medium;
mod phase;
mod random;
mod scene;
mod single;
mod walk;

pub use estimate::{Effort, Figure, Radiance, View, diffuse_irradiance, furnace, radiance};
pub use glam::DVec3;
pub use medium::Medium;
