//! Pillars of light.

use super::{Preset, looking, sun};
use crate::{
    camera::{Camera, Projection},
    direction::Direction,
    display::{Display, Exposure},
    document::Scene,
    ice_crystals::{CrystalLayer, CrystalVariation, GaussianTilt, IceCrystals, Tilt},
    lights::{Above, Lamp, Light, ProceduralTown, Town},
    moon::Moon,
    planet::Planet,
    terrain::{GroundAlbedo, Heightfield, Mountains, PlainAlbedo, Surface, Terrain},
};

/// Fresh snow.
const SNOW: [f64; 3] = [0.82, 0.85, 0.9];

pub(super) fn presets() -> Vec<Preset> {
    vec![
        Preset {
            name: "arctic-town",
            title: "Arctic town",
            description: "A town of 300 lamps at -20 °C under a clear night sky: plates of ice raise a pillar over each.",
            scene: Scene {
                camera: from(25.0, lens(45.0, looking(0.0, 12.0))),
                sun: sun(330.0, -25.0),
                moon: Some(crescent()),
                planet: snowy(),
                terrain: Some(Terrain::Heightfield(hills())),
                town: Some(Town::Procedural(ProceduralTown {
                    centre_m: [0.0, 3_600.0],
                    radius_m: 1_500.0,
                    above: Above::Ground,
                    luminous_intensity_cd: 1_500.0,
                    ..ProceduralTown::default()
                })),
                ice_crystals: Some(IceCrystals::One(CrystalLayer {
                    top_m: 500.0,
                    number_density_per_m3: 60_000.0,
                    extinction_per_m: 1.2e-4,
                    tilt: spread(0.9),
                    variation: Some(CrystalVariation {
                        amount: 0.4,
                        ..CrystalVariation::default()
                    }),
                    ..CrystalLayer::default()
                })),
                display: night(-3.5),
                ..Scene::clear()
            },
        },
        Preset {
            name: "candle-pillars",
            title: "Candle pillars",
            description: "Twelve great candles on the snow a hundred metres off, each under a thread of its own light.",
            scene: Scene {
                camera: lens(50.0, looking(0.0, 14.0)),
                sun: sun(330.0, -30.0),
                moon: Some(crescent()),
                planet: snowy(),
                lights: (0..12).map(candle).collect(),
                ice_crystals: Some(IceCrystals::One(CrystalLayer {
                    top_m: 150.0,
                    number_density_per_m3: 60_000.0,
                    tilt: spread(1.0),
                    ..CrystalLayer::default()
                })),
                display: night(-2.5),
                ..Scene::clear()
            },
        },
        Preset {
            name: "sun-pillar",
            title: "Sun pillar",
            description: "The sun has just set, and plates of ice high in the air hold up its last light.",
            scene: Scene {
                camera: lens(40.0, looking(250.0, 11.0)),
                sun: sun(250.0, -1.0),
                planet: snowy(),
                ice_crystals: Some(IceCrystals::One(CrystalLayer {
                    base_m: 2_500.0,
                    top_m: 5_000.0,
                    number_density_per_m3: 2_500.0,
                    plate_area_m2: 2e-8,
                    extinction_per_m: 2e-5,
                    tilt: spread(1.8),
                    ..CrystalLayer::default()
                })),
                ..Scene::clear()
            },
        },
    ]
}

fn snowy() -> Planet {
    Planet {
        ground_albedo: SNOW,
        ..Planet::default()
    }
}

/// Behind the camera: enough for snow and hills to be seen.
fn crescent() -> Moon {
    Moon {
        position: Some(Direction::angles(200.0, 30.0)),
        phase_angle_deg: Some(110.0),
        ..Moon::default()
    }
}

fn spread(sigma_deg: f64) -> Tilt {
    Tilt::Gaussian(GaussianTilt {
        sigma_deg,
        max_deg: 4.0 * sigma_deg,
    })
}

fn night(ev: f64) -> Display {
    Display {
        exposure: Exposure::Ev { ev },
        white_balance_k: 4_200.0,
        ..Display::default()
    }
}

fn lens(vertical_fov_deg: f64, camera: Camera) -> Camera {
    Camera {
        projection: Projection::Perspective { vertical_fov_deg },
        ..camera
    }
}

fn from(height_m: f64, camera: Camera) -> Camera {
    Camera {
        position_m: [0.0, 0.0, height_m],
        ..camera
    }
}

/// In two uneven rows.
fn candle(i: u8) -> Light {
    let i = f64::from(i);
    Light {
        position_m: [
            13.0 * (i - 5.5) + 3.0 * (2.3 * i).sin(),
            110.0 + 22.0 * (1.7 * i).sin(),
            0.3,
        ],
        lamp: Some(Lamp::Candle),
        luminous_intensity_cd: Some(40.0),
        radius_m: 0.02,
        ..Light::default()
    }
}

/// Low and snowy, about the town and behind it.
fn hills() -> Heightfield {
    Heightfield {
        mountains: Some(Mountains {
            seed: 2,
            ridge_scale_m: 2_500.0,
            roughness: 0.3,
            valley_radius_m: 1_500.0,
            ..Mountains::default()
        }),
        extent_m: Some(24_000.0),
        height_m: Some(300.0),
        surface: Surface {
            albedo: GroundAlbedo::Plain(PlainAlbedo { rgb: SNOW }),
            ..Surface::default()
        },
        ..Heightfield::default()
    }
}
