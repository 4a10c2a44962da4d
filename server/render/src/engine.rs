//! The list of passes, and what one frame asks of them.

use crate::{
    camera::CameraUniform,
    cloud_dome::DomeView,
    cloud_light::CloudLight,
    cloud_sky::CloudSky,
    cloudscape::CloudPasses,
    cpu::airglow::NightLight,
    error::Error,
    gpu::Gpu,
    groundscape::GroundPasses,
    kernel::Recorder,
    lens::Lens,
    lights::Lights,
    memo::{Fingerprint, Memo},
    method::Plan,
    night::Night,
    noise_cache::DiskCache,
    passes::{
        exposure::{ExposurePass, meter_size},
        multi_scattering::{MultiScatteringPass, Wanted},
        pillars::PillarsPass,
        probe::Probe,
        sky::{CloudInputs, Sky, SkyInputs},
        sky_view::SkyView,
        stars::{StarsOut, StarsPass},
        tone::Tone,
        transmittance::Transmittance,
    },
    pillars::PillarPasses,
    prepared::{Prepared, Tables, sky_inputs},
    renderer::RendererSettings,
    screen::Screen,
    shafts::exact_shafts,
    sunlight::Direct,
    uniforms::{AirUniform, Part, Standpoint},
};
use glam::UVec2;
use std::cell::OnceCell;
use welkin_scene::{
    Exposure, Method, Quality, Scene,
    renderer::{FrameOrder, Output, PassTime},
};

mod kept;
mod probe;
mod tile;

use kept::{airglow, moon_face};

/// The device with its passes. Fields drop in this order: what was made from the device goes before it.
pub(crate) struct Engine {
    transmittance: Transmittance,
    multi_scattering: MultiScatteringPass,
    sky_view: SkyView,
    sky: Sky,
    moon_face: OnceCell<wgpu::TextureView>,
    stars: StarsPass,
    exposure: ExposurePass,
    tone: Tone,
    probe: Probe,
    clouds: CloudPasses,
    ground: GroundPasses,
    pillars: (PillarPasses, PillarsPass),
    screen: Screen,
    night_light: Memo<NightLight>,
    direct: Memo<Direct>,
    pub(crate) generation: u64,
    pub(crate) gpu: Gpu,
}

impl Engine {
    /// `generation` tells this device from those before it.
    pub(crate) fn open(settings: &RendererSettings, generation: u64) -> Result<Self, Error> {
        Self::on(
            Gpu::open(&settings.adapter)?,
            settings.disk_cache.clone(),
            generation,
        )
    }

    pub(crate) fn on(gpu: Gpu, disk_cache: Option<DiskCache>, generation: u64) -> Result<Self, Error> {
        let passes = gpu.guarded(|| {
            Ok((
                Transmittance::new(&gpu),
                MultiScatteringPass::new(),
                SkyView::new(),
                StarsPass::new(),
                ExposurePass::new(&gpu),
                Tone::new(),
                Probe::new(),
                CloudPasses::new(disk_cache),
            ))
        })?;
        let (transmittance, multi_scattering, sky_view, stars, exposure, tone, probe, clouds) = passes;
        Ok(Self {
            transmittance,
            multi_scattering,
            sky_view,
            sky: Sky::new(),
            moon_face: OnceCell::new(),
            stars,
            exposure,
            tone,
            probe,
            clouds,
            ground: GroundPasses::new(),
            pillars: (PillarPasses::new(), PillarsPass::new()),
            screen: Screen::default(),
            night_light: Memo::new(8),
            direct: Memo::new(8),
            generation,
            gpu,
        })
    }

    fn tables(
        (transmittance, multi_scattering): (&mut Transmittance, &mut MultiScatteringPass),
        recorder: &mut Recorder<'_>,
        scene: &Scene,
        quality: Quality,
    ) -> Tables {
        let air = AirUniform::new(scene);
        let wanted = Wanted::new(scene, quality, air.multiple > 0.0);
        let plan = Plan::new(scene, &air);
        let asymmetry = f64::from(air.mie_asymmetry);
        let air = Part::new(&air);
        let transmittance = transmittance.run(recorder, &air, plan.table_steps());
        let multi_scattering = multi_scattering.run(recorder, &air, asymmetry, &transmittance, wanted);
        Tables {
            plan,
            air,
            stand: Standpoint::new(scene),
            transmittance,
            multi_scattering,
        }
    }

    /// Tables and exposure of a frame: all that does not grow with its size.
    pub(crate) fn prepare(&mut self, order: &FrameOrder) -> Result<(Prepared, Vec<PassTime>), Error> {
        let scene = &*order.scene;
        let gpu = &self.gpu;
        gpu.guarded(|| {
            // Noise that a probe made is no part of this frame.
            drop(self.clouds.take_times());
            let cloud_sky = CloudSky::new(scene);
            let textures = cloud_sky
                .as_ref()
                .map(|sky| self.clouds.textures(gpu, sky.clouds, &order.assets))
                .transpose()?;
            let mut recorder = Recorder::new(gpu);
            let passes = (&mut self.transmittance, &mut self.multi_scattering);
            let tables = Self::tables(passes, &mut recorder, scene, order.quality);
            let reads = (&*tables.transmittance, &tables.multi_scattering.source);
            let sky_view = (tables.plan.method == Method::Lut).then(|| {
                let (air, stand) = (&tables.air, &tables.stand);
                self.sky_view
                    .run(&mut recorder, air, stand, reads, tables.plan, order.quality)
            });
            let observer = Part::new(&tables.stand.observer(tables.plan.pixel_steps()));
            let size_px = UVec2::new(order.width_px, order.height_px);
            let night = Night::new(scene, &tables.stand);
            let moon_sky_view = night.moon.filter(|moon| moon.counts > 0.0).map(|moon| {
                let (air, stand) = (&tables.air, moon.stand(&tables.stand));
                self.sky_view
                    .run(&mut recorder, air, &stand, reads, tables.plan, order.quality)
            });
            let glow = airglow(&mut self.night_light, scene, &tables);
            let face = || moon_face(&self.moon_face, gpu);
            let of_discs = Fingerprint::of((
                &tables.air,
                format!("{:?} {night:?} {:?}", tables.stand, scene.sun),
            ));
            let direct = self
                .direct
                .get_or(of_discs, || Direct::new(scene, &tables.stand, &night));
            let lights = Lights::new(scene, &tables.stand, night, &direct, glow, face, moon_sky_view);
            let stars = scene.stars.as_ref().filter(|_| night.stars > 0.0).map(|stars| {
                let (seen_by, hidden_by) =
                    ((&scene.camera, size_px), night.screens(&tables.stand, &scene.sun));
                StarsOut {
                    field: self
                        .stars
                        .field(gpu, stars, &scene.firmament(), seen_by, &hidden_by),
                    out: night.stars,
                }
            });
            let clouded = cloud_sky.is_some();
            // In previews a table tells what clouds keep from the air.
            let shafted =
                order.quality == Quality::Final && exact_shafts(scene, clouded, order.quality).is_some();
            let light = CloudLight::new(&tables.stand, &night, &lights, (clouded, shafted));
            let moon_stand = night
                .moon
                .filter(|moon| moon.counts > 0.0)
                .map(|moon| moon.stand(&tables.stand));
            let ground = self.ground.scape(
                &mut recorder,
                &mut self.clouds.aerial,
                &tables,
                (scene, &order.assets),
                (&light, moon_stand),
                (order.quality, Some(size_px)),
            )?;
            let clouds = cloud_sky.zip(textures).map(|(sky, textures)| {
                self.clouds.scape(
                    &mut recorder,
                    &tables,
                    (&sky, textures),
                    (light, ground.as_ref()),
                    order.quality,
                )
            });
            let camera = CameraUniform::new(&scene.camera, size_px);
            let shows = order.output == Output::Display;
            let glare = if shows { scene.display.glare } else { 0.0 };
            let pillars = self.pillars.0.scape(
                &mut recorder,
                (scene, &order.assets),
                (&tables.stand, &tables.air, &night),
                (ground.as_ref(), clouds.as_ref().map(|scape| scape.base_m)),
                Some((&camera, size_px, glare)),
            )?;
            let dome = clouds
                .as_ref()
                .filter(|_| order.quality == Quality::Preview)
                .map(|scape| {
                    let lens = Lens::new(&scene.camera, size_px);
                    let pixel_angle = f64::from(camera.pixel_angle);
                    let dome = self
                        .clouds
                        .dome
                        .run(&mut recorder, scape, &lens, size_px, pixel_angle);
                    let before_ground = ground
                        .as_ref()
                        .is_some_and(|g| g.may_hide(scape.base_m, &tables.stand));
                    DomeView {
                        before_ground,
                        ..dome
                    }
                });
            let exposure = match scene.display.exposure {
                Exposure::Auto { compensation_ev } if order.output == Output::Display => {
                    // The meter looks into neither sun nor moon, and sees no stars.
                    let small = meter_size(size_px);
                    let metered = Part::new(&CameraUniform::new(&scene.camera, small));
                    let parts = [lights.view(true), &metered, &observer];
                    let inputs = SkyInputs {
                        clouds: clouds.as_ref().map(|scape| CloudInputs {
                            scape,
                            dome: dome.as_ref(),
                        }),
                        ground: ground.as_ref(),
                        frame_px: small,
                        ..sky_inputs(&tables, &lights, true, parts, sky_view.as_deref())
                    };
                    let compensation = crate::uniforms::narrow(compensation_ev);
                    self.exposure
                        .run(&mut recorder, &mut self.sky, inputs, small, compensation)
                }
                _ => self.exposure.none(gpu),
            };
            let ((), spent) = recorder.finish(&[], |_| ())?;
            let mut times = self.clouds.take_times();
            times.extend(spent);
            let before = (clouds.as_ref(), ground.as_ref());
            let discs_left = self.probe.discs_left(gpu, before, scene, &tables.stand, &night)?;
            let dome = dome.map(|dome| DomeView { discs_left, ..dome });
            let glare = lights.glare.behind(discs_left);
            let camera_part = Part::new(&camera);
            let by_lattices = order.quality == Quality::Preview
                && tables.plan.runs_evenly()
                && clouds.is_some() == dome.is_some();
            Ok((
                Prepared {
                    tables,
                    lights,
                    camera,
                    camera_part,
                    observer,
                    sky_view,
                    stars,
                    clouds,
                    ground,
                    pillars,
                    exposure,
                    dome,
                    by_lattices,
                    glare,
                    direct: direct.behind(discs_left),
                    generation: self.generation,
                },
                times,
            ))
        })
    }
}
