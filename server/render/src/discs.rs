//! What of the light of sun and moon reaches the observer, past clouds and ground.

use crate::{
    cloudscape::Cloudscape,
    error::Error,
    gpu::Gpu,
    groundscape::Groundscape,
    kernel::Recorder,
    memo::Fingerprint,
    night::Night,
    passes::{
        ground_view::{Looks, SEEN_BYTES},
        probe::Probe,
    },
    sunlight::{DiscsLeft, across_disc},
    uniforms::Standpoint,
};
use glam::DVec3;
use welkin_scene::Scene;

impl Probe {
    /// The mean over what the sphere does not hide of each disc. Waits for the device, once for every sky.
    pub(crate) fn discs_left(
        &mut self,
        gpu: &Gpu,
        (clouds, ground): (Option<&Cloudscape>, Option<&Groundscape>),
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
        if rays.is_empty() || (clouds.is_none() && ground.is_none()) {
            return Ok(DiscsLeft::default());
        }
        let bytes: &[u8] = bytemuck::cast_slice(&rays);
        let made_from = Fingerprint::of((
            "discs",
            clouds.map(Cloudscape::fingerprint),
            ground.map(Groundscape::fingerprint),
            bytes,
        ));
        let (view, followed) = (&mut self.view, &mut self.clouds);
        let discs = self.discs.try_get_or(made_from, || {
            let directions = gpu.filled("directions", bytes, wgpu::BufferUsages::STORAGE);
            let count = u32::try_from(rays.len()).unwrap_or(u32::MAX);
            let mut recorder = Recorder::new(gpu);
            let copied = |recorder: &mut Recorder<'_>, from: &wgpu::Buffer, size: u64| {
                let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
                let readable = gpu.buffer("discs", size, usage);
                recorder
                    .encoder
                    .copy_buffer_to_buffer(from, 0, &readable, 0, size);
                (readable, size)
            };
            let ground = ground.map(|scape| {
                let seen = view.run(&mut recorder, scape, Looks::List(&directions, count));
                copied(&mut recorder, &seen, SEEN_BYTES * u64::from(count))
            });
            let clouds = clouds.map(|scape| {
                let seen = followed.run(&mut recorder, scape, &directions, count, None);
                copied(&mut recorder, &seen, 16 * u64::from(count))
            });
            let readable: Vec<_> = ground
                .iter()
                .chain(&clouds)
                .map(|(buffer, size)| (buffer, *size))
                .collect();
            let (left, _) = recorder.finish(&readable, |bytes| {
                let mut bytes = bytes.iter();
                let mut left = vec![1.0; rays.len()];
                if ground.is_some() {
                    let seen: Vec<[f32; 6]> = bytes
                        .next()
                        .map_or_else(Vec::new, |b| bytemuck::pod_collect_to_vec(b));
                    for (left, seen) in left.iter_mut().zip(seen) {
                        *left *= if seen[0] >= 0.0 { 0.0 } else { 1.0 };
                    }
                }
                if clouds.is_some() {
                    let seen: Vec<[f32; 4]> = bytes
                        .next()
                        .map_or_else(Vec::new, |b| bytemuck::pod_collect_to_vec(b));
                    for (left, seen) in left.iter_mut().zip(seen) {
                        *left *= f64::from(seen[3]);
                    }
                }
                left
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

/// Of a disc that the sphere hides, all comes through: nothing is left to be dimmed.
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
