//! The program `welkin`: wiring of renderer, encoders and service. The one file that sees both the renderer and
//! the rest.

mod bench;
mod commands;
mod settings;

use commands::Failure;
use std::{process::ExitCode, sync::Arc};
use welkin_render::{AdapterChoice, DiskCache, Renderer, RendererSettings};
use welkin_scene::renderer::{DeviceInfo, Render};

fn main() -> ExitCode {
    commands::run()
}

/// Opens the device that the settings name.
fn open_renderer(settings: &settings::Settings) -> Result<Arc<dyn Render>, Failure> {
    let adapter = AdapterChoice {
        name: settings.adapter.clone(),
        require_gpu: settings.require_gpu,
    };
    let renderer = Renderer::start(RendererSettings {
        adapter,
        queue_places: settings.queue_places,
        disk_cache: settings.cache_folder().map(|folder| DiskCache {
            folder: folder.join("noise"),
            most_bytes: settings.disk_cache_bytes,
        }),
    });
    renderer
        .map(|renderer| Arc::new(renderer) as Arc<dyn Render>)
        .map_err(|e| Failure::Device(e.to_string()))
}

/// The adapters of this machine.
fn adapters() -> Vec<DeviceInfo> {
    welkin_render::adapters()
}
