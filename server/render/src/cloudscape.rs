//! What stands ready before a frame's clouds are marched through: noise and weather, the air in front of them, their
//! shadows.

use crate::{
    cloud_dome::CloudDomes,
    cloud_light::CloudLight,
    cloud_noise::{CloudNoise, CloudTextures},
    cloud_sky::CloudSky,
    error::Error,
    gpu::{Gpu, Shape},
    groundscape::Groundscape,
    kernel::{Bind, Recorder},
    memo::{Fingerprint, Memo},
    noise_cache::DiskCache,
    passes::{
        Table,
        aerial::{Aerial, AerialVolumes},
        cloud_air::{CloudAir, CloudAirInputs},
        cloud_shadow::CloudShadow,
        cloud_shape::ShapeFrequencies,
        cloud_volume::{CloudVolume, in_volume, volume_view},
        ground_shadow::ShadowMap,
        multi_scattering::MultiScattering,
    },
    prepared::Tables,
    shader::Texel,
    uniforms::{
        Part,
        clouds::{CloudFrameUniform, ShadowUniform},
        ground::GroundShadowUniform,
        narrow,
    },
};
use std::sync::Arc;
use welkin_scene::{
    Quality,
    assets::SceneAssets,
    clouds::{Clouds, PlainMap},
    renderer::PassTime,
};

/// The passes of the clouds.
pub(crate) struct CloudPasses {
    noise: CloudNoise,
    pub(crate) aerial: Aerial,
    volume: CloudVolume,
    shadow: CloudShadow,
    cloud_air: CloudAir,
    pub(crate) dome: CloudDomes,
    pictures: Memo<Table>,
}

/// All that the march through a scene's clouds reads.
pub(crate) struct Cloudscape {
    pub(crate) clouds: Part,
    pub(crate) air: Part,
    /// The light that counts, in the sun's place.
    pub(crate) view: Part,
    pub(crate) shade: Part,
    pub(crate) observer: Part,
    pub(crate) textures: CloudTextures,
    pub(crate) transmittance: Arc<Table>,
    multi_scattering: Arc<MultiScattering>,
    pub(crate) aerial: Arc<AerialVolumes>,
    pub(crate) shadow: Arc<Table>,
    /// In which the light's way is followed; a preview's single steps are exact, since its own is too coarse for them.
    volume: Option<Arc<Table>>,
    /// What the air loses to clouds, where no shafts tell it.
    cloud_air: Option<Arc<Table>>,
    /// Of what stands on the ground, where that may fall on them.
    ground_shadow: Option<Arc<ShadowMap>>,
    /// Altitude of the lowest.
    pub(crate) base_m: f32,
    frame: CloudFrameUniform,
    /// Whether the observer is under all of them.
    pub(crate) under_clouds: bool,
    one_layer: (&'static str, f64),
    made_from: Fingerprint,
}

/// A scene's cloud uniforms on the device.
pub(crate) struct CloudParts {
    pub(crate) clouds: wgpu::Buffer,
    pub(crate) air: wgpu::Buffer,
    pub(crate) view: wgpu::Buffer,
    pub(crate) shade: wgpu::Buffer,
    pub(crate) observer: wgpu::Buffer,
    ground_shadow: (wgpu::Buffer, wgpu::Buffer),
}

impl Cloudscape {
    /// What the march reads, on the device.
    pub(crate) fn upload(&self, gpu: &Gpu) -> CloudParts {
        CloudParts {
            clouds: self.clouds.upload(gpu, "clouds"),
            air: self.air.upload(gpu, "air"),
            view: self.view.upload(gpu, "view"),
            shade: self.shade.upload(gpu, "shade"),
            observer: self.observer.upload(gpu, "observer"),
            ground_shadow: self.ground_shadow.as_ref().map_or_else(
                || {
                    (
                        Part::new(&GroundShadowUniform::default()).upload(gpu, "ground_shadow"),
                        gpu.buffer("unused", 16, wgpu::BufferUsages::STORAGE),
                    )
                },
                |map| (map.in_scene.upload(gpu, "ground_shadow"), map.texels.clone()),
            ),
        }
    }

    /// The first bindings of every shader that marches through clouds.
    pub(crate) fn march_binds<'a>(&'a self, parts: &'a CloudParts) -> Vec<Bind<'a>> {
        let mut binds = self.textures.binds(&parts.clouds);
        binds.extend([Bind::Buffer(&parts.air), Bind::Buffer(&parts.view)]);
        binds
    }

    /// The first bindings of every shader that finds the clouds' light.
    pub(crate) fn binds<'a>(&'a self, parts: &'a CloudParts) -> Vec<Bind<'a>> {
        let mut binds = self.march_binds(parts);
        binds.extend([
            Bind::Buffer(&parts.shade),
            Bind::LinearClamp,
            Bind::Table(&self.transmittance.view),
            Bind::Table(&self.multi_scattering.irradiance.view),
            Bind::Table(&self.aerial.rayleigh),
            Bind::Table(&self.aerial.mie),
            Bind::Table(&self.aerial.multiple),
            Bind::Table(&self.shadow.view),
            Bind::Buffer(&parts.ground_shadow.0),
            Bind::Buffer(&parts.ground_shadow.1),
            Bind::Table(self.cloud_air_view()),
            Bind::Table(volume_view(self.volume.as_ref(), &self.textures)),
        ]);
        binds
    }

    /// The table, or something in its place.
    pub(crate) fn cloud_air_view(&self) -> &wgpu::TextureView {
        let table = self.cloud_air.as_ref();
        table.map_or(&self.multi_scattering.source.view, |table| &table.view)
    }

    /// The shaders' constant that is 1 where there is one.
    pub(crate) fn cloud_air(&self) -> (&'static str, f64) {
        ("CLOUD_AIR", f64::from(u8::from(self.cloud_air.is_some())))
    }

    /// What spares the shaders the search for the layer.
    pub(crate) const fn one_layer(&self) -> (&'static str, f64) {
        self.one_layer
    }

    /// What the shaders that find the clouds' light are made for.
    pub(crate) fn light_constants(&self) -> [(&'static str, f64); 4] {
        let shaded = f64::from(u8::from(self.ground_shadow.is_some()));
        [
            self.one_layer,
            ("SHADED", shaded),
            self.cloud_air(),
            in_volume(self.volume.as_ref()),
        ]
    }

    /// What the ground's shadows need.
    pub(crate) const fn frame(&self) -> CloudFrameUniform {
        self.frame
    }

    /// Of what stands where, whatever lights it.
    pub(crate) fn shape_fingerprint(&self) -> Fingerprint {
        Fingerprint::of((
            "shape of clouds",
            (&self.clouds, &self.air),
            self.textures.fingerprint(),
        ))
    }

    pub(crate) const fn fingerprint(&self) -> Fingerprint {
        self.made_from
    }
}

/// The longest step in height of the light's way through a band, as a share of the scale of the clouds' noise, and the most
/// steps from one height to the next.
const fn shadow_steps(quality: Quality) -> (f32, f32) {
    match quality {
        Quality::Preview => (0.0375, 6.0),
        Quality::Final => (0.015, 6.0),
    }
}

/// How many times more steps the light's way takes between two heights under a low sun: it is that much longer, and what is
/// stepped over there stands as stripes on the clouds. No more than four.
fn slant(sun_cosine: f64) -> f32 {
    narrow((LEVEL_COSINE / sun_cosine.abs()).clamp(1.0, 4.0))
}

/// `ALL_LIGHT_STEPS` of `lib/cloud_source.wgsl`.
const ALL_LIGHT_STEPS: u32 = 64;

/// From this cosine on light counts as low.
const LEVEL_COSINE: f64 = 0.3;

/// How fine the steps are against those that the scene asks for.
const fn fineness(quality: Quality) -> f64 {
    match quality {
        Quality::Preview => 0.4,
        Quality::Final => 1.0,
    }
}

impl CloudPasses {
    pub(crate) const fn new(disk_cache: Option<DiskCache>) -> Self {
        Self {
            noise: CloudNoise::new(disk_cache),
            aerial: Aerial::new(),
            volume: CloudVolume::new(),
            shadow: CloudShadow::new(),
            cloud_air: CloudAir::new(),
            dome: CloudDomes::new(),
            pictures: Memo::new(4),
        }
    }

    /// What noise and weather cost since this was last asked.
    pub(crate) fn take_times(&mut self) -> Vec<PassTime> {
        self.noise.take_times()
    }

    /// Noise and weather; made, and waited for, where they are not there yet.
    pub(crate) fn textures(
        &mut self,
        gpu: &Gpu,
        clouds: &Clouds,
        assets: &SceneAssets,
    ) -> Result<CloudTextures, Error> {
        let shape = &clouds.shape;
        let seed = shape.seed.unwrap_or(clouds.seed);
        let frequencies = ShapeFrequencies {
            perlin: shape.perlin_frequency,
            worley: shape.worley_frequency,
        };
        let (first, second, _) = clouds.weather_map.blended();
        Ok(CloudTextures {
            shape: self.noise.shape(gpu, seed, frequencies)?,
            detail: self.noise.detail(gpu, seed, shape.detail_frequency)?,
            curl: self.noise.curl(gpu, seed)?,
            first_weather: self.weather(gpu, &first, clouds.seed, assets)?,
            second_weather: self.weather(gpu, &second, clouds.seed, assets)?,
            sheet: self.noise.sheet(gpu, clouds.seed)?,
        })
    }

    fn weather(
        &mut self,
        gpu: &Gpu,
        map: &PlainMap,
        seed: u32,
        assets: &SceneAssets,
    ) -> Result<Arc<Table>, Error> {
        match map {
            PlainMap::Procedural(map) => self.noise.weather(gpu, map.seed.unwrap_or(seed)),
            // Nothing is read of it.
            PlainMap::Uniform(_) => self.noise.curl(gpu, seed),
            PlainMap::Asset(map) => {
                let picture = assets
                    .weather_maps
                    .get(&map.name)
                    .ok_or_else(|| Error::Asset(map.name.clone()))?;
                let made_from = Fingerprint::of(("weather picture", picture.digest));
                Ok(self.pictures.get_or(made_from, || Table {
                    view: gpu.holding(
                        "weather picture",
                        [picture.width_px, picture.height_px, 1],
                        Shape::Flat,
                        Texel::Byte,
                        &picture.rgba,
                    ),
                    made_from,
                }))
            }
        }
    }

    pub(crate) fn scape(
        &mut self,
        recorder: &mut Recorder<'_>,
        tables: &Tables,
        (sky, textures): (&CloudSky<'_>, CloudTextures),
        (light, ground): (CloudLight<'_>, Option<&Groundscape>),
        quality: Quality,
    ) -> Cloudscape {
        let scene = sky.scene;
        let uniform = sky.uniform(fineness(quality));
        let clouds = Part::new(&uniform);
        let shade = sky.shade(&light.stand, scene.camera.position_m);
        let base_m = shade.base_m;
        let under_clouds = light.stand.altitude_m < f64::from(shade.base_m);
        let shade = Part::new(&shade);
        let reads = (&*tables.transmittance, &tables.multi_scattering.source);
        let aerial = self
            .aerial
            .run(recorder, &tables.air, &light.stand, reads, tables.plan, quality);
        // Whoever wants the light's way followed to its ends gets it exact.
        let volume = (uniform.layer_count > 0 && uniform.light_steps < ALL_LIGHT_STEPS).then(|| {
            let layers = (uniform.layer_count, sky.one_layer());
            self.volume.run(recorder, &textures, &clouds, layers, quality)
        });
        let (share, most_steps) = shadow_steps(quality);
        let slant = slant(light.stand.up.dot(light.stand.sun));
        let towards = ShadowUniform {
            light: light.stand.sun.as_vec3(),
            step_m: share * sky.noise_scale_m() / slant,
            most_steps: most_steps * slant,
        };
        let shadow = self.shadow.run(
            recorder,
            (&textures, volume.as_ref()),
            (&clouds, &shade),
            towards,
            (sky.shade_count(), sky.one_layer()),
            quality,
        );
        let frame = CloudFrameUniform {
            place_m: crate::uniforms::narrow3(scene.camera.position_m),
            light: light.stand.sun.as_vec3(),
        };
        let cloud_air = (!light.shafted).then(|| {
            let inputs = CloudAirInputs {
                air: &tables.air,
                view: light.view,
                transmittance: &tables.transmittance,
                shade: &shade,
                shadow: &shadow,
                frame: &Part::new(&frame),
            };
            self.cloud_air.run(recorder, &inputs)
        });
        let ground_shadow = ground.and_then(|ground| ground.shadow_on_clouds(base_m, &light.stand));
        let observer = Part::new(&light.stand.observer(tables.plan.pixel_steps()));
        let made_from = Fingerprint::of((
            "clouds",
            (&clouds, &tables.air, light.view, &shade, &observer),
            textures.fingerprint(),
            (
                tables.transmittance.made_from,
                tables.multi_scattering.irradiance.made_from,
            ),
            (aerial.made_from, shadow.made_from),
            ground_shadow.as_ref().map(|map| map.made_from),
            cloud_air.is_some(),
        ));
        Cloudscape {
            clouds,
            air: tables.air.clone(),
            view: light.view.clone(),
            shade,
            observer,
            textures,
            transmittance: Arc::clone(&tables.transmittance),
            multi_scattering: Arc::clone(&tables.multi_scattering),
            aerial,
            shadow,
            volume: volume.filter(|_| matches!(quality, Quality::Final)),
            cloud_air,
            ground_shadow,
            base_m,
            frame,
            under_clouds,
            one_layer: sky.one_layer(),
            made_from,
        }
    }
}
