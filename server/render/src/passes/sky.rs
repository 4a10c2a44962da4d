//! Radiance of every pixel of a tile.

use super::{
    Table,
    cloud_view::CloudView,
    cloud_view_light::CloudViewLight,
    ground_light::LightInputs,
    ground_view::Looks,
    tone::{ToneInputs, curve_code},
};
use crate::{
    cloud_dome::DomeView,
    cloudscape::Cloudscape,
    frame_job::RUN,
    gpu::Gpu,
    groundscape::{GroundTiles, Groundscape},
    kernel::{Bind, Recorder, Variants},
    memo::Fingerprint,
    method::Plan,
    shader,
    uniforms::{
        Part, TileUniform, ToneUniform,
        clouds::{CloudFrameUniform, DomeUniform, ShadeUniform},
        night::MoonUniform,
    },
};
use glam::UVec2;
use welkin_scene::Method;

/// Where the pass writes.
pub(crate) enum SkyTo<'a> {
    /// Four floats a pixel.
    Radiance(&'a wgpu::Buffer),
    /// Four bytes a pixel, where nothing else reads the radiance.
    Picture(ToneInputs<'a>, &'a wgpu::Buffer),
    /// The same by way of lattices.
    Preview(ToneInputs<'a>, &'a wgpu::Buffer),
}

/// Pixels between the places at which a preview looks at the clear sky, across and down, and at clouds.
const CLEAR_GRAIN: UVec2 = UVec2::new(8, 8);
const CLOUD_GRAIN: UVec2 = UVec2::new(2, 2);

pub(crate) struct Sky {
    kernels: Variants,
    clouds: CloudView,
    clouds_light: CloudViewLight,
    ground: GroundTiles,
    lattices: [Lattice; 2],
}

/// What the pass reads.
#[derive(Clone, Copy)]
pub(crate) struct SkyInputs<'a> {
    pub(crate) air: &'a Part,
    pub(crate) view: &'a Part,
    pub(crate) camera: &'a Part,
    /// Of the whole frame.
    pub(crate) frame_px: UVec2,
    pub(crate) observer: &'a Part,
    pub(crate) plan: Plan,
    pub(crate) transmittance: &'a Table,
    pub(crate) irradiance: &'a Table,
    /// None where each pixel's ray is followed.
    pub(crate) sky_view: Option<&'a Table>,
    pub(crate) source: &'a Table,
    pub(crate) airglow: &'a Part,
    pub(crate) moon: Option<MoonInputs<'a>>,
    pub(crate) clouds: Option<CloudInputs<'a>>,
    /// None where nothing stands on the sphere.
    pub(crate) ground: Option<&'a Groundscape>,
}

/// The clouds as the pass reads them.
#[derive(Clone, Copy)]
pub(crate) struct CloudInputs<'a> {
    pub(crate) scape: &'a Cloudscape,
    /// None where a ray is followed before each pixel.
    pub(crate) dome: Option<&'a DomeView>,
}

/// The moon as the pass reads it.
#[derive(Clone, Copy)]
pub(crate) struct MoonInputs<'a> {
    pub(crate) moon: &'a Part,
    /// The moon in the sun's place.
    pub(crate) view: &'a Part,
    pub(crate) face: &'a wgpu::TextureView,
    /// True where its light on air and ground counts.
    pub(crate) lights: bool,
    /// That light in the air, for those who read it from a table.
    pub(crate) sky_view: Option<&'a Table>,
}

impl SkyInputs<'_> {
    pub(crate) fn fingerprint(&self, tile: &Part) -> Fingerprint {
        let tables = (
            self.transmittance.made_from,
            self.irradiance.made_from,
            self.source.made_from,
            self.sky_view.map(|table| table.made_from),
        );
        let parts = (self.air, self.view, self.camera, self.observer, tile);
        let moon = self
            .moon
            .map(|m| (m.moon, m.view, m.lights, m.sky_view.map(|table| table.made_from)));
        let clouds = self
            .clouds
            .map(|c| (c.scape.fingerprint(), c.dome.map(DomeView::uniform)));
        let ground = self.ground.map(Groundscape::fingerprint);
        Fingerprint::of((
            ("sky", self.plan, parts, tables),
            (self.airglow, moon, clouds, ground),
        ))
    }

    /// What the ground's light is made of.
    fn light(&self) -> LightInputs<'_> {
        LightInputs {
            air: self.air,
            view: self.view,
            observer: self.observer,
            plan: self.plan,
            transmittance: self.transmittance,
            irradiance: self.irradiance,
            source: self.source,
            airglow: self.airglow,
            moon_view: self.moon.filter(|moon| moon.lights).map(|moon| moon.view),
            clouds: self.clouds.map(|c| c.scape),
            followed: self.clouds.is_some_and(|c| c.dome.is_none()),
        }
    }
}

impl Sky {
    pub(crate) fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::SKY),
            clouds: CloudView::new(),
            clouds_light: CloudViewLight::new(),
            ground: GroundTiles::new(),
            lattices: [Lattice::default(), Lattice::default()],
        }
    }

    /// Writes one tile. Gives the table of its clouds where rays were followed for it, and the light of its ground.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        inputs: SkyInputs<'_>,
        tile: TileUniform,
        to: SkyTo<'_>,
    ) -> (Option<Table>, Option<wgpu::Buffer>) {
        let gpu = recorder.gpu;
        // A buffer that a variant does not write must still be bound, and bound once.
        let unused = || gpu.buffer("unused", 16, wgpu::BufferUsages::STORAGE);
        let (radiance, picture, exposure, settings, tone) = match to {
            SkyTo::Radiance(radiance) => {
                let nothing = Part::new(&ToneUniform::default());
                (radiance, &unused(), &unused(), nothing, None)
            }
            SkyTo::Picture(tone, picture) | SkyTo::Preview(tone, picture) => {
                let settings = Part::new(tone.settings);
                (&unused(), picture, tone.exposure, settings, Some(tone))
            }
        };
        let settings = settings.upload(gpu, "tone");
        let projection = inputs.plan.projection;
        let dome = inputs.clouds.and_then(|c| c.dome);
        let ground = inputs.ground.map(|scape| {
            let looks = Looks::Tile(inputs.camera, projection, tile, inputs.frame_px);
            self.ground.run(recorder, scape, inputs.light(), looks)
        });
        let clouds = inputs.clouds.filter(|_| dome.is_none()).map(|c| {
            let camera = (inputs.camera, projection);
            let tile = (tile, inputs.frame_px);
            let before = inputs.ground.zip(ground.as_ref().map(|ground| &ground.light));
            let nodes = self.clouds.run(recorder, c.scape, camera, tile, before);
            self.clouds_light
                .run(recorder, c.scape, camera, tile, (&nodes, ground.as_ref()))
        });
        let (shade, cloud_frame) = inputs.clouds.map_or_else(
            || (Part::new(&ShadeUniform::default()), CloudFrameUniform::default()),
            |c| (c.scape.shade.clone(), c.scape.frame()),
        );
        let (shade, cloud_frame) = (
            shade.upload(gpu, "shade"),
            Part::new(&cloud_frame).upload(gpu, "clouds"),
        );
        let air = inputs.air.upload(gpu, "air");
        let view = inputs.view.upload(gpu, "view");
        let camera = inputs.camera.upload(gpu, "camera");
        let observer = inputs.observer.upload(gpu, "observer");
        let place = Part::new(&tile).upload(gpu, "tile");
        // A variant reads nothing of what it is not for; anything stands there.
        let none = Part::new(&MoonUniform::default());
        let moon = inputs.moon.map_or(&none, |m| m.moon).upload(gpu, "moon");
        let moon_view = inputs
            .moon
            .map_or(inputs.view, |m| m.view)
            .upload(gpu, "moon view");
        let moon_sky_view = inputs.moon.and_then(|m| m.sky_view);
        let face = inputs.moon.map_or(&inputs.transmittance.view, |m| m.face);
        let airglow = inputs.airglow.upload(gpu, "airglow");
        let places = |grain: UVec2| place_count(tile, grain);
        let count = |grain: UVec2| u64::from(places(grain).x) * u64::from(places(grain).y);
        let preview = matches!(to, SkyTo::Preview(..));
        let [first, second] = &mut self.lattices;
        let (nothing, other, nowhere) = (unused(), unused(), unused());
        let (first, second) = if preview {
            let second = dome.map(|_| second.fit(gpu, count(CLOUD_GRAIN)));
            (first.fit(gpu, count(CLEAR_GRAIN)), second.unwrap_or(&nothing))
        } else {
            (&nothing, &nothing)
        };
        let binds = [
            Bind::Buffer(&air),
            Bind::Buffer(&view),
            Bind::Buffer(&camera),
            Bind::Buffer(&place),
            Bind::Buffer(&observer),
            Bind::Table(&inputs.transmittance.view),
            Bind::LinearClamp,
            Bind::Table(&inputs.irradiance.view),
            Bind::Table(&inputs.sky_view.unwrap_or(inputs.source).view),
            Bind::Table(&inputs.source.view),
            Bind::Buffer(radiance),
            Bind::Buffer(&airglow),
            Bind::Buffer(&moon),
            Bind::Buffer(&moon_view),
            Bind::Table(&moon_sky_view.unwrap_or(inputs.source).view),
            Bind::Table(face),
            Bind::Buffer(&settings),
            Bind::Buffer(exposure),
            Bind::Buffer(picture),
            Bind::Table(
                clouds
                    .as_ref()
                    .map_or(&inputs.transmittance.view, |table| &table.view),
            ),
            Bind::Buffer(&shade),
            Bind::Table(
                inputs
                    .clouds
                    .map_or(&inputs.source.view, |c| &c.scape.shadow.view),
            ),
            Bind::Buffer(&cloud_frame),
        ];
        let dome_uniform = dome.map_or_else(|| Part::new(&DomeUniform::default()), DomeView::uniform);
        let dome_uniform = dome_uniform.upload(gpu, "dome");
        let (pages, seen) = dome.map_or((&nowhere, &inputs.transmittance.view), |d| (&d.pages, &d.seen));
        let before_ground = dome.filter(|d| d.before_ground && ground.is_some());
        let lit_ground = ground.as_ref().map_or(&nowhere, |ground| &ground.light);
        let scape = inputs.clouds.map(|c| c.scape);
        let cloud_air = scape.map_or(&inputs.source.view, Cloudscape::cloud_air_view);
        let flag = |on: bool| f64::from(u8::from(on));
        let mut constants = vec![
            ("METHOD", inputs.plan.method_code()),
            ("PROJECTION", f64::from(projection)),
            ("AIRGLOW", flag(inputs.plan.airglow)),
            ("MOON", flag(inputs.moon.is_some())),
            ("MOONLIGHT", flag(moon_sky_view.is_some())),
            ("CLOUDS", flag(inputs.clouds.is_some())),
            scape.map_or(("CLOUD_AIR", 0.0), Cloudscape::cloud_air),
            ("DOME", flag(dome.is_some())),
            ("GROUND", flag(ground.is_some())),
            ("BEFORE_GROUND", flag(before_ground.is_some())),
        ];
        // Moonlight and rays of their own change from pixel to pixel.
        let span = if inputs.plan.method == Method::Lut && moon_sky_view.is_none() {
            RUN
        } else {
            1
        };
        constants.push(("SPAN", f64::from(span)));
        if let Some(tone) = tone {
            constants.extend([("PICTURE", 1.0), ("CURVE", curve_code(tone.curve))]);
        }
        if inputs.sky_view.is_none() {
            constants.extend(inputs.plan.march_constants());
        }
        let mut stage = |stage: f64, grain: UVec2, lattices: [&wgpu::Buffer; 2], threads: UVec2| {
            let [from, to] = lattices;
            let mut constants = constants.clone();
            if preview {
                constants.extend(grains(stage, grain));
            }
            let kernel = self.kernels.get(gpu, &constants);
            let all: Vec<_> = binds
                .iter()
                .copied()
                .chain([from, to].map(Bind::Buffer))
                .chain([
                    Bind::Buffer(&dome_uniform),
                    Bind::Buffer(pages),
                    Bind::Table(seen),
                    Bind::Buffer(lit_ground),
                    Bind::Buffer(before_ground.map_or(&nowhere, |d| &d.nodes)),
                    Bind::Table(cloud_air),
                ])
                .collect();
            recorder.dispatch(kernel, &all, [threads.x, threads.y, 1]);
        };
        if !preview {
            let threads = UVec2::new(runs(tile, span), tile.size_px.y);
            stage(0.0, UVec2::ONE, [&nothing, &other], threads);
        } else {
            stage(1.0, CLEAR_GRAIN, [&nothing, first], places(CLEAR_GRAIN));
            let (grain, lattice) = if dome.is_some() {
                stage(2.0, CLOUD_GRAIN, [first, second], places(CLOUD_GRAIN));
                (CLOUD_GRAIN, second)
            } else {
                (CLEAR_GRAIN, first)
            };
            stage(3.0, grain, [lattice, &other], blocks(tile, grain));
        }
        (clouds, ground.map(|ground| ground.light))
    }
}

/// A buffer of places, made when the first is asked for and again when a larger one is.
#[derive(Default)]
struct Lattice(Option<(u64, wgpu::Buffer)>);

impl Lattice {
    fn fit(&mut self, gpu: &Gpu, places: u64) -> &wgpu::Buffer {
        let kept = self.0.take().filter(|(there, _)| *there >= places);
        let make = || {
            (
                places,
                gpu.buffer("lattice", 16 * places, wgpu::BufferUsages::STORAGE),
            )
        };
        &self.0.insert(kept.unwrap_or_else(make)).1
    }
}

/// `place_count` of the shader.
fn place_count(tile: TileUniform, grain: UVec2) -> UVec2 {
    let end = tile.origin_px + tile.size_px;
    (end + grain - 1) / grain - tile.origin_px / grain + 2
}

/// Runs of a row that the tile has pixels of.
fn runs(tile: TileUniform, span: u32) -> u32 {
    let (begin, stride) = (tile.origin_px.x, tile.stride_px);
    (begin % span + tile.size_px.x * stride).div_ceil(span.max(stride))
}

/// Blocks of pixels, `RUN` to a row, that the tile has a part of.
fn blocks(tile: TileUniform, grain: UVec2) -> UVec2 {
    let size = UVec2::new(RUN, grain.y);
    (tile.origin_px + tile.size_px + size - 1) / size - tile.origin_px / size
}

fn grains(stage: f64, grain: UVec2) -> [(&'static str, f64); 5] {
    [
        ("STAGE", stage),
        ("GRAIN_X", f64::from(grain.x)),
        ("GRAIN_Y", f64::from(grain.y)),
        ("COARSE_X", f64::from(CLEAR_GRAIN.x)),
        ("COARSE_Y", f64::from(CLEAR_GRAIN.y)),
    ]
}
