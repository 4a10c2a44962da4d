//! Radiance, transmittance and distance at exact directions.

use super::{
    Table,
    cloud_probe::CloudProbe,
    ground_light::LightInputs,
    ground_view::{GroundView, Looks},
    multi_scattering::MultiScattering,
    pillars::{PillarsInputs, PillarsPass},
    sky::MoonInputs,
};
use crate::{
    cloud_dome::CloudsSeen,
    cloudscape::Cloudscape,
    error::Error,
    gpu::Gpu,
    groundscape::{GroundTiles, Groundscape},
    kernel::{Bind, Recorder, Variants},
    memo::Memo,
    method::Plan,
    pillars::Pillars,
    shader,
    sunlight::DiscsLeft,
    uniforms::{
        Part, Standpoint,
        clouds::{CloudFrameUniform, ShadeUniform},
        night::MoonUniform,
    },
};
use glam::DVec3;
use welkin_scene::Method;

/// Most directions in one dispatch: about as much work as one tile of a frame.
pub(crate) const CHUNK: usize = 8192;
/// The same through clouds.
pub(crate) const CLOUDED_CHUNK: usize = 1024;

pub(crate) struct Probe {
    kernels: Variants,
    pub(crate) clouds: CloudProbe,
    ground: GroundTiles,
    pillars: PillarsPass,
    pub(crate) view: GroundView,
    pub(crate) discs: Memo<DiscsLeft>,
}

/// A direction to probe.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sight {
    pub(crate) direction: DVec3,
    pub(crate) disc: bool,
}

/// What is seen there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub(crate) radiance: [f64; 3],
    pub(crate) transmittance: [f64; 3],
    pub(crate) distance_m: Option<f64>,
}

/// What the pass reads.
#[derive(Clone, Copy)]
pub(crate) struct ProbeInputs<'a> {
    pub(crate) air: &'a Part,
    pub(crate) view: &'a Part,
    pub(crate) stand: &'a Standpoint,
    pub(crate) plan: Plan,
    pub(crate) transmittance: &'a Table,
    pub(crate) multi_scattering: &'a MultiScattering,
    pub(crate) airglow: &'a Part,
    /// The moon, and the observer with it in the sun's place.
    pub(crate) moon: Option<(MoonInputs<'a>, Standpoint)>,
    pub(crate) clouds: Option<&'a Cloudscape>,
    pub(crate) ground: Option<&'a Groundscape>,
    pub(crate) pillars: Option<&'a Pillars>,
}

impl Probe {
    pub(crate) fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::PROBE),
            clouds: CloudProbe::new(),
            ground: GroundTiles::new(),
            pillars: PillarsPass::new(),
            view: GroundView::new(),
            discs: Memo::new(8),
        }
    }

    /// One answer a direction, at most [`CHUNK`] of them. Waits for the device.
    pub(crate) fn run(
        &mut self,
        gpu: &Gpu,
        inputs: ProbeInputs<'_>,
        sights: &[Sight],
    ) -> Result<Vec<Seen>, Error> {
        let packed: Vec<[f32; 4]> = sights
            .iter()
            .map(|s| {
                s.direction
                    .as_vec3()
                    .extend(if s.disc { 1.0 } else { 0.0 })
                    .to_array()
            })
            .collect();
        let count = packed.len() as u64;
        let directions = gpu.filled(
            "directions",
            bytemuck::cast_slice(&packed),
            wgpu::BufferUsages::STORAGE,
        );
        // Radiance and distance, transmittance and padding.
        let size = 32 * count;
        let answers = gpu.buffer(
            "answers",
            size,
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        );
        let readable = gpu.buffer(
            "answers",
            size,
            wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        );
        let air = inputs.air.upload(gpu, "air");
        let view = inputs.view.upload(gpu, "view");
        let on_way = Part::new(&inputs.stand.observer(inputs.plan.probe_steps()));
        let observer = on_way.upload(gpu, "observer");
        let of_moon = inputs.moon.map(|(moon, _)| moon);
        let moon_stand = inputs.moon.map_or(*inputs.stand, |(_, stand)| stand);
        let airglow = inputs.airglow.upload(gpu, "airglow");
        // A variant reads nothing of what it is not for; anything stands there.
        let none = Part::new(&MoonUniform::default());
        let moon = of_moon.map_or(&none, |m| m.moon).upload(gpu, "moon");
        let moon_view = of_moon.map_or(inputs.view, |m| m.view).upload(gpu, "moon view");
        let moon_observer =
            Part::new(&moon_stand.observer(inputs.plan.probe_steps())).upload(gpu, "moon observer");
        let face = of_moon.map_or(&inputs.transmittance.view, |m| m.face);
        let mut recorder = Recorder::new(gpu);
        let threads = u32::try_from(packed.len()).unwrap_or(u32::MAX);
        let lit_ground = inputs.ground.map(|scape| {
            let light = LightInputs {
                air: inputs.air,
                view: inputs.view,
                observer: &on_way,
                plan: inputs.plan.along_rays(),
                transmittance: inputs.transmittance,
                irradiance: &inputs.multi_scattering.irradiance,
                source: &inputs.multi_scattering.source,
                airglow: inputs.airglow,
                moon_view: of_moon.filter(|moon| moon.lights).map(|moon| moon.view),
                clouds: inputs.clouds,
                followed: true,
            };
            let looks = Looks::List(&directions, threads);
            self.ground.run(&mut recorder, scape, light, looks)
        });
        let clouds = inputs.clouds.map(|scape| {
            let before = lit_ground.as_ref();
            self.clouds
                .run(&mut recorder, scape, &directions, threads, before)
        });
        let (shade, cloud_frame) = inputs.clouds.map_or_else(
            || (Part::new(&ShadeUniform::default()), CloudFrameUniform::default()),
            |scape| (scape.shade.clone(), scape.frame()),
        );
        let shade = shade.upload(gpu, "shade");
        let cloud_frame = Part::new(&cloud_frame).upload(gpu, "cloud frame");
        let shadow = inputs
            .clouds
            .map_or(&inputs.multi_scattering.source.view, |scape| &scape.shadow.view);
        let unused = gpu.buffer("unused", 16, wgpu::BufferUsages::STORAGE);
        let source = &inputs.multi_scattering.source.view;
        let binds = [
            Bind::Buffer(&air),
            Bind::Buffer(&view),
            Bind::Buffer(&observer),
            Bind::Table(&inputs.transmittance.view),
            Bind::LinearClamp,
            Bind::Table(&inputs.multi_scattering.irradiance.view),
            Bind::Table(&inputs.multi_scattering.source.view),
            Bind::Buffer(&directions),
            Bind::Buffer(&answers),
            Bind::Buffer(&airglow),
            Bind::Buffer(&moon),
            Bind::Buffer(&moon_view),
            Bind::Buffer(&moon_observer),
            Bind::Table(face),
            Bind::Buffer(clouds.as_ref().unwrap_or(&directions)),
            Bind::Buffer(&shade),
            Bind::Table(shadow),
            Bind::Buffer(&cloud_frame),
            Bind::Buffer(lit_ground.as_ref().map_or(&unused, |ground| &ground.light)),
            Bind::Table(inputs.clouds.map_or(source, Cloudscape::cloud_air_view)),
        ];
        let nested = inputs.plan.method == Method::Nested;
        let flag = |on: bool| f64::from(u8::from(on));
        let [multiple, haze] = inputs.plan.march_constants();
        let constants = [
            multiple,
            haze,
            ("NESTED", flag(nested)),
            ("MOON", flag(of_moon.is_some())),
            ("MOONLIGHT", flag(of_moon.is_some_and(|m| m.lights))),
            ("CLOUDS", flag(inputs.clouds.is_some())),
            inputs.clouds.map_or(("CLOUD_AIR", 0.0), Cloudscape::cloud_air),
            ("GROUND", flag(inputs.ground.is_some())),
        ];
        let kernel = self.kernels.get(gpu, &constants);
        recorder.dispatch(kernel, &binds, [threads, 1, 1]);
        recorder
            .encoder
            .copy_buffer_to_buffer(&answers, 0, &readable, 0, size);
        // Pillars are narrow: sums over all directions leave them out, as they do the discs.
        let shown = inputs.pillars.filter(|_| sights.iter().any(|s| s.disc));
        let Some(pillars) = shown else {
            let (seen, _) = recorder.finish(&[(&readable, size)], |bytes| answers_of(bytes[0]))?;
            return Ok(seen);
        };
        let added = gpu.buffer(
            "pillars",
            16 * count,
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        );
        let added_readable = gpu.buffer(
            "pillars",
            16 * count,
            wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        );
        let reads = PillarsInputs {
            air: inputs.air,
            transmittance: inputs.transmittance,
            clouds: clouds.as_ref().map(CloudsSeen::List),
            lit_ground: lit_ground.as_ref().map(|ground| &ground.light),
        };
        self.pillars.run(
            &mut recorder,
            reads,
            pillars,
            Looks::List(&directions, threads),
            &added,
        );
        recorder
            .encoder
            .copy_buffer_to_buffer(&added, 0, &added_readable, 0, 16 * count);
        let both = [(&readable, size), (&added_readable, 16 * count)];
        let (seen, _) = recorder.finish(&both, |bytes| {
            let mut seen = answers_of(bytes[0]);
            let added: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(bytes[1]);
            for ((seen, added), sight) in seen.iter_mut().zip(added).zip(sights) {
                if sight.disc {
                    for (to, from) in seen.radiance.iter_mut().zip(added) {
                        *to += f64::from(from);
                    }
                }
            }
            seen
        })?;
        Ok(seen)
    }
}

fn answers_of(bytes: &[u8]) -> Vec<Seen> {
    let rows: Vec<[f32; 8]> = bytemuck::pod_collect_to_vec(bytes);
    rows.iter().map(answer).collect()
}

fn answer(row: &[f32; 8]) -> Seen {
    let triple = |at: usize| [f64::from(row[at]), f64::from(row[at + 1]), f64::from(row[at + 2])];
    let distance_m = (row[3] >= 0.0).then(|| f64::from(row[3]));
    Seen {
        radiance: triple(0),
        transmittance: triple(4),
        distance_m,
    }
}
