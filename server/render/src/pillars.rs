//! What stands ready before the pillars of a frame are looked at: plates of ice, lamps, which cell sees which, and how far
//! their light goes.

use crate::{
    camera::CameraUniform,
    error::Error,
    gpu::Gpu,
    groundscape::Groundscape,
    kernel::Recorder,
    lamps::{Lamp, fall_m, lamps, lamps_made_from},
    lens::Lens,
    memo::{Fingerprint, Memo},
    night::Night,
    passes::{
        lamp_heights::LampHeights,
        pillar_polar::{PillarPolar, Polar},
        pillar_shares::{PillarShares, Shares, SharesInputs},
    },
    pillar_cells::cells,
    uniforms::{
        Part, Standpoint, narrow,
        pillars::{DistantUniform, IceUniform, LampUniform, OwnUniform, PillarsUniform},
    },
};
use glam::{DMat3, DVec3, UVec2};
use std::sync::Arc;
use welkin_scene::{Scene, assets::SceneAssets};

/// Lamps as one observer sees them.
pub(crate) struct LampBuffer {
    pub(crate) buffer: wgpu::Buffer,
    lamps: Vec<LampUniform>,
    made_from: Fingerprint,
}

/// Which lamps each cell of a picture may show.
pub(crate) struct CellBuffers {
    /// Where each cell's list begins, where the last one ends, and the lists.
    pub(crate) lists: wgpu::Buffer,
    /// The cell of each entry of the lists.
    pub(crate) owners: wgpu::Buffer,
    /// What each cell sees.
    pub(crate) cones: wgpu::Buffer,
    /// Where the lists begin, and how many entries they have.
    pub(crate) first: u32,
    pub(crate) entries: u32,
    pub(crate) across: u32,
    /// Lamps of a cell, on average.
    mean: f64,
}

/// A scene's pillars, ready to be looked at.
pub(crate) struct Pillars {
    pub(crate) ice: Part,
    pub(crate) scene: Part,
    pub(crate) lamps: Arc<LampBuffer>,
    pub(crate) cells: Arc<CellBuffers>,
    pub(crate) polar: Option<Arc<Polar>>,
    /// None where each pixel sums by itself.
    pub(crate) shares: Option<Arc<Shares>>,
    /// True where clouds may be before them.
    pub(crate) lamps_clouded: bool,
    pub(crate) sun_clouded: bool,
    made_from: Fingerprint,
}

impl Pillars {
    pub(crate) const fn fingerprint(&self) -> Fingerprint {
        self.made_from
    }

    /// About how many times the work of one lamp each pixel takes, in pixels that read tables.
    pub(crate) fn work_per_pixel(&self, one: f64) -> u32 {
        let shaded = if self.polar.is_some() { 3.0 } else { 1.0 };
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a few hundred at most"
        )]
        let work = (one * shaded * self.cells.mean).min(200.0) as u32;
        work + 1
    }
}

/// The passes before those of each tile.
pub(crate) struct PillarPasses {
    heights: LampHeights,
    polar: PillarPolar,
    shares: PillarShares,
    standing: Memo<Vec<Lamp>>,
    seen: Memo<LampBuffer>,
    cells: Memo<CellBuffers>,
}

/// How a picture is looked at: its camera, its size, and its share of the lens' veil. None for directions.
pub(crate) type Picture<'a> = Option<(&'a CameraUniform, UVec2, f64)>;

/// A light of less than this above the air raises no pillar that is seen, W/m²: a thousandth of a quarter moon's.
const LEAST_LIGHT: f64 = 1e-11;

impl PillarPasses {
    pub(crate) const fn new() -> Self {
        Self {
            heights: LampHeights::new(),
            polar: PillarPolar::new(),
            shares: PillarShares::new(),
            standing: Memo::new(3),
            seen: Memo::new(4),
            cells: Memo::new(4),
        }
    }

    /// None where a scene has no lamps, nor plates that mirror sun or moon.
    pub(crate) fn scape(
        &mut self,
        recorder: &mut Recorder<'_>,
        (scene, assets): (&Scene, &SceneAssets),
        (stand, air, night): (&Standpoint, &Part, &Night),
        (ground, clouds_base_m): (Option<&Groundscape>, Option<f32>),
        picture: Picture<'_>,
    ) -> Result<Option<Pillars>, Error> {
        if scene.lights.is_empty() && scene.town.is_none() && scene.ice_crystals.is_none() {
            return Ok(None);
        }
        let gpu = recorder.gpu;
        let terrain = ground.filter(|scape| scape.terrains.shape.code != 0.0);
        let standing_from = Fingerprint::of((
            lamps_made_from(scene, assets),
            terrain.map(|scape| scape.terrains.shape.made_from),
            format!("{:?}", scene.terrain.is_some()),
            scene.planet.radius_m.to_bits(),
        ));
        let heights = &mut self.heights;
        let make = || standing(heights, gpu, scene, assets, terrain);
        let standing = self.standing.try_get_or(standing_from, make)?;
        let ice = IceUniform::new(scene, stand.altitude_m);
        let own = own_frame(stand.up);
        let distant = distant(scene, night, &own);
        if standing.is_empty() && (ice.count == 0 || distant.is_empty()) {
            return Ok(None);
        }
        let place_m = DVec3::from_array(scene.camera.position_m);
        let seen_from = Fingerprint::of((
            standing_from,
            place_m.to_array().map(f64::to_bits),
            stand.up.to_array().map(f64::to_bits),
        ));
        let lamps = self.seen.get_or(seen_from, || {
            let lamps: Vec<LampUniform> = standing.iter().map(|l| as_seen(l, place_m, &own)).collect();
            let filler = [LampUniform {
                place_m: [0.0, 0.0, 1.0],
                radius_m: 0.0,
                intensity: [0.0; 3],
                emission: 0,
            }];
            let held = if lamps.is_empty() { &filler[..] } else { &lamps };
            LampBuffer {
                buffer: gpu.filled("lamps", bytemuck::cast_slice(held), wgpu::BufferUsages::STORAGE),
                lamps,
                made_from: seen_from,
            }
        });
        let ice_part = Part::new(&ice);
        let pixel_angle = picture.map_or(0.0, |(camera, ..)| f64::from(camera.pixel_angle));
        let veiled = picture.is_some_and(|(.., glare)| glare > 0.0);
        let size_px = picture.map(|(_, size_px, _)| size_px);
        let cells_from = Fingerprint::of((
            lamps.made_from,
            &ice_part,
            format!("{:?} {size_px:?} {veiled}", scene.camera),
        ));
        let cells = self.cells.get_or(cells_from, || {
            let Some(size_px) = size_px else {
                return CellBuffers::none(gpu);
            };
            let lens = Lens::new(&scene.camera, size_px);
            CellBuffers::upload(
                gpu,
                &cells(
                    &lens,
                    &own,
                    size_px,
                    &lamps.lamps,
                    ice.layers(),
                    pixel_angle,
                    veiled,
                ),
            )
        });
        let own_part = Part::new(&OwnUniform {
            east: own.row(0).as_vec3(),
            north: own.row(1).as_vec3(),
            up: own.row(2).as_vec3(),
        });
        let sin_max = ice.layers().iter().map(|l| l.sin_max).fold(0.0, f32::max);
        let polar = terrain.filter(|_| !standing.is_empty()).map(|scape| {
            self.polar.run(
                recorder,
                scape,
                (&lamps.buffer, standing.len()),
                (&ice_part, &own_part, sin_max),
                lamps.made_from,
            )
        });
        let inputs = SharesInputs {
            air,
            ice: &ice_part,
            layers: ice.layers().len(),
            lamps: &lamps,
            cells: &cells,
            polar: polar.as_deref(),
            pixel_angle: narrow(pixel_angle),
        };
        let shares = self.shares.run(recorder, &inputs, cells_from);
        let mut uniform = PillarsUniform {
            east: own.row(0).as_vec3(),
            north: own.row(1).as_vec3(),
            up: own.row(2).as_vec3(),
            altitude_m: narrow(stand.altitude_m),
            cells_across: cells.across,
            glare: picture.map_or(0.0, |(.., glare)| narrow(glare)),
            pixel_angle: narrow(pixel_angle),
            first: cells.first,
            ..PillarsUniform::default()
        };
        for (to, from) in uniform.distant.iter_mut().zip(&distant) {
            *to = *from;
            uniform.suns += 1;
        }
        let scene_part = Part::new(&uniform);
        // Clouds are before what lies beyond their bases.
        let base_m = clouds_base_m.map_or(f64::INFINITY, f64::from);
        let over = stand.altitude_m > base_m;
        let top_m = ice
            .layers()
            .iter()
            .map(|l| f64::from(l.top_m))
            .fold(0.0, f64::max)
            + stand.altitude_m;
        Ok(Some(Pillars {
            made_from: Fingerprint::of((
                "pillars",
                (&ice_part, &scene_part),
                (lamps.made_from, cells_from),
                polar.as_ref().map(|p| p.made_from),
                shares.as_ref().map(|s| s.made_from),
            )),
            ice: ice_part,
            scene: scene_part,
            lamps,
            cells,
            polar,
            shares,
            lamps_clouded: over,
            sun_clouded: over || top_m > base_m,
        }))
    }
}

impl CellBuffers {
    fn upload(gpu: &Gpu, cells: &crate::pillar_cells::Cells) -> Self {
        let first = u32::try_from(cells.begins.len()).unwrap_or(u32::MAX);
        let mut words: Vec<u32> = cells.begins.iter().map(|at| first + at).collect();
        words.extend(&cells.lamps);
        // A buffer cannot be empty.
        words.push(0);
        let filled = |label, bytes: &[u8]| {
            let bytes = if bytes.is_empty() { &[0; 16] } else { bytes };
            gpu.filled(label, bytes, wgpu::BufferUsages::STORAGE)
        };
        Self {
            lists: filled("cells", bytemuck::cast_slice(&words)),
            owners: filled("owners", bytemuck::cast_slice(&cells.owners)),
            cones: filled("cones", bytemuck::cast_slice(&cells.cones)),
            first,
            entries: u32::try_from(cells.lamps.len()).unwrap_or(u32::MAX),
            across: cells.across,
            #[allow(clippy::cast_precision_loss, reason = "an average")]
            mean: cells.lamps.len() as f64 / cells.begins.len().max(1) as f64,
        }
    }

    /// Of directions, which look at all lamps.
    fn none(gpu: &Gpu) -> Self {
        Self::upload(gpu, &crate::pillar_cells::Cells::default())
    }
}

/// Lamps with their places in the scene.
fn standing(
    heights: &mut LampHeights,
    gpu: &Gpu,
    scene: &Scene,
    assets: &SceneAssets,
    terrain: Option<&Groundscape>,
) -> Result<Vec<Lamp>, Error> {
    let mut all = lamps(scene, assets)?;
    let radius_m = scene.planet.radius_m;
    all.retain(|lamp| fall_m(radius_m, lamp.place_m).is_some());
    if let Some(scape) = terrain {
        let on_ground = |lamp: &&mut Lamp| lamp.on_ground;
        let places: Vec<DVec3> = all
            .iter()
            .filter(|lamp| lamp.on_ground)
            .map(|lamp| lamp.place_m - DVec3::Z * fall_m(radius_m, lamp.place_m).unwrap_or(0.0))
            .collect();
        let found = heights.run(gpu, &scape.terrains, &places)?;
        for (lamp, height_m) in all.iter_mut().filter(on_ground).zip(found) {
            lamp.place_m.z += height_m;
        }
    }
    for lamp in &mut all {
        lamp.place_m.z -= fall_m(radius_m, lamp.place_m).unwrap_or(0.0);
    }
    Ok(all)
}

/// Rows east, north and up of the observer's own frame.
fn own_frame(up: DVec3) -> DMat3 {
    let east = DVec3::Y.cross(up).try_normalize().unwrap_or(DVec3::X);
    DMat3::from_cols(east, up.cross(east), up).transpose()
}

fn as_seen(lamp: &Lamp, place_m: DVec3, own: &DMat3) -> LampUniform {
    // Nobody stands in a lamp.
    let mut off = *own * (lamp.place_m - place_m);
    if off.length() < 0.01 {
        off = DVec3::new(0.0, 0.0, -0.01);
    }
    LampUniform {
        place_m: off.as_vec3().to_array(),
        radius_m: narrow(lamp.radius_m),
        intensity: lamp.intensity.map(narrow),
        emission: lamp.emission,
    }
}

/// Sun and moon, where they light the plates.
fn distant(scene: &Scene, night: &Night, own: &DMat3) -> Vec<DistantUniform> {
    let sun = night.sun(&scene.sun);
    let sun = (
        DVec3::from_array(scene.sun_direction()),
        sun.angular_diameter_deg,
        sun.irradiance_w_m2,
    );
    let moon = night.moon.map(|over| {
        let seen = over.seen;
        let irradiance = over.light.irradiance_w_m2 * over.counts;
        (
            DVec3::from_array(seen.direction),
            seen.angular_diameter_deg,
            irradiance.to_array(),
        )
    });
    std::iter::once(sun)
        .chain(moon)
        .filter(|(direction, _, irradiance)| {
            // From 20° below the horizon no plate in the air is lit.
            irradiance.iter().any(|e| *e > LEAST_LIGHT) && (*own * *direction).z > -0.34
        })
        .map(|(direction, diameter_deg, irradiance)| DistantUniform {
            direction: (*own * direction).as_vec3(),
            angular_radius: narrow((diameter_deg / 2.0).to_radians()),
            irradiance: crate::uniforms::narrow3(irradiance),
        })
        .collect()
}
