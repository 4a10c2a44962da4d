//! Mountains, a coast, and the planet from above.

use super::{Preset, clouds, looking, sun, volume};
use crate::{
    camera::{Camera, Projection},
    clouds::Layer,
    display::{Display, Exposure, ToneCurve},
    document::Scene,
    haze::Haze,
    planet::{Planet, SphereSurface, Water},
    terrain::{
        GroundAlbedo, Heightfield, Mountains, Shadow, ShadowFilter, ShadowMap, Surface, SurfaceBands, Terrain,
    },
};

/// Of deep water, by its molecules and what lives in it (Morel and Maritorena 2001, clear ocean).
const SEA: [f64; 3] = [0.003, 0.012, 0.03];

pub(super) fn presets() -> Vec<Preset> {
    vec![
        Preset {
            name: "alpine-dawn",
            title: "Alpine dawn",
            description: "The sun comes through a gap between two mountains; its light stands in the haze, and theirs is the \
                          shadow.",
            scene: Scene {
                camera: standing([2_000.0, 800.0, 400.0], normal(87.0, 6.0)),
                sun: sun(81.0, 7.6),
                clouds: None,
                haze: Some(Haze {
                    visibility_m: Some(110_000.0),
                    top_m: 2_200.0,
                    ..Haze::default()
                }),
                terrain: Some(Terrain::Heightfield(alps())),
                // As one would open up for a slope in the shade, in the contrast of a slide.
                display: Display {
                    tone_curve: ToneCurve::Aces,
                    ..opened(1.1)
                },
                ..Scene::default()
            },
        },
        Preset {
            name: "ridge-and-clouds",
            title: "Ridge and clouds",
            description: "Heaps of cloud among the summits; their shadows lie on the slopes and in the valleys.",
            scene: Scene {
                camera: standing([-9_000.0, -3_000.0, 3_300.0], normal(60.0, -11.0)),
                sun: sun(150.0, 42.0),
                clouds: Some(clouds(0.35, vec![Layer::Volume(volume(2_000.0, 2_800.0, 0.8))])),
                display: opened(0.4),
                terrain: Some(Terrain::Heightfield(alps())),
                ..Scene::default()
            },
        },
        Preset {
            name: "sea-of-cloud",
            title: "Sea of cloud",
            description: "A valley filled with cloud under the ridges that hold it in.",
            scene: Scene {
                camera: standing([-9_000.0, -3_000.0, 2_300.0], normal(60.0, -7.0)),
                sun: sun(170.0, 30.0),
                clouds: Some(clouds(0.45, vec![Layer::Volume(volume(700.0, 1_300.0, 0.4))])),
                display: opened(0.7),
                terrain: Some(Terrain::Heightfield(alps())),
                ..Scene::default()
            },
        },
        Preset {
            name: "coast",
            title: "Coast",
            description: "The evening sun glitters on the sea before a range of hills.",
            scene: Scene {
                camera: from(60.0, looking(290.0, 2.0)),
                sun: sun(278.0, 13.0),
                planet: sea(6.0),
                clouds: Some(clouds(0.3, vec![Layer::Volume(volume(1_200.0, 2_200.0, 0.7))])),
                terrain: Some(Terrain::Heightfield(Heightfield {
                    mountains: Some(Mountains {
                        seed: 12,
                        ridge_scale_m: 5_000.0,
                        roughness: 0.4,
                        valley_radius_m: 3_000.0,
                        ..Mountains::default()
                    }),
                    extent_m: Some(22_000.0),
                    height_m: Some(900.0),
                    // So that the sea covers the lowest fifth, with an uneven shore.
                    base_m: -180.0,
                    centre_m: [-6_000.0, 13_000.0],
                    edge_fade: 0.6,
                    ..Heightfield::default()
                })),
                ..Scene::default()
            },
        },
        Preset {
            name: "orbit-terminator",
            title: "Over the terminator",
            description: "From 400 km up along the line of dusk: day at the left, night at the right, clouds reddened \
                          between.",
            scene: Scene {
                camera: Camera {
                    projection: Projection::Perspective {
                        vertical_fov_deg: 55.0,
                    },
                    ..from(400_000.0, looking(0.0, -28.0))
                },
                sun: sun(268.0, 1.0),
                planet: sea(7.0),
                clouds: Some(clouds(0.45, vec![Layer::Volume(volume(1_500.0, 6_000.0, 0.7))])),
                ..Scene::default()
            },
        },
    ]
}

fn alps() -> Heightfield {
    Heightfield {
        mountains: Some(Mountains {
            seed: 3,
            ..Mountains::default()
        }),
        extent_m: Some(60_000.0),
        height_m: Some(2_800.0),
        surface: Surface {
            albedo: GroundAlbedo::Bands(SurfaceBands {
                grass_line_m: 1_200.0,
                snow_line_m: 1_600.0,
                ..SurfaceBands::default()
            }),
            ..Surface::default()
        },
        shadow: Some(Shadow::Map(ShadowMap {
            size_px: 4096,
            filter: ShadowFilter::Gaussian,
        })),
        ..Heightfield::default()
    }
}

fn sea(wind_m_s: f64) -> Planet {
    Planet {
        ground_albedo: SEA,
        surface: SphereSurface::Water(Water { wind_m_s }),
        ..Planet::default()
    }
}

fn from(height_m: f64, camera: Camera) -> Camera {
    standing([0.0, 0.0, height_m], camera)
}

fn standing(position_m: [f64; 3], camera: Camera) -> Camera {
    Camera { position_m, ..camera }
}

/// So many stops more light than the meter says.
fn opened(compensation_ev: f64) -> Display {
    Display {
        exposure: Exposure::Auto { compensation_ev },
        ..Display::default()
    }
}

/// Narrower than [`looking`]: far mountains are large.
fn normal(azimuth_deg: f64, elevation_deg: f64) -> Camera {
    Camera {
        projection: Projection::Perspective {
            vertical_fov_deg: 50.0,
        },
        ..looking(azimuth_deg, elevation_deg)
    }
}
