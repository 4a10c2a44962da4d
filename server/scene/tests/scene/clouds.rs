//! Clouds: what they are by default, every kind of fault, and random valid ones.

use crate::faults::problems;
use proptest::{array, collection::vec, option, prelude::*, sample::select};
use serde_json::{Value, json};
use welkin_scene::{
    Clouds, Scene,
    clouds::{
        AssetMap, BlendMap, Convention, Droplets, DualHenyeyGreenstein, Genus, Gradients, Layer, Phase,
        PlainMap, ProceduralMap, Shape, SheetLayer, UniformMap, VolumeLayer, WeatherMap, Wind,
    },
    preset,
};

fn layer() -> impl Strategy<Value = Layer> {
    let heights = (0.0..=9.9e4, 1e-3..=1.0);
    let share = || option::of(0.0..=1.0);
    let volume = (heights, share(), share(), 0.0..=10.0, 0.0..=1.0).prop_map(
        |((base_m, rise), cloud_type, coverage, density, anvil)| {
            Layer::Volume(VolumeLayer {
                base_m,
                top_m: base_m + rise * (1e5 - base_m),
                cloud_type,
                coverage,
                density,
                anvil,
            })
        },
    );
    let genera = vec![
        Genus::Cirrus,
        Genus::Cirrocumulus,
        Genus::Cirrostratus,
        Genus::Altocumulus,
        Genus::Altostratus,
    ];
    let sheet = (0.0..=1e5, select(genera), share(), option::of(0.0..=20.0)).prop_map(
        |(height_m, genus, coverage, optical_depth)| {
            Layer::Sheet(SheetLayer {
                height_m,
                genus,
                coverage,
                optical_depth,
            })
        },
    );
    prop_oneof![volume, sheet]
}

fn plain_map() -> impl Strategy<Value = PlainMap> {
    let conventions = vec![Convention::CoverageTypeRain, Convention::LowHighHeightDensity];
    prop_oneof![
        (1e3..=1e7, option::of(any::<u32>()))
            .prop_map(|(extent_m, seed)| PlainMap::Procedural(ProceduralMap { extent_m, seed })),
        ("[a-z0-9][a-z0-9_-]{0,63}", select(conventions), 1e3..=1e7).prop_map(
            |(name, convention, extent_m)| {
                PlainMap::Asset(AssetMap {
                    name,
                    convention,
                    extent_m,
                })
            }
        ),
        (0.0..=1.0, 0.0..=1.0, 0.0..=1.0).prop_map(|(coverage, cloud_type, rain)| PlainMap::Uniform(
            UniformMap {
                coverage,
                cloud_type,
                rain
            }
        )),
    ]
}

fn weather_map() -> impl Strategy<Value = WeatherMap> {
    prop_oneof![
        plain_map().prop_map(WeatherMap::from),
        (plain_map(), plain_map(), 0.0..=1.0).prop_map(|(from, to, share)| WeatherMap::Blend(BlendMap {
            from,
            to,
            share
        })),
    ]
}

fn gradient() -> impl Strategy<Value = [f64; 4]> {
    // Four steps of at least a hundredth, which end at 1 or below.
    (array::uniform4(0.01..=1.0), 0.1..=1.0).prop_map(|(steps, end): ([f64; 4], f64)| {
        let whole: f64 = steps.iter().sum();
        let mut height = 0.0;
        steps.map(|step| {
            height += end * step / whole;
            height.min(1.0)
        })
    })
}

fn shape() -> impl Strategy<Value = Shape> {
    let gradients =
        (gradient(), gradient(), gradient()).prop_map(|(stratus, stratocumulus, cumulus)| Gradients {
            stratus,
            stratocumulus,
            cumulus,
        });
    (
        (100.0..=1e5, 10.0..=1e5),
        (0.0..0.5, 0.5..=1.0),
        (0.0..=1.0, 0.0..=1e4),
        option::of(any::<u32>()),
        (1_u32..=32, 1_u32..=32, 1_u32..=32),
        gradients,
    )
        .prop_map(|(scales, low, edges, seed, frequencies, gradients)| Shape {
            base_scale_m: scales.0,
            detail_scale_m: scales.1,
            low_freq_min: low.0,
            low_freq_max: low.1,
            high_freq_modifier: edges.0,
            curl_distortion_m: edges.1,
            seed,
            perlin_frequency: frequencies.0,
            worley_frequency: frequencies.1,
            detail_frequency: frequencies.2,
            gradients,
        })
}

fn wind() -> impl Strategy<Value = Wind> {
    (
        0.0..=100.0,
        -360.0..=360.0,
        0.0..=5e3,
        0.0..=20.0,
        array::uniform3(-1e12..=1e12),
    )
        .prop_map(|(speed_m_s, azimuth_deg, shear_m, evolution_m_s, drift_m)| Wind {
            speed_m_s,
            azimuth_deg,
            shear_m,
            evolution_m_s,
            drift_m,
        })
}

fn phase() -> impl Strategy<Value = Phase> {
    prop_oneof![
        (0.0..=0.99, -0.99..=0.0, 0.0..=1.0).prop_map(|(forward, backward, blend)| {
            Phase::DualHenyeyGreenstein(DualHenyeyGreenstein {
                forward,
                backward,
                blend,
            })
        }),
        (5e-6..=5e-5).prop_map(|diameter_m| Phase::Droplets(Droplets { diameter_m })),
    ]
}

prop_compose! {
    pub(crate) fn clouds()(
        (coverage, density, precipitation, seed) in (0.0..=1.0, 0.0..=10.0, 0.0..=1.0, any::<u32>()),
        layers in vec(layer(), 0..=8),
        weather_map in weather_map(),
        (shape, wind, phase) in (shape(), wind(), phase()),
        (extinction_per_m, albedo) in (0.0..=1.0, 0.0..=1.0),
        (sun_factor, ambient_factor) in (0.0..=10.0, 0.0..=10.0),
        (sun_colour, base_colour) in (array::uniform3(0.0..=1.0), array::uniform3(0.0..=1.0)),
        (powder, octaves) in (0.0..=1.0, 1_u32..=8),
        (steps, light_steps) in (16_u32..=1024, 1_u32..=64),
        (shadows, haze) in (any::<bool>(), 0.0..=1.0),
    ) -> Clouds {
        Clouds {
            coverage, density, precipitation, seed, layers, weather_map, shape, wind, phase, extinction_per_m, albedo,
            sun_factor, ambient_factor, sun_colour, base_colour, powder, octaves, steps, light_steps, shadows, haze,
        }
    }
}

fn read(clouds: Value) -> Clouds {
    let scene = Scene::from_value(&json!({ "clouds": clouds })).unwrap();
    scene.clouds.unwrap()
}

#[test]
fn nothing_is_fair_weather_and_null_is_no_cloud() {
    assert_eq!(read(json!({})), Clouds::default());
    let unsaid = Scene::from_value(&json!({})).unwrap().clouds;
    assert_eq!(unsaid, Some(Clouds::default()));
    assert_eq!(preset("fair-weather").unwrap().scene.clouds, unsaid);
    let thin = read(json!({"density": 0.2}));
    let expected = Clouds {
        density: 0.2,
        ..Clouds::default()
    };
    assert_eq!(thin, expected);
    let none = Scene::from_value(&json!({"clouds": null})).unwrap();
    assert_eq!(none.clouds, None);
    assert_eq!(serde_json::to_value(&none).unwrap()["clouds"], Value::Null);
    assert_eq!(none, Scene::clear());
}

/// The names are a contract. It shows a sky half covered, which is more than fair weather's.
#[test]
fn the_published_example_is_what_it_says() {
    let clouds = read(json!({
        "coverage": 0.5, "density": 1, "precipitation": 0, "seed": 1,
        "layers": [
            {"kind": "volume", "base_m": 1500, "top_m": 4000, "type": 0.8},
            {"kind": "sheet", "height_m": 8000, "genus": "cirrus", "coverage": 0.3}
        ],
        "weather_map": {"kind": "procedural", "extent_m": 60000},
        "shape": {
            "base_scale_m": 8000, "detail_scale_m": 900, "low_freq_min": 0, "low_freq_max": 1,
            "high_freq_modifier": 0.35, "curl_distortion_m": 120
        },
        "wind": {"speed_m_s": 8, "azimuth_deg": 270, "shear_m": 500},
        "phase": {"kind": "dual-henyey-greenstein", "forward": 0.8, "backward": -0.25, "blend": 0.3},
        "extinction_per_m": 0.04, "albedo": 0.9999, "sun_factor": 1, "ambient_factor": 1, "powder": 0.5,
        "octaves": 8, "steps": 128, "light_steps": 6
    }));
    let half = Clouds {
        coverage: 0.5,
        ..Clouds::default()
    };
    assert_eq!(clouds, half);
    let clouds = read(json!({
        "weather_map": {"kind": "blend", "share": 0.25,
            "from": {"kind": "asset", "name": "front", "convention": "low-high-height-density"},
            "to": {"kind": "uniform", "coverage": 1, "type": 0, "rain": 0.5}},
        "phase": {"kind": "droplets", "diameter_m": 2e-5}
    }));
    let WeatherMap::Blend(BlendMap { from, to, share }) = clouds.weather_map else {
        panic!("{:?}", clouds.weather_map)
    };
    assert_eq!(share, 0.25);
    assert_eq!(
        from,
        PlainMap::Asset(AssetMap {
            name: "front".into(),
            convention: Convention::LowHighHeightDensity,
            extent_m: 60_000.0
        })
    );
    assert_eq!(
        to,
        PlainMap::Uniform(UniformMap {
            coverage: 1.0,
            cloud_type: 0.0,
            rain: 0.5
        })
    );
    assert_eq!(clouds.phase, Phase::Droplets(Droplets { diameter_m: 2e-5 }));
}

#[test]
fn faults_name_their_field() {
    for (clouds, pointer, message) in [
        (
            json!({"coverage": 1.2}),
            "/coverage",
            "`coverage` must be a number from 0 to 1, but is 1.2",
        ),
        (
            json!({"layers": [{"kind": "sheet"}, {"kind": "volume", "base_m": 2000, "top_m": 2000}]}),
            "/layers/1/top_m",
            "`top_m` must be a number of metres above `base_m`, 2000, but is 2000",
        ),
        (
            json!({"layers": [{"kind": "volume", "base_m": 4000}]}),
            "/layers/0/top_m",
            "`top_m` must be a number of metres above `base_m`, 4000, but is 4000",
        ),
        (
            json!({"layers": [{"kind": "sheet", "genus": "cumulus"}]}),
            "/layers/0/genus",
            "`genus` must be one of `cirrus`, `cirrocumulus`, `cirrostratus`, `altocumulus`, `altostratus`, but is the text \"cumulus\"; did you mean `altocumulus`?",
        ),
        (
            json!({"layers": [{"base_m": 100}]}),
            "/layers/0/kind",
            "`layers[0]` lacks the field `kind`, which must be one of `volume`, `sheet`",
        ),
        (
            json!({"layers": vec![json!({"kind": "volume"}); 9]}),
            "/layers",
            "`layers` must be an array of at most 8, each an object whose `kind` is one of `volume`, `sheet`, but is [{\"kind\":\"volume\"},{\"kind\":\"volume\"},{\"kind\":\"volume\"},{\"kind\":\"volume\"},{\"kind…",
        ),
        (
            json!({"weather_map": {"kind": "asset"}}),
            "/weather_map/name",
            "`weather_map` lacks the field `name`, which must be a text that matches `^[a-z0-9][a-z0-9_-]{0,63}$`",
        ),
        (
            json!({"weather_map": {"kind": "asset", "name": "../front"}}),
            "/weather_map/name",
            "`name` must be a text that matches `^[a-z0-9][a-z0-9_-]{0,63}$`, but is the text \"../front\"",
        ),
        (
            json!({"weather_map": {"kind": "blend", "to": {"kind": "blend"}}}),
            "/weather_map/to/kind",
            "`kind` must be one of `procedural`, `asset`, `uniform`, but is the text \"blend\"",
        ),
        (
            json!({"shape": {"low_freq_min": 0.7, "low_freq_max": 0.7}}),
            "/shape/low_freq_min",
            "`low_freq_min` must be a number below `low_freq_max`, 0.7, but is 0.7",
        ),
        (
            json!({"shape": {"gradients": {"cumulus": [0, 0.5, 0.4, 1]}}}),
            "/shape/gradients/cumulus",
            "`cumulus` must be four numbers, each greater than the one before, but is [0,0.5,0.4,1]",
        ),
        (
            json!({"shape": {"perlin_frequency": 2.5}}),
            "/shape/perlin_frequency",
            "`perlin_frequency` must be a whole number from 1 to 32, but is 2.5",
        ),
        (
            json!({"wind": {"speed_m_s": -1}}),
            "/wind/speed_m_s",
            "`speed_m_s` must be a number from 0 to 100 metres per second, but is -1",
        ),
        (
            json!({"phase": {"kind": "droplets", "forward": 0.5}}),
            "/phase/forward",
            "unknown field `forward`; `phase` has the fields `diameter_m`, `kind`",
        ),
        (
            json!({"seed": -1}),
            "/seed",
            "`seed` must be a whole number from 0 to 4.294967295e9, but is -1",
        ),
    ] {
        let all = problems(Scene::from_value(&json!({ "clouds": clouds })));
        assert_eq!(all.len(), 1, "{all:?}");
        assert_eq!(
            (all[0].pointer.as_str(), all[0].message.as_str()),
            (format!("/clouds{pointer}").as_str(), message)
        );
    }
}

#[test]
fn whole_numbers_may_be_written_as_json_likes() {
    let clouds = read(
        json!({"seed": 4_294_967_295.0, "steps": 64.0, "weather_map": {"kind": "procedural", "seed": 7.0}}),
    );
    assert_eq!((clouds.seed, clouds.steps), (u32::MAX, 64));
    let WeatherMap::Procedural(map) = clouds.weather_map else {
        panic!("{:?}", clouds.weather_map)
    };
    assert_eq!(map.seed, Some(7));
}

#[test]
fn the_wind_blows_from_its_azimuth() {
    let at = |azimuth_deg| Wind {
        speed_m_s: 10.0,
        azimuth_deg,
        evolution_m_s: 0.5,
        drift_m: [5.0, 0.0, 1.0],
        ..Wind::default()
    };
    // sin and cos of 270° and 180° are off by their last digits.
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
    assert!(near(at(270.0).displacement_m(2.0), [25.0, 0.0, 2.0]));
    assert!(near(at(180.0).displacement_m(2.0), [5.0, 20.0, 2.0]));
    assert!(near(at(-90.0).displacement_m(0.0), [5.0, 0.0, 1.0]));
}

#[test]
fn a_sheet_is_as_dense_as_it_says_or_as_its_genus_is() {
    let usual = SheetLayer {
        genus: Genus::Altostratus,
        ..SheetLayer::default()
    };
    assert_eq!(
        usual.densest_optical_depth(),
        Genus::Altostratus.usual_optical_depth()
    );
    let said = SheetLayer {
        optical_depth: Some(0.0),
        ..usual
    };
    assert_eq!(said.densest_optical_depth(), 0.0);
}
