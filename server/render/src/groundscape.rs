//! What stands ready before the ground in a frame is looked at: its shape, its shadow, the light of the sky on it.

use crate::{
    cloud_light::CloudLight,
    cloudscape::Cloudscape,
    error::Error,
    gpu::Gpu,
    ground::{Shapes, Terrains, skin, wind_m_s},
    kernel::Recorder,
    memo::{Fingerprint, Memo},
    passes::{
        aerial::{Aerial, AerialVolumes},
        cloud_view::CloudView,
        ground_light::{GroundLight, LightInputs, LitGround},
        ground_shadow::{GroundShadow, ShadowMap},
        ground_sky::GroundSky,
        ground_view::{GroundView, Looks},
        shafts::{ONE_PLACE, Sees, Shafts as ShaftsPass, lattice_for},
    },
    prepared::Tables,
    shafts::{ShaftSettings, exact_shafts, radial_shafts},
    uniforms::{
        Part, Standpoint,
        clouds::CloudFrameUniform,
        ground::{GroundShadowUniform, StandUniform},
        narrow, narrow3,
    },
};
use glam::{DVec3, UVec2};
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

/// Side of the map by which the air is shaded where surfaces are by rays.
const AIR_MAP_PX: u32 = 2048;
/// A preview's map has an eighth of the side, but no less.
const LEAST_MAP_PX: u32 = 512;

/// How the ground hides its light.
pub(crate) enum Shades {
    None,
    Map(Arc<ShadowMap>, ShadowFilter),
    /// On surfaces by rays, in the air by a map.
    Rays(Arc<ShadowMap>),
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
            Self::Map(map, _) | Self::Rays(map) => (map.uniform.upload(gpu, "shadow"), map.texels.clone()),
        }
    }

    fn fingerprint(&self) -> Fingerprint {
        match self {
            Self::None => Fingerprint::of("no shadow"),
            Self::Map(map, filter) => Fingerprint::of((map.made_from, filter)),
            Self::Rays(map) => Fingerprint::of(("rays", map.made_from)),
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
    /// How shafts are looked for, if they are.
    pub(crate) shafts: Option<ShaftSettings>,
    /// Over a sphere of water.
    pub(crate) wind_m_s: Option<f32>,
    /// True where the shadow is that of the moon.
    pub(crate) by_moon: bool,
    pub(crate) harmonics: Arc<wgpu::Buffer>,
    pub(crate) aerial: Option<Arc<AerialVolumes>>,
    pub(crate) moon_observer: Option<Part>,
    /// Where the observer stands in the scene, and the light that casts shadows.
    pub(crate) frame: CloudFrameUniform,
    made_from: Fingerprint,
}

impl Groundscape {
    /// True where it, or who looks, may stand above clouds that begin at that altitude: then some are before it.
    pub(crate) fn may_hide(&self, base_m: f32, stand: &Standpoint) -> bool {
        if !self.has_silhouettes() {
            return false;
        }
        let top_m = self.terrains.shape.most_m.z.max(stand.altitude_m);
        top_m > f64::from(base_m)
    }

    /// True where more than a matt sphere is seen.
    pub(crate) fn has_silhouettes(&self) -> bool {
        self.terrains.shape.code != 0.0 || self.wind_m_s.is_some()
    }

    /// What keeps light from clouds that begin at that altitude, by places in the scene: none where all of them are over
    /// all that stands and their light comes from above.
    pub(crate) fn shadow_on_clouds(&self, base_m: f32, stand: &Standpoint) -> Option<Arc<ShadowMap>> {
        let under = self.terrains.shape.most_m.z > f64::from(base_m);
        let from_below = stand.up.dot(stand.sun) < 0.0;
        match &self.shadow {
            Shades::Map(map, _) | Shades::Rays(map) if under || from_below => Some(Arc::clone(map)),
            _ => None,
        }
    }

    pub(crate) const fn fingerprint(&self) -> Fingerprint {
        self.made_from
    }

    /// Of what stands where, as it is seen from here, in whatever light.
    pub(crate) fn place_fingerprint(&self) -> Fingerprint {
        Fingerprint::of((
            self.terrains.shape.made_from,
            &self.ground,
            &self.stand,
            self.wind_m_s.is_some(),
        ))
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

    /// None where a scene has no ground but a matt sphere, nor shafts. `light` is the one that casts shadows, `moon` where the moon stands
    /// if its light counts, `size_px` the picture's size, if there is one.
    pub(crate) fn scape(
        &mut self,
        recorder: &mut Recorder<'_>,
        aerial: &mut Aerial,
        tables: &Tables,
        (scene, assets): (&Scene, &SceneAssets),
        (light, moon): (&CloudLight<'_>, Option<Standpoint>),
        (quality, size_px): (Quality, Option<UVec2>),
    ) -> Result<Option<Groundscape>, Error> {
        let towards = light.stand.sun;
        let radial = size_px.and_then(|px| radial_shafts(scene, light.clouded, px, towards));
        let shafts = exact_shafts(scene, light.clouded, quality).or(radial);
        let wind_m_s = wind_m_s(scene);
        if scene.terrain.is_none() && shafts.is_none() && wind_m_s.is_none() {
            return Ok(None);
        }
        let terrains = self.shapes.of(recorder.gpu, scene, assets)?;
        let by_moon = light.stand.sun != tables.stand.sun;
        let kind = scene.terrain.as_ref().and_then(welkin_scene::Terrain::shadow);
        let side = |size_px: u32| match quality {
            Quality::Final => size_px,
            Quality::Preview => (size_px / 8).max(LEAST_MAP_PX),
        };
        let mut map = |size_px| self.shadow.run(recorder, &terrains, towards, side(size_px));
        let shadow = match kind {
            None => Shades::None,
            Some(Shadow::Map(of)) => Shades::Map(map(of.size_px), of.filter),
            Some(Shadow::Rays {}) => Shades::Rays(map(AIR_MAP_PX)),
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
            format!("{lights:?} {shafts:?} {towards} {wind_m_s:?}"),
        ));
        Ok(Some(Groundscape {
            terrains,
            ground,
            skin,
            stand,
            shadow,
            shafts,
            wind_m_s,
            by_moon,
            harmonics,
            aerial: volumes,
            moon_observer: moon.map(|stand| Part::new(&stand.observer(tables.plan.pixel_steps()))),
            frame: CloudFrameUniform {
                place_m: narrow3(scene.camera.position_m),
                light: towards.as_vec3(),
            },
            made_from,
        }))
    }
}

/// The passes of the ground that are run for every tile.
pub(crate) struct GroundTiles {
    view: GroundView,
    /// Behind which radial shafts begin.
    clouds: CloudView,
    shafts: ShaftsPass,
    /// What whole frames lose, for all of their tiles.
    lost: Memo<wgpu::Buffer>,
    light: GroundLight,
}

impl GroundTiles {
    pub(crate) const fn new() -> Self {
        Self {
            view: GroundView::new(),
            clouds: CloudView::new(),
            shafts: ShaftsPass::new(),
            lost: Memo::new(4),
            light: GroundLight::new(),
        }
    }

    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Groundscape,
        inputs: LightInputs<'_>,
        looks: Looks<'_>,
    ) -> LitGround {
        let seen = self.view.run(recorder, scape, looks);
        let lost = scape.shafts.as_ref().map(|settings| match looks {
            Looks::Tile(camera, projection, tile, frame_px) => {
                let (tile, kept) = lattice_for(tile, frame_px, settings.grain(frame_px));
                let looks = Looks::Tile(camera, projection, tile, frame_px);
                let made_from = Fingerprint::of((
                    "shafts",
                    (scape.fingerprint(), camera, projection, frame_px),
                    (
                        inputs.air,
                        inputs.view,
                        inputs.moon_view,
                        inputs.transmittance.made_from,
                    ),
                    inputs.clouds.map(Cloudscape::fingerprint),
                ));
                let mut make = || {
                    let seen = self.view.run(recorder, scape, looks);
                    let clouds = inputs
                        .clouds
                        .filter(|_| settings.is_radial())
                        .map(|clouds| self.clouds.look(recorder, clouds, (camera, projection), tile));
                    let sees = Sees {
                        ground: &seen,
                        clouds: clouds.as_ref(),
                    };
                    self.shafts.run(recorder, scape, inputs, (looks, sees), settings)
                };
                let lost = if kept {
                    self.lost.get_or(made_from, make)
                } else {
                    Arc::new(make())
                };
                (lost, tile)
            }
            Looks::List(..) => {
                let sees = Sees {
                    ground: &seen,
                    clouds: None,
                };
                let lost = self.shafts.run(recorder, scape, inputs, (looks, sees), settings);
                (Arc::new(lost), ONE_PLACE)
            }
        });
        self.light
            .run(recorder, scape, inputs, (looks, &seen), lost.as_ref())
    }
}
