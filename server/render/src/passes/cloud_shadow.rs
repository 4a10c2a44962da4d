//! Optical depth of each band and sheet of clouds towards the light.

use super::{
    Table,
    cloud_volume::{in_volume, volume_view},
};
use crate::{
    cloud_noise::CloudTextures,
    gpu::Shape,
    kernel::{Bind, Recorder, Variants},
    memo::{Fingerprint, Memo},
    shader::{self, Texel},
    uniforms::{Part, clouds::ShadowUniform},
};
use std::sync::Arc;
use welkin_scene::Quality;

pub(crate) struct CloudShadow {
    kernels: Variants,
    memo: Memo<Table>,
}

/// Side of a map, texels.
const fn side(quality: Quality) -> u32 {
    match quality {
        Quality::Preview => 128,
        Quality::Final => 384,
    }
}

impl CloudShadow {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::CLOUD_SHADOW),
            memo: Memo::new(4),
        }
    }

    /// `count` maps of two layers, one after the other in height.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        (textures, volume): (&CloudTextures, Option<&Arc<Table>>),
        (clouds, shade): (&Part, &Part),
        light: ShadowUniform,
        (count, one_layer): (u32, (&'static str, f64)),
        quality: Quality,
    ) -> Arc<Table> {
        let light = Part::new(&light);
        let made_from = Fingerprint::of((
            "cloud_shadow",
            clouds,
            shade,
            &light,
            textures.fingerprint(),
            volume.is_some(),
            quality,
        ));
        self.memo.get_or(made_from, || {
            let gpu = recorder.gpu;
            let side = side(quality);
            let view = gpu.written(
                "cloud_shadow",
                [side, side, 2 * count],
                Shape::Layers,
                Texel::Float,
            );
            let (clouds, shade) = (clouds.upload(gpu, "clouds"), shade.upload(gpu, "shade"));
            let light = light.upload(gpu, "shadow");
            let mut binds = textures.binds(&clouds);
            binds.extend([
                Bind::Buffer(&shade),
                Bind::Buffer(&light),
                Bind::LinearClamp,
                Bind::Table(volume_view(volume, textures)),
                Bind::Table(&view),
            ]);
            recorder.dispatch(
                self.kernels.get(gpu, &[one_layer, in_volume(volume)]),
                &binds,
                [side, side, count],
            );
            Table { view, made_from }
        })
    }
}
