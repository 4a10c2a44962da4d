//! The device: its choice, its limits, its buffers and textures, and reading back from it.

use crate::{error::Error, shader::Texel};
use std::sync::{Arc, Mutex, PoisonError, mpsc};
use welkin_scene::{frame::MAX_SIDE_PX, renderer::DeviceInfo};

/// Which adapter to open.
#[derive(Clone, Debug, Default)]
pub struct AdapterChoice {
    /// Part of the adapter's name, in any case. Without it a GPU goes before a software adapter.
    pub name: Option<String>,
    /// Refuse software adapters.
    pub require_gpu: bool,
}

/// An open device.
pub(crate) struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) info: DeviceInfo,
    /// Of all tables: 32-bit floats where the device filters them, else half floats.
    pub(crate) table_format: wgpu::TextureFormat,
    pub(crate) linear_clamp: wgpu::Sampler,
    pub(crate) linear_repeat: wgpu::Sampler,
    /// Nanoseconds a tick, where the device can time its passes.
    pub(crate) timestamp_period_ns: Option<f32>,
    lost: Arc<Mutex<Option<String>>>,
}

/// How a texture's texels are laid out.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Shape {
    Flat,
    Layers,
    Volume,
}

fn instance() -> wgpu::Instance {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    // Not GL: Mesa's software adapter shows up there a second time, without compute of the kind we need.
    descriptor.backends = wgpu::Backends::VULKAN | wgpu::Backends::METAL | wgpu::Backends::DX12;
    wgpu::Instance::new(descriptor)
}

fn describe(info: &wgpu::AdapterInfo) -> DeviceInfo {
    let kind = match info.device_type {
        wgpu::DeviceType::Cpu => "cpu",
        wgpu::DeviceType::DiscreteGpu => "discrete-gpu",
        wgpu::DeviceType::IntegratedGpu => "integrated-gpu",
        wgpu::DeviceType::VirtualGpu => "virtual-gpu",
        wgpu::DeviceType::Other => "other",
    };
    DeviceInfo {
        adapter: info.name.clone(),
        kind: kind.to_owned(),
        backend: info.backend.to_str().to_owned(),
        driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
        max_side_px: MAX_SIDE_PX,
        recoveries: 0,
    }
}

/// The adapters of this machine.
#[must_use]
pub fn adapters() -> Vec<DeviceInfo> {
    let all = pollster::block_on(instance().enumerate_adapters(wgpu::Backends::all()));
    all.iter().map(|adapter| describe(&adapter.get_info())).collect()
}

/// GPUs in the order of their usual speed, software last.
const fn rank(kind: wgpu::DeviceType) -> u8 {
    match kind {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    }
}

fn choose(choice: &AdapterChoice) -> Result<wgpu::Adapter, Error> {
    let mut all = pollster::block_on(instance().enumerate_adapters(wgpu::Backends::all()));
    if all.is_empty() {
        return Err(Error::NoAdapter);
    }
    let there = all
        .iter()
        .map(|a| a.get_info().name)
        .collect::<Vec<_>>()
        .join(", ");
    all.sort_by_key(|adapter| rank(adapter.get_info().device_type));
    let wanted = choice.name.as_deref().map(str::to_lowercase);
    all.into_iter()
        .find(|adapter| {
            let info = adapter.get_info();
            let named = wanted
                .as_ref()
                .is_none_or(|name| info.name.to_lowercase().contains(name.as_str()));
            named && !(choice.require_gpu && info.device_type == wgpu::DeviceType::Cpu)
        })
        .ok_or_else(|| {
            let asked = match (&choice.name, choice.require_gpu) {
                (Some(name), true) => format!("\"{name}\" that is a GPU"),
                (Some(name), false) => format!("\"{name}\""),
                (None, _) => "the wish for a GPU".to_owned(),
            };
            Error::NoSuchAdapter { asked, there }
        })
}

impl Gpu {
    /// Opens the adapter that is asked for. Features are probed, none assumed but compute.
    pub(crate) fn open(choice: &AdapterChoice) -> Result<Self, Error> {
        let adapter = choose(choice)?;
        let info = describe(&adapter.get_info());
        let lacking = |what: &str| Error::Lacking {
            adapter: info.adapter.clone(),
            what: what.to_owned(),
        };
        if !adapter
            .get_downlevel_capabilities()
            .flags
            .contains(wgpu::DownlevelFlags::COMPUTE_SHADERS)
        {
            return Err(lacking("compute shaders"));
        }
        let offered = adapter.features();
        let features = offered & (wgpu::Features::FLOAT32_FILTERABLE | wgpu::Features::TIMESTAMP_QUERY);
        let table_format = if features.contains(wgpu::Features::FLOAT32_FILTERABLE) {
            wgpu::TextureFormat::Rgba32Float
        } else {
            wgpu::TextureFormat::Rgba16Float
        };
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("welkin"),
            required_features: features,
            required_limits: wgpu::Limits::default().using_resolution(adapter.limits()),
            memory_hints: wgpu::MemoryHints::MemoryUsage,
            ..wgpu::DeviceDescriptor::default()
        };
        let opened = pollster::block_on(adapter.request_device(&descriptor));
        let (device, queue) = opened.map_err(|e| Error::Open(e.to_string()))?;
        let lost = Arc::new(Mutex::new(None));
        let note = Arc::clone(&lost);
        device.set_device_lost_callback(move |reason, message| {
            let mut noted = note.lock().unwrap_or_else(PoisonError::into_inner);
            *noted = Some(format!("{reason:?}: {message}"));
        });
        // Every command runs inside an error scope; what still comes here must not bring the process down.
        device.on_uncaptured_error(Arc::new(
            |error| tracing::error!(%error, "device error outside a scope"),
        ));
        let linear = |label, address_mode| {
            device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some(label),
                address_mode_u: address_mode,
                address_mode_v: address_mode,
                address_mode_w: address_mode,
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..wgpu::SamplerDescriptor::default()
            })
        };
        let linear_clamp = linear("linear_clamp", wgpu::AddressMode::ClampToEdge);
        let linear_repeat = linear("linear_repeat", wgpu::AddressMode::Repeat);
        let timed = features.contains(wgpu::Features::TIMESTAMP_QUERY);
        let timestamp_period_ns = timed.then(|| queue.get_timestamp_period());
        Ok(Self {
            device,
            queue,
            info,
            table_format,
            linear_clamp,
            linear_repeat,
            timestamp_period_ns,
            lost,
        })
    }

    /// The reason, once the device is lost.
    pub(crate) fn lost(&self) -> Option<String> {
        self.lost.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Runs `work` inside error scopes; what the device refuses in it is an error here.
    pub(crate) fn guarded<T>(&self, work: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let result = work();
        let refused = pollster::block_on(validation.pop()).or(pollster::block_on(memory.pop()));
        if let Some(reason) = self.lost() {
            return Err(Error::Lost(reason));
        }
        refused.map_or(result, |error| Err(Error::Command(error.to_string())))
    }

    pub(crate) fn buffer(&self, label: &str, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size,
            usage,
            mapped_at_creation: false,
        })
    }

    /// A buffer that holds `bytes`.
    pub(crate) fn filled(&self, label: &str, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let buffer = self.buffer(label, bytes.len() as u64, usage | wgpu::BufferUsages::COPY_DST);
        self.queue.write_buffer(&buffer, 0, bytes);
        buffer
    }

    pub(crate) const fn format(&self, texel: Texel) -> wgpu::TextureFormat {
        match texel {
            Texel::Float => self.table_format,
            Texel::Single => match self.table_format {
                wgpu::TextureFormat::Rgba32Float => wgpu::TextureFormat::R32Float,
                half => half,
            },
            Texel::Byte => wgpu::TextureFormat::Rgba8Unorm,
        }
    }

    /// A table that shaders write and sample. New tables hold zeros.
    pub(crate) fn table(&self, label: &str, width: u32, height: u32, layers: u32) -> wgpu::TextureView {
        let shape = if layers > 1 { Shape::Layers } else { Shape::Flat };
        self.written(label, [width, height, layers], shape, Texel::Float)
    }

    /// A texture that shaders write and sample. New ones hold zeros.
    pub(crate) fn written(
        &self,
        label: &str,
        [width, height, depth_or_array_layers]: [u32; 3],
        shape: Shape,
        texel: Texel,
    ) -> wgpu::TextureView {
        let usage = wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_SRC;
        self.texture(
            label,
            [width, height, depth_or_array_layers],
            (shape, texel),
            usage,
        )
        .1
    }

    /// A texture that holds `bytes`, rows from the top, layers or slices one after the other.
    pub(crate) fn holding(
        &self,
        label: &str,
        [width, height, depth]: [u32; 3],
        shape: Shape,
        texel: Texel,
        bytes: &[u8],
    ) -> wgpu::TextureView {
        let usage = wgpu::TextureUsages::COPY_DST | wgpu::TextureUsages::COPY_SRC;
        let (texture, view) = self.texture(label, [width, height, depth], (shape, texel), usage);
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: self.format(texel).block_copy_size(None).map(|size| size * width),
            rows_per_image: Some(height),
        };
        self.queue
            .write_texture(texture.as_image_copy(), bytes, layout, texture.size());
        view
    }

    fn texture(
        &self,
        label: &str,
        [width, height, depth_or_array_layers]: [u32; 3],
        (shape, texel): (Shape, Texel),
        usage: wgpu::TextureUsages,
    ) -> (wgpu::Texture, wgpu::TextureView) {
        let (dimension, seen_as) = match shape {
            Shape::Flat => (wgpu::TextureDimension::D2, wgpu::TextureViewDimension::D2),
            Shape::Layers => (wgpu::TextureDimension::D2, wgpu::TextureViewDimension::D2Array),
            Shape::Volume => (wgpu::TextureDimension::D3, wgpu::TextureViewDimension::D3),
        };
        let texture = self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension,
            format: self.format(texel),
            usage: usage | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(seen_as),
            ..wgpu::TextureViewDescriptor::default()
        });
        (texture, view)
    }

    /// A table that holds a picture, rows from the top.
    pub(crate) fn picture(&self, label: &str, width: u32, texels: &[[f32; 3]]) -> wgpu::TextureView {
        let height = u32::try_from(texels.len()).unwrap_or(0) / width;
        let whole: Vec<[f32; 4]> = texels.iter().map(|[r, g, b]| [*r, *g, *b, 1.0]).collect();
        let bytes = if self.table_format == wgpu::TextureFormat::Rgba32Float {
            bytemuck::cast_slice(&whole).to_vec()
        } else {
            let halves: Vec<half::f16> = whole.iter().flatten().map(|v| half::f16::from_f32(*v)).collect();
            bytemuck::cast_slice(&halves).to_vec()
        };
        self.holding(label, [width, height, 1], Shape::Flat, Texel::Float, &bytes)
    }

    /// Waits for all submitted work, then hands the first `size` bytes of each mappable buffer to `take`.
    pub(crate) fn read<T>(
        &self,
        buffers: &[(&wgpu::Buffer, u64)],
        take: impl FnOnce(&[&[u8]]) -> T,
    ) -> Result<T, Error> {
        let (sender, receiver) = mpsc::channel();
        for (buffer, size) in buffers {
            let sender = sender.clone();
            // The receiver lives until the end of this function; a failed send would mean nobody waits.
            buffer.map_async(wgpu::MapMode::Read, 0..*size, move |result| {
                drop(sender.send(result))
            });
        }
        drop(sender);
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|e| Error::Lost(self.lost().unwrap_or_else(|| e.to_string())))?;
        for result in receiver {
            result.map_err(|e| Error::Lost(self.lost().unwrap_or_else(|| e.to_string())))?;
        }
        let ranges = buffers
            .iter()
            .map(|(buffer, size)| buffer.get_mapped_range(0..*size));
        let views = ranges
            .collect::<Result<Vec<_>, _>>()
            .map_err(|e| Error::Command(e.to_string()))?;
        let slices: Vec<&[u8]> = views.iter().map(|view| &**view).collect();
        let taken = take(&slices);
        drop(views);
        for (buffer, _) in buffers {
            buffer.unmap();
        }
        Ok(taken)
    }
}
