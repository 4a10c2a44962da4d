//! Mountains, a coast, and the planet from above.

use super::{Preset, clouds, looking, sun, volume};
use crate::{
    camera::{Camera, Projection},
    clouds::Layer,
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
            description: "From the floor of a valley towards a sun that comes over the ridges: shafts in the haze.",
            scene: Scene {
                camera: looking(95.0, 9.0),
                sun: sun(98.0, 11.0),
                haze: Some(Haze {
                    visibility_m: Some(35_000.0),
                    top_m: 1_500.0,
                    ..Haze::default()
                }),
                terrain: Some(Terrain::Heightfield(alps())),
                ..Scene::default()
            },
        },
        Preset {
            name: "ridge-and-clouds",
            title: "Ridge and clouds",
            description: "Above a sea of cloud from which summits rise; their shadows lie on it, and its own on them.",
            scene: Scene {
                camera: from(2_900.0, looking(330.0, -7.0)),
                sun: sun(255.0, 24.0),
                clouds: Some(clouds(0.6, vec![Layer::Volume(volume(1_100.0, 1_900.0, 0.5))])),
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
    Camera {
        position_m: [0.0, 0.0, height_m],
        ..camera
    }
}
