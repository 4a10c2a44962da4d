//! The clouds at exact directions.

use crate::{
    cloudscape::Cloudscape,
    error::Error,
    gpu::Gpu,
    kernel::{Bind, Recorder, Variants},
    memo::{Fingerprint, Memo},
    night::Night,
    shader,
    sunlight::{DiscsLeft, across_disc},
    uniforms::Standpoint,
};
use glam::DVec3;
use welkin_scene::Scene;

pub(crate) struct CloudProbe {
    kernels: Variants,
    discs: Memo<DiscsLeft>,
}

impl CloudProbe {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::CLOUD_PROBE),
            discs: Memo::new(8),
        }
    }

    /// Four floats a direction: what to add in R, G and B, and what comes through.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Cloudscape,
        directions: &wgpu::Buffer,
        count: u32,
    ) -> wgpu::Buffer {
        march(&mut self.kernels, recorder, scape, directions, count)
    }

    /// What comes through the clouds of the light of sun and moon: the mean over what the ground does not hide of each
    /// disc. Waits for the device, once for every sky.
    pub(crate) fn discs_left(
        &mut self,
        gpu: &Gpu,
        scape: &Cloudscape,
        scene: &Scene,
        stand: &Standpoint,
        night: &Night,
    ) -> Result<DiscsLeft, Error> {
        let radius_m = scene.planet.radius_m;
        let sun = across_disc(stand, radius_m, scene.sun.angular_diameter_deg);
        let moon = night.moon.map_or_else(Vec::new, |moon| {
            across_disc(&moon.stand(stand), radius_m, moon.seen.angular_diameter_deg)
        });
        let rays: Vec<[f32; 4]> = sun.iter().chain(&moon).copied().map(packed).collect();
        if rays.is_empty() {
            return Ok(DiscsLeft::default());
        }
        let bytes: &[u8] = bytemuck::cast_slice(&rays);
        let made_from = Fingerprint::of(("discs", scape.fingerprint(), bytes));
        let discs = self.discs.try_get_or(made_from, || {
            let size = 16 * rays.len() as u64;
            let directions = gpu.filled("directions", bytes, wgpu::BufferUsages::STORAGE);
            let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
            let readable = gpu.buffer("discs", size, usage);
            let mut recorder = Recorder::new(gpu);
            let count = u32::try_from(rays.len()).unwrap_or(u32::MAX);
            let seen = march(&mut self.kernels, &mut recorder, scape, &directions, count);
            recorder
                .encoder
                .copy_buffer_to_buffer(&seen, 0, &readable, 0, size);
            let (left, _) = recorder.finish(&[(&readable, size)], |bytes| {
                let seen: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(bytes[0]);
                seen.iter().map(|seen| f64::from(seen[3])).collect::<Vec<_>>()
            })?;
            let (of_sun, of_moon) = left.split_at(sun.len());
            Ok::<_, Error>(DiscsLeft {
                sun: mean(of_sun),
                moon: mean(of_moon),
            })
        })?;
        Ok(*discs)
    }
}

/// Four floats a direction: what to add in R, G and B, and what comes through.
fn march(
    kernels: &mut Variants,
    recorder: &mut Recorder<'_>,
    scape: &Cloudscape,
    directions: &wgpu::Buffer,
    count: u32,
) -> wgpu::Buffer {
    let gpu = recorder.gpu;
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
    let answers = gpu.buffer("clouds seen", 16 * u64::from(count), usage);
    let parts = scape.upload(gpu);
    let mut binds = scape.binds(&parts);
    binds.extend([
        Bind::Buffer(directions),
        Bind::Buffer(&parts.observer),
        Bind::Buffer(&answers),
    ]);
    recorder.dispatch(kernels.get(gpu, &[scape.one_layer()]), &binds, [count, 1, 1]);
    answers
}

/// Of a disc that the ground hides, all comes through: nothing is left to be dimmed.
fn mean(left: &[f64]) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "a few dozen rays")]
    let count = left.len() as f64;
    if left.is_empty() {
        1.0
    } else {
        left.iter().sum::<f64>() / count
    }
}

fn packed(direction: DVec3) -> [f32; 4] {
    direction.as_vec3().extend(0.0).to_array()
}
