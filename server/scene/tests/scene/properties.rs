//! Random documents: none panics, valid ones round trip, and the schema and the reader are of one mind.

use jsonschema::Validator;
use proptest::{collection::vec, option, prelude::*, sample::select};
use serde_json::{Value, json};
use std::sync::LazyLock;
use welkin_scene::{
    Atmosphere, Bands, Camera, Direction, Display, Exposure, FisheyeMapping, FrameRequest, Haze, Method, Mie,
    Orders, Ozone, Planet, ProbeRequest, Projection, Rayleigh, Scene, SceneError, Sun, SunPosition,
    ToneCurve, presets, scene_schema, sun::TimeAndPlace,
};

static SCHEMA: LazyLock<Validator> =
    LazyLock::new(|| jsonschema::draft202012::new(&scene_schema()).expect("a derived schema is valid"));

/// Where the reader refuses what the schema lets pass.
const BEYOND_THE_SCHEMA: [&str; 8] = [
    "/camera/direction",
    "/camera/position_m",
    "/camera/projection/fov_deg",
    "/haze/extinction_per_m",
    "/haze/top_m",
    "/sun/position",
    "/sun/position/time",
    "/time_s",
];

fn words() -> impl Strategy<Value = String> {
    const KNOWN: &[&str] = &[
        "camera",
        "direction",
        "azimuth_deg",
        "elevation_deg",
        "kind",
        "fisheye",
        "stereographic",
        "single",
        "agx",
        "time",
        "latitude_deg",
        "2026-06-21T05:00:00Z",
        "ozone",
        "fov_deg",
        "/",
        "~1",
        "",
    ];
    prop_oneof![select(KNOWN).prop_map(String::from), any::<String>()]
}

fn json_value() -> impl Strategy<Value = Value> {
    let leaf = prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::from),
        select(vec![
            0.0, -0.0, 1.0, -1.0, 0.5, 90.0, 301.0, 1e4, 6.36e6, 1e9, 1e300, 5e-324
        ])
        .prop_map(Value::from),
        any::<f64>().prop_map(Value::from),
        any::<i64>().prop_map(Value::from),
        any::<u64>().prop_map(Value::from),
        words().prop_map(Value::from),
    ];
    leaf.prop_recursive(4, 32, 4, |inner| {
        prop_oneof![
            vec(inner.clone(), 0..5).prop_map(Value::from),
            vec((words(), inner), 0..5).prop_map(|members| members.into_iter().collect()),
        ]
    })
}

/// A preset with some of its fields replaced, renamed or removed.
fn damaged_scene() -> impl Strategy<Value = Value> {
    let edit = (
        any::<prop::sample::Index>(),
        option::weighted(0.8, json_value()),
        option::weighted(0.2, words()),
    );
    (select(presets()), vec(edit, 1..4)).prop_map(|(preset, edits)| {
        let mut scene = serde_json::to_value(&preset.scene).expect("a scene is JSON");
        for (at, value, name) in edits {
            let mut parents = Vec::new();
            pointers(&scene, "", &mut parents);
            if parents.is_empty() {
                continue;
            }
            let pointer = at.get(&parents).clone();
            let (parent, key) = pointer.rsplit_once('/').expect("a member");
            match scene.pointer_mut(parent).expect("it was found there") {
                Value::Array(items) => match value {
                    Some(value) => items[key.parse::<usize>().expect("an index")] = value,
                    None => drop(items.pop()),
                },
                Value::Object(members) => {
                    let key = key.replace("~1", "/").replace("~0", "~");
                    let old = members.remove(&key);
                    let value = if name.is_some() { old } else { value };
                    members.extend(value.map(|value| (name.unwrap_or(key), value)));
                }
                _ => unreachable!("only arrays and objects have members"),
            }
        }
        scene
    })
}

fn pointers(value: &Value, at: &str, found: &mut Vec<String>) {
    let members: Vec<(String, &Value)> = match value {
        Value::Array(items) => items
            .iter()
            .enumerate()
            .map(|(i, v)| (i.to_string(), v))
            .collect(),
        Value::Object(members) => members
            .iter()
            .map(|(k, v)| (k.replace('~', "~0").replace('/', "~1"), v))
            .collect(),
        _ => Vec::new(),
    };
    for (key, value) in members {
        let pointer = format!("{at}/{key}");
        pointers(value, &pointer, found);
        found.push(pointer);
    }
}

fn direction() -> impl Strategy<Value = Direction> {
    prop_oneof![
        (-360.0..=360.0, -90.0..=90.0).prop_map(|(azimuth, elevation)| Direction::angles(azimuth, elevation)),
        prop::array::uniform3(-1e12..=1e12)
            .prop_filter("a direction has a length", |v| *v != [0.0; 3])
            .prop_map(Direction::Vector),
    ]
}

fn camera() -> impl Strategy<Value = Camera> {
    let projection = prop_oneof![
        (0.01..=170.0).prop_map(|vertical_fov_deg| Projection::Perspective { vertical_fov_deg }),
        (
            1.0..=300.0,
            select(vec![
                FisheyeMapping::Equidistant,
                FisheyeMapping::Equisolid,
                FisheyeMapping::Stereographic
            ])
        )
            .prop_map(|(fov_deg, mapping)| Projection::Fisheye { fov_deg, mapping }),
        Just(Projection::Equirectangular {}),
        Just(Projection::Cubemap {}),
    ];
    (
        (-5e7..=5e7, -5e7..=5e7, 0.0..=5e7),
        direction(),
        -360.0..=360.0,
        projection,
    )
        .prop_map(|((x, y, z), direction, roll_deg, projection)| Camera {
            position_m: [x, y, z],
            direction,
            roll_deg,
            projection,
        })
}

fn sun() -> impl Strategy<Value = Sun> {
    let time = (
        1933..2067,
        1..=12,
        1..=28,
        0..24,
        -90.0..=90.0,
        -180.0..=180.0,
        any::<bool>(),
    )
        .prop_map(
            |(year, month, day, hour, latitude_deg, longitude_deg, refraction)| {
                let time = format!("{year}-{month:02}-{day:02}T{hour:02}:30:00+01:00");
                SunPosition::TimeAndPlace(TimeAndPlace {
                    time,
                    latitude_deg,
                    longitude_deg,
                    refraction,
                })
            },
        );
    let position = prop_oneof![direction().prop_map(SunPosition::Direction), time];
    (
        position,
        prop::array::uniform3(0.0..=1e6),
        0.0..=20.0,
        any::<bool>(),
        any::<bool>(),
    )
        .prop_map(
            |(position, irradiance_w_m2, angular_diameter_deg, limb_darkening, disc)| Sun {
                position,
                irradiance_w_m2,
                angular_diameter_deg,
                limb_darkening,
                disc,
            },
        )
}

fn bands(most: f64) -> impl Strategy<Value = Bands> {
    prop_oneof![
        (0.0..=most).prop_map(Bands::Grey),
        prop::array::uniform3(0.0..=most).prop_map(Bands::Rgb),
    ]
}

fn haze() -> impl Strategy<Value = Haze> {
    let density = prop_oneof![
        option::of(50.0..=1e6).prop_map(|visibility_m| (visibility_m, None)),
        (0.0..=0.1).prop_map(|extinction_per_m| (None, Some(extinction_per_m))),
    ];
    (density, 1.0..=1e3, bands(1.0)).prop_map(|((visibility_m, extinction_per_m), top_m, albedo)| Haze {
        visibility_m,
        extinction_per_m,
        top_m,
        albedo,
    })
}

fn atmosphere() -> impl Strategy<Value = Atmosphere> {
    let rayleigh = (
        prop::array::uniform3(0.0..=0.1),
        prop::array::uniform3(0.0..=0.1),
        10.0..=1e5,
    )
        .prop_map(|(scattering_per_m, absorption_per_m, scale_height_m)| Rayleigh {
            scattering_per_m,
            absorption_per_m,
            scale_height_m,
        });
    let mie = (bands(0.1), bands(0.1), 10.0..=1e5, -0.999..=0.999).prop_map(
        |(scattering_per_m, absorption_per_m, scale_height_m, asymmetry)| Mie {
            scattering_per_m,
            absorption_per_m,
            scale_height_m,
            asymmetry,
        },
    );
    let ozone = (prop::array::uniform3(0.0..=0.1), 0.0..=1e6, 1.0..=1e6).prop_map(
        |(absorption_per_m, centre_m, half_width_m)| Ozone {
            absorption_per_m,
            centre_m,
            half_width_m,
        },
    );
    let methods = select(vec![Method::Nested, Method::Table, Method::Lut]);
    let orders = select(vec![Orders::Single, Orders::Multiple]);
    let steps = || option::of(4_u32..=256);
    (
        (methods, steps(), steps(), orders),
        1e3..=1e6,
        0.0..=100.0,
        option::of(rayleigh),
        option::of(mie),
        option::of(ozone),
        option::of(crate::night::airglow()),
    )
        .prop_map(
            |(
                (method, view_steps, sun_steps, orders),
                top_m,
                density_factor,
                rayleigh,
                mie,
                ozone,
                airglow,
            )| {
                Atmosphere {
                    method,
                    view_steps,
                    sun_steps,
                    orders,
                    top_m,
                    density_factor,
                    rayleigh,
                    mie,
                    ozone,
                    airglow,
                }
            },
        )
}

fn display() -> impl Strategy<Value = Display> {
    let exposure = prop_oneof![
        (-30.0..=30.0).prop_map(|ev| Exposure::Ev { ev }),
        (-10.0..=10.0).prop_map(|compensation_ev| Exposure::Auto { compensation_ev }),
        (0.0..=1e6).prop_map(|gain| Exposure::Pupil { gain }),
    ];
    let curves = vec![
        ToneCurve::Reinhard,
        ToneCurve::Exponential,
        ToneCurve::Aces,
        ToneCurve::Agx,
    ];
    (exposure, select(curves), 1667.0..=25e3, 0.0..=10.0, any::<bool>()).prop_map(
        |(exposure, tone_curve, white_balance_k, glare, dither)| Display {
            exposure,
            tone_curve,
            white_balance_k,
            glare,
            dither,
        },
    )
}

prop_compose! {
    fn valid_scene()(
        time_s in -1e9..=1e9,
        camera in camera(),
        sun in sun(),
        (moon, stars) in (option::of(crate::night::moon()), option::of(crate::night::stars())),
        radius_m in 1e5..=1e8,
        ground_albedo in prop::array::uniform3(0.0..=1.0),
        atmosphere in option::of(atmosphere()),
        haze in option::of(haze()),
        display in display(),
    ) -> Scene {
        Scene { time_s, camera, sun, moon, stars, planet: Planet { radius_m, ground_albedo }, atmosphere, haze, display }
    }
}

/// Some problems, each of which points to something or to where it should be.
fn is_told_well(document: &Value, error: &SceneError) -> bool {
    let SceneError::Invalid(problems) = error else {
        return false;
    };
    let exists = |pointer: &str| document.pointer(pointer).is_some();
    !problems.is_empty()
        && problems.len() <= 16
        && problems.iter().all(|p| {
            let parent = p.pointer.rsplit_once('/').map_or("", |(parent, _)| parent);
            !p.allowed.is_empty() && !p.message.is_empty() && (exists(&p.pointer) || exists(parent))
        })
}

proptest! {
    #[test]
    fn valid_scenes_round_trip(scene in valid_scene()) {
        let text = serde_json::to_string(&scene).unwrap();
        prop_assert_eq!(Scene::from_json(&text).unwrap(), scene.clone());
        let request = FrameRequest { scene, width_px: 600, height_px: 100, ..FrameRequest::default() };
        prop_assert_eq!(FrameRequest::from_value(&serde_json::to_value(&request).unwrap()).unwrap(), request);
    }

    #[test]
    fn the_sun_and_the_observer_of_a_valid_scene_are_somewhere(scene in valid_scene()) {
        let observer = scene.observer();
        prop_assert!(observer.altitude_m >= 0.0);
        for unit in [scene.sun_direction(), observer.up] {
            // A few roundings of a 53-bit fraction.
            prop_assert!((unit.iter().map(|c| c * c).sum::<f64>() - 1.0).abs() < 1e-14);
        }
        prop_assert!(scene.sun_place().elevation_deg.abs() <= 90.0);
    }

    #[test]
    fn schema_and_reader_are_of_one_mind(document in damaged_scene()) {
        match Scene::from_value(&document) {
            Ok(scene) => {
                prop_assert!(SCHEMA.is_valid(&document));
                let written = serde_json::to_value(&scene).unwrap();
                prop_assert_eq!(Scene::from_value(&written).unwrap(), scene);
            }
            Err(error) => {
                prop_assert!(is_told_well(&document, &error), "{error:?}");
                if SCHEMA.is_valid(&document) {
                    let SceneError::Invalid(problems) = error else { unreachable!("told well") };
                    for problem in problems {
                        prop_assert!(BEYOND_THE_SCHEMA.contains(&problem.pointer.as_str()), "{problem:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn any_json_is_answered(document in json_value()) {
        for read in [
            Scene::from_value(&document).map(drop),
            FrameRequest::from_value(&document).map(drop),
            ProbeRequest::from_value(&document).map(drop),
            ProbeRequest::from_value(&json!({"directions": [document]})).map(drop),
            Scene::from_value(&json!({"sun": document})).map(drop),
            Scene::from_json(&document.to_string()).map(drop),
        ] {
            if let Err(error) = read {
                prop_assert!(matches!(&error, SceneError::Invalid(p) if (1..=16).contains(&p.len())));
                prop_assert!(!error.to_string().is_empty());
            }
        }
    }

    #[test]
    fn any_text_is_answered(text in ".{0,200}", cut in any::<prop::sample::Index>()) {
        drop(Scene::from_json(&text));
        let scene = serde_json::to_string_pretty(&Scene::default()).unwrap();
        let mut broken = scene.clone();
        broken.insert_str(cut.index(scene.len()), &text);
        drop(Scene::from_json(&broken));
        prop_assert!(Scene::from_json(&scene[..cut.index(scene.len())]).is_err());
    }
}
