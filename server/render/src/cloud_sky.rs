//! A scene's clouds as the shaders take them: layers in bands, weather, drift, phase function.

use crate::uniforms::{
    Standpoint,
    clouds::{BandUniform, CloudsUniform, LayerUniform, MOST, ShadeUniform, SheetUniform, WeatherUniform},
    narrow, narrow3,
};
use glam::{DVec2, Vec2, Vec3, Vec4};
use welkin_scene::{
    Scene,
    clouds::{Clouds, Convention, Genus, Layer, Phase, PlainMap, SheetLayer, VolumeLayer},
};

/// Scale of the curl noise's tile against that of the detail's.
const CURL_SCALE: f64 = 2.3;
/// Side of the sheets' tile, metres.
const SHEET_SCALE_M: [f64; 3] = [60_000.0, 24_000.0, 90_000.0];
/// `SECOND_LOOK` of `lib/cloud.wgsl`.
const SECOND_LOOK: [f64; 2] = [0.2867, 0.1513];
/// Half the side of the shadows' maps, metres.
const SHADE_REACH_M: f64 = 120_000.0;
/// Of a volume layer's optical depth, what a column of it has on average where there is cloud: of heaps, and of a closed deck,
/// whose noise is never under a half.
const MEAN_FILLING: [f64; 2] = [0.2, 0.45];

/// What full rain adds to the extinction of a place, in shares of it: that of `densest_per_m` in `lib/cloud.wgsl`.
const RAIN_DARKENS: f64 = 2.0;

/// As the shader closes a deck: 0 up to a coverage of 0.85, 1 where all is covered.
fn closed(coverage: f64) -> f64 {
    let x = ((coverage - 0.85) / 0.15).clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

fn mean_filling(coverage: f64) -> f64 {
    let [heaps, deck] = MEAN_FILLING;
    heaps + (deck - heaps) * closed(coverage)
}

/// `RIM` of `lib/cloud.wgsl`.
const RIM: f64 = 0.5;
/// Of the weather's range, what the noise takes from the rims of clouds on average: more of flat ones. As counted over
/// ten seeds.
fn lost(cloud_type: Option<f64>) -> f64 {
    (0.335 - 0.15 * (cloud_type.unwrap_or(0.65) - 0.5)).min(0.335)
}

/// How far a layer is heaps, which lose light at their sides, and not a deck: all of it from cumulus on, whose type is 0.8.
fn leak(cloud_type: Option<f64>, coverage: f64) -> f32 {
    let heaped = cloud_type.map_or(0.65, |t| ((t - 0.5) / 0.3).clamp(0.0, 1.0));
    narrow(heaped * (1.0 - closed(coverage)))
}

/// The coverage that the threshold needs for clouds to cover that share of the sky. The range of the weather over which
/// they thin out is `rim`; `lost` of it is not seen; and at either end nothing or everything must be left.
fn covering(share: f64, rim: f64, lost: f64) -> f64 {
    let moved = share + lost * (share / 0.1).min(1.0) + (rim - lost) * ((share - 0.9) / 0.1).max(0.0);
    moved / (1.0 + rim)
}

/// Of a sheet's range, what is too thin to be seen: below an optical depth of 0.03 (Sassen and Cho 1992), where the depth
/// goes with the square of the way in from the rim over 0.6 of the range, and the texture takes a fifth on average.
fn unseen(optical_depth: f64) -> f64 {
    (0.6 * (0.03 / (0.8 * optical_depth)).sqrt()).min(SHEET_RIM)
}

/// What `sheet_optical_depth` of `lib/cloud.wgsl` moves its threshold by.
const SHEET_RIM: f64 = 0.2;

/// The part of x/period after the point: coordinates of tiles keep their precision however long the wind has blown.
fn turns(x: f64, period: f64) -> f32 {
    narrow((x / period).rem_euclid(1.0))
}

/// What there is to see of a scene's clouds.
pub(crate) struct CloudSky<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) clouds: &'a Clouds,
    volumes: Vec<(&'a VolumeLayer, f64, f64)>,
    sheets: Vec<(&'a SheetLayer, f64)>,
}

impl<'a> CloudSky<'a> {
    /// None where nothing of them could be seen.
    pub(crate) fn new(scene: &'a Scene) -> Option<Self> {
        let clouds = scene.clouds.as_ref()?;
        let mut sky = Self {
            scene,
            clouds,
            volumes: Vec::new(),
            sheets: Vec::new(),
        };
        for layer in &clouds.layers {
            let coverage = layer.coverage().unwrap_or(clouds.coverage);
            match layer {
                Layer::Volume(volume) => {
                    let extinction = clouds.extinction_per_m * clouds.density * volume.density;
                    if coverage > 0.0 && extinction > 0.0 {
                        sky.volumes.push((volume, coverage, extinction));
                    }
                }
                Layer::Sheet(sheet) => {
                    if coverage > 0.0 && sheet.densest_optical_depth() * clouds.density > 0.0 {
                        sky.sheets.push((sheet, coverage));
                    }
                }
            }
        }
        sky.volumes.sort_by(|a, b| a.0.base_m.total_cmp(&b.0.base_m));
        sky.sheets.sort_by(|a, b| a.0.height_m.total_cmp(&b.0.height_m));
        (!sky.volumes.is_empty() || !sky.sheets.is_empty()).then_some(sky)
    }

    fn layers_and_bands(&self) -> ([LayerUniform; MOST], Vec<BandUniform>) {
        let mut layers = [LayerUniform::default(); MOST];
        let mut bands: Vec<BandUniform> = Vec::new();
        for ((at, layer), (volume, coverage, extinction)) in (0_u32..).zip(&mut layers).zip(&self.volumes) {
            let thickness_m = narrow(volume.top_m - volume.base_m);
            *layer = LayerUniform {
                base_m: narrow(volume.base_m),
                inverse_thickness_per_m: 1.0 / thickness_m,
                cloud_type: volume.cloud_type.map_or(-1.0, narrow),
                coverage: narrow(covering(*coverage, RIM, lost(volume.cloud_type))),
                share: narrow(*coverage),
                extinction_per_m: narrow(*extinction),
                anvil: narrow(volume.anvil),
            };
            match bands.last_mut().filter(|band| layer.base_m < band.top_m) {
                Some(band) => {
                    band.top_m = band.top_m.max(narrow(volume.top_m));
                    band.count += 1;
                    band.thickness_m = band.thickness_m.min(thickness_m);
                    band.leak = band.leak.max(leak(volume.cloud_type, *coverage));
                }
                None => bands.push(BandUniform {
                    base_m: layer.base_m,
                    top_m: narrow(volume.top_m),
                    first: at,
                    count: 1,
                    thickness_m,
                    leak: leak(volume.cloud_type, *coverage),
                }),
            }
        }
        (layers, bands)
    }

    /// `fineness` multiplies the scene's own steps.
    pub(crate) fn uniform(&self, fineness: f64) -> CloudsUniform {
        let (scene, clouds) = (self.scene, self.clouds);
        let shape = &clouds.shape;
        let moved = clouds.wind.displacement_m(scene.time_s);
        let drift = |scale: f64| Vec3::from_array(moved.map(|way| turns(way, scale)));
        let (layers, found) = self.layers_and_bands();
        let mut bands = [BandUniform::default(); MOST];
        bands[..found.len()].copy_from_slice(&found);
        let along = self.wind_along();
        let mut sheets = [SheetUniform::default(); MOST];
        for (to, (sheet, coverage)) in sheets.iter_mut().zip(&self.sheets) {
            let channel: u8 = match sheet.genus {
                Genus::Cirrus => 0,
                Genus::Cirrocumulus | Genus::Altocumulus => 1,
                Genus::Cirrostratus | Genus::Altostratus => 2,
            };
            let depth = sheet.densest_optical_depth() * clouds.density;
            let scale = SHEET_SCALE_M[usize::from(channel)]
                * if sheet.genus == Genus::Altocumulus {
                    1.7
                } else {
                    1.0
                };
            let (x, y) = (
                along.dot(DVec2::new(moved[0], moved[1])),
                along.perp_dot(DVec2::new(moved[0], moved[1])),
            );
            *to = SheetUniform {
                turn: (along / scale).as_vec2(),
                drift: Vec2::new(turns(x, scale), turns(y, scale)),
                height_m: narrow(sheet.height_m),
                coverage: narrow(covering(*coverage, SHEET_RIM, unseen(depth))),
                optical_depth: narrow(depth),
                channel: u32::from(channel),
            };
        }
        let (weather, weather_share) = self.weather(scene);
        let phase = lobes(&clouds.phase);
        let g = &shape.gradients;
        let gradient = |v: [f64; 4]| Vec4::from_array(v.map(narrow));
        let curl_scale = CURL_SCALE * shape.detail_scale_m;
        CloudsUniform {
            layers,
            bands,
            sheets,
            weather,
            gradients: [
                gradient(g.stratus),
                gradient(g.stratocumulus),
                gradient(g.cumulus),
            ],
            place_m: narrow3(scene.camera.position_m),
            radius_m: narrow(scene.planet.radius_m),
            base_drift: drift(shape.base_scale_m),
            base_inverse_scale_per_m: narrow(1.0 / shape.base_scale_m),
            detail_drift: drift(shape.detail_scale_m),
            detail_inverse_scale_per_m: narrow(1.0 / shape.detail_scale_m),
            shear_m: (-along * clouds.wind.shear_m).as_vec2(),
            curl_inverse_scale_per_m: narrow(1.0 / curl_scale),
            curl_m: narrow(shape.curl_distortion_m),
            layer_count: u32::try_from(self.volumes.len()).unwrap_or(0),
            band_count: u32::try_from(found.len()).unwrap_or(0),
            sheet_count: u32::try_from(self.sheets.len()).unwrap_or(0),
            weather_share,
            low_least: narrow(shape.low_freq_min),
            low_inverse_range: narrow(1.0 / (shape.low_freq_max - shape.low_freq_min).max(1e-3)),
            erosion: narrow(shape.high_freq_modifier),
            precipitation: narrow(clouds.precipitation),
            fineness: narrow(f64::from(clouds.steps) / 128.0 * fineness),
            albedo: narrow3(clouds.base_colour.map(|c| c * clouds.albedo)),
            asymmetry: phase.asymmetry(),
            sun_colour: narrow3(clouds.sun_colour),
            forward: phase.forward,
            other: phase.other,
            other_share: phase.share,
            alpha: phase.alpha,
            sun_factor: narrow(clouds.sun_factor),
            ambient_factor: narrow(clouds.ambient_factor),
            powder: narrow(clouds.powder),
            octaves: clouds.octaves,
            light_steps: if fineness < 1.0 { 0 } else { clouds.light_steps },
            haze: narrow(clouds.haze),
        }
    }

    /// Where the wind blows to, east and north.
    fn wind_along(&self) -> DVec2 {
        let azimuth = (self.clouds.wind.azimuth_deg + 180.0).to_radians();
        DVec2::new(azimuth.sin(), azimuth.cos())
    }

    fn weather(&self, scene: &Scene) -> ([WeatherUniform; 2], f32) {
        let moved = self.clouds.wind.displacement_m(scene.time_s);
        let (first, second, share) = self.clouds.weather_map.blended();
        let sources = [first, second].map(|map| weather_source(&map, moved));
        (sources, narrow(share))
    }

    /// The maps of shadows, for an observer under a light at that cosine.
    pub(crate) fn shade(&self, stand: &Standpoint, place_m: [f64; 3]) -> ShadeUniform {
        let (_, bands) = self.layers_and_bands();
        let middles = bands
            .iter()
            .map(|band| 0.5 * (band.base_m + band.top_m))
            .chain(self.sheets.iter().map(|(sheet, _)| narrow(sheet.height_m)));
        let mut middles_m = [Vec4::ZERO; 4];
        let mut count = 0;
        for (at, middle) in middles.enumerate() {
            middles_m[at / 4][at % 4] = middle;
            count += 1;
        }
        let asymmetry = f64::from(lobes(&self.clouds.phase).asymmetry());
        let mu = stand.up.dot(stand.sun).max(0.05);
        let (mut direct, mut diffuse) = (1.0, 1.0);
        // Of a map that is the same everywhere coverage and rain are known; of others coverage is the threshold's, and it rains
        // in few places.
        let everywhere = |map: &PlainMap| match map {
            PlainMap::Uniform(even) => [even.coverage, even.rain],
            PlainMap::Procedural(_) | PlainMap::Asset(_) => [1.0, 0.0],
        };
        let (first, second, share) = self.clouds.weather_map.blended();
        let (first, second) = (everywhere(&first), everywhere(&second));
        let [there, rain] = [0, 1].map(|i| (1.0 - share) * first[i] + share * second[i]);
        let darker = 1.0 + RAIN_DARKENS * self.clouds.precipitation * rain;
        let volumes = self.volumes.iter().map(|(v, coverage, extinction)| {
            let depth = mean_filling(*coverage) * extinction * (v.top_m - v.base_m);
            (*coverage, darker * depth)
        });
        let columns = volumes.chain(self.sheets.iter().map(|(sheet, coverage)| {
            let depth = 0.3 * sheet.densest_optical_depth() * self.clouds.density;
            (*coverage, depth)
        }));
        for (coverage, depth) in columns {
            let coverage = coverage * there;
            direct *= 1.0 - coverage * (1.0 - (-depth / mu).exp());
            let whole = (1.0 - asymmetry) * depth;
            let passed = (2.0 + 3.0 * mu + (2.0 - 3.0 * mu) * (-whole / mu).exp()) / (4.0 + 3.0 * whole);
            diffuse *= 1.0 - coverage * (1.0 - passed);
        }
        let base = self.volumes.iter().map(|(v, ..)| v.base_m);
        let base_m = base
            .chain(self.sheets.iter().map(|(sheet, _)| sheet.height_m))
            .fold(f64::INFINITY, f64::min);
        if !self.clouds.shadows {
            (direct, diffuse, count) = (1.0, 1.0, 0);
        }
        ShadeUniform {
            middles_m,
            centre_m: Vec2::new(narrow(place_m[0]), narrow(place_m[1])),
            reach_m: narrow(SHADE_REACH_M),
            count,
            direct_left: narrow(direct),
            diffuse_left: narrow(diffuse),
            asymmetry: narrow(asymmetry),
            base_m: narrow(base_m),
            even_depth: narrow(-direct.max(1e-9).ln()),
            spread_left: narrow((diffuse - direct).max(0.0)),
        }
    }

    /// Of the coarse noise.
    pub(crate) fn noise_scale_m(&self) -> f32 {
        narrow(self.clouds.shape.base_scale_m)
    }

    /// The shaders' constant that is 1 where there is a single layer of volume; sheets are counted apart.
    pub(crate) const fn one_layer(&self) -> (&'static str, f64) {
        ("ONE_LAYER", if self.volumes.len() == 1 { 1.0 } else { 0.0 })
    }

    /// Maps of shadows that there are.
    pub(crate) fn shade_count(&self) -> u32 {
        let (_, bands) = self.layers_and_bands();
        u32::try_from(bands.len() + self.sheets.len()).unwrap_or(0)
    }
}

fn weather_source(map: &PlainMap, moved: [f64; 3]) -> WeatherUniform {
    match map {
        PlainMap::Uniform(even) => WeatherUniform {
            even: narrow3([even.coverage, even.cloud_type, even.rain]),
            ..WeatherUniform::default()
        },
        PlainMap::Procedural(map) => {
            let [x, y, _] = moved.map(|way| way / map.extent_m);
            let [a, b] = SECOND_LOOK;
            WeatherUniform {
                convention: 1,
                drift: Vec2::new(turns(x, 1.0), turns(y, 1.0)),
                // The columns of the shader's matrix are (a, b) and (-b, a).
                second_drift: Vec2::new(turns(a * x - b * y, 1.0), turns(b * x + a * y, 1.0)),
                inverse_extent_per_m: narrow(1.0 / map.extent_m),
                twice: 1.0,
                ..WeatherUniform::default()
            }
        }
        PlainMap::Asset(map) => WeatherUniform {
            convention: match map.convention {
                Convention::CoverageTypeRain => 1,
                Convention::LowHighHeightDensity => 2,
            },
            drift: Vec2::new(turns(moved[0], map.extent_m), turns(-moved[1], map.extent_m)),
            inverse_extent_per_m: narrow(1.0 / map.extent_m),
            ..WeatherUniform::default()
        },
    }
}

struct Lobes {
    forward: f32,
    other: f32,
    share: f32,
    alpha: f32,
}

impl Lobes {
    /// Mean cosine: Henyey and Greenstein's is g; Draine's is g (1 + α (3 + 2g²)/5) / (1 + α (1 + 2g²)/3).
    fn asymmetry(&self) -> f32 {
        let g = self.other;
        let draine = g * (1.0 + self.alpha * (3.0 + 2.0 * g * g) / 5.0)
            / (1.0 + self.alpha * (1.0 + 2.0 * g * g) / 3.0);
        (1.0 - self.share) * self.forward + self.share * draine
    }
}

/// Droplets: Jendersie and d'Eon 2023, diameters in micrometres, 5 to 50.
fn lobes(phase: &Phase) -> Lobes {
    match phase {
        Phase::DualHenyeyGreenstein(lobes) => Lobes {
            forward: narrow(lobes.forward),
            other: narrow(lobes.backward),
            share: narrow(lobes.blend),
            alpha: 0.0,
        },
        Phase::Droplets(droplets) => {
            let d = droplets.diameter_m * 1e6;
            Lobes {
                forward: narrow((-0.099_056_7 / (d - 1.671_54)).exp()),
                other: narrow((-2.206_79 / (d + 3.910_29) - 0.428_934).exp()),
                alpha: narrow((3.624_89 - 8.292_88 / (d + 5.528_25)).exp()),
                share: narrow((-0.599_085 / (d - 0.641_583) - 0.665_888).exp()),
            }
        }
    }
}
