//! What stands ready before the ground in a frame is looked at: its shape, its shadow, the light of the sky on it.

use crate::{
    cloudscape::CloudLight,
    error::Error,
    gpu::Gpu,
    ground::{Shapes, Terrains, skin},
    kernel::Recorder,
    memo::Fingerprint,
    passes::{
        aerial::{Aerial, AerialVolumes},
        ground_light::{GroundLight, LightInputs},
        ground_shadow::{GroundShadow, ShadowMap},
        ground_sky::GroundSky,
        ground_view::{GroundView, Looks},
    },
    prepared::Tables,
    uniforms::{
        Part, Standpoint,
        ground::{GroundShadowUniform, StandUniform},
        narrow, narrow3,
    },
};
use glam::{DVec3, Vec3};
use std::sync::Arc;
use welkin_scene::{
    Method, Quality, Scene,
    assets::SceneAssets,
    terrain::{Shadow, ShadowFilter},
};

/// The passes of the ground that are run once for a frame.
pub(crate) struct GroundPasses {
    shapes: Shapes,
    shadow: GroundShadow,
    sky: GroundSky,
}

/// How the ground hides its light.
pub(crate) enum Shades {
    None,
    Map(Arc<ShadowMap>, ShadowFilter),
    /// By rays; the map's uniform tells which way.
    Rays(Part),
}

impl Shades {
    pub(crate) fn constants(&self) -> [(&'static str, f64); 2] {
        let (kind, filter) = match self {
            Self::None => (0.0, 0.0),
            Self::Map(_, ShadowFilter::Nearest) => (1.0, 0.0),
            Self::Map(_, ShadowFilter::Bilinear) => (1.0, 1.0),
            Self::Map(_, ShadowFilter::Gaussian) => (1.0, 2.0),
            Self::Rays(_) => (2.0, 0.0),
        };
        [("SHADOW", kind), ("FILTER", filter)]
    }

    /// The uniform and the map, or something in its place.
    pub(crate) fn upload(&self, gpu: &Gpu) -> (wgpu::Buffer, wgpu::Buffer) {
        let unused = || gpu.buffer("unused", 16, wgpu::BufferUsages::STORAGE);
        match self {
            Self::None => (
                Part::new(&GroundShadowUniform::default()).upload(gpu, "shadow"),
                unused(),
            ),
            Self::Map(map, _) => (map.uniform.upload(gpu, "shadow"), map.texels.clone()),
            Self::Rays(uniform) => (uniform.upload(gpu, "shadow"), unused()),
        }
    }

    fn fingerprint(&self) -> Fingerprint {
        match self {
            Self::None => Fingerprint::of("no shadow"),
            Self::Map(map, filter) => Fingerprint::of((map.made_from, filter)),
            Self::Rays(uniform) => Fingerprint::of(("rays", uniform)),
        }
    }
}

/// A scene's ground, ready to be looked at.
pub(crate) struct Groundscape {
    pub(crate) terrains: Terrains,
    pub(crate) ground: Part,
    pub(crate) skin: Part,
    pub(crate) stand: Part,
    pub(crate) shadow: Shades,
    /// True where the shadow is that of the moon.
    pub(crate) by_moon: bool,
    pub(crate) harmonics: Arc<wgpu::Buffer>,
    pub(crate) aerial: Option<Arc<AerialVolumes>>,
    pub(crate) moon_observer: Option<Part>,
    pub(crate) place_m: Vec3,
    made_from: Fingerprint,
}

impl Groundscape {
    /// True where it, or who looks, may stand above clouds that begin at that altitude: then some are before it.
    pub(crate) fn may_hide(&self, base_m: f32, stand: &Standpoint) -> bool {
        let top_m = self.terrains.shape.most_m.z.max(stand.altitude_m);
        top_m > f64::from(base_m)
    }

    pub(crate) const fn fingerprint(&self) -> Fingerprint {
        self.made_from
    }
}

impl GroundPasses {
    pub(crate) const fn new() -> Self {
        Self {
            shapes: Shapes::new(),
            shadow: GroundShadow::new(),
            sky: GroundSky::new(),
        }
    }

    /// None where a scene has no ground but the sphere. `light` is the one that casts shadows, `moon` where the moon stands
    /// if its light counts.
    pub(crate) fn scape(
        &mut self,
        recorder: &mut Recorder<'_>,
        aerial: &mut Aerial,
        tables: &Tables,
        (scene, assets): (&Scene, &SceneAssets),
        (light, moon): (&CloudLight<'_>, Option<Standpoint>),
        quality: Quality,
    ) -> Result<Option<Groundscape>, Error> {
        let Some(terrains) = self.shapes.of(recorder.gpu, scene, assets)? else {
            return Ok(None);
        };
        let by_moon = light.stand.sun != tables.stand.sun;
        let kind = scene.terrain.as_ref().and_then(welkin_scene::Terrain::shadow);
        let towards = light.stand.sun;
        let shadow = match kind {
            None => Shades::None,
            Some(Shadow::Map(map)) => Shades::Map(
                self.shadow.run(recorder, &terrains, towards, map.size_px),
                map.filter,
            ),
            Some(Shadow::Rays {}) => Shades::Rays(Part::new(&crate::passes::ground_shadow::shadow_uniform(
                &terrains, towards, 2,
            ))),
        };
        let reads = (&*tables.transmittance, &tables.multi_scattering.source);
        let over = |stand: &Standpoint| terrains.stand(stand.sun);
        let lights = [Some(over(&tables.stand)), moon.as_ref().map(over)];
        let harmonics = self.sky.run(recorder, &tables.air, lights, reads, tables.plan);
        let volumes = (tables.plan.method == Method::Lut)
            .then(|| aerial.run(recorder, &tables.air, &tables.stand, reads, tables.plan, quality));
        let place_m = DVec3::from_array(scene.camera.position_m);
        let ground = Part::new(&terrains.uniform(place_m));
        let stand = Part::new(&StandUniform {
            up: tables.stand.up.as_vec3(),
            altitude_m: narrow(tables.stand.altitude_m),
        });
        let skin = Part::new(&skin(scene));
        let made_from = Fingerprint::of((
            "ground",
            terrains.shape.made_from,
            (&ground, &stand, &skin),
            shadow.fingerprint(),
            volumes.as_ref().map(|v| v.made_from),
            format!("{lights:?}"),
        ));
        Ok(Some(Groundscape {
            terrains,
            ground,
            skin,
            stand,
            shadow,
            by_moon,
            harmonics,
            aerial: volumes,
            moon_observer: moon.map(|stand| Part::new(&stand.observer(tables.plan.pixel_steps()))),
            place_m: narrow3(scene.camera.position_m),
            made_from,
        }))
    }
}

/// The passes of the ground that are run for every tile.
pub(crate) struct GroundTiles {
    view: GroundView,
    light: GroundLight,
}

impl GroundTiles {
    pub(crate) const fn new() -> Self {
        Self {
            view: GroundView::new(),
            light: GroundLight::new(),
        }
    }

    /// Radiance and distance, four floats a pixel or direction.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Groundscape,
        inputs: LightInputs<'_>,
        looks: Looks<'_>,
    ) -> wgpu::Buffer {
        let seen = self.view.run(recorder, scape, looks);
        self.light.run(recorder, scape, inputs, looks, &seen)
    }
}
