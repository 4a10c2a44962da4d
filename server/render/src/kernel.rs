//! A shader made ready, and the recording of its dispatches.

use crate::{
    error::Error,
    gpu::Gpu,
    shader::{Kind, Shader, Texel},
};
use std::collections::BTreeMap;
use welkin_scene::renderer::PassTime;

/// A compute pipeline with its layout.
pub(crate) struct Kernel {
    shader: &'static Shader,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

/// What is bound, in the order of the shader's bindings.
#[derive(Clone, Copy)]
pub(crate) enum Bind<'a> {
    Buffer(&'a wgpu::Buffer),
    Table(&'a wgpu::TextureView),
    LinearClamp,
    LinearRepeat,
}

fn layout_entry(binding: u32, kind: Kind, gpu: &Gpu) -> wgpu::BindGroupLayoutEntry {
    use wgpu::{BindingType, BufferBindingType, StorageTextureAccess, TextureViewDimension};
    let buffer = |ty| BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let sampled = |view_dimension| BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: true },
        view_dimension,
        multisampled: false,
    };
    let written = |view_dimension, texel: Texel| BindingType::StorageTexture {
        access: StorageTextureAccess::WriteOnly,
        format: gpu.format(texel),
        view_dimension,
    };
    let ty = match kind {
        Kind::Uniform => buffer(BufferBindingType::Uniform),
        Kind::Read => buffer(BufferBindingType::Storage { read_only: true }),
        Kind::Write => buffer(BufferBindingType::Storage { read_only: false }),
        Kind::Sampler => BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        Kind::Table => sampled(TextureViewDimension::D2),
        Kind::TableLayers => sampled(TextureViewDimension::D2Array),
        Kind::Volume => sampled(TextureViewDimension::D3),
        Kind::WriteTable(texel) => written(TextureViewDimension::D2, texel),
        Kind::WriteTableLayers(texel) => written(TextureViewDimension::D2Array, texel),
        Kind::WriteVolume(texel) => written(TextureViewDimension::D3, texel),
    };
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty,
        count: None,
    }
}

impl Kernel {
    pub(crate) fn new(gpu: &Gpu, shader: &'static Shader) -> Self {
        Self::variant(gpu, shader, &[])
    }

    /// With values for the shader's `override` constants.
    pub(crate) fn variant(gpu: &Gpu, shader: &'static Shader, constants: &[(&str, f64)]) -> Self {
        let entries: Vec<_> = (0_u32..)
            .zip(shader.bindings)
            .map(|(at, kind)| layout_entry(at, *kind, gpu))
            .collect();
        let layout = gpu
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(shader.name),
                entries: &entries,
            });
        let pipeline_layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(shader.name),
                bind_group_layouts: &[Some(&layout)],
                immediate_size: 0,
            });
        // The shaders name 32-bit tables; a device that cannot filter those gets half floats.
        let text = if gpu.table_format == wgpu::TextureFormat::Rgba32Float {
            shader.wgsl.into()
        } else {
            let half = shader.wgsl.replace("rgba32float", "rgba16float");
            half.replace("<r32float", "<rgba16float").into()
        };
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(shader.name),
            source: wgpu::ShaderSource::Wgsl(text),
        });
        let pipeline = gpu
            .device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(shader.name),
                layout: Some(&pipeline_layout),
                module: &module,
                entry_point: Some(shader.name),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants,
                    ..wgpu::PipelineCompilationOptions::default()
                },
                cache: None,
            });
        Self {
            shader,
            layout,
            pipeline,
        }
    }
}

/// The variants of a shader by the values of its `override` constants, each made when it is first asked for.
pub(crate) struct Variants {
    shader: &'static Shader,
    made: Vec<(Vec<(&'static str, f64)>, Kernel)>,
}

impl Variants {
    pub(crate) const fn new(shader: &'static Shader) -> Self {
        Self {
            shader,
            made: Vec::new(),
        }
    }

    pub(crate) fn get(&mut self, gpu: &Gpu, constants: &[(&'static str, f64)]) -> &Kernel {
        let known = self.made.iter().position(|(key, _)| key == constants);
        let index = known.unwrap_or_else(|| {
            let kernel = Kernel::variant(gpu, self.shader, constants);
            self.made.push((constants.to_vec(), kernel));
            self.made.len() - 1
        });
        &self.made[index].1
    }
}

/// Most dispatches that one recording times.
const MOST_TIMED: u32 = 64;

/// Commands on their way to the device, each dispatch timed where the device can.
pub(crate) struct Recorder<'a> {
    pub(crate) gpu: &'a Gpu,
    pub(crate) encoder: wgpu::CommandEncoder,
    queries: Option<wgpu::QuerySet>,
    timed: Vec<&'static str>,
}

impl<'a> Recorder<'a> {
    pub(crate) fn new(gpu: &'a Gpu) -> Self {
        let queries = gpu.timestamp_period_ns.map(|_| {
            gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("pass times"),
                ty: wgpu::QueryType::Timestamp,
                count: 2 * MOST_TIMED,
            })
        });
        let encoder = gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        Self {
            gpu,
            encoder,
            queries,
            timed: Vec::new(),
        }
    }

    /// Runs at least `threads` invocations.
    pub(crate) fn dispatch(&mut self, kernel: &Kernel, binds: &[Bind<'_>], threads: [u32; 3]) {
        let size = kernel.shader.workgroup;
        let groups = [0, 1, 2].map(|i| threads[i].div_ceil(size[i]));
        self.dispatch_groups(kernel, binds, groups);
    }

    /// Runs whole workgroups.
    pub(crate) fn dispatch_groups(&mut self, kernel: &Kernel, binds: &[Bind<'_>], groups: [u32; 3]) {
        let entries: Vec<_> = (0_u32..)
            .zip(binds)
            .map(|(binding, bind)| wgpu::BindGroupEntry {
                binding,
                resource: match bind {
                    Bind::Buffer(buffer) => buffer.as_entire_binding(),
                    Bind::Table(view) => wgpu::BindingResource::TextureView(view),
                    Bind::LinearClamp => wgpu::BindingResource::Sampler(&self.gpu.linear_clamp),
                    Bind::LinearRepeat => wgpu::BindingResource::Sampler(&self.gpu.linear_repeat),
                },
            })
            .collect();
        let group = self.gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(kernel.shader.name),
            layout: &kernel.layout,
            entries: &entries,
        });
        let index = u32::try_from(self.timed.len()).unwrap_or(MOST_TIMED);
        let queries = self.queries.as_ref().filter(|_| index < MOST_TIMED);
        let mut pass = self.encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(kernel.shader.name),
            timestamp_writes: queries.map(|query_set| wgpu::ComputePassTimestampWrites {
                query_set,
                beginning_of_pass_write_index: Some(2 * index),
                end_of_pass_write_index: Some(2 * index + 1),
            }),
        });
        pass.set_pipeline(&kernel.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(groups[0], groups[1], groups[2]);
        if queries.is_some() {
            self.timed.push(kernel.shader.name);
        }
    }

    /// Submits, waits, and hands the bytes of the mappable buffers to `take`. Also gives the time of each pass.
    pub(crate) fn finish<T>(
        mut self,
        buffers: &[(&wgpu::Buffer, u64)],
        take: impl FnOnce(&[&[u8]]) -> T,
    ) -> Result<(T, Vec<PassTime>), Error> {
        let gpu = self.gpu;
        let ticks = self
            .queries
            .as_ref()
            .filter(|_| !self.timed.is_empty())
            .map(|queries| {
                let count = u32::try_from(2 * self.timed.len()).unwrap_or(0);
                let size = 8 * u64::from(count);
                let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
                let resolved = gpu.buffer("pass times", size, usage);
                let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
                let readable = gpu.buffer("pass times", size, usage);
                self.encoder.resolve_query_set(queries, 0..count, &resolved, 0);
                self.encoder
                    .copy_buffer_to_buffer(&resolved, 0, &readable, 0, size);
                (readable, size)
            });
        gpu.queue.submit([self.encoder.finish()]);
        let mut all = buffers.to_vec();
        if let Some((readable, size)) = &ticks {
            all.push((readable, *size));
        }
        let period_ns = f64::from(gpu.timestamp_period_ns.unwrap_or(0.0));
        let names = self.timed;
        gpu.read(&all, |bytes| {
            let mut times: BTreeMap<usize, PassTime> = BTreeMap::new();
            if ticks.is_some() {
                let stamps: Vec<u64> = bytes[buffers.len()]
                    .chunks_exact(8)
                    .map(|b| u64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]))
                    .collect();
                for (i, name) in names.iter().enumerate() {
                    #[allow(
                        clippy::cast_precision_loss,
                        reason = "a pass takes far fewer than 2^53 ticks"
                    )]
                    let ms = stamps[2 * i + 1].saturating_sub(stamps[2 * i]) as f64 * period_ns * 1e-6;
                    let first = names.iter().position(|n| n == name).unwrap_or(i);
                    times.entry(first).or_insert(PassTime { pass: name, ms: 0.0 }).ms += ms;
                }
            }
            (take(&bytes[..buffers.len()]), times.into_values().collect())
        })
    }
}
