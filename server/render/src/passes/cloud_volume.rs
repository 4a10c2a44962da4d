//! The coarse extinction of all layers of clouds about the observer.

use super::Table;
use crate::{
    cloud_noise::CloudTextures,
    gpu::Shape,
    kernel::{Bind, Recorder, Variants},
    memo::{Fingerprint, Memo},
    shader::{self, Texel},
    uniforms::Part,
};
use std::sync::Arc;
use welkin_scene::Quality;

pub(crate) struct CloudVolume {
    kernels: Variants,
    memo: Memo<Table>,
}

/// Texels of a layer to a side, and its levels. More than two layers share about what two have.
const fn size(quality: Quality, layers: u32) -> [u32; 2] {
    let [side, levels] = match quality {
        Quality::Preview => [128, 12],
        Quality::Final => [512, 24],
    };
    match layers {
        0..=2 => [side, levels],
        3..=4 => [side * 3 / 4, levels],
        _ => [side / 2, levels],
    }
}

impl CloudVolume {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::CLOUD_VOLUME),
            memo: Memo::new(2),
        }
    }

    /// One float a texel, 1/m; the levels of `count` layers one on the other.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        textures: &CloudTextures,
        clouds: &Part,
        (count, one_layer): (u32, (&'static str, f64)),
        quality: Quality,
    ) -> Arc<Table> {
        let made_from = Fingerprint::of(("cloud_volume", clouds, textures.fingerprint(), quality));
        self.memo.get_or(made_from, || {
            let gpu = recorder.gpu;
            let [side, levels] = size(quality, count);
            let view = gpu.written(
                "cloud_volume",
                [side, side, levels * count],
                Shape::Volume,
                Texel::Single,
            );
            let clouds = clouds.upload(gpu, "clouds");
            let mut binds = textures.coarse_binds(&clouds);
            binds.push(Bind::Table(&view));
            recorder.dispatch(self.kernels.get(gpu, &[one_layer]), &binds, [side, side, count]);
            Table { view, made_from }
        })
    }
}

/// The volume, or something in its place.
pub(crate) fn volume_view<'a>(
    volume: Option<&'a Arc<Table>>,
    textures: &'a CloudTextures,
) -> &'a wgpu::TextureView {
    volume.map_or(&textures.detail.view, |volume| &volume.view)
}

/// The shaders' constant that is 1 where there is one.
pub(crate) fn in_volume(volume: Option<&Arc<Table>>) -> (&'static str, f64) {
    ("VOLUME", f64::from(u8::from(volume.is_some())))
}
