//! Radiance of every pixel of a tile.

use super::{
    Table,
    cloud_view::CloudView,
    tone::{ToneInputs, curve_code},
};
use crate::{
    camera::{CameraUniform, projection_code},
    cloudscape::Cloudscape,
    frame_job::RUN,
    kernel::{Bind, Recorder, Variants},
    memo::Fingerprint,
    method::Plan,
    shader,
    uniforms::{
        Part, TileUniform, ToneUniform,
        clouds::{CloudFrameUniform, ShadeUniform},
        night::MoonUniform,
    },
};
use glam::UVec2;
use welkin_scene::{Camera, Direction, Method, Projection};

/// Where the pass writes.
pub(crate) enum SkyTo<'a> {
    /// Four floats a pixel.
    Radiance(&'a wgpu::Buffer),
    /// Four bytes a pixel, where nothing else reads the radiance.
    Picture(ToneInputs<'a>, &'a wgpu::Buffer),
}

pub(crate) struct Sky {
    kernels: Variants,
    clouds: CloudView,
}

/// What the pass reads.
#[derive(Clone, Copy)]
pub(crate) struct SkyInputs<'a> {
    pub(crate) air: &'a Part,
    pub(crate) view: &'a Part,
    pub(crate) camera: &'a Part,
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
}

/// The clouds as the pass reads them.
#[derive(Clone, Copy)]
pub(crate) struct CloudInputs<'a> {
    pub(crate) scape: &'a Cloudscape,
    /// Pixels to the side of one ray through them.
    pub(crate) grain: u32,
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
        let clouds = self.clouds.map(|c| (c.scape.fingerprint(), c.grain));
        Fingerprint::of(("sky", self.plan, parts, tables, self.airglow, moon, clouds))
    }
}

impl Sky {
    /// The clouds before a disc: a table of 2 × 2 rays.
    pub(crate) fn clouds_before_disc(
        &mut self,
        recorder: &mut Recorder<'_>,
        scape: &Cloudscape,
        towards: [f64; 3],
        diameter_deg: f64,
    ) -> Table {
        let camera = Camera {
            direction: Direction::Vector(towards),
            projection: Projection::Perspective {
                vertical_fov_deg: diameter_deg.clamp(0.1, 10.0),
            },
            ..Camera::default()
        };
        let size_px = UVec2::splat(2);
        let tile = TileUniform {
            origin_px: UVec2::ZERO,
            size_px,
        };
        let projection = projection_code(&camera.projection);
        let camera = Part::new(&CameraUniform::new(&camera, size_px));
        self.clouds.run(recorder, scape, (&camera, projection), tile, 1)
    }

    pub(crate) fn new() -> Self {
        Self {
            kernels: Variants::new(&shader::SKY),
            clouds: CloudView::new(),
        }
    }

    /// Writes one tile. Gives the table of its clouds.
    pub(crate) fn run(
        &mut self,
        recorder: &mut Recorder<'_>,
        inputs: SkyInputs<'_>,
        tile: TileUniform,
        to: SkyTo<'_>,
    ) -> Option<Table> {
        let gpu = recorder.gpu;
        // A buffer that a variant does not write must still be bound, and bound once.
        let unused = || gpu.buffer("unused", 16, wgpu::BufferUsages::STORAGE);
        let (radiance, picture, exposure, settings, tone) = match to {
            SkyTo::Radiance(radiance) => {
                let nothing = Part::new(&ToneUniform::default());
                (radiance, &unused(), &unused(), nothing, None)
            }
            SkyTo::Picture(tone, picture) => {
                let settings = Part::new(tone.settings);
                (&unused(), picture, tone.exposure, settings, Some(tone))
            }
        };
        let settings = settings.upload(gpu, "tone");
        let projection = inputs.plan.projection;
        let clouds = inputs.clouds.map(|c| {
            let camera = (inputs.camera, projection);
            self.clouds.run(recorder, c.scape, camera, tile, c.grain)
        });
        let (shade, cloud_frame) = inputs.clouds.map_or_else(
            || (Part::new(&ShadeUniform::default()), CloudFrameUniform::default()),
            |c| (c.scape.shade.clone(), c.scape.frame(c.grain)),
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
        let disc = tone.and_then(|tone| tone.disc_clouds);
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
            Bind::Table(disc.map_or(&inputs.transmittance.view, |table| &table.view)),
        ];
        let flag = |on: bool| f64::from(u8::from(on));
        let mut constants = vec![
            ("METHOD", inputs.plan.method_code()),
            ("PROJECTION", f64::from(projection)),
            ("AIRGLOW", flag(inputs.plan.airglow)),
            ("MOON", flag(inputs.moon.is_some())),
            ("MOONLIGHT", flag(moon_sky_view.is_some())),
            ("CLOUDS", flag(clouds.is_some())),
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
        let kernel = self.kernels.get(gpu, &constants);
        let threads = [tile.size_px.x.div_ceil(span), tile.size_px.y, 1];
        recorder.dispatch(kernel, &binds, threads);
        clouds
    }
}
