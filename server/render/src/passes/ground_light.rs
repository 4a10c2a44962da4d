//! The light of the ground, through the air in front of it.

use super::{
    Table,
    ground_view::Looks,
    shafts::{LOST_BYTES, ONE_PLACE},
};
use crate::{
    cloudscape::Cloudscape,
    groundscape::Groundscape,
    kernel::{Bind, Recorder, Variants},
    method::Plan,
    shader,
    uniforms::{Part, TileUniform, clouds::ShadeUniform, ground::LightSettingsUniform},
};
use std::sync::Arc;

pub(crate) struct GroundLight {
    kernels: Variants,
}

/// What the pass reads beside the ground.
#[derive(Clone, Copy)]
pub(crate) struct LightInputs<'a> {
    pub(crate) air: &'a Part,
    pub(crate) view: &'a Part,
    pub(crate) observer: &'a Part,
    pub(crate) plan: Plan,
    pub(crate) transmittance: &'a Table,
    pub(crate) irradiance: &'a Table,
    pub(crate) source: &'a Table,
    pub(crate) airglow: &'a Part,
    /// The moon in the sun's place, where its light counts.
    pub(crate) moon_view: Option<&'a Part>,
    pub(crate) clouds: Option<&'a Cloudscape>,
    /// True where rays are followed through them.
    pub(crate) followed: bool,
}

/// Bytes of one pixel's light: four floats.
pub(crate) const LIT_BYTES: u64 = 16;

/// What stands on the ground before the pixels of a tile, or the directions of a list.
pub(crate) struct LitGround {
    /// Radiance and distance; where nothing stands, what the sky loses to shafts, and -1 or less.
    pub(crate) light: wgpu::Buffer,
    /// What each ray loses to shafts, if there are any: `Lost` of `lib/shaft_lattice.wgsl`.
    pub(crate) lost: Option<wgpu::Buffer>,
}

impl GroundLight {
    pub(crate) const fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::GROUND_LIGHT),
        }
    }

    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Groundscape,
        inputs: LightInputs<'_>,
        (looks, seen): (Looks<'_>, &wgpu::Buffer),
        lost: Option<&(Arc<wgpu::Buffer>, TileUniform)>,
    ) -> LitGround {
        let gpu = recorder.gpu;
        let lit = gpu.buffer(
            "ground_light",
            LIT_BYTES * looks.count(),
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        );
        let [camera, tile, directions] = looks.upload(gpu);
        let air = inputs.air.upload(gpu, "air");
        let view = inputs.view.upload(gpu, "view");
        let observer = inputs.observer.upload(gpu, "observer");
        let airglow = inputs.airglow.upload(gpu, "airglow");
        let moon_view = inputs.moon_view.unwrap_or(inputs.view).upload(gpu, "moon view");
        let moon_observer = scape
            .moon_observer
            .as_ref()
            .unwrap_or(inputs.observer)
            .upload(gpu, "moon observer");
        let shade = inputs
            .clouds
            .map_or_else(|| Part::new(&ShadeUniform::default()), |c| c.shade.clone());
        let (shade, cloud_frame) = (
            shade.upload(gpu, "shade"),
            Part::new(&scape.frame).upload(gpu, "clouds"),
        );
        let lattice = lost.map_or(ONE_PLACE, |(_, lattice)| *lattice);
        let settings = Part::new(&LightSettingsUniform {
            first_place_px: lattice.origin_px,
            places_across: lattice.size_px.x,
            grain: lattice.stride_px,
            wind_m_s: scape.wind_m_s.unwrap_or(0.0),
        });
        let settings = settings.upload(gpu, "light settings");
        let unused = gpu.buffer("unused", LOST_BYTES, wgpu::BufferUsages::STORAGE);
        let nowhere = gpu.buffer("unused", LOST_BYTES, wgpu::BufferUsages::STORAGE);
        let lost_before = lost.map(|_| {
            let size = LOST_BYTES * looks.count();
            gpu.buffer("lost", size, wgpu::BufferUsages::STORAGE)
        });
        let shade_maps = inputs
            .clouds
            .map_or(&inputs.source.view, |scape| &scape.shadow.view);
        // A variant reads nothing of what it is not for; anything of its kind stands there.
        let nothing = gpu.written(
            "unused",
            [1, 1, 1],
            crate::gpu::Shape::Volume,
            shader::Texel::Float,
        );
        let volumes = scape
            .aerial
            .as_ref()
            .map_or([&nothing; 3], |a| [&a.rayleigh, &a.mie, &a.multiple]);
        let binds = [
            Bind::Buffer(&air),
            Bind::Buffer(&view),
            Bind::Buffer(&camera),
            Bind::Buffer(&tile),
            Bind::Buffer(&observer),
            Bind::Table(&inputs.transmittance.view),
            Bind::LinearClamp,
            Bind::Table(&inputs.irradiance.view),
            Bind::Table(&inputs.source.view),
            Bind::Table(volumes[0]),
            Bind::Table(volumes[1]),
            Bind::Table(volumes[2]),
            Bind::Buffer(&airglow),
            Bind::Buffer(&moon_view),
            Bind::Buffer(&moon_observer),
            Bind::Buffer(&shade),
            Bind::Table(shade_maps),
            Bind::Buffer(&cloud_frame),
            Bind::Buffer(&directions),
            Bind::Buffer(seen),
            Bind::Buffer(&scape.harmonics),
            Bind::Buffer(&lit),
            Bind::Buffer(&settings),
            Bind::Buffer(lost.map_or(&unused, |(lost, _)| lost)),
            Bind::Buffer(lost_before.as_ref().unwrap_or(&nowhere)),
            Bind::Table(
                inputs
                    .clouds
                    .map_or(&inputs.source.view, Cloudscape::cloud_air_view),
            ),
        ];
        let flag = |on: bool| f64::from(u8::from(on));
        let mut constants = vec![
            ("METHOD", inputs.plan.method_code()),
            ("AIRGLOW", flag(inputs.plan.airglow)),
            ("MOONLIGHT", flag(inputs.moon_view.is_some())),
            ("MOON_HIDDEN", flag(scape.by_moon)),
            ("SHAFTS", flag(lost.is_some())),
            ("WATER", flag(scape.wind_m_s.is_some())),
            ("CLOUDS", flag(inputs.clouds.is_some())),
            inputs.clouds.map_or(("CLOUD_AIR", 0.0), Cloudscape::cloud_air),
            ("DOME", flag(inputs.clouds.is_some() && !inputs.followed)),
        ];
        constants.extend(inputs.plan.march_constants());
        constants.extend(looks.constants());
        let kernel = self.kernels.get(gpu, &constants);
        recorder.dispatch(kernel, &binds, looks.threads());
        LitGround {
            light: lit,
            lost: lost_before,
        }
    }
}
