//! Where clouds stand and how light goes through them: single functions of the shaders against their f64 twins and
//! against what can be known without computing it.

mod air;
mod cover;
mod far;
mod grid;
mod light;
mod slab;
mod volume;

use crate::{
    cloud_noise::CloudTextures, cloud_sky::CloudSky, cloudscape::CloudPasses, gpu::Gpu, kernel::Bind,
    noise_cache::DiskCache, uniforms::Part,
};
use serde_json::{Value, json};
use welkin_scene::{Scene, assets::SceneAssets};
use wgpu::BindingResource;

/// A scene with those clouds and nothing else that is not usual.
fn cloudy(clouds: Value) -> Scene {
    serde_json::from_value(json!({ "clouds": clouds })).unwrap()
}

/// Noise outlasts the test, since each runs in a process of its own.
fn passes() -> CloudPasses {
    let cache = DiskCache {
        folder: std::env::temp_dir().join("welkin-test-noise"),
        most_bytes: 1 << 28,
    };
    CloudPasses::new(Some(cache))
}

/// Noise and numbers of a scene's clouds on the device.
struct Ready {
    textures: CloudTextures,
    clouds: wgpu::Buffer,
}

impl Ready {
    fn new(gpu: &Gpu, passes: &mut CloudPasses, scene: &Scene) -> Self {
        Self::with(gpu, passes, scene, &SceneAssets::default())
    }

    fn with(gpu: &Gpu, passes: &mut CloudPasses, scene: &Scene, assets: &SceneAssets) -> Self {
        let sky = CloudSky::new(scene).expect("the scene has clouds");
        Self {
            textures: passes.textures(gpu, sky.clouds, assets).unwrap(),
            clouds: Part::new(&sky.uniform(1.0)).upload(gpu, "clouds"),
        }
    }

    /// Those bindings of `lib/cloud.wgsl` that a test's statements use.
    fn binds<'a>(&'a self, gpu: &'a Gpu, used: &[u32]) -> Vec<(u32, BindingResource<'a>)> {
        let all = self.textures.binds(&self.clouds);
        let resources = all.into_iter().map(|bind| match bind {
            Bind::Buffer(buffer) => buffer.as_entire_binding(),
            Bind::Table(view) => BindingResource::TextureView(view),
            Bind::LinearClamp => BindingResource::Sampler(&gpu.linear_clamp),
            Bind::LinearRepeat => BindingResource::Sampler(&gpu.linear_repeat),
        });
        (0..).zip(resources).filter(|(at, _)| used.contains(at)).collect()
    }
}

/// Bindings by which volume clouds, and sheets, are asked for.
const VOLUME: [u32; 7] = [0, 1, 2, 3, 4, 5, 6];
const SHEET: [u32; 3] = [0, 1, 7];
