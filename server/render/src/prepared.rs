//! A frame whose tables are ready.

use crate::{
    camera::CameraUniform,
    cloud_dome::{CloudsSeen, DomeView},
    cloudscape::Cloudscape,
    groundscape::Groundscape,
    lights::{Glare, Lights},
    method::Plan,
    passes::{
        Table,
        multi_scattering::MultiScattering,
        sky::{CloudInputs, SkyInputs},
        stars::StarsOut,
    },
    pillars::Pillars,
    sunlight::Direct,
    uniforms::{Part, Standpoint},
};
use glam::UVec2;
use std::sync::Arc;

/// What the air and the observer give, before any pixel.
pub(crate) struct Tables {
    pub(crate) plan: Plan,
    pub(crate) air: Part,
    pub(crate) stand: Standpoint,
    pub(crate) transmittance: Arc<Table>,
    pub(crate) multi_scattering: Arc<MultiScattering>,
}

/// A frame whose tables are ready and whose exposure is metered.
pub(crate) struct Prepared {
    pub(crate) tables: Tables,
    pub(crate) lights: Lights,
    pub(crate) camera: CameraUniform,
    pub(crate) camera_part: Part,
    pub(crate) observer: Part,
    pub(crate) sky_view: Option<Arc<Table>>,
    pub(crate) stars: Option<StarsOut>,
    pub(crate) clouds: Option<Cloudscape>,
    pub(crate) ground: Option<Groundscape>,
    pub(crate) pillars: Option<Pillars>,
    pub(crate) exposure: Arc<wgpu::Buffer>,
    /// A preview's clouds.
    pub(crate) dome: Option<DomeView>,
    /// True for a preview whose pixels may be interpolated.
    pub(crate) by_lattices: bool,
    /// As clouds leave it.
    pub(crate) glare: Glare,
    /// As clouds leave it.
    pub(crate) direct: Direct,
    /// The device that holds it.
    pub(crate) generation: u64,
}

/// Of a ray through the clouds, in pixels that read tables.
const CLOUD_WORK: u32 = 48;
/// Of a ray to what stands on the ground.
const GROUND_WORK: u32 = 4;
/// Of a lamp that a cell lists, in the open.
const LAMP_WORK: f64 = 0.4;

impl Prepared {
    pub(crate) fn sky_inputs(&self) -> SkyInputs<'_> {
        let parts = [self.lights.view(false), &self.camera_part, &self.observer];
        let dome = self.dome.as_ref();
        SkyInputs {
            clouds: self.clouds.as_ref().map(|scape| CloudInputs { scape, dome }),
            ground: self.ground.as_ref(),
            frame_px: self.camera.size_px.as_uvec2(),
            ..sky_inputs(&self.tables, &self.lights, false, parts, self.sky_view.as_deref())
        }
    }

    /// True where something stands before the sky that hides it or not, pixel by pixel.
    pub(crate) fn has_silhouettes(&self) -> bool {
        self.ground.as_ref().is_some_and(Groundscape::has_silhouettes)
    }

    /// What clouds let through, by direction or in the tile's table.
    pub(crate) fn clouds_seen<'a>(&'a self, tile: Option<&'a Table>) -> Option<CloudsSeen<'a>> {
        let dome = self.dome.as_ref().map(CloudsSeen::Dome);
        dome.or(tile.map(CloudsSeen::Tile))
    }

    /// About how many times the work of a pixel that reads tables a pixel takes.
    pub(crate) fn work_per_pixel(&self) -> u32 {
        let followed = self.clouds.is_some() && self.dome.is_none();
        let ground = if self.ground.is_some() { GROUND_WORK } else { 0 };
        let pillars = self
            .pillars
            .as_ref()
            .map_or(0, |pillars| pillars.work_per_pixel(LAMP_WORK));
        self.tables.plan.work_per_pixel() + ground + pillars + if followed { CLOUD_WORK } else { 0 }
    }
}

pub(crate) fn sky_inputs<'a>(
    tables: &'a Tables,
    lights: &'a Lights,
    metered: bool,
    [view, camera, observer]: [&'a Part; 3],
    sky_view: Option<&'a Table>,
) -> SkyInputs<'a> {
    SkyInputs {
        air: &tables.air,
        view,
        camera,
        frame_px: UVec2::ZERO,
        observer,
        plan: tables.plan,
        transmittance: &tables.transmittance,
        irradiance: &tables.multi_scattering.irradiance,
        sky_view,
        source: &tables.multi_scattering.source,
        airglow: lights.airglow(),
        moon: lights.moon(metered),
        clouds: None,
        ground: None,
    }
}
