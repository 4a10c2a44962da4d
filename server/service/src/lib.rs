//! REST and WebSocket over any renderer that implements [`welkin_scene::renderer::Render`].
//!
//! [`app`] is a router that tests call without a socket; [`serve`] puts it on one.

mod assets;
mod body;
mod calm;
mod discovery;
mod error;
mod frames;
mod jobs;
mod live;
mod metrics;
mod openapi;
mod operations;
mod probe;
mod problem;
mod router;
mod scenes;
mod server;
mod settings;
mod state;
mod web;

pub use router::app;
pub use server::{StartError, listen, serve, tell_operations};
pub use settings::Settings;
pub use state::Service;
