//! Random valid scenes, part by part.

use proptest::{option, prelude::*, sample::select};
use welkin_scene::{
    Atmosphere, Bands, Camera, Direction, Display, Exposure, FisheyeMapping, Haze, Method, Mie, Orders,
    Ozone, Planet, Projection, Rayleigh, Scene, Sun, SunPosition, ToneCurve, sun::TimeAndPlace,
};

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
    pub(crate) fn valid_scene()(
        time_s in -1e9..=1e9,
        camera in camera(),
        sun in sun(),
        (moon, stars) in (option::of(crate::night::moon()), option::of(crate::night::stars())),
        radius_m in 1e5..=1e8,
        (ground_albedo, surface) in (prop::array::uniform3(0.0..=1.0), crate::terrain::sphere_surface()),
        atmosphere in option::of(atmosphere()),
        haze in option::of(haze()),
        clouds in option::of(crate::clouds::clouds()),
        (terrain, shafts) in (option::of(crate::terrain::terrain()), option::of(crate::terrain::shafts())),
        display in display(),
    ) -> Scene {
        let planet = Planet { radius_m, ground_albedo, surface };
        Scene { time_s, camera, sun, moon, stars, planet, atmosphere, clouds, haze, terrain, shafts, display }
    }
}
