//! The ground as its light sees it.

use crate::{
    ground::{Frame, Terrains},
    kernel::{Bind, Recorder, Variants},
    memo::{Fingerprint, Memo},
    shader,
    uniforms::{Part, ground::GroundShadowUniform, narrow},
};
use glam::{DVec3, Vec3};
use std::sync::Arc;

pub(crate) struct GroundShadow {
    kernels: Variants,
    memo: Memo<ShadowMap>,
}

/// A map with what it was made from.
pub(crate) struct ShadowMap {
    pub(crate) texels: wgpu::Buffer,
    pub(crate) uniform: Part,
    /// The same by places in the scene.
    pub(crate) in_scene: Part,
    pub(crate) made_from: Fingerprint,
}

/// Texels that a place on a surface is lifted off it.
const LIFT_PX: f32 = 1.0;

/// The map's axes and size: it holds the box about the terrain, whichever way the light comes.
pub(crate) fn shadow_uniform(terrains: &Terrains, light: DVec3, size_px: u32) -> GroundShadowUniform {
    let towards = terrains.frame.turn(light);
    // Level, so that a low light's map is as low as the terrain.
    let right = DVec3::Z.cross(towards).try_normalize().unwrap_or(DVec3::X);
    let up = towards.cross(right);
    let (least, most) = (terrains.shape.least_m, terrains.shape.most_m);
    let mut bounds = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for k in 0..8 {
        let pick = |axis: usize| {
            if k >> axis & 1 == 1 {
                most[axis]
            } else {
                least[axis]
            }
        };
        let corner = DVec3::new(pick(0), pick(1), pick(2));
        let along = DVec3::new(corner.dot(right), corner.dot(up), corner.dot(towards));
        bounds = (bounds.0.min(along), bounds.1.max(along));
    }
    // A little over, so that nothing at the edge rounds out of it.
    let half = 0.505 * (bounds.1 - bounds.0) + 1.0;
    GroundShadowUniform {
        right: right.as_vec3(),
        size_px,
        up: up.as_vec3(),
        lift_px: narrow(f64::from(LIFT_PX)),
        light: towards.as_vec3(),
        middle_m: (0.5 * (bounds.0 + bounds.1)).as_vec3(),
        half_m: half.as_vec3(),
    }
}

/// The same map by places in the scene: along an axis a there, p·a = (p - o)·a + o·a with o the ground's origin.
fn in_scene(of: &GroundShadowUniform, frame: &Frame) -> GroundShadowUniform {
    let turn_back = |v: Vec3| {
        let v = v.as_dvec3();
        frame.east * v.x + frame.north * v.y + frame.up * v.z
    };
    let [right, up, light] = [of.right, of.up, of.light].map(turn_back);
    let origin = [right, up, light].map(|axis| frame.origin_m.dot(axis));
    GroundShadowUniform {
        right: right.as_vec3(),
        up: up.as_vec3(),
        light: light.as_vec3(),
        middle_m: (of.middle_m.as_dvec3() + DVec3::from_array(origin)).as_vec3(),
        ..of.clone()
    }
}

impl GroundShadow {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::GROUND_SHADOW),
            memo: Memo::new(3),
        }
    }

    /// Made anew only when light or ground change.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        terrains: &Terrains,
        light: DVec3,
        size_px: u32,
    ) -> Arc<ShadowMap> {
        let uniform = shadow_uniform(terrains, light, size_px);
        let in_scene = Part::new(&in_scene(&uniform, &terrains.frame));
        let uniform = Part::new(&uniform);
        let own = terrains.own();
        let made_from = Fingerprint::of(("ground_shadow", &uniform, &own, terrains.shape.made_from));
        self.memo.get_or(made_from, || {
            let gpu = recorder.gpu;
            let words = size_px / 2;
            let texels = gpu.buffer(
                "ground_shadow",
                4 * u64::from(words) * u64::from(size_px),
                wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            );
            let (held, ground) = (uniform.upload(gpu, "shadow"), own.upload(gpu, "ground"));
            let binds = [
                Bind::Buffer(&ground),
                Bind::Buffer(&held),
                Bind::Buffer(&texels),
                Bind::Buffer(&terrains.shape.words),
                Bind::Buffer(&terrains.shape.finder),
            ];
            let kernel = self.kernels.get(gpu, &[("SHAPE", terrains.shape.code)]);
            recorder.dispatch(kernel, &binds, [words, size_px, 1]);
            ShadowMap {
                texels,
                uniform,
                in_scene,
                made_from,
            }
        })
    }
}
