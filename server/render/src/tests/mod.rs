//! Tests that look inside: single functions of the shaders on the device against their f64 twins, the kernels, the
//! device's loss. What the crate shows to others is tested in `server/render/tests`.
#![allow(
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::needless_range_loop,
    reason = "tests fail by panicking"
)]

mod aerial;
mod cloud;
mod depth;
mod dome;
mod furnace;
mod geometry;
mod ground;
mod half_tables;
mod layout;
mod lens;
mod night;
mod noise;
mod phase;
mod scattering;
mod tables;

use crate::{engine::Engine, gpu::Gpu, renderer::RendererSettings, shader::Shader};
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};
use wgpu::{BindGroupEntry, BindingResource, BufferUsages};

/// One device for all tests.
pub(crate) fn engine() -> MutexGuard<'static, Engine> {
    static ENGINE: LazyLock<Mutex<Engine>> =
        LazyLock::new(|| Mutex::new(Engine::open(&RendererSettings::default(), 0).unwrap()));
    ENGINE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A compute shader of a test's own, run over all groups.
fn run_shader(gpu: &Gpu, text: &str, entry: &str, binds: &[(u32, BindingResource<'_>)], groups: [u32; 3]) {
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(entry),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    let pipeline = gpu
        .device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry),
            layout: None,
            module: &module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
    let entries: Vec<_> = binds
        .iter()
        .map(|(binding, resource)| BindGroupEntry {
            binding: *binding,
            resource: resource.clone(),
        })
        .collect();
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(entry),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &entries,
    });
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(groups[0], groups[1], groups[2]);
    }
    gpu.queue.submit([encoder.finish()]);
}

/// Runs WGSL statements among the functions of a linked shader, once for each row. They find the row as `a` and `b`
/// and leave their findings in `x` and `y`, each four floats. `binds` are those bindings of the shader that they use.
fn evaluate(
    gpu: &Gpu,
    shader: &Shader,
    statements: &str,
    rows: &[[f32; 8]],
    binds: &[(u32, BindingResource<'_>)],
) -> Vec<[f32; 8]> {
    let text = format!(
        "{}
        struct TestRow {{ a: vec4f, b: vec4f }}
        @group(0) @binding(30) var<storage, read> test_rows: array<TestRow>;
        @group(0) @binding(31) var<storage, read_write> test_found: array<TestRow>;
        @compute @workgroup_size(64)
        fn test_entry(@builtin(global_invocation_id) id: vec3u) {{
            if id.x >= arrayLength(&test_rows) {{
                return;
            }}
            let a = test_rows[id.x].a;
            let b = test_rows[id.x].b;
            var x = vec4f(0.0);
            var y = vec4f(0.0);
            {statements}
            test_found[id.x] = TestRow(x, y);
        }}",
        shader.wgsl
    );
    let bytes: &[u8] = bytemuck::cast_slice(rows);
    let size = bytes.len() as u64;
    gpu.guarded(|| {
        let given = gpu.filled("rows", bytes, BufferUsages::STORAGE);
        let found = gpu.buffer("found", size, BufferUsages::STORAGE | BufferUsages::COPY_SRC);
        let mut all = binds.to_vec();
        all.push((30, given.as_entire_binding()));
        all.push((31, found.as_entire_binding()));
        let groups = u32::try_from(rows.len()).unwrap().div_ceil(64);
        run_shader(gpu, &text, "test_entry", &all, [groups, 1, 1]);
        read(gpu, &found, size)
    })
    .unwrap()
}

/// The floats of a buffer, in rows of `N`.
fn read<const N: usize>(gpu: &Gpu, buffer: &wgpu::Buffer, size: u64) -> Result<Vec<[f32; N]>, crate::Error>
where
    [f32; N]: bytemuck::Pod,
{
    let readable = gpu.buffer("readable", size, BufferUsages::COPY_DST | BufferUsages::MAP_READ);
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_buffer_to_buffer(buffer, 0, &readable, 0, size);
    gpu.queue.submit([encoder.finish()]);
    gpu.read(&[(&readable, size)], |bytes| {
        bytemuck::pod_collect_to_vec(bytes[0])
    })
}

/// The texels of one layer of a table.
fn read_table(gpu: &Gpu, view: &wgpu::TextureView, layer: u32) -> Vec<[f32; 4]> {
    let texture = view.texture();
    let (width, height) = (texture.width(), texture.height());
    // Rows of a copy stand 256 bytes apart or a multiple of it.
    assert_eq!(
        16 * width % 256,
        0,
        "a test reads tables whose width is a multiple of 16"
    );
    let size = 16 * u64::from(width * height);
    let buffer = gpu.buffer("texels", size, BufferUsages::COPY_DST | BufferUsages::COPY_SRC);
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let mut from = texture.as_image_copy();
    from.origin.z = layer;
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(16 * width),
        rows_per_image: None,
    };
    let to = wgpu::TexelCopyBufferInfo {
        buffer: &buffer,
        layout,
    };
    encoder.copy_texture_to_buffer(
        from,
        to,
        wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
    );
    gpu.queue.submit([encoder.finish()]);
    read(gpu, &buffer, size).unwrap()
}
