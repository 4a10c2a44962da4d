//! The scene document through its public interface.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "tests fail by panicking")]

mod air;
mod air_colour;
mod clouds;
mod documents;
mod faults;
mod geometry;
mod hostile;
mod jobs;
mod metar;
mod metar_air;
mod metar_clouds;
mod metar_hostile;
mod night;
mod pillars;
mod properties;
mod schemas;
mod strategies;
mod sun;
mod terrain;
mod timeline;
mod timeline_ground;
mod timeline_random;
mod timeline_sky;
