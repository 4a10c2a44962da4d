//! The noise that clouds are made of: textures that depend on seeds and frequencies alone. Each is computed once, kept on
//! the device while it is used, and kept on disk between starts.

use crate::{
    error::Error,
    gpu::{Gpu, Shape},
    kernel::{Bind, Kernel, Recorder},
    memo::{Fingerprint, Memo},
    noise_cache::DiskCache,
    passes::{
        Table,
        cloud_curl::cloud_curl,
        cloud_detail::cloud_detail,
        cloud_shape::{ShapeFrequencies, cloud_shape},
        cloud_sheet::cloud_sheet,
        cloud_weather::cloud_weather,
    },
    shader::{Shader, Texel},
    uniforms::Part,
};
use sha2::{Digest, Sha256};
use std::sync::Arc;
use welkin_scene::renderer::PassTime;

/// Noise and weather of one scene.
pub(crate) struct CloudTextures {
    pub(crate) shape: Arc<Table>,
    pub(crate) detail: Arc<Table>,
    pub(crate) curl: Arc<Table>,
    pub(crate) first_weather: Arc<Table>,
    pub(crate) second_weather: Arc<Table>,
    pub(crate) sheet: Arc<Table>,
}

impl CloudTextures {
    pub(crate) fn fingerprint(&self) -> Fingerprint {
        let all = [
            &self.shape,
            &self.detail,
            &self.curl,
            &self.first_weather,
            &self.second_weather,
            &self.sheet,
        ];
        Fingerprint::of(all.map(|table| table.made_from))
    }

    /// The first bindings of every shader that asks where there is cloud.
    pub(crate) fn binds<'a>(&'a self, clouds: &'a wgpu::Buffer) -> Vec<Bind<'a>> {
        let mut binds = self.coarse_binds(clouds);
        binds.extend([
            Bind::Table(&self.detail.view),
            Bind::Table(&self.curl.view),
            Bind::Table(&self.sheet.view),
        ]);
        binds
    }

    /// Those of them that tell where there is cloud, but for its edges.
    pub(crate) fn coarse_binds<'a>(&'a self, clouds: &'a wgpu::Buffer) -> Vec<Bind<'a>> {
        vec![
            Bind::Buffer(clouds),
            Bind::LinearRepeat,
            Bind::Table(&self.shape.view),
            Bind::Table(&self.first_weather.view),
            Bind::Table(&self.second_weather.view),
        ]
    }
}

/// How a texture is made: its shader writes four floats a texel, and these become bytes.
pub(crate) struct Recipe {
    pub(crate) shader: &'static Shader,
    pub(crate) uniform: Part,
    pub(crate) size: [u32; 3],
    pub(crate) shape: Shape,
    pub(crate) to_bytes: fn(&[[f32; 4]]) -> Vec<u8>,
}

/// The textures, RGBA of a byte each, all of which close on themselves: sample them with a sampler that repeats.
pub(crate) struct CloudNoise {
    shape: Memo<Table>,
    detail: Memo<Table>,
    curl: Memo<Table>,
    weather: Memo<Table>,
    sheet: Memo<Table>,
    disk: Option<DiskCache>,
    times: Vec<PassTime>,
}

impl CloudNoise {
    pub(crate) const fn new(disk: Option<DiskCache>) -> Self {
        Self {
            shape: Memo::new(2),
            detail: Memo::new(4),
            curl: Memo::new(4),
            weather: Memo::new(4),
            sheet: Memo::new(4),
            disk,
            times: Vec::new(),
        }
    }

    /// What was computed since this was last asked.
    pub(crate) fn take_times(&mut self) -> Vec<PassTime> {
        std::mem::take(&mut self.times)
    }

    /// A volume; see [`cloud_shape`].
    pub(crate) fn shape(
        &mut self,
        gpu: &Gpu,
        seed: u32,
        frequencies: ShapeFrequencies,
    ) -> Result<Arc<Table>, Error> {
        let recipe = cloud_shape(seed, frequencies);
        made(&mut self.shape, self.disk.as_ref(), gpu, &recipe, &mut self.times)
    }

    /// A volume; see [`cloud_detail`].
    pub(crate) fn detail(&mut self, gpu: &Gpu, seed: u32, frequency: u32) -> Result<Arc<Table>, Error> {
        let recipe = cloud_detail(seed, frequency);
        made(
            &mut self.detail,
            self.disk.as_ref(),
            gpu,
            &recipe,
            &mut self.times,
        )
    }

    /// See [`cloud_curl`].
    pub(crate) fn curl(&mut self, gpu: &Gpu, seed: u32) -> Result<Arc<Table>, Error> {
        let recipe = cloud_curl(seed);
        made(&mut self.curl, self.disk.as_ref(), gpu, &recipe, &mut self.times)
    }

    /// See [`cloud_weather`].
    pub(crate) fn weather(&mut self, gpu: &Gpu, seed: u32) -> Result<Arc<Table>, Error> {
        let recipe = cloud_weather(seed);
        made(
            &mut self.weather,
            self.disk.as_ref(),
            gpu,
            &recipe,
            &mut self.times,
        )
    }

    /// See [`cloud_sheet`].
    pub(crate) fn sheet(&mut self, gpu: &Gpu, seed: u32) -> Result<Arc<Table>, Error> {
        let recipe = cloud_sheet(seed);
        made(&mut self.sheet, self.disk.as_ref(), gpu, &recipe, &mut self.times)
    }
}

fn made(
    memo: &mut Memo<Table>,
    disk: Option<&DiskCache>,
    gpu: &Gpu,
    recipe: &Recipe,
    times: &mut Vec<PassTime>,
) -> Result<Arc<Table>, Error> {
    let name = recipe.shader.name;
    let made_from = Fingerprint::of((name, &recipe.uniform));
    memo.try_get_or(made_from, || {
        let (bytes, spent) = bytes(gpu, disk, recipe)?;
        times.extend(spent);
        let view = gpu.holding(name, recipe.size, recipe.shape, Texel::Byte, &bytes);
        Ok(Table { view, made_from })
    })
}

/// From disk where they are there, else computed and put there.
pub(crate) fn bytes(
    gpu: &Gpu,
    disk: Option<&DiskCache>,
    recipe: &Recipe,
) -> Result<(Vec<u8>, Vec<PassTime>), Error> {
    let Some(disk) = disk else {
        return computed(gpu, recipe);
    };
    let (name, key) = (recipe.shader.name, key(gpu, recipe));
    let size: usize = recipe.size.iter().map(|side| *side as usize).product();
    if let Some(kept) = disk.find(name, &key, 4 * size) {
        return Ok((kept, Vec::new()));
    }
    let (bytes, times) = computed(gpu, recipe)?;
    disk.keep(name, &key, &bytes);
    Ok((bytes, times))
}

/// Of all that the bytes depend on. Adapters differ in the last bits of a sine, and releases in what becomes of the
/// floats.
fn key(gpu: &Gpu, recipe: &Recipe) -> [u8; 32] {
    let mut digest = Sha256::new();
    let size = recipe.size.map(u32::to_le_bytes);
    for part in [
        env!("CARGO_PKG_VERSION").as_bytes(),
        gpu.info.adapter.as_bytes(),
        gpu.info.driver.as_bytes(),
        recipe.shader.wgsl.as_bytes(),
        &recipe.uniform.0,
        size.as_flattened(),
    ] {
        digest.update((part.len() as u64).to_le_bytes());
        digest.update(part);
    }
    digest.finalize().into()
}

fn computed(gpu: &Gpu, recipe: &Recipe) -> Result<(Vec<u8>, Vec<PassTime>), Error> {
    let name = recipe.shader.name;
    let size = 16 * recipe.size.iter().map(|side| u64::from(*side)).product::<u64>();
    let texels = gpu.buffer(
        name,
        size,
        wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
    );
    let readable = gpu.buffer(
        name,
        size,
        wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
    );
    let uniform = recipe.uniform.upload(gpu, name);
    let kernel = Kernel::new(gpu, recipe.shader);
    let mut recorder = Recorder::new(gpu);
    let binds = [Bind::Buffer(&uniform), Bind::Buffer(&texels)];
    recorder.dispatch(&kernel, &binds, recipe.size);
    recorder
        .encoder
        .copy_buffer_to_buffer(&texels, 0, &readable, 0, size);
    recorder.finish(&[(&readable, size)], |bytes| {
        (recipe.to_bytes)(bytemuck::cast_slice(bytes[0]))
    })
}
