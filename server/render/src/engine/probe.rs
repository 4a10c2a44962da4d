//! What a probe asks of the passes.

use super::{
    Engine,
    kept::{airglow, moon_face},
};
use crate::{
    cloud_light::CloudLight,
    cloud_sky::CloudSky,
    error::Error,
    kernel::Recorder,
    lights::Lights,
    night::Night,
    passes::probe::{ProbeInputs, Seen, Sight},
    shafts::exact_shafts,
    sunlight::{Direct, DiscsLeft},
};
use welkin_scene::{Quality, Scene, assets::SceneAssets};

impl Engine {
    /// Answers at exact directions, at final quality, and what clouds leave of the light of sun and moon.
    pub(crate) fn probe(
        &mut self,
        scene: &Scene,
        assets: &SceneAssets,
        sights: &[Sight],
    ) -> Result<(Vec<Seen>, DiscsLeft), Error> {
        let gpu = &self.gpu;
        gpu.guarded(|| {
            let cloud_sky = CloudSky::new(scene);
            let textures = cloud_sky
                .as_ref()
                .map(|sky| self.clouds.textures(gpu, sky.clouds, assets))
                .transpose()?;
            let mut recorder = Recorder::new(gpu);
            let passes = (&mut self.transmittance, &mut self.multi_scattering);
            let tables = Self::tables(passes, &mut recorder, scene, Quality::Final);
            let night = Night::new(scene, &tables.stand);
            let glow = airglow(&mut self.night_light, scene, &tables);
            let face = || moon_face(&self.moon_face, gpu);
            let direct = Direct::new(scene, &tables.stand, &night);
            let lights = Lights::new(scene, &tables.stand, night, &direct, glow, face, None);
            let clouded = cloud_sky.is_some();
            let shafted = exact_shafts(scene, clouded, Quality::Final).is_some();
            let light = CloudLight::new(&tables.stand, &night, &lights, (clouded, shafted));
            let moonlit = night.moon.filter(|moon| moon.counts > 0.0);
            let ground = self.ground.scape(
                &mut recorder,
                &mut self.clouds.aerial,
                &tables,
                (scene, assets),
                (&light, moonlit.map(|moon| moon.stand(&tables.stand))),
                (Quality::Final, None),
            )?;
            let clouds = cloud_sky.zip(textures).map(|(sky, textures)| {
                self.clouds.scape(
                    &mut recorder,
                    &tables,
                    (&sky, textures),
                    (light, ground.as_ref()),
                    Quality::Final,
                )
            });
            let pillars = self.pillars.0.scape(
                &mut recorder,
                (scene, assets),
                (&tables.stand, &tables.air, &night),
                (ground.as_ref(), clouds.as_ref().map(|scape| scape.base_m)),
                None,
            )?;
            recorder.finish(&[], |_| ())?;
            let before = (clouds.as_ref(), ground.as_ref());
            let discs_left = self.probe.discs_left(gpu, before, scene, &tables.stand, &night)?;
            let moon_stand = night.moon.map(|moon| moon.stand(&tables.stand));
            let inputs = ProbeInputs {
                air: &tables.air,
                view: lights.view(false),
                stand: &tables.stand,
                plan: tables.plan,
                transmittance: &tables.transmittance,
                multi_scattering: &tables.multi_scattering,
                airglow: lights.airglow(),
                moon: lights.moon(false).zip(moon_stand),
                clouds: clouds.as_ref(),
                ground: ground.as_ref(),
                pillars: pillars.as_ref(),
            };
            Ok((self.probe.run(gpu, inputs, sights)?, discs_left))
        })
    }
}
