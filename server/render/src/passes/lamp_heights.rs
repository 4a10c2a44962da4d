//! How high the ground lies under lamps that stand on it.

use crate::{
    error::Error,
    gpu::Gpu,
    ground::Terrains,
    kernel::{Bind, Recorder, Variants},
    shader,
};
use glam::DVec3;

pub(crate) struct LampHeights {
    kernels: Variants,
}

impl LampHeights {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::LAMP_HEIGHTS),
        }
    }

    /// Heights over the sphere under places in the scene, metres. Waits for the device.
    pub(crate) fn run(
        &mut self,
        gpu: &Gpu,
        terrains: &Terrains,
        places_m: &[DVec3],
    ) -> Result<Vec<f64>, Error> {
        if places_m.is_empty() {
            return Ok(Vec::new());
        }
        let places: Vec<[f32; 4]> = places_m
            .iter()
            .map(|p| terrains.frame.place(*p).as_vec3().extend(0.0).to_array())
            .collect();
        let size = 4 * places.len() as u64;
        let storage = wgpu::BufferUsages::STORAGE;
        let given = gpu.filled("places", bytemuck::cast_slice(&places), storage);
        let heights = gpu.buffer("lamp_heights", size, storage | wgpu::BufferUsages::COPY_SRC);
        let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
        let readable = gpu.buffer("lamp_heights", size, usage);
        let ground = terrains.own().upload(gpu, "ground");
        let binds = [
            Bind::Buffer(&ground),
            Bind::Buffer(&given),
            Bind::Buffer(&heights),
            Bind::Buffer(&terrains.shape.words),
            Bind::Buffer(&terrains.shape.finder),
        ];
        let mut recorder = Recorder::new(gpu);
        let kernel = self.kernels.get(gpu, &[("SHAPE", terrains.shape.code)]);
        let threads = u32::try_from(places.len()).unwrap_or(u32::MAX);
        recorder.dispatch(kernel, &binds, [threads, 1, 1]);
        recorder
            .encoder
            .copy_buffer_to_buffer(&heights, 0, &readable, 0, size);
        let (found, _) = recorder.finish(&[(&readable, size)], |bytes| {
            let found: Vec<f32> = bytemuck::pod_collect_to_vec(bytes[0]);
            found.into_iter().map(f64::from).collect()
        })?;
        Ok(found)
    }
}
