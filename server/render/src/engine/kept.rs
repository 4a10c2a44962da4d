//! What the night's sky is made of, made once and kept.

use crate::{
    cpu::airglow::{NightLight, night_light},
    gpu::Gpu,
    memo::{Fingerprint, Memo},
    moon_face,
    prepared::Tables,
    uniforms::{Part, night::AirglowUniform},
};
use std::cell::OnceCell;
use welkin_scene::Scene;

/// The picture of the moon, made when a scene first has one.
pub(super) fn moon_face(kept: &OnceCell<wgpu::TextureView>, gpu: &Gpu) -> wgpu::TextureView {
    let side = u32::try_from(moon_face::SIDE).unwrap_or(u32::MAX);
    kept.get_or_init(|| gpu.picture("moon_face", side, moon_face::face()))
        .clone()
}

/// The night sky's own light; summed anew when air or stars change.
pub(super) fn airglow(memo: &mut Memo<NightLight>, scene: &Scene, tables: &Tables) -> Part {
    let glow = scene.atmosphere.as_ref().map(|air| &air.airglow);
    let made_from = Fingerprint::of((&tables.air, format!("{glow:?} {:?}", scene.stars)));
    let light = memo.get_or(made_from, || night_light(scene));
    Part::new(&AirglowUniform::new(scene, &light, tables.stand.altitude_m))
}
