//! The renderer: the only crate that speaks wgpu.
//!
//! A frame is a pure function of a scene. The renderer is a short list of passes ([`engine`]); each keeps its output
//! until what it was made from changes. One thread owns the device ([`renderer`]).

mod area;
mod camera;
mod catalogue;
mod cloud_dome;
mod cloud_light;
mod cloud_noise;
mod cloud_sky;
mod cloudscape;
mod colour;
mod cpu;
mod discs;
mod engine;
mod error;
mod frame_job;
mod gpu;
mod ground;
mod groundscape;
mod kept_frames;
mod kernel;
mod lamps;
mod lens;
mod lights;
mod memo;
mod method;
mod moon_face;
mod moonlight;
mod night;
mod noise_cache;
mod passes;
mod phase;
mod pillar_cells;
mod pillars;
mod prepared;
mod probe_job;
mod quadrature;
mod renderer;
mod screen;
mod shader;
mod shafts;
mod silhouettes;
mod spread;
mod starfield;
mod sunlight;
#[cfg(test)]
mod tests;
mod uniforms;
mod work;

pub use error::Error;
pub use gpu::{AdapterChoice, adapters};
pub use noise_cache::DiskCache;
pub use renderer::{Renderer, RendererSettings};
